//! The truth about heat: a temperature given by a formula, held against the heat equation.

mod check;
mod field;
mod problem;
#[cfg(test)]
mod tests;

pub use field::{Temperature, TemperatureDerivatives};
pub use problem::{Conduction, HeatFace, HeatFacePoint, HeatForcing, ThermalCondition, source_at};
