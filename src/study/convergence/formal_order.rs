//! The order that theory gives a case along the axis that is refined.

use crate::exact::Problem;
use crate::mpm::SchemeName;
use crate::subject::Start;
use crate::suite::model::method::Method;
use crate::suite::model::{Case, ConvergencePlan};
use crate::verify::Axis;

/// Order of the midpoint rule. Particles are the quadrature points of the weak form, but theory
/// gives no order for them in general: integrands jump where a basis does, and the midpoint rule
/// holds only as long as particles stay in the middle of their parts of the body (Steffen, Kirby &
/// Berzins 2008, Int. J. Numer. Meth. Engng 76, 922). The judge uses it to tell floors, and as the
/// centre of the expected interval of a suite that gives no `order`.
const MIDPOINT: f64 = 2.0;

/// Share of the largest velocity (or acceleration) above which a motion starts with one.
const AT_REST: f64 = 1e-9;

/// The order of the displacement error.
pub(crate) fn formal_order(plan: &ConvergencePlan, case: &Case) -> f64 {
    match plan.refine.axis {
        Axis::Space => case.method.formal_order(),
        Axis::Time => in_time(case.method, plan.exact.as_ref()),
        Axis::Particles => MIDPOINT,
    }
}

/// Euler-Cromer is a leapfrog, of order 2, if it starts as one: with `v(-dt/2)`. `v(0)` in its
/// place is a push of `dt/2 a(0)`, and order 1 unless a(0) = 0. USF adds `dt grad v` of the first
/// velocity to F before anything has moved: order 1 unless v(0) = 0. (That USL and USF keep terms
/// of first order, of h^2 and of the strain squared, is for suites to say: temporal-order.) Where
/// no formula tells, neither is taken as zero.
pub(crate) fn in_time(method: Method, exact: Option<&Problem>) -> f64 {
    let (start, updates_first) = match method {
        Method::Mpm { start, scheme, .. } => (start, scheme == SchemeName::Usf),
        Method::Fem { start, .. } => (start, false),
        // Forward Euler.
        Method::Heat { .. } => return 1.0,
        // What is told of such a solver is its order in space: none in time is known.
        Method::External { formal_order, .. } => return formal_order,
    };
    let [moves, accelerates] = exact.map_or([true, true], begins);
    let pushed = start == Start::AtZero && accelerates;
    if pushed || (updates_first && moves) { 1.0 } else { 2.0 }
}

/// Whether the motion begins with a velocity, and with an acceleration.
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
