//! The truth about heat: a temperature given by a formula, held against the heat equation.

mod check;
mod condition;
mod equation;
mod field;
mod forcing;
mod magnitudes;
mod problem;
mod source;
#[cfg(test)]
mod tests;
mod weak;

pub use condition::{HeatFacePoint, ThermalCondition};
pub use field::{Temperature, TemperatureDerivatives};
pub use forcing::HeatForcing;
pub use problem::{Conduction, HeatFace};
pub use source::source_at;
