//! Judges a case of a convergence study from its levels and the judge plan.

use super::exclusion::leaves_too_few;
use super::expectation::gate::{Acceptance, GateResult, Gating, rounding_remark};
use super::figure::{CaseFigure, counted};
use super::{
    CaseFindings, ConservationError, Convergence, EstimateRefusal, Expectation, Floor, Interval,
    JudgePlan, Judgement, LevelOutcome, LevelRun, LimitEstimate, Limits, Measured, Reruns,
    SeriesPoint, Unmet, Verdict, estimate_limit, rerun,
};

/// Judgement of a case, computed from its levels.
#[derive(Debug, Clone)]
pub struct CaseJudgement {
    /// Verdict, as text.
    pub verdict: String,
    /// Explanation of the verdict, with the measured values that led to it.
    pub reason: String,
    /// Expectations that are not met.
    pub unmet: Vec<Unmet>,
    /// Reason why `run --gate` requires nothing of the case; `None` if it requires something.
    pub exemption: Option<String>,
    /// Levels, orders and measured values.
    pub study: Convergence,
}

/// Judges a case from the `runs` of its levels. `reruns` runs levels again to find the cause of an
/// error floor, or with shorter time steps for `run --gate`.
pub fn judge_case<R: Reruns>(
    plan: &JudgePlan<'_>,
    runs: Vec<LevelRun>,
    reruns: &R,
) -> CaseJudgement {
    let mut levels: Vec<LevelOutcome> = runs.into_iter().map(|run| plan.level(run)).collect();
    let judgement = plan.judge_levels(&levels);
    let floor = rerun::floor(plan, &judgement, &levels, reruns);
    let mut exemption = plan.exemption(&levels);
    let mut gate = match (&exemption, plan.gating) {
        (None, Some(Gating::Required(required))) => {
            Some(rerun::gate(plan, required, &levels, &judgement, reruns))
        }
        _ => None,
    };
    // Errors below the rounding bound are no evidence of an order.
    if gate.as_ref().is_some_and(|gate| gate.result.is_err()) && leaves_too_few(&levels, &judgement)
    {
        exemption = Some("the rounding bound leaves too few levels for an order".to_owned());
        gate = None;
    }
    for (level, order) in levels.iter_mut().zip(&judgement.pairwise) {
        level.order = *order;
    }
    let remarks =
        gate.as_ref().map_or_else(Vec::new, |gate| remarks(plan, gate, &judgement, &levels));
    if let Some(gate) = &gate {
        for level in &mut levels {
            let bound = gate.rounding * plan.settings.scale.unwrap_or(1.0);
            level.rounding_bound = level.rounding_bound.or((bound > 0.0).then_some(bound));
        }
    }
    let measured = measure(&levels);
    let unmet = match (plan.expectation, &gate) {
        (Some(expectation), _) => {
            let finest = levels.last();
            expectation.unmet(&CaseFindings {
                verdict: judgement.verdict,
                order: judgement.order.map(|order| (order.low, order.high)),
                finest_pair: finest.and_then(|level| level.order),
                crossings: finest.and_then(|level| level.run.counters.crossings),
                measured,
                floor: floor.as_ref().and_then(Floor::cause),
            })
        }
        (None, Some(gate)) => gate.result.as_ref().err().cloned().into_iter().collect(),
        (None, None) => Vec::new(),
    };
    let (verdict, reason) = match plan.expectation {
        Some(expectation) => headline(expectation, &judgement, &measured, &unmet),
        None => plan.explore(&judgement, &measured),
    };
    let rounding = rounding_without_order(plan, gate.as_ref(), &levels, reruns);
    let (met, reason) = match (&rounding, &gate) {
        (Some(remark), _) => (Some(Acceptance::Rounding), remark.clone()),
        (None, Some(gate)) => (gate.result.as_ref().ok().copied(), reason),
        (None, None) => (None, reason),
    };
    let cause = floor.as_ref().filter(|floor| !floor.probes.is_empty()).map(Floor::sentence);
    let reasons: Vec<String> =
        [Some(reason), cause].into_iter().flatten().chain(remarks.clone()).collect();
    CaseJudgement {
        verdict: met.map_or(verdict, |met| met.verdict(judgement.verdict)),
        reason: reasons.join("; "),
        unmet,
        exemption,
        study: Convergence { remarks, ..plan.study(levels, judgement, floor, met, gate.as_ref()) },
    }
}

