//! A total force on a set of particles.

use super::contract::{BodySite, LoadTarget, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, LoadedSet};
use crate::exact::Term;
use crate::exact::formula::Formula;
use crate::mpm::input::EffectInput;
use crate::subject::PlaneState;
use crate::suite::scene::numbers::{LoadNumbers, of_time, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Total force on a set (N), formulas of t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SetForceSpec {
    /// Name of the set.
    on: String,
    /// Total force (N), formulas of `t`.
    value: Vec<NumberText>,
}

impl LoadKeys for SetForceSpec {
    fn example(vector: &str) -> String {
        format!("{{on: some, value: {vector}}}")
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        let (set, scene) = (entry.free_set(&self.on)?, entry.scene);
        let (from, to) = set.region.within(&scene.from, &scene.to);
        let of_box = || from.iter().zip(&to).map(|(from, to)| to - from).product();
        let volume = scene.outline.as_ref().map_or_else(of_box, |o| o.volume_within(&from, &to));
        Ok(Arc::new(SetForceLoad {
            value: entry.path.then("value").vector(&self.value, entry.dimension(), &["t"])?,
            volume,
            // A varying density is refused in `compile::scene::density`.
            density: scene.density.largest(),
            set,
        }))
    }

    fn against_plane(&self, plane: PlaneState) -> Option<&'static str> {
        let reason = "it is not defined for a body of revolution";
        (plane == PlaneState::Axisymmetric).then_some(reason)
    }
}

/// Total force on the set (N, per m^(3-D) of thickness): one formula of t for each component.
#[derive(Debug)]
struct SetForceLoad {
    set: LoadedSet,
    value: Vec<Formula>,
    /// Volume of the set within the body (m^D).
    volume: f64,
    /// Density of the body (kg/m3).
    density: f64,
}

/// The force f on a set of volume V is a body force `f/(rho0 V)` in the set.
impl Term for SetForceLoad {
    fn stated(&self, i: usize, label: &[f64], t: f64, _: &[f64; 3]) -> f64 {
        if !self.set.region.holds(label) {
            return 0.0;
        }
        self.value.get(i).map_or(0.0, |formula| formula.eval(&[t])) / self.volume / self.density
    }
}

impl SceneLoad for SetForceLoad {
    fn target(&self) -> LoadTarget {
        LoadTarget::Set(self.set.number)
    }

    fn numbers(&self) -> LoadNumbers {
        let numbers = LoadNumbers::vector("force", &self.value).on(&self.set.region);
        LoadNumbers { constants: vec![("volume", self.volume)], ..numbers }
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![self.set.row(&format!("total force = {}", value_with_unit(&self.value, "N")))]
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        EffectInput::SetForce(self.set.input(), of_time(&self.value))
    }
}
