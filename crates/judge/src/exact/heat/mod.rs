//! Exact temperature given by a formula, and its check against the heat equation.

mod check;
mod field;
mod problem;
#[cfg(test)]
mod tests;

pub use field::{Temperature, TemperatureDerivatives};
pub use problem::{Conduction, HeatFace, HeatFacePoint, HeatForcing, ThermalCondition, source_at};