/// Describes the errors of a case without requirement, if all are rounding errors. They have no
/// order, except by chance.
fn rounding_without_order<R: Reruns>(
    plan: &JudgePlan<'_>,
    gate: Option<&GateResult>,
    levels: &[LevelOutcome],
    reruns: &R,
) -> Option<String> {
    // Levels in single precision have a bound of their own, and advice.
    let is_double = levels.iter().all(|level| level.rounding_bound.is_none());
    let is_compared = plan.settings.compared;
    let is_free = is_compared && plan.expectation.is_none() && gate.is_none() && is_double;
    let counted: Vec<&LevelOutcome> =
        levels.iter().filter(|level| level.usable && is_free).collect();
    let bound = (!counted.is_empty()).then(|| rerun::rounding(plan, levels, reruns))?;
    let is_within = |level: &&LevelOutcome| level.run.failure.is_none() && level.error <= bound;
    let (all, is_met) = (counted.len(), bound > 0.0 && counted.iter().all(is_within));
    is_met.then(|| rounding_remark(bound, all, all))
}

fn remarks(
    plan: &JudgePlan<'_>,
    gate: &GateResult,
    judgement: &Judgement,
    levels: &[LevelOutcome],
) -> Vec<String> {
    let counted = levels.iter().filter(|level| level.usable);
    let errors: Vec<f64> = counted.map(|level| level.error).collect();
    let within = errors.iter().filter(|error| **error <= gate.rounding).count();
    let rounding = (within > 0 && gate.result.is_ok() && gate.remark.is_none())
        .then(|| rounding_remark(gate.rounding, within, errors.len()));
    let excess = match plan.gating {
        Some(Gating::Required(required)) if gate.remark.is_none() => required.excess(judgement),
        _ => None,
    };
    [rounding, excess, gate.remark.clone()].into_iter().flatten().collect()
}

impl JudgePlan<'_> {
    fn explore(&self, judgement: &Judgement, measured: &Measured) -> (String, String) {
        let drift = self.sums.iter().map(|sum| (*sum, f64::INFINITY)).collect();
        let drifts = Limits { drift, ..Limits::default() }.found(measured);
        let parts = [judgement.reason.clone(), drifts];
        let reasons: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        (judgement.verdict.to_string(), reasons.join("; "))
    }

    fn study(
        &self,
        levels: Vec<LevelOutcome>,
        judgement: Judgement,
        floor: Option<Floor>,
        accepted: Option<Acceptance>,
        gate: Option<&GateResult>,
    ) -> Convergence {
        let limits = self.expectation.map(|expectation| &expectation.limits);
        Convergence {
            settings: self.settings.clone(),
            bounded: self.expectation.is_some_and(|expectation| expectation.verdict.is_none())
                || accepted.is_some_and(|accepted| accepted != Acceptance::Order)
                || gate.is_some_and(|gate| gate.remark.is_some()),
            accepted,
            remarks: Vec::new(),
            drifts: limits.map_or_else(|| self.sums.clone(), Limits::drifts),
            rated: limits.is_some_and(|limits| limits.energy_rate.is_some()),
            judgement,
            floor,
            observed_limit: observed_limit(&levels),
            levels,
        }
    }
}

fn measure(levels: &[LevelOutcome]) -> Measured {
    let drifts: Option<Vec<ConservationError>> =
        counted(levels).map(|level| level.run.drift).collect();
    let rates: Option<Vec<Interval>> = counted(levels).map(|level| level.run.energy_rate).collect();
    Measured {
        figures: CaseFigure::ALL.map(|figure| figure.value(levels)),
        drift: drifts.and_then(|drifts| drifts.into_iter().reduce(ConservationError::larger)),
        energy_rate: rates.and_then(|rates| {
            let ends = rates.into_iter().map(|rate| (rate.low, rate.high));
            ends.reduce(|(low, high), (a, b)| (low.min(a), high.max(b)))
        }),
    }
}

/// Returns the verdict (for bounds only: `within bounds` or `out of bounds`) and its reason.
fn headline(
    expectation: &Expectation,
    judgement: &Judgement,
    measured: &Measured,
    unmet: &[Unmet],
) -> (String, String) {
    let (verdict, reason) = (judgement.verdict, &judgement.reason);
    let figures = expectation.limits.found(measured);
    if figures.is_empty() {
        return (verdict.to_string(), reason.clone());
    }
    if expectation.verdict.is_some() || verdict == Verdict::Failed {
        return (verdict.to_string(), format!("{reason}; {figures}"));
    }
    let within = if unmet.is_empty() { "within bounds" } else { "out of bounds" };
    // Without an expected order, the reason contains only the observed order.
    let judged = match (verdict, judgement.order) {
        (Verdict::TooFewLevels, _) => String::new(),
        (Verdict::AtFloor | Verdict::Divergent, _) | (_, None) => format!("; {verdict}: {reason}"),
        (_, Some(order)) => format!("; order {}", order.shown()),
    };
    (within.to_owned(), figures + &judged)
}

