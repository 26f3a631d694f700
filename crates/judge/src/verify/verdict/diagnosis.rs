//! Determines why a case does not have the theoretical order. Each run changes one property.

use crate::verify::{Interval, Judgement, OrderHypothesis, Verdict};

/// Maximum remaining fraction of the finest error for a change that only reduces the error.
const FALL: f64 = 0.75;

/// Maximum half-width of the confidence interval of a settled order.
const SETTLED: f64 = 0.15;

/// Minimum increase of an order that counts as raised.
const RISE: f64 = 0.25;

/// Maximum difference between orders that count as equal.
const ALIKE: f64 = 0.1;

/// Maximum remaining fraction of the distance from the theoretical order for a restored order.
const CLOSER: f64 = 0.5;

/// Effect by which a change reveals the cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// With the change, the order is the theoretical one.
    Restored,
    /// With the change, the order is higher, and settled.
    Raised,
    /// With the change, the finest error is smaller.
    Lowered,
}

/// A run of the finest levels of a case with one change.
#[derive(Debug, Clone)]
pub struct ChangedRun {
    /// The change, as text.
    pub change: String,
    /// Cause that is inferred if the change restores or raises the order, or reduces the error.
    pub cause: &'static str,
    /// Modification of the suite that restores the order.
    pub remedy: &'static str,
    /// Reason why `check` rejects the suite with this change. `None` if `check` accepts the suite
    /// or was not run.
    pub refusal: Option<String>,
    /// Verdict on the levels of the run, for an expected order near the theoretical one.
    pub verdict: Verdict,
    /// Observed order on the levels of the run.
    pub order: Option<Interval>,
    /// Error on the finest level.
    pub error: f64,
    /// Finest error with the change, divided by the finest error without it.
    pub ratio: f64,
    /// `ratio` divided by the ratio of the sizes of exact solutions with and without the change.
    pub relative_ratio: f64,
    /// Whether the change refines the levels, which reduces the error for any cause.
    pub is_finer: bool,
    /// Whether the change increases the number of particles per cell, and nothing else.
    pub has_more_particles: bool,
}

/// Kind of a [`KnownCause`], in the order of reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum KnownCauseKind {
    /// The time step is longer than the stable time step.
    UnstableStep,
    /// Particles leave the grid.
    OutsideGrid,
    /// The suite has an equilibrium solution, but the scene has no dissipation.
    NoDamping,
    /// The errors of an external solver are as large as the solution on all levels.
    AnotherProblem,
    /// The coarsest levels do not resolve the exact solution.
    CoarseLevels,
    /// The exact solution is not smooth enough for the theoretical order.
    NotSmooth,
}

/// A cause that lies in the problem, the levels or the time steps, and affects any method.
#[derive(Debug, Clone)]
pub struct KnownCause {
    /// Kind of the cause.
    pub kind: KnownCauseKind,
    /// The cause, as a clause without a full stop.
    pub cause: String,
    /// Measured values that support the finding, in whole sentences.
    pub evidence: String,
    /// Change of the suite that removes the cause, if any.
    pub remedy: Option<String>,
    /// Observed order without the cause, if measured.
    pub order: Option<Interval>,
    /// Whether the cause explains the observed order. Otherwise another cause has a larger effect.
    pub explains: bool,
}

/// A cause, with the evidence for it.
#[derive(Debug, Clone, Copy)]
pub enum Cause<'a> {
    /// A property of the problem, the levels or the time steps.
    Known(&'a KnownCause),
    /// A run with one change, and the effect of the change.
    Run(&'a ChangedRun, Evidence),
}

/// Diagnosis of one case: its possible causes and the evidence.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// Name of the case.
    pub case: String,
    /// Theoretical order.
    pub formal_order: f64,
    /// Judgement of the unchanged case on all levels.
    pub judgement: Judgement,
    /// Judgement of the unchanged case on the levels on which changes are tried.
    pub finest: Judgement,
    /// Error of the unchanged case on the finest level.
    pub finest_error: f64,
    /// Names of the levels on which changes are tried.
    pub levels: Vec<String>,
    /// Whether the solver is external. Its settings then cannot be changed.
    pub is_external: bool,
    /// Causes that were found without changing the method.
    pub findings: Vec<KnownCause>,
    /// Runs with one change each.
    pub runs: Vec<ChangedRun>,
    /// Descriptions of changes that were not tried because they are too expensive.
    pub skipped: Vec<String>,
}

impl Cause<'_> {
    /// Returns the cause, as a clause without a full stop.
    pub fn cause(&self) -> &str {
        match self {
            Self::Known(finding) => &finding.cause,
            Self::Run(run, _) => run.cause,
        }
    }

    /// Returns the change that removes the cause; `None` if `check` accepts no such change.
    pub fn remedy(&self) -> Option<&str> {
        match self {
            Self::Known(finding) => finding.remedy.as_deref(),
            Self::Run(run, _) => run.refusal.is_none().then_some(run.remedy),
        }
    }
}

