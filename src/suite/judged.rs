//! From levels that have run to the outcome of a case.

use super::{
    model::{Case, ConvergencePlan},
    statement,
    words::NormName,
};
use crate::verify::{
    self, CaseOutcome, Claim, Convergence, Judgement, LevelOutcome, Richardson, Run, Seen, Study,
    judge,
};

fn error_of(norm: NormName, run: &Run) -> f64 {
    match norm {
        NormName::Rms => run.errors.rms,
        NormName::L1 => run.errors.l1,
        NormName::L2 => run.errors.l2,
        NormName::Linf => run.errors.linf,
        NormName::MaxRms => run.max_rms,
    }
}

/// The outcome of a case whose levels have run.
pub(super) fn judged(
    plan: &ConvergencePlan,
    case: &Case,
    mut levels: Vec<LevelOutcome>,
) -> CaseOutcome {
    let judgement = judge_levels(plan, case, &levels);
    for (level, order) in levels.iter_mut().zip(&judgement.pairwise) {
        level.order = *order;
    }
    let finest = levels.last();
    let seen = Seen {
        verdict: judgement.verdict,
        order: judgement.order.map(|order| (order.low, order.high)),
        finest_pair: finest.and_then(|level| level.order),
        crossings: finest.and_then(|level| level.run.census.crossings),
    };
    CaseOutcome {
        verdict: judgement.verdict.to_string(),
        reason: judgement.reason.clone(),
        unmet: case.expectation.unmet(&seen),
        study: Study::Convergence(Box::new(Convergence {
            formal_order: case.method.formal_order(),
            richardson: richardson(&levels),
            observed_at: plan.observe.as_ref().map(|place| place[0]),
            norm: plan.norm.name(),
            judgement,
            levels,
        })),
        ..described(case)
    }
}

fn judge_levels(plan: &ConvergencePlan, case: &Case, levels: &[LevelOutcome]) -> Judgement {
    let judged: Vec<verify::Level> = levels
        .iter()
        .map(|level| {
            let plain = verify::Level::new(level.h, error_of(plan.norm, &level.run));
            let plain = if level.usable { plain } else { plain.unusable() };
            match &level.run.failure {
                Some(reason) => plain.failing(reason.clone()),
                None => plain,
            }
        })
        .collect();
    let claim =
        Claim { formal_order: case.method.formal_order(), expected: case.expectation.order };
    judge(&judged, &claim)
}

/// Richardson's extrapolation for each triple of levels with n, 2n and 4n cells.
fn richardson(levels: &[LevelOutcome]) -> Vec<([u64; 3], Richardson)> {
    let value = |cells: u64| {
        levels.iter().find(|level| level.cells == cells).and_then(|level| level.run.displacement)
    };
    levels
        .iter()
        .filter_map(|level| {
            let cells = [level.cells, 2 * level.cells, 4 * level.cells];
            let values = [value(cells[0])?, value(cells[1])?, value(cells[2])?];
            Some((cells, Richardson::equal_ratio(values, 2.0)))
        })
        .collect()
}

/// What is known of a case before it runs.
fn described(case: &Case) -> CaseOutcome {
    CaseOutcome {
        case: case.name.clone(),
        subject: case.method.subject(),
        settings: statement::settings(case),
        expected: case.expectation.summary(),
        because: case.expectation.because.clone(),
        verdict: String::new(),
        reason: String::new(),
        unmet: Vec::new(),
        study: Study::Refused,
    }
}

/// The outcome of a case that could not be set up.
pub(super) fn refused(case: &Case, reason: String) -> CaseOutcome {
    CaseOutcome {
        verdict: verify::Verdict::Failed.to_string(),
        unmet: vec![format!("the case could not be run: {reason}")],
        reason,
        ..described(case)
    }
}