/// Estimates the limit of the 1-D displacement at the observed point, from two values or more.
fn observed_limit(levels: &[LevelOutcome]) -> Option<Result<LimitEstimate, EstimateRefusal>> {
    let point = |level: &LevelOutcome| match level.run.displacement.as_deref() {
        // One component of several does not represent the displacement.
        Some([u]) => Some(SeriesPoint { h: level.spacing, value: *u, resolution: 0.0 }),
        _ => None,
    };
    let series: Vec<SeriesPoint> = levels.iter().filter_map(point).collect();
    (series.len() > 1).then(|| estimate_limit(&series))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::conservation::Balance;
    use crate::verify::convergence::tests::study;
    use crate::verify::judge_plan::tests::{level_run, plan};
    use crate::verify::rerun::RoundingSizes;
    use crate::verify::rerun::tests::{SECOND_ORDER, SIZES, scripted};
    use crate::verify::{Axis, Conserved, Level, OrderHypothesis, UnmetCode, judge};
    use approx::assert_relative_eq;
    use mpm_subject::Totals;
    use rstest::rstest;

    fn level(usable: bool, error: f64, drift: Option<ConservationError>) -> LevelOutcome {
        let mut level = study(&[error]).levels.remove(0);
        level.usable = usable;
        level.run.drift = drift;
        level.run.observed_error = Some(error);
        level
    }

    /// Drifts, speeds and rates have their extremes on different levels.
    #[test]
    fn only_levels_that_count_are_measured() {
        let all = [(true, 3.0, 0.5), (true, 1.0, 0.75), (true, 2.0, 0.25), (false, 9.0, 7.0)];
        let mut levels: Vec<LevelOutcome> = all
            .map(|(usable, error, mass)| {
                let totals = |mass| Totals { mass, ..Totals::default() };
                let mut balance = Balance::start(totals(1.0));
                balance.look(Some(&totals(1.0 - mass)));
                level(usable, error, Some(balance.drift()))
            })
            .into();
        for (level, rate) in levels.iter_mut().zip([-3.0, 2.0, -1.0, 9.0]) {
            level.run.energy_rate =
                Some(Interval { value: rate, low: rate - 0.5, high: rate + 0.25 });
            level.run.residual_speed = Some(4.0 - rate.abs());
        }
        let found = measure(&levels);
        assert_eq!(found.figures, [Some(3.0), Some(1.0), Some(9.0), Some(3.0)]);
        assert_eq!(found.drift.map(|drift| drift.of(Conserved::Mass)), Some(0.75));
        assert_eq!(found.energy_rate, Some((-3.5, 2.25)));
        (levels[1].run.drift, levels[1].run.energy_rate) = (None, None);
        let found = measure(&levels);
        assert_eq!((found.drift, found.energy_rate), (None, None));
        let found = measure(&[level(false, 1.0, None)]);
        assert_eq!(found.figure(CaseFigure::ErrorBelow), None);
    }

    fn runs(errors: [f64; 4]) -> Vec<LevelRun> {
        let sizes = [4, 8, 16, 32].into_iter().zip(errors);
        sizes.map(|(cells, error)| level_run(cells, 0.4 / cells as f64, error)).collect()
    }

    /// The bound of 99 steps is 8e4 m 2^-53 = 8.88e-12 m, or 8.88e-6 of the scale.
    #[rstest]
    #[case::all_within([8.8e-12, 1e-12, 3e-12, 2e-12], 4, "at rounding")]
    #[case::fine_levels([6.4e-11, 1.6e-11, 4e-12, 1e-12], 2, "within bounds")]
    #[case::one_above([9e-12, 8e-12, 9e-12, 8e-12], 2, "at floor")]
    fn the_gate_accepts_rounding_errors(
        #[case] errors: [f64; 4],
        #[case] within: usize,
        #[case] verdict: &str,
    ) {
        let gating = Gating::Required(SECOND_ORDER);
        let gated = JudgePlan { gating: Some(&gating), ..plan() };
        let found = judge_case(&gated, runs(errors), &scripted(|h, _| h));
        assert_eq!((found.verdict.as_str(), found.exemption), (verdict, None));
        assert_eq!(found.unmet.is_empty(), verdict != "at floor");
        let remark = format!("errors at most 8.9e-6 count as rounding: {within} of 4 levels");
        let text = format!(
            "{} {}",
            found.reason,
            found.unmet.iter().map(|u| &*u.text).collect::<String>()
        );
        assert!(text.contains(&remark), "{text}");
        for level in &found.study.levels {
            let bound = 8e4 / 9_007_199_254_740_992.0;
            assert_relative_eq!(level.rounding_bound.unwrap(), bound, max_relative = 1e-14);
        }
        // Without a requirement, only a case whose errors are all within the bound is at rounding.
        let free = judge_case(&plan(), runs(errors), &scripted(|h, _| h));
        assert_eq!(free.verdict == "at rounding", within == 4, "{}", free.verdict);
        assert_eq!(free.study.levels[0].rounding_bound, None);
        let mut exact = scripted(|h, _| h);
        exact.sizes = Some(RoundingSizes { unit: 0.0, ..SIZES });
        assert_ne!(judge_case(&plan(), runs(errors), &exact).verdict, "at rounding");
    }

    /// Errors of order 2, 1 and 3 between the levels, and a displacement of 2 m - 3 m/s2 dt^2. The
    /// step falls with the square of the cell size.
    #[test]
    fn a_case_has_the_orders_of_its_levels_and_the_limit_over_the_refined_spacing() {
        let mut runs = runs([3.2e-5, 0.8e-5, 0.4e-5, 0.05e-5]);
        for run in &mut runs {
            run.sizes.dt = 6.4 * run.sizes.h * run.sizes.h;
            run.run.displacement = Some(vec![2.0 - 3.0 * run.sizes.dt * run.sizes.dt]);
        }
        let mut plan = plan();
        let found = judge_case(&plan, runs.clone(), &scripted(|h, _| h));
        let orders: Vec<_> = found.study.levels.iter().map(|level| level.order).collect();
        assert_eq!(orders[0], None);
        for (order, expected) in orders[1..].iter().zip([2.0, 1.0, 3.0]) {
            assert_relative_eq!(order.unwrap(), expected, max_relative = 1e-12);
        }
        for (axis, order) in [(Axis::Space, 4.0), (Axis::Time, 2.0)] {
            plan.settings.axis = axis;
            let study = judge_case(&plan, runs.clone(), &scripted(|h, _| h)).study;
            let limit = study.observed_limit.expect("values").expect("a limit");
            assert_relative_eq!(limit.limit.value, 2.0, max_relative = 1e-9);
            assert_relative_eq!(limit.order.value, order, max_relative = 1e-6);
        }
        runs[0].run.displacement = Some(vec![1.0, 2.0]);
        let study = judge_case(&plan, runs, &scripted(|h, _| h)).study;
        let refusal = study.observed_limit.expect("three values").unwrap_err();
        assert_eq!(refusal, EstimateRefusal::TooFewLevels { levels: 3 });
    }

    #[test]
    fn nan_is_the_largest_and_the_smallest_value() {
        for errors in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            let [most, least, ..] = measure(&errors.map(|e| level(true, e, None))).figures;
            assert!(least.unwrap().is_nan() && most.unwrap().is_nan());
        }
        let alone = measure(&[level(true, f64::NAN, Some(ConservationError::NONE))]);
        assert!(alone.figure(CaseFigure::ErrorAbove).unwrap().is_nan());
        assert!(alone.drift.unwrap().of(Conserved::Mass).is_nan());
    }

    #[test]
    fn headline_of_bounds_starts_with_the_bounded_values() {
        let bounds = vec![(CaseFigure::ErrorBelow, 1e-9)];
        let limits = Limits { bounds, ..Limits::default() };
        let bound =
            Expectation { verdict: None, order: None, limits, ..Expectation::of_order(2.0, "") };
        let said = |level: Level, unmet: &[Unmet]| {
            let judgement = judge(&[level], &OrderHypothesis::formal(2.0));
            let figures = [Some(1e-12), Some(1e-12), None, None];
            let measured = Measured { figures, ..Measured::NONE };
            headline(&bound, &judgement, &measured, unmet)
        };
        let one = Level::new(1.0, 1e-12);
        let within = ("within bounds".to_owned(), "largest error 1e-12".to_owned());
        assert_eq!(said(one.clone(), &[]), within);
        assert_eq!(
            said(one.clone(), &[Unmet::new(UnmetCode::BoundExceeded, "too large")]).0,
            "out of bounds"
        );
        assert_eq!(said(one.failing("inverted"), &[]).0, "failed");
    }
}
