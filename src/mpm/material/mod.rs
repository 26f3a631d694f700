//! Materials: the family. A member is one file and one line below; a parameter that no other
//! material has is one line in [`parameter`].

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

pub use contract::Material;
pub use hencky::Hencky;
pub use j2::J2;
pub use linear_elastic::LinearElastic;
pub use neo_hookean::NeoHookean;
pub use newtonian::Newtonian;
pub use parameter::{Parameter, Range};
pub use rigid::Rigid;

use parameter::{BULK, DENSITY, HARDENING, POISSON, VISCOSITY, YIELD, YOUNG};
use registry::{key, materials};

materials! {
    "linear_elastic" => LinearElastic { young: YOUNG, poisson: POISSON },
    "neo_hookean" => NeoHookean { young: YOUNG, poisson: POISSON },
    "hencky" => Hencky { young: YOUNG, poisson: POISSON },
    "j2" => J2 { young: YOUNG, poisson: POISSON, r#yield: YIELD, #[serde(default)] hardening: HARDENING },
    "newtonian" => Newtonian { bulk: BULK, viscosity: VISCOSITY },
    "rigid" => Rigid {},
}

impl MaterialPlan {
    /// Young's modulus (Pa) and Poisson's ratio of a solid.
    pub fn elasticity(&self) -> Option<(f64, f64)> {
        let parameters = self.parameters();
        let value = |wanted| parameters.iter().find(|(known, _)| *known == wanted);
        Some((value(YOUNG)?.1, value(POISSON)?.1))
    }

    /// Stiffness against strain along one axis (Pa), at rest: `rho0 c^2` of the fastest wave.
    pub fn wave_modulus(&self) -> f64 {
        if let Some((young, poisson)) = self.elasticity() {
            let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
            return lambda + 2.0 * mu;
        }
        let parameters = self.parameters();
        parameters.iter().find(|(known, _)| *known == BULK).map_or(f64::NAN, |(_, bulk)| *bulk)
    }
}
