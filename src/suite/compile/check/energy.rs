//! Whether a scene has an energy that can be bound.

use crate::suite::evaluator::Evaluator;
use crate::suite::model::ConvergencePlan;
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses to bound the energy of a body whose law has none; `path` is that of the bound.
pub(crate) fn refuse_law_without_energy(
    evaluator: &Evaluator<'_>,
    path: &Path,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    let material = &plan.scene.material;
    let mut energy = material.properties().has_energy(plan.scene.dimension());
    let is_prestressed = plan.scene.each().iter().any(|body| !body.initial_stress.is_none());
    if is_prestressed && material.properties().depends_on_deformation_alone().is_err() {
        energy = Err("is integrated in rate form, and has no energy beside an initial stress");
    }
    let Err(reason) = energy else { return Ok(()) };
    let message = format!("the law `{}` {reason}", material.name());
    let diagnostic = evaluator.diagnostic_at_key(path, &message);
    Err(diagnostic.with_help("take `neo_hookean` or `hencky`"))
}
