//! Capabilities that a solver declares and that no examination covers.

use super::examination::ALL;
use super::finding::{ExaminationReport, ExaminationResult, UnexaminedCapability};
use crate::embedded;
use crate::external::{Capabilities, SolverFactory};
use crate::study::{needs_of_suite, under};
use crate::suite::Suite;
use rayon::prelude::*;

const SUITES: usize = 3;

/// Lists the capabilities that `solver` declares and that no examination covers. Skipped
/// examinations cover theirs, because they run once the defects are corrected.
pub(super) fn unexamined(
    solver: &dyn SolverFactory,
    reports: &[ExaminationReport],
) -> Vec<UnexaminedCapability> {
    let applies = |name: &str| {
        let is_not = |result: &_| matches!(result, ExaminationResult::NotApplicable { .. });
        reports.iter().any(|made| made.examination == name && !is_not(&made.result))
    };
    let covered: Vec<&str> =
        ALL.iter().filter(|one| applies(one.name)).flat_map(|one| one.covers).copied().collect();
    let claimed = solver.capabilities().map_or(Vec::new(), Capabilities::entries);
    let left: Vec<String> =
        claimed.into_iter().filter(|entry| !covered.contains(&entry.as_str())).collect();
    if left.is_empty() {
        return Vec::new();
    }
    let names: Vec<&str> = embedded::names().collect();
    let runnable = names.into_par_iter().filter_map(|name| Some((name, required(name, solver)?)));
    let mut suites: Vec<(&str, Vec<String>)> = runnable.collect();
    // Suites that need little else come first. The sort is stable, so equal ones stay in order.
    suites.sort_by_key(|(_, needs)| needs.len());
    let of = |capability: String| {
        let testing = suites.iter().filter(|(_, needs)| needs.contains(&capability));
        let suites = testing.map(|(name, _)| *name).take(SUITES).collect();
        UnexaminedCapability { capability, suites }
    };
    left.into_iter().map(of).collect()
}

/// Returns the capabilities that a built-in suite requires; `None` if the solver cannot run it.
fn required(name: &str, solver: &dyn SolverFactory) -> Option<Vec<String>> {
    let suite = Suite::load(&embedded::source(name)?.ok()?.trusted()).ok()?;
    let needs = needs_of_suite(&suite)?;
    let can_run =
        solver.lacks(&needs).is_empty() && !under(&suite, solver, false)?.case_names().is_empty();
    can_run.then(|| Capabilities::default().lacking(&needs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::external::everything;

    #[test]
    fn covered_capabilities_exist() {
        let known = everything().entries();
        for one in ALL {
            let unknown = one.covers.iter().find(|name| !known.iter().any(|known| known == *name));
            assert_eq!(unknown, None, "{}", one.name);
        }
    }
}
