//! A prescribed velocity of a set of particles.

use super::contract::{BodySite, LoadTarget, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, LoadedSet};
use crate::exact::formula::Formula;
use crate::exact::{Region, Term};
use crate::mpm::input::EffectInput;
use crate::suite::scene::numbers::{LoadNumbers, of_place_and_time, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Velocity of a set (m/s), formulas of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SetVelocitySpec {
    /// Name of the set.
    on: String,
    /// Velocity (m/s), formulas of the coordinates and `t`.
    value: Vec<NumberText>,
}

impl LoadKeys for SetVelocitySpec {
    fn example(vector: &str) -> String {
        format!("{{on: some, value: {vector}}}")
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        Ok(Arc::new(SetVelocityLoad {
            set: entry.free_set(&self.on)?,
            value: entry.path.then("value").fields(&self.value, entry.dimension())?,
        }))
    }
}

#[derive(Debug)]
struct SetVelocityLoad {
    set: LoadedSet,
    value: Vec<Formula>,
}

impl Term for SetVelocityLoad {
    fn driven(&self) -> Option<(&Region, &[Formula])> {
        Some((&self.set.region, &self.value))
    }
}

impl SceneLoad for SetVelocityLoad {
    fn target(&self) -> LoadTarget {
        LoadTarget::Set(self.set.number)
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("velocity", &self.value).on(&self.set.region)
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![self.set.row(&format!("velocity = {}", value_with_unit(&self.value, "m/s")))]
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let value = Box::new(of_place_and_time(&self.value));
        EffectInput::PrescribedVelocity(self.set.input(), value)
    }
}
