//! A traction on a face of a box.

use super::contract::{BodySite, LoadTarget, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, LoadedFace};
use crate::exact::formula::Formula;
use crate::exact::{Condition, FacePoint, Term, Violation};
use crate::fem::TimeFunction;
use crate::mpm::Placement;
use crate::mpm::input::EffectInput;
#[cfg(feature = "schemas")]
use crate::suite::scene::face::face_name;
use crate::suite::scene::numbers::{LoadNumbers, of_place_and_time, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Force per reference area on one face (Pa), formulas of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TractionSpec {
    /// Face on which the traction acts.
    #[cfg_attr(feature = "schemas", schemars(schema_with = "face_name"))]
    on: String,
    /// Force per reference area (Pa), formulas of the coordinates and `t`.
    value: Vec<NumberText>,
    /// Where the traction acts; by default at the outermost particles.
    at: Option<Placement>,
}

impl LoadKeys for TractionSpec {
    fn example(vector: &str) -> String {
        format!("{{on: right, value: {vector}}}")
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        Ok(Arc::new(TractionLoad {
            face: entry.free_face(&self.on)?,
            value: entry.path.then("value").fields(&self.value, entry.dimension())?,
            placement: self.at.unwrap_or_default(),
        }))
    }

    fn face(&self) -> Option<&str> {
        Some(&self.on)
    }
}

#[derive(Debug)]
struct TractionLoad {
    face: LoadedFace,
    value: Vec<Formula>,
    placement: Placement,
}

impl Term for TractionLoad {}

/// Requires `P n = p0(X, t)`.
impl Condition for TractionLoad {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        let pulled = |i| point.traction(i, "loaded", point.value(&self.value[i]));
        (0..point.dimension()).try_for_each(pulled)
    }
}

impl SceneLoad for TractionLoad {
    fn target(&self) -> LoadTarget {
        LoadTarget::Face(self.face.number)
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("traction", &self.value)
    }

    fn rows(&self) -> Vec<(String, String)> {
        let traction = format!("traction = {}", value_with_unit(&self.value, "Pa"));
        vec![self.face.row(&traction, self.placement)]
    }

    fn condition(self: Arc<Self>) -> Option<Arc<dyn Condition>> {
        Some(self)
    }

    fn traction(&self, values: &[f64]) -> Vec<f64> {
        self.value.iter().map(|component| component.eval(values)).collect()
    }

    fn tension(&self, x: f64, outwards: f64) -> Option<TimeFunction> {
        let value = self.value.first()?.clone();
        Some(Box::new(move |t| outwards * value.eval(&[x, t])))
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let value = Box::new(of_place_and_time(&self.value));
        EffectInput::Traction { face: self.face.place(), placement: self.placement, value }
    }
}
