//! Constitutive laws of exact solutions, implemented independently of the solvers. Each law has a
//! file and a line of `laws!`.

mod contract;
#[cfg(test)]
mod energy;
mod registry;
mod simple_shear;
/// The law that `docs/exercises/material.md` adds.
#[cfg(test)]
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../../../tests/exercises/st_venant_kirchhoff_law.rs"]
mod st_venant_kirchhoff_law;
mod uniaxial_flow;

use super::formula::Number;
use super::tensor::Tensor;
use contract::ConstitutiveLaw;
use registry::laws;
pub(super) use uniaxial_flow::strained_axis;

laws! {
    "linear_elastic" => small_strain::SmallStrainLaw["young", "poisson"];
    "jaumann" => jaumann::JaumannLaw["young", "poisson"];
    "green_naghdi" => green_naghdi::GreenNaghdiLaw["young", "poisson"];
    "neo_hookean" => neo_hookean::NeoHookeanLaw["young", "poisson"];
    "hencky" => hencky::HenckyLaw["young", "poisson"];
    "corotated" => corotated::CorotatedLaw["young", "poisson"];
    "j2" => j2::J2Law["young", "poisson", "yield", "hardening"];
    "drucker_prager" => drucker_prager::DruckerPragerLaw[
        "young", "poisson", "friction", "dilation", "strength"
    ];
    "mohr_coulomb" => mohr_coulomb::MohrCoulombLaw[
        "young", "poisson", "friction_angle", "dilation_angle", "cohesion"
    ];
    "cam_clay" => cam_clay::CamClayLaw[
        "critical_state_slope", "swelling_slope", "compression_slope", "poisson", "initial_pressure", "preconsolidation"
    ];
    "newtonian" => tait::TaitLaw["bulk", "viscosity"];
    "linear_fluid" => linear_fluid::LinearFluidLaw["bulk"];
    "polytropic" => polytropic::PolytropicLaw["stiffness", "exponent"];
}
