//! Thermal conditions on the faces of a body in which heat flows.

use super::contract::LoadEntry;
use crate::mpm::{Side, ThermalBoundary};
use crate::suite::compile::boundary::FaceEntry;
use crate::suite::compile::boundary::thermal::{Insulated, PeriodicTemperature, ThermalSpec};
use crate::suite::compile::scene::face::face;
use crate::suite::model::heat::{HeatCondition, ThermalFace, build as build_condition};
use crate::suite::model::load::BodySite;
use crate::suite::model::scene::SceneFace;
use crate::suite::yaml::{Diagnostic, Ordered, Path};
use std::sync::Arc;

/// Every face of the body, insulated where the words do not name it.
pub(crate) fn faces(
    entry: &LoadEntry<'_>,
    words: &Ordered<ThermalSpec>,
) -> Result<Vec<ThermalFace>, Diagnostic> {
    let (evaluator, dimension) = (entry.evaluator, entry.dimension());
    let unnamed = |face: &SceneFace| {
        let SceneFace { name, axis, high, .. } = *face;
        let periodic = face.hold.is_periodic();
        let condition: Arc<dyn HeatCondition> =
            if periodic { Arc::new(PeriodicTemperature) } else { Arc::new(Insulated) };
        ThermalFace { name, axis, high, condition }
    };
    let path = entry.path.then("boundary");
    let mut faces: Vec<ThermalFace> = entry.scene.faces.iter().map(unnamed).collect();
    for (name, words) in words.as_slice() {
        let at = path.then(name.as_str());
        let i = face(evaluator, &at, name, dimension, true)?;
        let (condition, words) = words.named();
        on_grid(entry, &at, words.lets_heat_in(), &entry.scene.faces[i])?;
        let entry = FaceEntry { evaluator, path: at.then(condition), dimension };
        faces[i].condition = words.compile(&entry)?;
    }
    Ok(faces)
}

/// Temperatures are held, and heat enters, at the nodes of the grid's face: the body must end
/// there, and stay.
fn on_grid(
    entry: &LoadEntry<'_>,
    path: &Path,
    lets_heat_in: bool,
    face: &SceneFace,
) -> Result<(), Diagnostic> {
    let (name, verb) = (face.name, face.hold.verb());
    if face.hold.is_periodic() {
        let message = format!("the {name} face {verb}, and has no temperature of its own");
        return Err(entry.evaluator.diagnostic_at_key(path, &message));
    }
    if face.hold.stays() || !lets_heat_in {
        return Ok(());
    }
    let message = format!("the {name} face {verb}, and heat enters at the face of the grid");
    let diagnostic = entry.evaluator.diagnostic_at_key(path, &message);
    Err(diagnostic.with_help("hold it (`fixed` or `roller`), or leave it insulated"))
}

/// The conditions for the solver.
pub(crate) fn build<const D: usize>(
    faces: &[ThermalFace],
    site: &BodySite<'_, D>,
) -> Vec<ThermalBoundary<D>> {
    let build = |face: &ThermalFace| {
        let at = (face.axis, if face.high { Side::High } else { Side::Low });
        let condition = build_condition(&face.condition)?;
        Some(ThermalBoundary::new((site.grid, site.basis), site.particles, at, condition))
    };
    faces.iter().filter_map(build).collect()
}
