//! A pressure on a face of a box or a rim of a round body. The pressure follows the surface.

use super::contract::{BodySite, LoadTarget, SceneLoad};
use super::entry::{LoadEntry, LoadKeys, LoadedFace};
use crate::exact::formula::Formula;
use crate::exact::{Circle, Condition, FacePoint, Term, Violation};
use crate::fem::TimeFunction;
use crate::mpm::input::{EffectInput, FaceInput, PressedPart};
use crate::mpm::{Placement, RimCircle, Side};
#[cfg(feature = "schemas")]
use crate::suite::scene::face::face_or_rim;
use crate::suite::scene::numbers::{LoadNumbers, scalar, with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// A pressure load on a face or rim. Its direction follows the moving surface.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PressureSpec {
    /// The face of a box, or the rim `inner` or `outer` of an annulus or a disk.
    #[cfg_attr(feature = "schemas", schemars(schema_with = "face_or_rim"))]
    on: String,
    /// Pressure (Pa), a formula of the coordinates and `t`.
    value: NumberText,
    /// Where the pressure acts on a face; by default at the outermost particles. On a rim, it acts
    /// at the surface.
    at: Option<Placement>,
}

#[derive(Debug)]
enum PressedSite {
    Face(LoadedFace, Placement),
    Rim(Circle),
}

impl LoadKeys for PressureSpec {
    fn example(_: &str) -> String {
        "{on: right, value: s*(1 + t)}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        let site = if entry.scene.faces.is_empty() {
            if let Some(Placement::Particles) = self.at {
                let message = "a pressure on a rim acts at the surface";
                return entry.path.then("at").refuse(message, "remove `at`");
            }
            PressedSite::Rim(entry.free_rim(&self.on)?)
        } else {
            PressedSite::Face(entry.free_face(&self.on)?, self.at.unwrap_or_default())
        };
        let value = entry.path.then("value").field(&self.value, entry.dimension())?;
        Ok(Arc::new(PressureLoad { site, value }))
    }

    fn acts_on_rims(&self) -> bool {
        true
    }

    fn face(&self) -> Option<&str> {
        Some(&self.on)
    }
}

/// A pressure (Pa, per current area), a formula of the coordinates and t.
#[derive(Debug)]
struct PressureLoad {
    site: PressedSite,
    value: Formula,
}

impl Term for PressureLoad {
    fn pressed_rim(&self) -> Option<(usize, &Formula)> {
        match &self.site {
            PressedSite::Face(..) => None,
            PressedSite::Rim(circle) => Some((circle.number, &self.value)),
        }
    }
}

/// Requires `P n = -p J F^-T n`: the load is normal to the deformed surface.
impl Condition for PressureLoad {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        let (p, area) = (point.value(&self.value), point.present_area());
        let pressed = |i| point.traction(i, "under pressure", -p * area[i]);
        (0..point.dimension()).try_for_each(pressed)
    }
}

impl SceneLoad for PressureLoad {
    fn target(&self) -> LoadTarget {
        match &self.site {
            PressedSite::Face(face, _) => LoadTarget::Face(face.number),
            PressedSite::Rim(circle) => LoadTarget::Rim(circle.number),
        }
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::scalar("pressure", &self.value)
    }

    fn rows(&self) -> Vec<(String, String)> {
        let pressure = with_unit(self.value.source(), "Pa");
        let pressure = format!("pressure = {pressure}, normal to the deformed");
        vec![match &self.site {
            PressedSite::Face(face, placement) => face.row(&format!("{pressure} face"), *placement),
            PressedSite::Rim(circle) => (format!("{} rim", circle.name), format!("{pressure} rim")),
        }]
    }

    fn condition(self: Arc<Self>) -> Option<Arc<dyn Condition>> {
        Some(self)
    }

    fn traction(&self, values: &[f64]) -> Vec<f64> {
        let PressedSite::Face(face, _) = &self.site else { return Vec::new() };
        let FaceInput { axis: normal, side } = face.place();
        let inwards = if side == Side::High { -1.0 } else { 1.0 };
        let component = |axis| if axis == normal { inwards * self.value.eval(values) } else { 0.0 };
        (0..values.len() - 1).map(component).collect()
    }

    /// In uniaxial strain the area of a face is constant, so the tension is minus the pressure.
    fn tension(&self, x: f64, _: f64) -> Option<TimeFunction> {
        let value = self.value.clone();
        Some(Box::new(move |t| -value.eval(&[x, t])))
    }

    fn input(&self, _: &BodySite<'_>) -> EffectInput {
        let part = match &self.site {
            PressedSite::Face(face, placement) => PressedPart::Face(face.place(), *placement),
            PressedSite::Rim(Circle { centre, radius, outwards, .. }) => {
                let (centre, radius, outwards) = (*centre, *radius, *outwards);
                PressedPart::Rim(RimCircle { centre, radius, outwards })
            }
        };
        EffectInput::Pressure { part, value: Box::new(scalar(&self.value)) }
    }
}
