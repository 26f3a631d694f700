//! The study that preflight rules check, and the paths in its file.

use crate::mpm::FrameName;
use crate::study::exact_motion::Extremes;
use crate::suite::grammar::WarningName;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity, Source};
use crate::verify::{Axis, Verdict};

pub(crate) struct Preflight<'a> {
    pub(crate) plan: &'a ConvergencePlan,
    /// Extremes of the exact motion, if the motion is given by formulas and an order is expected.
    pub(crate) extremes: Option<Extremes>,
    source: &'a Source,
}

impl<'a> Preflight<'a> {
    pub(crate) fn new(plan: &'a ConvergencePlan, source: &'a Source) -> Self {
        let mut preflight = Self { plan, extremes: None, source };
        if preflight.claims_an_order() {
            preflight.extremes = plan.exact.as_ref().map(Extremes::of);
        }
        preflight
    }

    pub(crate) fn claims_an_order(&self) -> bool {
        self.of_an_order().next().is_some()
    }

    pub(crate) fn levels(&self) -> &[LevelPlan] {
        self.plan.refine.levels(Extent::Usual)
    }

    pub(crate) fn of_an_order(&self) -> impl Iterator<Item = &Case> {
        let claims = |case: &&Case| match &case.expectation {
            Some(expected) => expected.verdict == Some(Verdict::Converging),
            None => case.against != Against::Nothing,
        };
        self.plan.cases.iter().filter(claims)
    }

    pub(crate) fn sizes(&self) -> Path {
        Path::top("refine").then(match self.plan.refine.axis {
            Axis::Space => "cells",
            Axis::Time => "dt",
            Axis::Particles => "ppc",
        })
    }

    pub(crate) fn truth(&self) -> Path {
        let keys = ["exact", "manufactured", "equilibrium"].map(Path::top);
        keys.into_iter().find(|path| self.stands(path)).unwrap_or_else(|| Path::top("exact"))
    }

    pub(crate) fn motion(&self) -> Path {
        let motion = self.truth().then("displacement");
        if self.stands(&motion) { motion } else { self.truth() }
    }

    fn stands(&self, path: &Path) -> bool {
        self.source.value_at(path.steps()).is_some()
    }

    /// Warns of unused acknowledgements, unless an external solver replaces the methods.
    pub(crate) fn unused_acknowledgements(&self, used: &[WarningName]) -> Vec<Diagnostic> {
        let replaced = self.plan.cases.iter().any(|case| case.solver.is_some());
        let all = self.plan.acknowledged.iter().enumerate().filter(|_| !replaced);
        let unused = all.filter(|(_, name)| !used.contains(name));
        let warning = |(i, name): (usize, &WarningName)| {
            let path = Path::top("acknowledge").then(i).then("warning");
            let message = format!("there is no warning `{}` to acknowledge", name.name());
            self.finding(Severity::Warning, &path, &message).with_help("remove this entry")
        };
        unused.map(warning).collect()
    }

    pub(crate) fn finding(&self, severity: Severity, path: &Path, message: &str) -> Diagnostic {
        self.source.diagnostic_at(path.steps(), message).with_severity(severity)
    }
}

pub(crate) fn moves_on_grid(case: &Case) -> bool {
    match case.method {
        Method::Mpm(method) => method.frame == FrameName::Updated,
        method => matches!(method, Method::QuasiStatic { .. }),
    }
}
