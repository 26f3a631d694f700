//! Materials: the family. A member is one file and one line of `members`; a parameter that no other
//! material has is one line in `parameter`.

mod axisymmetric;
mod contract;
mod hyperelastic;
#[cfg(test)]
mod laws;
mod parameter;
mod plane_stress;
mod plastic_flow;
mod prestressed;
mod registry;
#[cfg(test)]
mod specimen;
mod spectral;
mod stress_update;

#[cfg(test)]
use contract::ClosedForms;
pub use contract::{Material, MaterialProperties};
pub use parameter::{MaterialParameter, Range};
pub use plastic_flow::ElastoPlastic;
pub use prestressed::Prestressed;
pub use stress_update::{StressBlock, StressUpdate};

use crate::members::{each_material, key};
use crate::subject::PlaneState;
use axisymmetric::Axisymmetric;
use parameter::{
    BULK, COHESION, DENSITY, DILATION, DILATION_ANGLE, FRICTION, FRICTION_ANGLE, HARDENING,
    POISSON, STRENGTH, VISCOSITY, YIELD, YOUNG,
};
use registry::materials;

each_material!(materials);

impl MaterialPlan {
    /// The material of a body in this state across its plane; none of a law that is not known
    /// there.
    pub fn in_plane<const D: usize>(&self, plane: PlaneState) -> Option<Box<dyn Material<D>>> {
        match plane {
            PlaneState::Strain => Some(self.build()),
            PlaneState::Stress => self.build().in_plane_stress(),
            PlaneState::Axisymmetric => Some(Box::new(Axisymmetric::new(self.build()))),
        }
    }

    /// Young's modulus (Pa) and Poisson's ratio of a solid.
    pub fn elasticity(&self) -> Option<(f64, f64)> {
        Some((self.parameter("young")?, self.parameter("poisson")?))
    }
}
