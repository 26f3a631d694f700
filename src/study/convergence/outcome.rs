//! From levels that have run to the outcome of a case.

use super::described::described;
use super::formal_order::formal_order;
use crate::suite::compile::truth::conservation_only;
use crate::suite::grammar::NormName;
use crate::suite::model::method::Method;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::verify;
use crate::verify::{
    Acceptance, Axis, CaseFindings, CaseOutcome, ConservationError, Conserved, Convergence,
    ErrorScale, Expectation, Floor, GateResult, Interval, Judgement, LevelOutcome, Limits,
    Measured, OrderHypothesis, Richardson, RunResult, Verdict, judge, larger,
};
use std::sync::Arc;

/// The error that `plan` judges.
pub(crate) fn error_of(plan: &ConvergencePlan, run: &RunResult) -> f64 {
    let error = match plan.norm {
        NormName::Rms => run.at_end.rms,
        NormName::L1 => run.at_end.l1,
        NormName::L2 => run.at_end.l2,
        NormName::Linf => run.at_end.linf,
        NormName::MaxRms => run.largest.rms,
        NormName::MaxL1 => run.largest.l1,
        NormName::MaxL2 => run.largest.l2,
        NormName::MaxLinf => run.largest.linf,
    };
    plan.scale.map_or(error, |scale| error / scale)
}

/// Expectation of a case, or the result of its gate.
#[derive(Clone, Copy)]
pub(crate) struct CaseBinding<'a> {
    pub(crate) expectation: Option<&'a Expectation>,
    pub(crate) gate: Option<&'a GateResult>,
}

/// The outcome of a case whose levels have run.
pub(crate) fn judged(
    plan: &ConvergencePlan,
    case: &Case,
    binding: CaseBinding<'_>,
    mut levels: Vec<LevelOutcome>,
    judgement: Judgement,
    floor: Option<Floor>,
    error_scale: ErrorScale,
) -> CaseOutcome {
    let CaseBinding { expectation, gate } = binding;
    for (level, order) in levels.iter_mut().zip(&judgement.pairwise) {
        level.order = *order;
    }
    let finest = levels.last();
    let measured = measured(&levels);
    let seen = CaseFindings {
        verdict: judgement.verdict,
        order: judgement.order.map(|order| (order.low, order.high)),
        finest_pair: finest.and_then(|level| level.order),
        crossings: finest.and_then(|level| level.run.counters.crossings),
        measured,
        floor: floor.as_ref().and_then(Floor::cause),
    };
    let unmet = match (expectation, gate) {
        (Some(expectation), _) => expectation.unmet(&seen),
        (None, Some(gate)) => gate.result.as_ref().err().cloned().into_iter().collect(),
        (None, None) => Vec::new(),
    };
    let (verdict, reason) = match expectation {
        Some(expectation) => headline(expectation, &judgement, &measured, &unmet),
        None => explored(plan, case, &judgement, &measured),
    };
    let is_met = gate.and_then(|gate| gate.result.as_ref().ok());
    let verdict = is_met.map_or(verdict, |met| met.verdict(judgement.verdict));
    let remark = gate.and_then(|gate| gate.remark.clone());
    let drifts = match expectation {
        Some(expectation) => expectation.limits.drifts(),
        None => explored_drifts(plan, case),
    };
    let found = floor.as_ref().filter(|floor| !floor.probes.is_empty()).map(Floor::sentence);
    CaseOutcome {
        verdict,
        reason: [Some(reason), found, remark].into_iter().flatten().collect::<Vec<_>>().join("; "),
        unmet,
        study: Some(Arc::new(Convergence {
            axis: plan.refine.axis,
            formal_order: formal_order(plan, case),
            floor,
            richardson: richardson(plan.refine.axis, &levels),
            observed_at: plan.observe.clone(),
            norm: plan.norm.name(),
            of: plan.of,
            scale: plan.scale,
            error_scale,
            compared: case.against != Against::Nothing,
            bounded: expectation.is_some_and(|expectation| expectation.verdict.is_none())
                || is_met.is_some_and(|met| *met != Acceptance::Order)
                || gate.is_some_and(|gate| gate.remark.is_some()),
            accepted: is_met.copied(),
            drifts,
            rated: expectation.is_some_and(|expected| expected.limits.energy_rate.is_some()),
            judgement,
            levels,
        })),
        ..described(plan, case, expectation)
    }
}

/// A level as the judge takes it, with its failure, whether or not it may count.
pub(crate) fn to_judge(level: &LevelOutcome) -> verify::Level {
    let judged = verify::Level::new(level.spacing, level.error);
    match &level.run.failure {
        Some(reason) => judged.failing(reason.clone()),
        None => judged,
    }
}

