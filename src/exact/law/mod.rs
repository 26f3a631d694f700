//! Constitutive laws of exact solutions, implemented independently of the solvers. A new law needs
//! a file in this folder and a line in `members`.

mod contract;
#[cfg(test)]
mod energy;
mod registry;
mod simple_shear;
/// The law that `docs/exercises/material.md` adds.
#[cfg(test)]
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../tests/exercises/st_venant_kirchhoff_law.rs"]
mod st_venant_kirchhoff_law;
mod uniaxial_flow;

use super::formula::Number;
use super::tensor::Tensor;
use crate::members::each_material;
use contract::ConstitutiveLaw;
use registry::laws;
pub(super) use uniaxial_flow::strained_axis;

each_material!(laws);
