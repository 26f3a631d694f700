//! The truth about heat: a temperature given by a formula, held against the heat equation.

mod check;
mod field;
mod problem;
#[cfg(test)]
mod tests;

pub use field::{Temperature, TemperatureDerivatives};
pub use problem::HeatForcing;
pub use problem::source_at;
pub use problem::{Conduction, HeatFace};
pub use problem::{HeatFacePoint, ThermalCondition};