/// The levels as the judge takes them, with those marked that do not count.
pub(crate) fn series(levels: &[LevelOutcome]) -> Vec<verify::Level> {
    let marked = |level: &LevelOutcome| {
        let judged = to_judge(level);
        if level.usable { judged } else { judged.unusable() }
    };
    levels.iter().map(marked).collect()
}

/// The judge's finding on levels that have run.
pub(crate) fn judge_levels(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
    levels: &[LevelOutcome],
) -> Judgement {
    let truthless = case.against == Against::Nothing;
    if let Some(judgement) = truthless.then(|| conservation_only::judgement(levels)).flatten() {
        return judgement;
    }
    judge_series(plan, case, expectation, &series(levels))
}

/// The judge's finding on a series of errors.
pub(crate) fn judge_series(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
    levels: &[verify::Level],
) -> Judgement {
    let (formal_order, axis) = (formal_order(plan, case), plan.refine.axis);
    let expected = expectation.and_then(|expectation| expectation.order);
    judge(levels, &OrderHypothesis { formal_order, expected, axis })
}

/// Figures that limits apply to: the worst of the levels that count, and the observed place on the
/// finest.
fn measured(levels: &[LevelOutcome]) -> Measured {
    let counted = || levels.iter().filter(|level| level.usable);
    let errors = counted().map(|level| (level.error, level.error));
    let residual_speed: Option<Vec<f64>> =
        counted().map(|level| level.run.residual_speed).collect();
    let drifts: Option<Vec<ConservationError>> = counted().map(|level| level.run.drift).collect();
    let rates: Option<Vec<Interval>> = counted().map(|level| level.run.energy_rate).collect();
    Measured {
        errors: errors.reduce(|(least, most), (error, _)| {
            if (least + most + error).is_nan() {
                return (f64::NAN, f64::NAN);
            }
            (least.min(error), most.max(error))
        }),
        observed: levels.last().and_then(|level| level.run.observed_error),
        residual_speed: residual_speed.and_then(|all| all.into_iter().reduce(larger)),
        drift: drifts.and_then(|drifts| drifts.into_iter().reduce(ConservationError::larger)),
        energy_rate: rates.and_then(|rates| {
            let ends = rates.into_iter().map(|rate| (rate.low, rate.high));
            ends.reduce(|(low, high), (a, b)| (low.min(a), high.max(b)))
        }),
    }
}

/// The verdict and its reason where nothing is expected: what the judge says against the order of
/// theory, and what drifts.
fn explored(
    plan: &ConvergencePlan,
    case: &Case,
    judgement: &Judgement,
    measured: &Measured,
) -> (String, String) {
    let drift = explored_drifts(plan, case).into_iter().map(|sum| (sum, f64::INFINITY)).collect();
    let found = Limits { drift, ..Limits::default() }.found(measured);
    let seen = [judgement.reason.clone(), found];
    let said: Vec<String> = seen.into_iter().filter(|part| !part.is_empty()).collect();
    (judgement.verdict.to_string(), said.join("; "))
}

/// The sums that a case has, for an author who has not bound any.
fn explored_drifts(plan: &ConvergencePlan, case: &Case) -> Vec<Conserved> {
    let dimension = plan.scene.dimension();
    let has_energy = plan.scene.material.properties().has_energy(dimension).is_ok();
    let has = |sum: &Conserved| match sum {
        Conserved::AngularMomentum => dimension > 1,
        Conserved::Energy => has_energy,
        Conserved::KineticEnergyGain => false,
        Conserved::Mass | Conserved::Momentum | Conserved::KineticEnergy => true,
    };
    let moves = matches!(case.method, Method::Mpm { .. });
    Conserved::ALL.iter().copied().filter(|sum| moves && has(sum)).collect()
}

/// The verdict and its reason. Where limits alone bind a case, their finding comes first, and that
/// of the judge follows if the levels are enough for a judgement.
fn headline(
    expectation: &Expectation,
    judgement: &Judgement,
    measured: &Measured,
    unmet: &[String],
) -> (String, String) {
    let (verdict, reason) = (judgement.verdict, &judgement.reason);
    let found = expectation.limits.found(measured);
    if found.is_empty() {
        return (verdict.to_string(), reason.clone());
    }
    if expectation.verdict.is_some() || verdict == Verdict::Failed {
        return (verdict.to_string(), format!("{reason}; {found}"));
    }
    let within = if unmet.is_empty() { "within bounds" } else { "out of bounds" };
    // The judge's reason speaks of an expected order, of which there is none here.
    let judged = match (verdict, judgement.order) {
        (Verdict::TooFewLevels, _) => String::new(),
        (Verdict::AtFloor | Verdict::Divergent, _) | (_, None) => format!("; {verdict}: {reason}"),
        (_, Some(order)) => format!("; order {}", order.shown()),
    };
    (within.to_owned(), found + &judged)
}

