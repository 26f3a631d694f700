//! Registry of the materials. A new material requires one file and one line of `materials!`. A new
//! parameter requires one more line at the end of this file.

mod axisymmetric;
#[cfg(test)]
mod clay_paths;
mod contract;
mod hyperelastic;
#[cfg(test)]
mod laws;
mod plane_stress;
mod plastic_flow;
mod prestressed;
#[cfg(test)]
mod rate_paths;
mod registry;
#[cfg(test)]
mod specimen;
mod spectral;
mod stress_update;
mod stretch;
mod tangent;

use axisymmetric::Axisymmetric;
pub use contract::{Contradiction, Material, MaterialProperties, YieldFunction};
use mpm_subject::PlaneState;
pub use plastic_flow::ElastoPlastic;
pub use prestressed::Prestressed;
use registry::materials;
pub use stress_update::{StressBlock, StressUpdate};
pub use tangent::StressResponse;

materials! {
    "linear_elastic" => linear_elastic::LinearElastic { young: YOUNG, poisson: POISSON };
    "jaumann" => jaumann::Jaumann { young: YOUNG, poisson: POISSON };
    "green_naghdi" => green_naghdi::GreenNaghdi { young: YOUNG, poisson: POISSON };
    "neo_hookean" => neo_hookean::NeoHookean { young: YOUNG, poisson: POISSON };
    "hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON };
    "corotated" => corotated::Corotated { young: YOUNG, poisson: POISSON };
    "j2" => j2::J2 {
        young: YOUNG, poisson: POISSON, r#yield: YIELD, #[serde(default)] hardening: HARDENING
    };
    "drucker_prager" => drucker_prager::DruckerPrager {
        young: YOUNG, poisson: POISSON, friction: FRICTION, dilation: DILATION, strength: STRENGTH
    };
    "mohr_coulomb" => mohr_coulomb::MohrCoulomb {
        young: YOUNG, poisson: POISSON, friction_angle: FRICTION_ANGLE,
        dilation_angle: DILATION_ANGLE, cohesion: COHESION
    };
    "cam_clay" => cam_clay::CamClay {
        critical_state_slope: CRITICAL_SLOPE, swelling_slope: SWELLING,
        compression_slope: COMPRESSION, poisson: POISSON,
        initial_pressure: INITIAL_PRESSURE, preconsolidation: PRECONSOLIDATION
    };
    "newtonian" => newtonian::Newtonian { bulk: BULK, viscosity: VISCOSITY };
    "linear_fluid" => linear_fluid::LinearFluid { bulk: BULK };
    "polytropic" => polytropic::Polytropic { stiffness: STIFFNESS, exponent: EXPONENT };
    "rigid" => rigid::Rigid {};
}

impl MaterialPlan {
    /// Creates the material for a body with this out-of-plane state; `None` if the law does not
    /// support this state.
    pub fn in_plane<const D: usize>(&self, plane: PlaneState) -> Option<Box<dyn Material<D>>> {
        match plane {
            PlaneState::Strain => Some(self.build()),
            PlaneState::Stress => self.build().in_plane_stress(),
            PlaneState::Axisymmetric => Some(Box::new(Axisymmetric::new(self.build()))),
        }
    }

    /// Whether the law supports this state of two-dimensional bodies.
    pub fn supports(&self, plane: PlaneState) -> bool {
        self.in_plane::<2>(plane).is_some()
    }

    /// Returns Young's modulus (Pa) and Poisson's ratio; `None` for a material without these
    /// parameters.
    pub fn elasticity(&self) -> Option<(f64, f64)> {
        Some((self.parameter("young")?, self.parameter("poisson")?))
    }
}

/// A material parameter in a suite file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MaterialParameter {
    /// Name of the parameter in messages, such as `Young's modulus`.
    pub what: &'static str,
    /// Symbol of the parameter in reports, such as `E`.
    pub symbol: &'static str,
    /// Unit of the parameter; empty for a ratio.
    pub unit: &'static str,
    /// Range of valid values.
    pub range: Range,
}

/// Range of the valid values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Above one.
    AboveOne,
    /// Above -1 and below 1/2: an isotropic solid is then stable and compressible.
    PoissonsRatio,
    /// Zero or above, and below 90 (degrees).
    Angle,
}

const fn parameter(
    what: &'static str,
    symbol: &'static str,
    unit: &'static str,
    range: Range,
) -> MaterialParameter {
    MaterialParameter { what, symbol, unit, range }
}

const YOUNG: MaterialParameter = parameter("Young's modulus", "E", "Pa", Range::Positive);
const POISSON: MaterialParameter = parameter("Poisson's ratio", "nu", "", Range::PoissonsRatio);
const YIELD: MaterialParameter = parameter("the yield stress", "Y", "Pa", Range::Positive);
const HARDENING: MaterialParameter =
    parameter("the hardening modulus", "H", "Pa", Range::NotNegative);
const FRICTION: MaterialParameter =
    parameter("the coefficient of friction", "eta", "", Range::NotNegative);
const DILATION: MaterialParameter =
    parameter("the coefficient of dilation", "etab", "", Range::NotNegative);
const STRENGTH: MaterialParameter =
    parameter("the strength without mean stress", "k", "Pa", Range::NotNegative);
const FRICTION_ANGLE: MaterialParameter =
    parameter("the friction angle", "phi", "degrees", Range::Angle);
const DILATION_ANGLE: MaterialParameter =
    parameter("the dilation angle", "psi", "degrees", Range::Angle);
const COHESION: MaterialParameter = parameter("the cohesion", "c", "Pa", Range::NotNegative);
const CRITICAL_SLOPE: MaterialParameter =
    parameter("the slope of the critical-state line", "M", "", Range::Positive);
const SWELLING: MaterialParameter =
    parameter("the slope of swelling", "kappa", "", Range::Positive);
const COMPRESSION: MaterialParameter =
    parameter("the slope of compression", "lambda", "", Range::Positive);
const INITIAL_PRESSURE: MaterialParameter =
    parameter("the initial pressure", "p0", "Pa", Range::Positive);
const PRECONSOLIDATION: MaterialParameter =
    parameter("the preconsolidation pressure", "pc", "Pa", Range::Positive);
const BULK: MaterialParameter = parameter("the bulk modulus", "K", "Pa", Range::Positive);
const VISCOSITY: MaterialParameter = parameter("the viscosity", "eta", "Pa s", Range::NotNegative);
const STIFFNESS: MaterialParameter =
    parameter("the stiffness", "K", "Pa (m3/kg)^g", Range::Positive);
const EXPONENT: MaterialParameter = parameter("the exponent", "g", "", Range::AboveOne);
