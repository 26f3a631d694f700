//! Constitutive laws as the truth knows them, written apart from those of the solvers: the family.
//! A member is one file, its `mod` and one line below.

mod contract;
#[cfg(test)]
mod energy;
mod hencky;
mod j2;
mod neo_hookean;
mod registry;
mod small_strain;
mod tait;

use super::formula::Number;
use super::tensor::Tensor;
use contract::ConstitutiveLaw;
use registry::laws;

laws! {
    "linear_elastic" => small_strain::SmallStrainLaw("young", "poisson"),
    "neo_hookean" => neo_hookean::NeoHookeanLaw("young", "poisson"),
    "hencky" => hencky::HenckyLaw("young", "poisson"),
    "j2" => j2::J2Law("young", "poisson", "yield", "hardening"),
    "newtonian" => tait::TaitLaw("bulk", "viscosity"),
}
