//! The order that a norm can have on an exact solution that is not smooth.

use super::jumps::{lowest_jump, sizes};
use super::session::Known;
use crate::suite::grammar::NormName;
use crate::suite::model::{Against, ConvergencePlan};
use crate::verify::{Axis, KnownCause, KnownCauseKind, OrderHypothesis, Quantity};

/// Share of its largest value by which the strain changes in a cell that cannot tell the change
/// from a jump.
const STEEP: f64 = 0.5;

/// Distance of the observed order below the limit, at most, if the limit explains it.
const BELOW: f64 = 0.5;

/// Largest order that a method of order `p` can be expected to have on a solution of which the
/// derivative of order `jump` jumps; `None` of a sum over the body.
///
/// A jump of the judged quantity is smeared over h^(p/(p + 1)) by a scheme of order p, and each
/// continuous derivative gains that factor (Brenner & Thomee 1971, Math. Scand. 27, 5). In an
/// equilibrium nothing travels: the front is as wide as a cell.
fn limit(plan: &ConvergencePlan, p: f64, jump: usize) -> Option<f64> {
    let differentiated = match plan.of {
        Quantity::Displacement => 0.0,
        Quantity::Velocity | Quantity::Stress | Quantity::DeformationGradient => 1.0,
        _ => return None,
    };
    let of_support = match plan.norm {
        NormName::L1 | NormName::MaxL1 => 1.0,
        NormName::Rms | NormName::MaxRms | NormName::L2 | NormName::MaxL2 => 0.5,
        NormName::Linf | NormName::MaxLinf => 0.0,
    };
    let is_at_rest = plan.exact.as_ref().is_some_and(|exact| exact.at_rest);
    let front = if is_at_rest { 1.0 } else { p / (p + 1.0) };
    Some((jump as f64 - differentiated + of_support).max(0.0) * front)
}

/// A finding about an exact solution on which the order of theory cannot be reached.
pub(super) fn check(known: &Known<'_>) -> Option<KnownCause> {
    let (plan, case) = (known.plan, known.session.case);
    let problem = plan.exact.as_ref().filter(|_| case.against == Against::Exact)?;
    if plan.refine.axis != Axis::Space {
        return None;
    }
    let finest = known.levels.last()?.h;
    let (jump, cause) = if let Some(jump) = lowest_jump(problem, case.until) {
        let what = match jump.order {
            0 => "displacement",
            1 => "velocity or strain",
            _ => "acceleration or strain gradient",
        };
        let place: Vec<String> = jump.place.iter().map(|x| format!("{x:.4}")).collect();
        let kind = if jump.order == 1 { "a kink" } else { "a jump" };
        let cause = format!(
            "the exact solution is not smooth: it has {kind}, its {what} jumps at X = ({}) m, \
             t = {:.3e} s",
            place.join(", "),
            jump.time
        );
        (jump.order, cause)
    } else {
        let length = sizes(problem, case.until).gradient_length();
        (length < STEEP * finest).then_some(())?;
        let cause = format!(
            "the exact solution is not smooth at the scale of the cells: its strain changes over \
             {length:.1e} m, and the finest cells measure {finest:.1e} m, so that it has a kink"
        );
        (1, cause)
    };
    let p = known.session.formal_order;
    let limit = limit(plan, p, jump)?;
    let observed = known.finest.order;
    // A higher order than this limit shows that the jump does no harm: the grid has a line there.
    let is_lower =
        observed.is_none_or(|order| order.low <= limit + 2.0 * OrderHypothesis::TOLERANCE);
    if !(limit < p - OrderHypothesis::TOLERANCE && is_lower) {
        return None;
    }
    let norm = plan.norm.name().replace('_', " ");
    let of = plan.of.words();
    let shown = observed.map_or("not determined".to_owned(), |order| order.shown());
    let evidence = format!(
        "On such a solution a method of order {p} has an order of at most about {limit:.2} in the \
         {norm} norm of the {of}; the observed order is {shown}."
    );
    let manufactured = plan.manufactured().is_some() && jump < 2;
    let lacking = " A manufactured force has no concentrated force at a kink, so that the solver \
                   solves another problem.";
    Some(KnownCause {
        kind: KnownCauseKind::NotSmooth,
        cause,
        evidence: if manufactured { evidence + lacking } else { evidence },
        remedy: Some(if manufactured {
            "a manufactured displacement without a kink".to_owned()
        } else {
            format!(
                "expect an order of about {limit:.2} or less, or use an initial state and loads that \
                 give a smooth solution"
            )
        }),
        order: None,
        explains: observed.is_some_and(|order| order.value >= limit - BELOW),
    })
}
