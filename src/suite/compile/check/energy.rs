//! Whether a scene has an energy that can be bound.

use crate::{
    mpm::MaterialPlan,
    suite::{
        compile::{evaluator::Evaluator, path::Path},
        model::ConvergencePlan,
        yaml::Diagnostic,
    },
};

/// Refuses to bound the energy of a body whose law has none; `path` is that of the bound.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    path: &Path,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    let rate = matches!(plan.scene.material, MaterialPlan::LinearElastic { .. });
    if !rate || plan.scene.dimension() == 1 {
        return Ok(());
    }
    let message =
        "the law `linear_elastic` is integrated in rate form, and has an energy in 1-D only";
    let diagnostic = evaluator.diagnostic_at_key(path, message);
    Err(diagnostic.with_help("take `neo_hookean` or `hencky`"))
}
