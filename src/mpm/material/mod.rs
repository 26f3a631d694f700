//! Materials: the family. A member is one file, its `mod` and one line below; a parameter that no
//! other material has is one line in `parameter`. The truth's law of a material is a member of
//! the family in `exact/law`.

#[cfg(test)]
mod closed_forms;
mod contract;
mod hencky;
mod j2;
#[cfg(test)]
mod laws;
mod linear_elastic;
mod neo_hookean;
mod newtonian;
mod parameter;
mod registry;
mod rigid;
#[cfg(test)]
mod specimen;
mod spectral;

#[cfg(test)]
use contract::ClosedForms;
pub use contract::{Material, MaterialProperties};
pub use parameter::{MaterialParameter, Range};

use parameter::{BULK, DENSITY, HARDENING, POISSON, VISCOSITY, YIELD, YOUNG};
use registry::{key, materials};

materials! {
    "linear_elastic" => linear_elastic::LinearElastic { young: YOUNG, poisson: POISSON },
    "neo_hookean" => neo_hookean::NeoHookean { young: YOUNG, poisson: POISSON },
    "hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON },
    "j2" => j2::J2 { young: YOUNG, poisson: POISSON, r#yield: YIELD, #[serde(default)] hardening: HARDENING },
    "newtonian" => newtonian::Newtonian { bulk: BULK, viscosity: VISCOSITY },
    "rigid" => rigid::Rigid {},
}

impl MaterialPlan {
    /// Young's modulus (Pa) and Poisson's ratio of a solid.
    pub fn elasticity(&self) -> Option<(f64, f64)> {
        Some((self.parameter("young")?, self.parameter("poisson")?))
    }
}
