//! Runs one case repeatedly within a budget, and checks whether `check` accepts a remedy.

use crate::external::SolverFactory;
use crate::study::kind::{RunContext, Study};
use crate::study::preflight::estimate_of;
use crate::suite::compile::suite::with_changes;
use crate::suite::grammar::{
    BoxSpec, ConvergenceSpec, MethodSpec, SchemeKey, StepSpec, TransferSpec,
};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::suite::model::{Case, ConvergencePlan};
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany, Source};
use crate::verify::{
    Axis, Convergence, Judgement, KnownCause, KnownCauseKind, Level, LevelOutcome, OrderHypothesis,
    judge,
};
use std::cell::{Cell, RefCell};
use std::time::Instant;

/// An order counts as restored if it is at most this much below the theoretical order.
const NEAR: f64 = 0.2;

/// An order counts as restored if it is at most this much above the theoretical order.
const ABOVE: f64 = 0.8;

pub(super) struct Session<'a> {
    pub(super) suite: &'a str,
    pub(super) source: &'a Source,
    pub(super) case: &'a Case,
    pub(super) formal_order: f64,
    pub(super) solver: Option<&'a dyn SolverFactory>,
    /// Remaining time budget (s) for changed runs.
    left: Cell<f64>,
    /// Measured time of an external solver divided by the predicted time of this crate, at least 1.
    slowness: Cell<f64>,
    skipped: RefCell<Vec<String>>,
}

impl<'a> Session<'a> {
    /// Creates a session with the time budget `budget` (s) for changed runs.
    pub(super) fn new(
        suite: &'a str,
        source: &'a Source,
        case: &'a Case,
        formal_order: f64,
        solver: Option<&'a dyn SolverFactory>,
        budget: f64,
    ) -> Self {
        let (left, slowness) = (Cell::new(budget), Cell::new(1.0));
        let skipped = RefCell::default();
        Self { suite, source, case, formal_order, solver, left, slowness, skipped }
    }

    pub(super) fn first(&self, plan: &ConvergencePlan) -> Result<Convergence, String> {
        let start = Instant::now();
        let found = self.run(plan)?;
        let predicted = estimate_of(plan).seconds;
        if self.solver.is_some() && predicted > 0.0 {
            self.slowness.set((start.elapsed().as_secs_f64() / predicted).max(1.0));
        }
        Ok(found)
    }

    /// Runs a changed plan; `None` without evidence, if it exceeds the budget or cannot be set up.
    pub(super) fn changed(&self, change: &str, plan: &ConvergencePlan) -> Option<Convergence> {
        let cost = self.slowness.get() * estimate_of(plan).seconds;
        if !(cost <= self.left.get()) {
            self.skipped.borrow_mut().push(change.to_owned());
            return None;
        }
        self.left.set(self.left.get() - cost);
        self.run(plan).ok()
    }

    fn run(&self, plan: &ConvergencePlan) -> Result<Convergence, String> {
        let (suite, extent, solver) = (self.suite, Extent::Usual, self.solver);
        let (cache, repeat) = (None, 1);
        let context = RunContext { suite, fingerprint: 0, extent, cache, repeat, solver };
        let outcome = plan.runner(context).case(0, &|| ());
        outcome.convergence().cloned().ok_or(outcome.reason)
    }

    pub(super) fn judge<'b>(
        &self,
        levels: impl IntoIterator<Item = &'b LevelOutcome>,
        axis: Axis,
    ) -> Judgement {
        let levels: Vec<Level> = levels.into_iter().map(LevelOutcome::to_level).collect();
        let p = self.formal_order;
        judge(&levels, &OrderHypothesis::within(p, p - NEAR, p + ABOVE).over(axis))
    }

    pub(super) fn into_skipped(self) -> Vec<String> {
        self.skipped.into_inner()
    }
}

pub(super) struct Known<'a> {
    pub(super) session: &'a Session<'a>,
    pub(super) plan: &'a ConvergencePlan,
    pub(super) levels: &'a [LevelOutcome],
    pub(super) finest: &'a Judgement,
}

/// Returns a cause that explains the observed order.
pub(super) fn finding(
    kind: KnownCauseKind,
    cause: impl Into<String>,
    evidence: String,
    remedy: impl Into<String>,
) -> KnownCause {
    let (cause, remedy) = (cause.into(), Some(remedy.into()));
    KnownCause { kind, cause, evidence, remedy, order: None, explains: true }
}

pub(super) fn only(plan: &ConvergencePlan, case: &Case, levels: &[LevelPlan]) -> ConvergencePlan {
    let mut plan = plan.clone();
    plan.refine.levels = levels.to_vec();
    plan.refine.usual = levels.len();
    plan.cases = vec![case.clone()];
    plan
}

/// Returns why `check` rejects the suite with the method and levels of `after`, if it does.
pub(super) fn refusal(
    source: &Source,
    before: &ConvergencePlan,
    after: &ConvergencePlan,
) -> Option<String> {
    let new_method = (before.cases[0].method != after.cases[0].method)
        .then(|| method_spec(after.cases[0].method))
        .flatten();
    let changed = with_changes(source, |spec| {
        if let Some(method) = new_method {
            spec.methods = vec![method];
        }
        write_levels(spec, &before.refine.levels, &after.refine.levels);
    });
    changed.err().map(|refused: Diagnostic| refused.message().to_owned())
}

pub(super) fn accepts_step(source: &Source, step: StepSpec) -> bool {
    with_changes(source, |spec| spec.run.dt = Some(step)).is_ok()
}

pub(super) fn accepts_grid(source: &Source, from: &[f64], to: &[f64]) -> bool {
    let corner = |x: &[f64]| x.iter().copied().map(NumberText::Number).collect();
    let grid = BoxSpec { from: corner(from), to: corner(to) };
    with_changes(source, |spec| spec.scene.grid = Some(grid)).is_ok()
}

fn method_spec(method: Method) -> Option<MethodSpec> {
    let Method::Mpm(method) = method else { return None };
    Some(MethodSpec::Mpm {
        basis: method.basis.into(),
        transfer: Some(TransferSpec(method.transfer).into()),
        scheme: SchemeKey::from(method.scheme).into(),
        start: Some(method.start.into()),
        mass: Some(method.mass.into()),
        frame: Some(method.frame.into()),
        volume: Some(method.volume.into()),
        precision: Some(method.precision.into()),
    })
}

/// Replaces the levels `before` by `after`. A time step that is a formula of h changes with them.
fn write_levels(spec: &mut ConvergenceSpec, before: &[LevelPlan], after: &[LevelPlan]) {
    let write = |values: &mut OneOrMany<NumberText>, of: fn(&LevelPlan) -> f64| {
        let is_changed = before.iter().map(of).ne(after.iter().map(of));
        let changed = values.with_values(after.iter().map(of).map(NumberText::Number));
        if let Some(changed) = changed.filter(|_| is_changed) {
            *values = changed;
        }
    };
    write(&mut spec.refine.cells, |level| level.cells as f64);
    if let Some(ppc) = &mut spec.refine.ppc {
        write(ppc, |level| level.ppc.unwrap_or(0) as f64);
    }
    if let Some(dt) = &mut spec.refine.dt {
        write(dt, |level| level.dt);
    }
    // The additional levels of full runs may not fit the changed list.
    spec.refine.full = None;
}
