//! Conduction of heat in a scene.

use crate::exact::formula::Formula;
use crate::exact::heat::HeatFace;

/// Conduction of heat, with every number computed.
#[derive(Debug, Clone)]
pub struct SceneHeat {
    /// k (W/(m K), per m^(3-D)).
    pub conductivity: f64,
    /// c (J/(kg K)).
    pub capacity: f64,
    /// Heat that arises (W/kg), a formula of the coordinates and t.
    pub source: Option<Formula>,
    /// Initial temperature (K), a formula of the coordinates and t; not stated, that of the truth.
    pub initial: Option<Formula>,
    /// Every face of the body.
    pub faces: Vec<HeatFace>,
}
