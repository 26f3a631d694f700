//! The built-in solver with one changed number, tested by the unchanged suite.

use super::gate::gate;
use super::leaf::{Change, Place, changed};
use mpm_verify::external::{LevelProblem, SolverFactory};
use mpm_verify::mpm::TransferChoice;
use mpm_verify::study::{self, Runner};
use mpm_verify::subject::{Subject, SubjectError};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{ConvergencePlan, LevelPlan, Method, StabilityPlan, Suite};
use mpm_verify::verify::CaseOutcome;
use serde_yaml::Value;
use std::path::Path;
use std::sync::Arc;

/// A suite of the repository, with its predicted time.
pub(super) struct Known {
    pub(super) suite: Suite,
    pub(super) text: Value,
    pub(super) study: String,
    /// Predicted time (s) on one core.
    pub(super) seconds: f64,
}

/// Assumed time (s) per step of a suite without levels.
const STEP: f64 = 2.5e-4;
const STEPS: f64 = 1000.0;

impl Known {
    /// Reads the suite in a file.
    pub(super) fn read(file: &Path) -> Self {
        let source = Source::read(file).unwrap_or_else(|found| panic!("{found}"));
        let suite = Suite::load(&source).unwrap_or_else(|found| panic!("{found}"));
        let text: Value = serde_yaml::from_str(source.text()).expect("YAML");
        let study = text.get("study").and_then(Value::as_str).unwrap_or("convergence").to_owned();
        let steps = text.get("run").and_then(|run| run.get("steps")).and_then(Value::as_f64);
        let without_levels = STEP * steps.unwrap_or(STEPS);
        let seconds = study::estimate(&suite).map_or(without_levels, |found| found.seconds);
        Self { suite, text, study, seconds }
    }

    /// Returns the indices of the cases that are judged and require no external program.
    pub(super) fn cases(&self) -> Vec<usize> {
        let plan = self.suite.plan::<ConvergencePlan>();
        let is_own = |case: &usize| plan.is_none_or(|plan| plan.cases[*case].solver.is_none());
        let is_judged = |case: &usize| self.suite.study.expectation(*case).is_some();
        (0..self.suite.case_names().len()).filter(is_own).filter(is_judged).collect()
    }

    /// Whether the suite expects an order for at least one case.
    pub(super) fn expects_an_order(&self) -> bool {
        let plan = self.suite.plan::<ConvergencePlan>();
        let mut expected =
            plan.iter().flat_map(|plan| &plan.cases).flat_map(|case| &case.expectation);
        expected.any(|expected| expected.order.is_some())
    }

    /// Changes one number in the part of the suite that the solver reads. A number that only the
    /// solver reads is changed in the suite itself.
    ///
    /// # Errors
    /// Reason why the changed text is refused.
    pub(super) fn with(
        &self,
        key: &str,
        place: &Place,
        change: Change,
    ) -> Result<Changed<'_>, String> {
        if key.starts_with("methods.mpm.") {
            return self.with_one_more_term(key, change);
        }
        let text = changed(&self.text, place, change);
        let source = Source::from_text("changed.yaml", text).map_err(|found| found.to_string())?;
        let plan = self.suite.plan::<ConvergencePlan>();
        let has_truth = |plan: &&ConvergencePlan| {
            key.starts_with("scene.") || (key.starts_with("manufactured.") && plan.has_formulas())
        };
        let Some(plan) = plan.filter(has_truth) else {
            let suite = Suite::load(&source).map_err(|found| found.to_string())?;
            return Ok(Changed { judged: Judged::Whole(suite), known: self });
        };
        let mut plan = plan.clone();
        if key.starts_with("scene.") {
            plan.scene = Suite::scene(&source).map_err(|found| found.to_string())?;
        } else {
            let suite = Suite::load(&source).map_err(|found| found.to_string())?;
            let changed = suite.plan::<ConvergencePlan>().expect("of the same study");
            (plan.exact, plan.conduction) = (changed.exact.clone(), changed.conduction.clone());
        }
        Ok(Changed { judged: Judged::Solver(Box::new(plan)), known: self })
    }

    /// Adds a term to every series in a method. Expectations still apply to the case with its
    /// former name.
    fn with_one_more_term(&self, key: &str, change: Change) -> Result<Changed<'_>, String> {
        if change != Change::PlusOne {
            return Err("a count".to_owned());
        }
        let longer = |method: &mut Method| match method {
            Method::Mpm { transfer: TransferChoice::With(name, terms), .. }
                if key.ends_with(name.name()) =>
            {
                *terms += 1;
            }
            _ => {}
        };
        let mut suite = self.suite.clone();
        if let Some(plan) = self.suite.plan::<ConvergencePlan>() {
            let mut plan = plan.clone();
            plan.cases.iter_mut().for_each(|case| longer(&mut case.method));
            suite.study = Arc::new(plan);
        } else if let Some(plan) = self.suite.plan::<StabilityPlan>() {
            let mut plan = plan.clone();
            plan.cases.iter_mut().for_each(|case| longer(&mut case.method));
            suite.study = Arc::new(plan);
        }
        Ok(Changed { judged: Judged::Whole(suite), known: self })
    }

    /// Returns the suite without a change, which runs in the same way as changed ones. Expectations
    /// that it does not meet are not counted later.
    pub(super) fn unchanged(&self) -> Changed<'_> {
        let plan = self.suite.plan::<ConvergencePlan>();
        let judged = plan.map_or_else(
            || Judged::Whole(self.suite.clone()),
            |plan| Judged::Solver(Box::new(plan.clone())),
        );
        Changed { judged, known: self }
    }
}

/// A suite or a solver with one changed number.
pub(super) struct Changed<'a> {
    judged: Judged,
    known: &'a Known,
}

enum Judged {
    Whole(Suite),
    Solver(Box<ConvergencePlan>),
}

impl Changed<'_> {
    /// Returns the first gate that a case does not pass.
    pub(super) fn gate(&self, case: usize) -> Option<&'static str> {
        let outcome = self.outcome(case);
        outcome.unmet.first().map(|line| gate(&outcome, line))
    }

    /// Whether a case runs and meets its expectation.
    pub(super) fn passes(&self, case: usize) -> bool {
        let outcome = self.outcome(case);
        outcome.study.is_some() && outcome.unmet.is_empty()
    }

    fn outcome(&self, case: usize) -> CaseOutcome {
        match &self.judged {
            Judged::Whole(suite) => Runner::new(suite).case(case, &|| ()),
            Judged::Solver(plan) => {
                let solver = Ours { plan, method: plan.cases[case].method };
                Runner::new(&self.known.suite).judging(&solver).case(case, &|| ())
            }
        }
    }
}

/// The built-in solver with a method, on the levels of a suite. It has its own plan.
struct Ours<'a> {
    plan: &'a ConvergencePlan,
    method: Method,
}

impl SolverFactory for Ours<'_> {
    fn name(&self) -> &'static str {
        "ours"
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let first = self.plan.refine.levels[0];
        let h = problem.grid.h;
        let cells = (first.cells as f64 * first.h / h).round() as u64;
        let level = LevelPlan { cells, h, dt: problem.dt, ppc: problem.particles_per_cell };
        study::subject(self.plan, self.method, level)
    }
}
