//! Everything that the judge is told about a case besides its levels.

use super::error_scale::{error_scale, largest_exact};
use super::formal_order::formal_order;
use crate::exact::Truth;
use crate::subject::Precision;
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::method::Method;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::verify::{Conserved, Expectation, JudgePlan, Quantity, RoundingSizes};

/// The plan by which a case is judged, whose errors are taken against `truth`.
pub(super) fn judge_plan<'a>(
    plan: &'a ConvergencePlan,
    case: &'a Case,
    expectation: Option<&'a Expectation>,
    truth: &dyn Truth,
) -> JudgePlan<'a> {
    JudgePlan {
        axis: plan.refine.axis,
        formal_order: formal_order(plan, case),
        norm: plan.norm,
        of: plan.of,
        scale: plan.scale,
        error_scale: error_scale(plan, case, truth),
        is_compared: case.against != Against::Nothing,
        excludes_crossings: plan.crossing_levels == CrossingLevels::Excluded,
        observed_at: plan.observe.as_deref(),
        sums: sums(plan, case),
        expectation,
        gating: case.gating.as_ref(),
    }
}

/// The sums over the body that a case has, for an author who has not bounded any.
fn sums(plan: &ConvergencePlan, case: &Case) -> Vec<Conserved> {
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

/// Sizes of the numbers that the solver of a case rounds.
pub(super) fn rounding_sizes(
    plan: &ConvergencePlan,
    case: &Case,
    truth: &dyn Truth,
) -> Option<RoundingSizes> {
    let unit = match case.method {
        Method::External { precision: Precision::Single, .. } => f64::from(f32::EPSILON) / 2.0,
        _ => f64::EPSILON / 2.0,
    };
    // The size of a sum over the body is the scale of its error.
    let value = Some(largest_exact(plan, case, truth)).filter(|size| *size > 0.0).or(plan.scale)?;
    let scene = &plan.scene;
    let positions = scene.from.iter().chain(&scene.to).fold(0.0_f64, |most, x| most.max(x.abs()));
    let number = match plan.of {
        // Displacements are differences of positions.
        Quantity::Displacement => positions + value,
        Quantity::DeformationGradient => 1.0,
        Quantity::Stress => value.max(scene.density * scene.wave_speed() * scene.wave_speed()),
        _ => value,
    };
    Some(RoundingSizes { value, number, unit })
}
