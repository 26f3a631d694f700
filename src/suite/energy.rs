//! Whether a scene has an energy that can be bound.

use super::{binder::Binder, model::ConvergencePlan, path::Path, yaml::Complaint};
use crate::mpm::MaterialPlan;

/// Refuses to bound the energy of a body whose law has none; `path` is that of the bound.
pub(super) fn check(
    binder: &Binder<'_>,
    path: &Path,
    plan: &ConvergencePlan,
) -> Result<(), Complaint> {
    let rate = matches!(plan.scene.material, MaterialPlan::LinearElastic { .. });
    if !rate || plan.scene.dimension() == 1 {
        return Ok(());
    }
    let message =
        "the law `linear_elastic` is integrated in rate form, and has an energy in 1-D only";
    let complaint = binder.complain_key(path, message);
    Err(complaint.with_help("take `neo_hookean` or `hencky`"))
}
