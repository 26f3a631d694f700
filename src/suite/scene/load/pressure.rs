//! A pressure on a face of a box, which follows the face.

use super::contract::{BodySite, BuildEffect, BuildError, LoadTarget, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, LoadedFace};
use crate::exact::formula::Formula;
use crate::exact::{Condition, FacePoint, Term, Violation};
use crate::fem::TimeFunction;
use crate::mpm::{Effect, Placement, Pressure, Side};
#[cfg(feature = "schemas")]
use crate::suite::scene::face::face_name;
use crate::suite::scene::numbers::{LoadNumbers, scalar};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Pressure that follows one face (Pa), a formula of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PressureSpec {
    /// The face.
    #[cfg_attr(feature = "schemas", schemars(schema_with = "face_name"))]
    on: String,
    /// Pressure (Pa), a formula of the coordinates and `t`.
    value: NumberText,
    /// Point of action; by default at the outermost particles.
    at: Option<Placement>,
}

impl LoadKeys for PressureSpec {
    fn example(_: &str) -> String {
        "{on: right, value: s*(1 + t)}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        Ok(Arc::new(PressureLoad {
            face: entry.free_face(&self.on)?,
            value: entry.scalar(&entry.path.then("value"), &self.value)?,
            placement: self.at.unwrap_or_default(),
        }))
    }

    fn face(&self) -> Option<&str> {
        Some(&self.on)
    }
}

/// A pressure (Pa, per present area), a formula of the coordinates and t.
#[derive(Debug)]
struct PressureLoad {
    face: LoadedFace,
    value: Formula,
    placement: Placement,
}

impl Term for PressureLoad {}

/// `P n = -p J F^-T n`: it is normal to the moving face.
impl Condition for PressureLoad {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        let (p, area) = (point.value(&self.value), point.present_area());
        let pressed = |i| point.traction(i, "under pressure", -p * area[i]);
        (0..point.dimension()).try_for_each(pressed)
    }
}

impl SceneLoad for PressureLoad {
    fn target(&self) -> LoadTarget {
        LoadTarget::Face(self.face.number)
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::scalar("pressure", &self.value)
    }

    fn rows(&self) -> Vec<(String, String)> {
        let text = format!("pressure {} Pa, which follows the face", self.value.source());
        vec![self.face.row(&text, self.placement)]
    }

    fn condition(self: Arc<Self>) -> Option<Arc<dyn Condition>> {
        Some(self)
    }

    fn traction(&self, values: &[f64]) -> Vec<f64> {
        let (normal, side) = self.face.place();
        let inwards = if side == Side::High { -1.0 } else { 1.0 };
        let component = |axis| if axis == normal { inwards * self.value.eval(values) } else { 0.0 };
        (0..values.len() - 1).map(component).collect()
    }

    /// In uniaxial strain the area of a face is constant, so a pressure is a traction.
    fn tension(&self, x: f64, _: f64) -> Option<TimeFunction> {
        let value = self.value.clone();
        Some(Box::new(move |t| -value.eval(&[x, t])))
    }
}

impl<const D: usize> BuildEffect<D> for PressureLoad {
    fn build(&self, site: &mut BodySite<'_, D>) -> Result<Box<dyn Effect<D>>, BuildError> {
        let ((axis, side), value) = (self.face.place(), scalar(&self.value));
        Ok(Box::new(Pressure::at(site.particles, axis, side, self.placement, value)))
    }
}
