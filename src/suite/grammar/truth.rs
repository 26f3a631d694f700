//! The words of a truth that is given by formulas.

use crate::{named::named, suite::yaml::NumberText};
use serde::Deserialize;

/// A solution, or the state in which the body comes to rest.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExactSpec {
    /// Both together, of a body that moves.
    pub(crate) equation: Option<EquationName>,
    pub(crate) displacement: Option<Vec<NumberText>>,
    /// Of a body in which heat flows.
    pub(crate) temperature: Option<NumberText>,
    pub(crate) tolerance: Option<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ManufacturedSpec {
    pub(crate) displacement: Option<Vec<NumberText>>,
    pub(crate) temperature: Option<NumberText>,
}

named! {
    /// Equations of motion, by their law between stress and strain.
    pub enum EquationName {
        /// `P = E u_X`: the linear problem of the talk.
        SmallStrain = "small_strain",
        /// `P = E ln F`: what the rate form of the original MPM integrates to in 1-D.
        LogStrain = "log_strain",
        /// `P = lambda ln(J) F^-T + mu (F - F^-T)`.
        NeoHookean = "neo_hookean",
        /// `P = (lambda ln(J) I + mu ln(F F^T)) F^-T`.
        Hencky = "hencky",
        /// J2 plasticity in uniaxial strain, under loading that never reverses.
        J2 = "j2",
        /// `P = -p J F^-T`, `p = K/7 (J^-7 - 1)`: a fluid at rest.
        Tait = "tait",
    }
}
