//! Traits of loads. The implementations are in the other files of this folder.

use super::name::EffectName;
use crate::exact::heat::Conduction;
use crate::exact::{Condition, Term};
use crate::fem::TimeFunction;
use crate::mpm::input::EffectInput;
use crate::suite::scene::boundary::thermal::SceneHeat;
use crate::suite::scene::numbers::LoadNumbers;
use std::ops::Deref;
use std::sync::Arc;

/// Part of the scene on which a load acts. Solvers apply loads in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum LoadTarget {
    Body,
    /// A face, given by its number.
    Face(usize),
    /// A rim of a round body, given by its index in [`Outline::rims`](crate::exact::Outline::rims).
    Rim(usize),
    /// A particle set, given by its index.
    Set(usize),
}

impl LoadTarget {
    pub(crate) fn face(self) -> Option<usize> {
        match self {
            Self::Face(number) => Some(number),
            Self::Body | Self::Rim(_) | Self::Set(_) => None,
        }
    }
}

pub(crate) struct BodySite<'a> {
    pub(crate) dimension: usize,
    /// The heat problem that the exact temperature solves.
    pub(crate) heat: Option<&'a Conduction>,
}

/// A load or effect of a scene, with all numbers computed.
pub(crate) trait SceneLoad: Term + 'static {
    fn input(&self, site: &BodySite<'_>) -> EffectInput;

    fn target(&self) -> LoadTarget {
        LoadTarget::Body
    }

    /// Returns the numbers for external solvers; empty if the protocol does not support the load.
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::default()
    }

    fn rows(&self) -> Vec<(String, String)>;

    /// Returns the boundary condition of the exact solution that the load imposes on its face.
    fn condition(self: Arc<Self>) -> Option<Arc<dyn Condition>> {
        None
    }

    /// Returns the tension (Pa), as a function of t, at the end `x` (m) of a bar. `outwards` is the
    /// sign of the outward normal.
    fn tension(&self, _x: f64, _outwards: f64) -> Option<TimeFunction> {
        None
    }

    /// Returns the force per reference area (Pa) for `values` of the coordinates and t; empty if
    /// the load does not act on a face.
    fn traction(&self, _values: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    fn heat(&self) -> Option<&SceneHeat> {
        None
    }

    /// Whether the load moves a stress-free body at rest, or damps its motion.
    fn disturbs_rest(&self) -> bool {
        true
    }
}

#[derive(Debug, Clone)]
pub(crate) struct ListedLoad {
    pub(crate) effect: EffectName,
    pub(crate) load: Arc<dyn SceneLoad>,
}

impl Deref for ListedLoad {
    type Target = dyn SceneLoad;

    fn deref(&self) -> &Self::Target {
        self.load.as_ref()
    }
}