/// Richardson's extrapolation for each triple of levels of which each is twice as fine as the one
/// before: with n, 2n and 4n cells, steps or (in 1-D, where alone a place is observed) particles.
fn richardson(axis: Axis, levels: &[LevelOutcome]) -> Vec<([usize; 3], Richardson)> {
    let fineness = |level: &LevelOutcome| match axis {
        Axis::Space => level.cells,
        Axis::Time => level.run.steps,
        Axis::Particles => level.ppc.unwrap_or(0),
    };
    let with = |wanted: u64| levels.iter().position(|level| fineness(level) == wanted);
    let triple = |k: usize| {
        let n = fineness(&levels[k]);
        let triple = [k, with(2 * n)?, with(4 * n)?];
        // Of several components no one stands for the displacement.
        let value =
            |k: usize| levels[k].run.displacement.as_deref().filter(|u| u.len() == 1).map(|u| u[0]);
        let values = [value(triple[0])?, value(triple[1])?, value(triple[2])?];
        Some((triple, Richardson::equal_ratio(values, 2.0)))
    };
    (0..levels.len()).filter_map(triple).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::RunCounters;
    use crate::verify::Norms;

    fn level(usable: bool, error: f64, drift: Option<ConservationError>) -> LevelOutcome {
        let counters = RunCounters::new(0);
        let run = RunResult {
            field: None,
            errors: Norms::ZERO,
            max_rms: 0.0,
            at_end: Norms::ZERO,
            largest: Norms::ZERO,
            drift,
            account: Vec::new(),
            energy_rate: None,
            counters,
            steps: 1,
            failure: None,
            history: None,
            displacement: None,
            observed_error: Some(error),
            residual_speed: None,
        };
        LevelOutcome {
            cells: 1,
            h: 1.0,
            spacing: 1.0,
            dt: 1.0,
            ppc: None,
            run,
            error,
            usable,
            order: None,
            stable_time_step: None,
        }
    }

    #[test]
    fn only_levels_that_count_are_measured() {
        let levels = [3.0, 1.0, 2.0].map(|error| level(true, error, None));
        let [a, b, c] = levels;
        let found = measured(&[a, b, c, level(false, 9.0, None)]);
        assert_eq!(
            (found.errors, found.observed, found.drift),
            (Some((1.0, 3.0)), Some(9.0), None)
        );
        assert_eq!(measured(&[level(false, 1.0, None)]).errors, None);
    }

    #[test]
    fn one_nan_is_the_largest_and_the_smallest() {
        for errors in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            let (least, most) = measured(&errors.map(|e| level(true, e, None))).errors.unwrap();
            assert!(least.is_nan() && most.is_nan());
        }
        let alone = measured(&[level(true, f64::NAN, Some(ConservationError::NONE))]);
        assert!(alone.errors.unwrap().0.is_nan());
        assert!(alone.drift.unwrap().of(verify::Conserved::Mass).is_nan());
    }

    /// One level that is bound and asked for no verdict.
    #[test]
    fn bounds_alone_make_the_headline() {
        let limits = Limits { error_below: Some(1e-9), ..Limits::default() };
        let crossings = None;
        let because = String::new();
        let (verdict, order, finest_pair, floor) = (None, None, None, None);
        let bound = Expectation { verdict, order, finest_pair, crossings, limits, floor, because };
        let said = |level: verify::Level, unmet: &[String]| {
            let judgement = judge(&[level], &OrderHypothesis::formal(2.0));
            let measured = Measured {
                errors: Some((1e-12, 1e-12)),
                observed: None,
                residual_speed: None,
                drift: None,
                energy_rate: None,
            };
            headline(&bound, &judgement, &measured, unmet)
        };
        let one = verify::Level::new(1.0, 1e-12);
        let within = ("within bounds".to_owned(), "largest error 1e-12".to_owned());
        assert_eq!(said(one.clone(), &[]), within);
        assert_eq!(said(one.clone(), &["too large".to_owned()]).0, "out of bounds");
        assert_eq!(said(one.failing("inverted"), &[]).0, "failed");
    }
}
