//! Exact solutions, and the check that they solve their problems.
//!
//! A suite gives its solution as formulas ([`formula`]), and its problem becomes a [`Problem`].
//! [`check`](Problem::check) substitutes the formulas into it before any solver runs.

pub(crate) mod bisection;
mod check;
mod condition;
mod correction;
mod density;
mod equation;
mod expansion;
pub mod formula;
mod gauss;
pub mod heat;
mod initial_stress;
pub mod law;
mod motion;
mod outline;
mod parametric_motion;
mod problem;
mod random;
mod shared_values;
mod sum;
mod tensor;
mod term;
mod truth;
mod violation;

#[cfg(test)]
pub(crate) mod tests;

pub use check::interface::Interface;
pub use condition::{Condition, FacePoint};
pub use density::Density;
pub use expansion::Expansion;
pub use gauss::CellQuadrature;
pub use law::{Equation, HenckyLaw, NeoHookeanLaw};
pub use motion::{Derivatives, Motion};
pub use outline::{Circle, Outline, Piece, Polygon};
pub use problem::{Forcing, Linearised, Problem};
pub use sum::BodySum;
pub use term::{Region, Term};
pub use truth::Truth;
pub use violation::Violation;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    check::interface::meets,
    check::survey::{Magnitudes, Survey},
    condition::Face,
    correction::FirstCorrection,
    density::NoDensity,
    initial_stress::InitialStress,
    law::SmallStrainLaw,
    motion::{Places, variables},
    outline::{Cut, Round, join_small},
    parametric_motion::{ParametricMotion, ParametricState},
    random::Random,
    shared_values::SharedValues,
    sum::{SumDensity, SumError, SumPoint, SumRegion},
};
