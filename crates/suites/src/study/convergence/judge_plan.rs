//! Inputs of the judge for a case: formal order, error scale and judge plan.

use crate::exact::{Problem, Truth};
use crate::mpm::SchemeName;
use crate::study::exact_motion::{Extremes, lattice};
use crate::subject::Start;
use crate::suite::grammar::CrossingLevels;
use crate::suite::model::method::Method;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::verify::{
    Axis, Conserved, ErrorScale, Expectation, JudgePlan, Quantity, RoundingSizes, StudySettings,
    single_precision_spacing,
};

pub(super) fn judge_plan<'a>(
    plan: &'a ConvergencePlan,
    case: &'a Case,
    expectation: Option<&'a Expectation>,
    truth: &dyn Truth,
) -> JudgePlan<'a> {
    let settings = StudySettings {
        axis: plan.refine.axis,
        formal_order: formal_order(plan, case),
        norm: plan.norm,
        of: plan.of,
        within: plan.within.clone(),
        scale: plan.scale,
        error_scale: error_scale(plan, case, truth),
        compared: case.against != Against::Nothing,
        steps: plan.steps,
        observed_at: plan.observe.clone(),
    };
    JudgePlan {
        settings,
        excludes_crossings: plan.crossing_levels == CrossingLevels::Excluded,
        position_spacing: position_spacing(plan, case),
        sums: sums(plan, case),
        expectation,
        gating: case.gating.as_ref(),
    }
}

/// Returns the distance (m) between neighbouring positions in single precision. `None` unless a
/// solver in single precision is judged by its displacement and formulas give the motion.
fn position_spacing(plan: &ConvergencePlan, case: &Case) -> Option<f64> {
    let is_judged = plan.of == Quantity::Displacement && case.against != Against::Nothing;
    let exact = plan.exact.as_ref().filter(|_| is_judged && case.method.is_single_precision())?;
    single_precision_spacing(Extremes::of(exact).largest_coordinate())
}

/// Returns the conserved sums whose drift is reported for a case without an expectation.
fn sums(plan: &ConvergencePlan, case: &Case) -> Vec<Conserved> {
    let dimension = plan.scene.dimension();
    let of_law = plan.scene.material.properties().has_energy(dimension).is_ok();
    let has_energy = of_law && !case.method.averages_volume();
    let has = |sum: &Conserved| match sum {
        Conserved::AngularMomentum => dimension > 1,
        Conserved::Energy => has_energy,
        Conserved::KineticEnergyGain => false,
        Conserved::Mass | Conserved::Momentum | Conserved::KineticEnergy => true,
    };
    let moves = matches!(case.method, Method::Mpm(_));
    Conserved::ALL.iter().copied().filter(|sum| moves && has(sum)).collect()
}

/// Returns the sizes of the numbers whose rounding limits the accuracy of a case.
pub(super) fn rounding_sizes(
    plan: &ConvergencePlan,
    case: &Case,
    truth: &dyn Truth,
) -> Option<RoundingSizes> {
    let is_single = case.method.is_single_precision();
    let unit = if is_single { f64::from(f32::EPSILON) / 2.0 } else { f64::EPSILON / 2.0 };
    // The error scale is used if the largest exact value is zero, as for a sum over the body.
    let value = Some(largest_exact(plan, case, truth)).filter(|size| *size > 0.0).or(plan.scale)?;
    let scene = &plan.scene;
    let positions = scene.from.iter().chain(&scene.to).fold(0.0_f64, |most, x| most.max(x.abs()));
    let number = match plan.of {
        // A displacement is the difference between two positions.
        Quantity::Displacement => positions + value,
        of if of.needs_deformation_gradient() => 1.0,
        of if of.is_stress() => value.max(scene.wave_modulus()),
        _ => value,
    };
    Some(RoundingSizes { value, number, unit })
}

/// Assumed order in the particle spacing, that of the midpoint rule. Theory gives no general order,
/// because integrands jump where derivatives of the basis jump, and because particles leave the
/// centres of their volumes (Steffen, Kirby & Berzins 2008, Int. J. Numer. Meth. Engng 76, 922).
const MIDPOINT: f64 = 2.0;

/// Fraction of the largest velocity or acceleration above which an initial value is not zero.
const AT_REST: f64 = 1e-9;

pub(crate) fn formal_order(plan: &ConvergencePlan, case: &Case) -> f64 {
    match plan.refine.axis {
        Axis::Space => case.method.formal_order(),
        Axis::Time => in_time(case.method, plan.exact.as_ref()),
        Axis::Particles => MIDPOINT,
    }
}

