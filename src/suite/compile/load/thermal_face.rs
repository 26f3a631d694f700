//! Thermal conditions on the faces of a body in which heat flows.

use super::contract::LoadEntry;
use super::fields::scalar;
use crate::exact::heat::{HeatFace, ThermalCondition};
use crate::mpm::{Side, Thermal, ThermalBoundary};
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::face::face;
use crate::suite::model::load::BodySite;
use crate::suite::model::scene::SceneFace;
use crate::suite::yaml::{Diagnostic, NumberText, Ordered};

/// The condition on a face; formulas are of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum ThermalSpec {
    /// No heat flows.
    Insulated,
    /// The temperature (K).
    Temperature(NumberText),
    /// Heat that enters (W/m^(D-1)).
    Flux(NumberText),
    /// `coefficient (ambient - T)` enters.
    Convection { coefficient: NumberText, ambient: NumberText },
}

/// Every face of the body, insulated where the words do not name it.
pub(crate) fn faces(
    entry: &LoadEntry<'_>,
    words: &Ordered<ThermalSpec>,
) -> Result<Vec<HeatFace>, Diagnostic> {
    let ends = |face: &SceneFace| HeatFace {
        name: face.name,
        axis: face.axis,
        high: face.high,
        condition: if face.hold.is_periodic() {
            ThermalCondition::Periodic
        } else {
            ThermalCondition::Insulated
        },
    };
    let path = entry.path.then("boundary");
    let mut faces: Vec<HeatFace> = entry.scene.faces.iter().map(ends).collect();
    for (name, words) in words.as_slice() {
        let at = path.then(name.as_str());
        let i = face(entry.evaluator, &at, name, entry.dimension(), true)?;
        on_grid(entry, &at, words, &entry.scene.faces[i])?;
        faces[i].condition = condition(entry, &at, words)?;
    }
    Ok(faces)
}

/// Temperatures are held, and heat enters, at the nodes of the grid's face: the body must end
/// there, and stay.
fn on_grid(
    entry: &LoadEntry<'_>,
    path: &Path,
    words: &ThermalSpec,
    face: &SceneFace,
) -> Result<(), Diagnostic> {
    let (name, verb) = (face.name, face.hold.verb());
    if face.hold.is_periodic() {
        let message = format!("the {name} face {verb}, and has no temperature of its own");
        return Err(entry.evaluator.diagnostic_at_key(path, &message));
    }
    if face.hold.stays() || matches!(words, ThermalSpec::Insulated) {
        return Ok(());
    }
    let message = format!("the {name} face {verb}, and heat enters at the face of the grid");
    let diagnostic = entry.evaluator.diagnostic_at_key(path, &message);
    Err(diagnostic.with_help("hold it (`fixed` or `roller`), or leave it insulated"))
}

fn condition(
    entry: &LoadEntry<'_>,
    path: &Path,
    words: &ThermalSpec,
) -> Result<ThermalCondition, Diagnostic> {
    Ok(match words {
        ThermalSpec::Insulated => ThermalCondition::Insulated,
        ThermalSpec::Temperature(text) => {
            ThermalCondition::Temperature(entry.scalar(&path.then("temperature"), text)?)
        }
        ThermalSpec::Flux(text) => ThermalCondition::Flux(entry.scalar(&path.then("flux"), text)?),
        ThermalSpec::Convection { coefficient, ambient } => {
            let path = path.then("convection");
            let (at, what) = (path.then("coefficient"), "the coefficient of convection");
            let coefficient = entry.evaluator.positive(&at, coefficient, what)?;
            let ambient = entry.scalar(&path.then("ambient"), ambient)?;
            ThermalCondition::Convection { coefficient, ambient }
        }
    })
}

/// The condition for reports; none of a face that is no end.
pub(crate) fn described(condition: &ThermalCondition) -> Option<String> {
    Some(match condition {
        ThermalCondition::Periodic => return None,
        ThermalCondition::Insulated => "insulated".to_owned(),
        ThermalCondition::Temperature(value) => format!("temperature {} K", value.source()),
        ThermalCondition::Flux(value) => format!("heat enters, {} W/m2", value.source()),
        ThermalCondition::Convection { coefficient, ambient } => {
            format!("convection, {coefficient} W/(m2 K) from {} K", ambient.source())
        }
    })
}

/// The conditions for the solver.
pub(crate) fn build<const D: usize>(
    faces: &[HeatFace],
    site: &BodySite<'_, D>,
) -> Vec<ThermalBoundary<D>> {
    let build = |face: &HeatFace| {
        let condition = match &face.condition {
            ThermalCondition::Insulated | ThermalCondition::Periodic => return None,
            ThermalCondition::Temperature(value) => Thermal::Temperature(scalar(value)),
            ThermalCondition::Flux(value) => Thermal::Flux(scalar(value)),
            ThermalCondition::Convection { coefficient, ambient } => {
                Thermal::Convection { coefficient: *coefficient, ambient: scalar(ambient) }
            }
        };
        let at = (face.axis, if face.high { Side::High } else { Side::Low });
        Some(ThermalBoundary::new((site.grid, site.basis), site.particles, at, condition))
    };
    faces.iter().filter_map(build).collect()
}
