//! What can be said of a suite before anything runs: warnings and notes, each with its place.
//!
//! ```text
//! extremes     the exact motion on a raster: strain, speed, reach
//! levels       levels that can count for an order
//! time_step    steps beyond the stable one, and steps that do not follow the cells
//! reach        a motion that leaves the grid
//! strain       a truth of small strain beside a solver of finite strain
//! alignment    interfaces and loaded faces inside a cell
//! cost         seconds and memory
//! ```
//!
//! A rule speaks of what its suite claims: a suite that only bounds an error is not told that its
//! levels are too few for an order.

pub(crate) mod alignment;
pub(crate) mod cost;
pub(crate) mod extremes;
pub(crate) mod levels;
pub(crate) mod reach;
pub(crate) mod strain;
pub(crate) mod time_step;

pub use cost::{Estimate, estimate};

use self::extremes::Extremes;
use crate::mpm::FrameName;
use crate::suite::compile::path::Path;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Against, Case, ConvergencePlan, Suite};
use crate::suite::yaml::{Diagnostic, Severity, Source};
use crate::verify::{Axis, Verdict};

/// A convergence study before it runs.
pub(crate) struct Preflight<'a> {
    pub(crate) plan: &'a ConvergencePlan,
    /// Extremes of the exact motion, where formulas give one and an order is claimed.
    pub(crate) extremes: Option<Extremes>,
    source: &'a Source,
}

/// Findings of one rule.
type Rule = fn(&Preflight<'_>) -> Vec<Diagnostic>;

/// Every rule.
const RULES: [Rule; 5] =
    [levels::check, time_step::check, reach::check, strain::check, alignment::check];

/// Warnings and notes about `suite`, read from `source`; none about studies that refine nothing.
pub fn preflight(suite: &Suite, source: &Source) -> Vec<Diagnostic> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let mut preflight = Preflight { plan, extremes: None, source };
    if preflight.of_an_order().next().is_none() {
        return Vec::new();
    }
    preflight.extremes = plan.exact.as_ref().map(Extremes::of);
    RULES.iter().flat_map(|rule| rule(&preflight)).collect()
}

impl Preflight<'_> {
    /// Levels of the gate.
    pub(crate) fn levels(&self) -> &[LevelPlan] {
        self.plan.refine.levels(Extent::Usual)
    }

    /// Cases whose expectation is an order, stated or that of theory.
    pub(crate) fn of_an_order(&self) -> impl Iterator<Item = &Case> {
        let claims = |case: &&Case| match &case.expectation {
            Some(expected) => expected.verdict == Some(Verdict::Converging),
            None => case.against != Against::Nothing,
        };
        self.plan.cases.iter().filter(claims)
    }

    /// Where the sizes of the refined axis stand.
    pub(crate) fn sizes(&self) -> Path {
        Path::top("refine").then(match self.plan.refine.axis {
            Axis::Space => "cells",
            Axis::Time => "dt",
            Axis::Particles => "ppc",
        })
    }

    /// Where the exact motion stands.
    pub(crate) fn motion(&self) -> Path {
        let of = |key: &str| Path::top(key).then("displacement");
        let keys = ["exact", "manufactured", "equilibrium"].map(of);
        let stands = |path: &Path| self.source.value_at(path.steps()).is_some();
        keys.into_iter().find(stands).unwrap_or_else(|| Path::top("exact"))
    }

    /// A finding about the value at `path`.
    pub(crate) fn finding(&self, severity: Severity, path: &Path, message: &str) -> Diagnostic {
        let diagnostic = match self.source.value_at(path.steps()) {
            Some(place) => self.source.diagnostic(place, message),
            None => Diagnostic::about(self.source.name(), message),
        };
        diagnostic.with_severity(severity)
    }
}

/// Whether the particles of a case move through the grid.
pub(crate) fn moves_on_grid(case: &Case) -> bool {
    matches!(case.method, Method::Mpm { frame: FrameName::Updated, .. })
}