impl Diagnosis {
    /// Whether the case has the theoretical order, so that there is nothing to explain.
    pub fn is_sound(&self) -> bool {
        self.judgement.verdict == Verdict::Converging
    }

    /// Whether a finding is certainly the cause. Runs with one change each are then not needed.
    pub fn is_known(&self) -> bool {
        self.findings.iter().any(|finding| finding.kind < KnownCauseKind::CoarseLevels)
    }

    /// Returns the finding of this kind, if any.
    pub fn finding(&self, kind: KnownCauseKind) -> Option<&KnownCause> {
        self.findings.iter().find(|finding| finding.kind == kind)
    }

    /// Returns the causes, starting with the most likely one. If a run restores the theoretical
    /// order, the exact solution is not a cause.
    pub fn causes(&self) -> Vec<Cause<'_>> {
        use KnownCauseKind::{CoarseLevels, NotSmooth};
        if self.is_known() {
            return self.findings.iter().map(Cause::Known).collect();
        }
        let run = self.found();
        let restored = run.filter(|(_, evidence)| *evidence == Evidence::Restored);
        let coarse = self.finding(CoarseLevels);
        let mut causes: Vec<_> = coarse.map(Cause::Known).into_iter().collect();
        if let Some((run, evidence)) = restored {
            // Finer cells reveal no other cause: they have the effect of omitting coarse levels.
            let is_nearer = coarse
                .is_none_or(|coarse| !run.is_finer && self.off(run.order) < self.off(coarse.order));
            causes.insert(if is_nearer { 0 } else { causes.len() }, Cause::Run(run, evidence));
        }
        if restored.is_some() {
            return causes;
        }
        // A raised order was not limited by the exact solution before, although it may be now.
        let is_raised = run.is_some_and(|(_, evidence)| evidence == Evidence::Raised);
        let limit = self.finding(NotSmooth);
        let is_limited = limit.is_some_and(|limit| limit.explains && !is_raised);
        if causes.is_empty() && !is_limited {
            causes.extend(run.map(|(run, evidence)| Cause::Run(run, evidence)));
        }
        causes.extend(limit.map(Cause::Known));
        causes
    }

    fn off(&self, order: Option<Interval>) -> f64 {
        order.map_or(f64::INFINITY, |order| (order.value - self.formal_order).abs())
    }

    /// Returns the (first) run that reveals the cause, and the effect of its change: a restored
    /// order (nearest to theory), a settled order (largest increase), or a decrease of the error.
    pub fn found(&self) -> Option<(&ChangedRun, Evidence)> {
        let least = self.formal_order - OrderHypothesis::TOLERANCE;
        let is_near = self.finest.verdict == Verdict::Converging;
        let before = self.off(self.finest.order);
        // An order that was already close to theory counts as restored only if the new interval is
        // within the expected range.
        let restores = |run: &&ChangedRun| {
            let is_within = run.order.is_some_and(|order| order.low >= least);
            let is_nearer = self.off(run.order) <= CLOSER * before;
            run.verdict == Verdict::Converging && is_nearer && (is_within || !is_near)
        };
        let restoring = self.runs.iter().filter(restores);
        let nearest = restoring.clone().map(|run| self.off(run.order)).reduce(f64::min);
        let is_nearest =
            |run: &&ChangedRun| nearest.is_some_and(|off| self.off(run.order) <= off + ALIKE);
        if let Some(run) = restoring.clone().find(is_nearest) {
            return Some((run, Evidence::Restored));
        }
        if is_near {
            return None;
        }
        let before = self.finest.order.map_or(0.0, |order| order.value.max(0.0));
        let settled = |run: &ChangedRun| {
            let order = run.order.filter(|order| order.half_width() <= SETTLED)?;
            (run.verdict == Verdict::TooLow && order.value >= before + RISE).then_some(order.value)
        };
        let highest = self.runs.iter().filter_map(settled).reduce(f64::max);
        let raises = |run: &&ChangedRun| {
            settled(run).zip(highest).is_some_and(|(order, most)| order >= most - ALIKE)
        };
        if let Some(run) = self.runs.iter().find(raises) {
            return Some((run, Evidence::Raised));
        }
        let falls = self.runs.iter().filter(|run| !run.is_finer && run.relative_ratio <= FALL);
        let most = falls.min_by(|a, b| a.relative_ratio.total_cmp(&b.relative_ratio));
        most.map(|run| (run, Evidence::Lowered))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Level, judge};
    use Verdict::{Converging, TooLow};

    fn found(verdict: Verdict, order: Interval) -> Judgement {
        let none = judge(&[Level::new(1.0, 1.0)], &OrderHypothesis::formal(2.0));
        Judgement { verdict, order: Some(order), ..none }
    }

    fn order(value: f64, half_width: f64) -> Interval {
        Interval { value, low: value - half_width, high: value + half_width }
    }

    fn diagnosis(finest: (Verdict, Interval), run: (Verdict, Interval, f64)) -> Diagnosis {
        let judgement = found(finest.0, finest.1);
        let changed = ChangedRun {
            change: String::new(),
            cause: "the cause",
            remedy: "",
            refusal: None,
            verdict: run.0,
            order: Some(run.1),
            error: run.2,
            ratio: run.2,
            relative_ratio: run.2,
            is_finer: false,
            has_more_particles: false,
        };
        Diagnosis {
            case: String::new(),
            formal_order: 2.0,
            finest: judgement.clone(),
            judgement,
            finest_error: 1.0,
            levels: Vec::new(),
            is_external: false,
            findings: Vec::new(),
            runs: vec![changed],
            skipped: Vec::new(),
        }
    }

    fn evidence(diagnosis: &Diagnosis) -> Option<Evidence> {
        diagnosis.found().map(|(_, evidence)| evidence)
    }

    /// A change of the order from 1.7 to 2.05 brings it nearer to 2, but a change to 2.4 does not.
    #[test]
    fn the_order_that_is_nearer_to_theory_is_restored() {
        let to = |value| (Converging, order(value, 0.05), 0.9);
        let low = (TooLow, order(1.7, 0.05));
        assert_eq!(evidence(&diagnosis(low, to(2.05))), Some(Evidence::Restored));
        assert_eq!(evidence(&diagnosis(low, to(2.4))), None);
        let low = (TooLow, order(1.79, 0.05));
        assert_eq!(evidence(&diagnosis(low, to(1.81))), None, "the order hardly moves");
    }

    /// A change to an order whose interval exceeds the range does not explain a nearly correct one.
    #[test]
    fn an_order_nearly_right_is_restored_by_a_whole_interval() {
        let near = (Converging, order(1.95, 0.04));
        let to = |half_width| (Converging, order(2.0, half_width), 0.9);
        assert_eq!(evidence(&diagnosis(near, to(0.05))), Some(Evidence::Restored));
        assert_eq!(evidence(&diagnosis(near, to(0.15))), None);
    }

    /// Creates a known cause of the given kind, with the order 1.97 after its removal.
    fn finding(kind: KnownCauseKind) -> KnownCause {
        let (cause, evidence) = ("the finding".to_owned(), String::new());
        KnownCause {
            kind,
            cause,
            evidence,
            remedy: None,
            order: Some(order(1.97, 0.02)),
            explains: true,
        }
    }

    fn causes(diagnosis: &Diagnosis) -> Vec<String> {
        diagnosis.causes().iter().map(|cause| cause.cause().to_owned()).collect()
    }

    #[test]
    fn largest_change_of_order_is_the_first_cause() {
        let low = (TooLow, order(1.5, 0.05));
        for (value, first) in [(1.8, "the finding"), (2.0, "the cause")] {
            let mut found = diagnosis(low, (Converging, order(value, 0.05), 0.9));
            found.findings = vec![finding(KnownCauseKind::CoarseLevels)];
            assert_eq!(causes(&found)[0], first, "{value}");
        }
    }

    #[test]
    fn a_kink_is_the_cause_unless_the_order_is_restored() {
        let low = (TooLow, order(1.0, 0.05));
        let mut found = diagnosis(low, (TooLow, order(1.01, 0.05), 0.6));
        found.findings = vec![finding(KnownCauseKind::NotSmooth)];
        assert_eq!(causes(&found), ["the finding"]);
        let mut found = diagnosis(low, (Converging, order(2.0, 0.05), 0.6));
        found.findings = vec![finding(KnownCauseKind::NotSmooth)];
        assert_eq!(causes(&found), ["the cause"]);
    }

    #[test]
    fn a_kink_that_does_not_explain_the_order_comes_last() {
        let mut found = diagnosis((TooLow, order(0.8, 0.05)), (TooLow, order(1.2, 0.05), 0.6));
        found.findings = vec![finding(KnownCauseKind::NotSmooth)];
        assert_eq!(causes(&found), ["the cause", "the finding"]);
        let mut found = diagnosis((TooLow, order(0.2, 0.05)), (TooLow, order(0.2, 0.05), 0.6));
        found.findings = vec![KnownCause { explains: false, ..finding(KnownCauseKind::NotSmooth) }];
        assert_eq!(causes(&found), ["the cause", "the finding"]);
    }

    #[test]
    fn a_smaller_error_of_finer_levels_is_no_evidence() {
        let mut found = diagnosis((TooLow, order(1.0, 0.05)), (TooLow, order(1.0, 0.05), 0.25));
        assert_eq!(evidence(&found), Some(Evidence::Lowered));
        found.runs[0].is_finer = true;
        assert_eq!(evidence(&found), None);
    }
}
