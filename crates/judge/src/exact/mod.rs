//! Exact solutions, and the check that they solve their problems.
//!
//! A suite gives its solution as formulas ([`formula`]). Its continuum problem becomes a
//! [`Problem`]. [`check`](Problem::check) substitutes the formulas into the problem before any
//! solver runs. The module imports no solver.

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

pub use check::interface::{Interface, meets};
pub use check::survey::{Magnitudes, Survey};
pub use condition::{Condition, Face, FacePoint};
pub use correction::FirstCorrection;
pub use density::{Density, NoDensity};
pub use expansion::Expansion;
pub use gauss::CellQuadrature;
pub use initial_stress::InitialStress;
pub use law::{Equation, HenckyLaw, NeoHookeanLaw, SmallStrainLaw};
pub use motion::{Derivatives, Motion, Places, variables};
pub use outline::{Circle, Cut, Outline, Piece, Polygon, Round, join_small};
pub use parametric_motion::{ParametricMotion, ParametricState};
pub use problem::{Forcing, Linearised, Problem};
pub use random::Random;
pub use shared_values::SharedValues;
pub use sum::{BodySum, SumDensity, SumError, SumPoint, SumRegion};
pub use term::{Region, Term};
pub use truth::Truth;
pub use violation::Violation;
