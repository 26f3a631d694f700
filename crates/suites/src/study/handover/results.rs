//! Levels of a suite whose results are in files.

use super::level_problem;
use crate::external::ResultLevel;
use crate::subject::SubjectError;
use crate::suite::model::Suite;
use crate::suite::model::method::ExternalMethod;
use crate::suite::model::refine_plan::Extent;
use crate::verify::Axis;
use serde_json::json;

/// Returns the levels of a convergence study whose results are in files, for an external solver
/// with the given method.
///
/// # Errors
/// If the suite is no convergence study or has no case for an external solver, or a problem cannot
/// be created.
pub fn result_levels(
    suite: &Suite,
    method: ExternalMethod<'_>,
    extent: Extent,
) -> Result<Vec<ResultLevel>, SubjectError> {
    let judged = suite.of_external(method, None);
    let plan = judged.as_ref().and_then(Suite::convergence);
    let plan = plan.ok_or("it is not a convergence study")?;
    let mut all: Vec<ResultLevel> = Vec::new();
    let levels = plan.refine.levels(extent);
    for case in &plan.cases {
        // Cases with different ends or references have numbers.
        let number = case.name.strip_prefix(method.name).unwrap_or_default();
        for (index, level) in levels.iter().enumerate() {
            let problem = level_problem(&suite.name, plan, case, *level)?;
            let name = match plan.refine.axis {
                Axis::Space => format!("{}{number}", level.cells),
                Axis::Time | Axis::Particles => format!("level-{}{number}", index + 1),
            };
            if all.iter().all(|known| json!(known.problem) != json!(problem)) {
                all.push(ResultLevel { name, problem });
            }
        }
    }
    if all.is_empty() { Err("it has no case for an external solver".into()) } else { Ok(all) }
}