/// Returns the formal order in time. Euler-Cromer is a leapfrog of order 2 if it starts with
/// `v(-dt/2)`. A start with `v(0)` instead causes a velocity error of `dt/2 a(0)`: order 1 unless
/// `a(0)` is zero. USF adds `dt grad v` of the initial velocity to F before the first motion: order
/// 1 unless `v(0)` is zero. Without a formula for the motion, `v(0)` and `a(0)` are assumed to be
/// non-zero.
pub(crate) fn in_time(method: Method, exact: Option<&Problem>) -> f64 {
    let (start, updates_first) = match method {
        Method::Mpm(method) => (method.start, method.scheme == SchemeName::Usf),
        Method::Fem { start, .. } => (start, false),
        // Load steps are not refined. Heat conduction is integrated by forward Euler.
        Method::QuasiStatic { .. } | Method::Heat { .. } => return 1.0,
        // The order that an external solver claims in space is assumed in time too.
        Method::External { formal_order, .. } => return formal_order,
    };
    let [moves, accelerates] = exact.map_or([true, true], begins);
    let pushed = start == Start::AtZero && accelerates;
    if pushed || (updates_first && moves) { 1.0 } else { 2.0 }
}

/// Whether the initial velocity and the initial acceleration of the motion are non-zero.
fn begins(problem: &Problem) -> [bool; 2] {
    const PER_AXIS: usize = 9;
    let d = problem.dimension();
    let label = |point: usize| -> Vec<f64> {
        let along = |axis: usize| {
            let index = point / PER_AXIS.pow(axis as u32) % PER_AXIS;
            let share = (index as f64 + 0.5) / PER_AXIS as f64;
            problem.from[axis] + (problem.to[axis] - problem.from[axis]) * share
        };
        (0..d).map(along).collect()
    };
    let largest = |t: f64| {
        let mut largest = [0.0_f64; 2];
        for point in 0..PER_AXIS.pow(d as u32) {
            let now = problem.motion.derivatives(&label(point), t);
            for (most, field) in largest.iter_mut().zip([now.velocity, now.acceleration]) {
                *most = field.iter().fold(*most, |a, b| a.max(b.abs()));
            }
        }
        largest
    };
    let first = largest(0.0);
    let mut ever = first;
    for k in 1..=PER_AXIS {
        let later = largest(problem.until * k as f64 / PER_AXIS as f64);
        ever = [ever[0].max(later[0]), ever[1].max(later[1])];
    }
    [first[0] > AT_REST * ever[0], first[1] > AT_REST * ever[1]]
}

/// Number of sampling intervals along each axis and in time, `COARSE` in 3-D. The numbers are even,
/// so the middle is a sampling point.
const FINE: usize = 20;
const COARSE: usize = 8;

pub(crate) fn error_scale(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> ErrorScale {
    ErrorScale {
        problem: match case.load_steps(plan) {
            Some(count) => {
                let plural = if count == 1 { "" } else { "s" };
                format!("in {count} load step{plural}, compared with {}", case.against.words())
            }
            None => format!("until t = {} s, compared with {}", case.until, case.against.words()),
        },
        size: size(plan, case, truth),
        growth: growth(plan),
    }
}

fn size(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> f64 {
    if case.against == Against::Nothing {
        return f64::NAN;
    }
    if plan.scale.is_some() {
        return 1.0;
    }
    largest_exact(plan, case, truth)
}

pub(crate) fn largest_exact(plan: &ConvergencePlan, case: &Case, truth: &dyn Truth) -> f64 {
    // A reference run of the same method has values only at the points of that run, so a formula
    // for the motion is preferred.
    let formula = plan.exact.as_ref().map(|exact| exact as &dyn Truth);
    let is_same = matches!(case.against, Against::SameMethod(_));
    let truth = if is_same { formula.unwrap_or(truth) } else { truth };
    let per_axis = if plan.scene.dimension() == 3 { COARSE } else { FINE };
    let at_rest = plan.exact.as_ref().is_some_and(|exact| exact.at_rest);
    let share = |k: usize| case.until * (k as f64 / per_axis as f64);
    let times: Vec<f64> =
        if at_rest { vec![case.until] } else { (0..=per_axis).map(share).collect() };
    plan.of.largest_exact(truth, &places(plan, per_axis), &times)
}

fn places(plan: &ConvergencePlan, per_axis: usize) -> Vec<Vec<f64>> {
    let scene = &plan.scene;
    let outline = scene.outline.as_ref();
    let inside = |place: &Vec<f64>| outline.is_none_or(|outline| outline.holds(place));
    lattice(&scene.from, &scene.to, per_axis).filter(inside).collect()
}

/// Returns the theoretical exponent k in work ~ spacing^-k, with the step numbers of the levels.
fn growth(plan: &ConvergencePlan) -> f64 {
    let d = plan.scene.dimension() as f64;
    let levels = &plan.refine.levels;
    let steps = match (levels.first(), levels.last()) {
        (Some(first), Some(last)) if last.h < first.h => {
            libm::log(first.dt / last.dt) / libm::log(first.h / last.h)
        }
        _ => 0.0,
    };
    match plan.refine.axis {
        Axis::Space => d + steps,
        Axis::Time => 1.0,
        // Particles fill the body, so half the spacing means 2^D times as many particles.
        Axis::Particles => d,
    }
}
