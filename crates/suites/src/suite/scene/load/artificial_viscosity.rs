//! Artificial viscosity: a pressure that resists compression, for shocks.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::Term;
use crate::mpm::ArtificialViscosity;
use crate::mpm::input::EffectInput;
use crate::subject::PlaneState;
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Coefficients of the artificial viscosity.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ViscositySpec {
    /// Coefficient c1 of `rho h abs(tr D) c1 c`.
    linear: NumberText,
    /// Coefficient c2 of `rho h^2 (tr D)^2 c2`.
    quadratic: NumberText,
}

impl LoadKeys for ViscositySpec {
    fn example(_: &str) -> String {
        "{linear: s, quadratic: s}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("artificial viscosity")?;
        let coefficient = |key: &str, text: &NumberText| {
            entry.path.then(key).zero_or_positive(text, "a coefficient of viscosity")
        };
        Ok(Arc::new(ViscosityLoad {
            linear: coefficient("linear", &self.linear)?,
            quadratic: coefficient("quadratic", &self.quadratic)?,
            speed: entry.scene.wave_speed(),
        }))
    }

    fn against_plane(&self, plane: PlaneState) -> Option<&'static str> {
        let reason = "it is a pressure on all axes";
        (plane != PlaneState::Strain).then_some(reason)
    }

    fn lacked_by_fem(&self) -> Option<&'static str> {
        Some("artificial viscosity")
    }
}

/// Coefficients of the linear and the quadratic term, and the wave speed in the body at rest (m/s).
#[derive(Debug)]
struct ViscosityLoad {
    linear: f64,
    quadratic: f64,
    speed: f64,
}

/// Artificial viscosity is part of the method, so it adds no term to the equation of motion.
impl Term for ViscosityLoad {}

impl SceneLoad for ViscosityLoad {
    fn numbers(&self) -> LoadNumbers {
        let Self { linear, quadratic, speed } = *self;
        LoadNumbers::constants(&[
            ("linear", linear),
            ("quadratic", quadratic),
            ("wave_speed", speed),
        ])
    }

    fn rows(&self) -> Vec<(String, String)> {
        let Self { linear, quadratic, .. } = self;
        let text = format!("linear coefficient {linear}, quadratic coefficient {quadratic}");
        vec![("artificial viscosity".to_owned(), text)]
    }

    fn disturbs_rest(&self) -> bool {
        false
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let Self { linear, quadratic, speed } = *self;
        // The solver uses the cell size as length.
        let viscosity =
            ArtificialViscosity { linear, quadratic, length: 0.0, speed, q: Vec::new() };
        EffectInput::ArtificialViscosity(viscosity)
    }
}
