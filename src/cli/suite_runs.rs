//! Suites that run with their own methods, with external solvers, or with both in one report.

use super::output::CommandError;
use mpm_verify::study::Shard;
use mpm_verify::suite::{Extent, Suite};
use std::collections::BTreeSet;

pub(super) struct SuiteRuns {
    /// One run by the methods of the suite, and one by each solver.
    pub(super) parts: Vec<SuitePart>,
}

/// A suite, and the methods or the solver that runs it.
pub(super) struct SuitePart {
    pub(super) suite: Suite,
    /// Index of the solver; `None` for the methods of the suite.
    pub(super) solver: Option<usize>,
}

impl SuiteRuns {
    pub(super) fn of_methods(suites: Vec<Suite>) -> Vec<Self> {
        let part = |suite| SuitePart { suite, solver: None };
        suites.into_iter().map(|suite| Self { parts: vec![part(suite)] }).collect()
    }

    /// Combines the runs of each suite: with its own methods if `with_methods`, and with solver k
    /// if it is in entry k of `of_each`. Suites without any run are skipped.
    pub(super) fn of_solvers(
        suites: &[Suite],
        of_each: Vec<Vec<Suite>>,
        with_methods: bool,
    ) -> Vec<Self> {
        let mut all: Vec<(String, Vec<SuitePart>)> =
            suites.iter().map(|suite| (suite.name.clone(), Vec::new())).collect();
        let mut put = |suite: Suite, solver: Option<usize>| {
            // Suites with equal names are matched by their order.
            let is_free = |(name, parts): &&mut (String, Vec<SuitePart>)| {
                *name == suite.name && parts.last().is_none_or(|part| part.solver != solver)
            };
            if let Some((_, parts)) = all.iter_mut().find(is_free) {
                parts.push(SuitePart { suite, solver });
            }
        };
        if with_methods {
            for suite in suites {
                put(suite.clone(), None);
            }
        }
        for (number, suites) in of_each.into_iter().enumerate() {
            for suite in suites {
                put(suite, Some(number));
            }
        }
        let has_parts = |(_, parts): &(String, Vec<SuitePart>)| !parts.is_empty();
        all.into_iter().filter(has_parts).map(|(_, parts)| Self { parts }).collect()
    }

    /// Keeps the cases whose names `is_chosen` accepts; `None` if there is no such case.
    pub(super) fn only(self, is_chosen: impl Fn(&str) -> bool) -> Option<Self> {
        let part = |SuitePart { suite, solver }: SuitePart| {
            let names = suite.case_names();
            let any = names.iter().any(|name| is_chosen(name));
            let suite = any.then(|| suite.only(&|case| is_chosen(names[case])))?;
            Some(SuitePart { suite, solver })
        };
        let parts: Vec<SuitePart> = self.parts.into_iter().filter_map(part).collect();
        (!parts.is_empty()).then_some(Self { parts })
    }

    /// Keeps the cases in `shard`. Each suite must have only one run.
    pub(super) fn shard(runs: Vec<Self>, shard: Shard, extent: Extent) -> Vec<Self> {
        let solver = runs.iter().find_map(|runs| runs.parts[0].solver);
        let suites: Vec<Suite> = runs.into_iter().map(|runs| runs.suite().clone()).collect();
        let part = |suite| Self { parts: vec![SuitePart { suite, solver }] };
        shard.of(&suites, extent).into_iter().map(part).collect()
    }

    /// Returns the suite of the first part. The problem is the same in all parts.
    pub(super) fn suite(&self) -> &Suite {
        &self.parts[0].suite
    }
}

/// Returns the first name that occurs a second time.
pub(super) fn repeated<'a>(names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut known = BTreeSet::new();
    names.into_iter().find(|name| !known.insert(*name))
}

/// Checks that case names, such as the name of a solver, are unique within each suite.
pub(super) fn check_names(runs: &[SuiteRuns]) -> Result<(), CommandError> {
    for runs in runs {
        let names = runs.parts.iter().flat_map(|part| part.suite.case_names());
        if let Some(name) = repeated(names) {
            let reason = format!("a case of the suite `{}` has this name", runs.suite().name);
            return Err(CommandError::option("--solver", name, reason));
        }
    }
    Ok(())
}
