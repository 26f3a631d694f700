//! Finds jumps of the exact displacement or its derivatives, and the order that such jumps allow.
//!
//! The derivatives are computed from the formulas. If two points approach each other, the
//! difference of their values remains at a jump, but vanishes on a steep slope.

use super::session::{Known, finding};
use crate::exact::{Derivatives, Problem};
use crate::suite::grammar::NormName;
use crate::suite::model::{Against, ConvergencePlan};
use crate::verify::{Axis, KnownCause, KnownCauseKind, OrderHypothesis, Quantity};

/// Length (cells) below which a change of the strain counts as a jump.
const STEEP: f64 = 0.5;

/// A jump explains an observed order only if the order is at most this much below the limit.
const BELOW: f64 = 0.5;

/// Returns the maximum order that a method of order `p` can reach if the derivative of order `jump`
/// of the solution is discontinuous; `None` for a temperature or a sum over the body.
///
/// A scheme of order p smears a jump of the judged quantity over h^(p/(p + 1)). Each continuous
/// derivative multiplies the error by this factor (Brenner & Thomee 1971, Math. Scand. 27, 5). In
/// an equilibrium the jump is smeared over one cell.
fn limit(plan: &ConvergencePlan, p: f64, jump: usize) -> Option<f64> {
    let differentiated = match plan.of {
        Quantity::Displacement => 0.0,
        Quantity::Velocity => 1.0,
        of if of.is_stress() || of.needs_deformation_gradient() => 1.0,
        _ => return None,
    };
    let of_support = match plan.norm {
        NormName::L1 | NormName::MaxL1 => 1.0,
        NormName::Rms
        | NormName::MaxRms
        | NormName::L2
        | NormName::MaxL2
        | NormName::MassL2
        | NormName::MaxMassL2 => 0.5,
        NormName::Linf | NormName::MaxLinf => 0.0,
    };
    let is_at_rest = plan.exact.as_ref().is_some_and(|exact| exact.at_rest);
    let front = if is_at_rest { 1.0 } else { p / (p + 1.0) };
    Some((jump as f64 - differentiated + of_support).max(0.0) * front)
}

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
            "the exact solution is not smooth: it has {kind}: its {what} jumps at X = ({}) m, \
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
             {length:.1e} m, but the finest cells measure {finest:.1e} m, so the change is a kink"
        );
        (1, cause)
    };
    let p = known.session.formal_order;
    let limit = limit(plan, p, jump)?;
    let observed = known.finest.order;
    // An order above this limit shows that the jump has no effect, because it lies on a grid line.
    let is_lower =
        observed.is_none_or(|order| order.low <= limit + 2.0 * OrderHypothesis::TOLERANCE);
    if !(limit < p - OrderHypothesis::TOLERANCE && is_lower) {
        return None;
    }
    let norm = plan.norm.name().replace('_', " ");
    let of = plan.of.words();
    let shown = observed.map_or("not determined".to_owned(), |order| order.shown());
    let evidence = format!(
        "For such a solution, a method of formal order {p} has an order of at most about \
         {limit:.2} in the {norm} norm of the {of}; the observed order is {shown}."
    );
    let manufactured = plan.manufactured().is_some() && jump < 2;
    let lacking = " The manufactured body force lacks the concentrated force at the kink, so the \
                   solver solves another problem.";
    let remedy = if manufactured {
        "a manufactured displacement without a kink".to_owned()
    } else {
        format!(
            "expect an order of about {limit:.2} or less, or use an initial state and loads that \
             give a smooth solution"
        )
    };
    let evidence = if manufactured { evidence + lacking } else { evidence };
    let explains = observed.is_some_and(|order| order.value >= limit - BELOW);
    let found = finding(KnownCauseKind::NotSmooth, cause, evidence, remedy);
    Some(KnownCause { explains, ..found })
}

/// Times at which the solution is examined, as fractions of the run.
const TIMES: [f64; 6] = [0.37, 0.61, 0.83, 0.17, 1.0, 0.0];

/// Number of intervals on each examined line, and number of lines along each axis, by dimension.
const INTERVALS: [usize; 3] = [512, 128, 64];
const LINES: [usize; 3] = [1, 5, 3];

/// Minimum size of a jump, as a fraction of the largest value of the derivative.
const LEAST: f64 = 1e-3;

/// Maximum length of an interval that counts as a point, as a fraction of the length of the line.
const POINT: f64 = 1e-9;

/// Fraction of its natural size below which a derivative counts as rounding error.
const ROUNDING: f64 = 1e-9;

type Derivative = (usize, fn(&Derivatives) -> Vec<f64>);

/// The displacement and its derivatives, starting with the lowest order.
const GROUPS: [Derivative; 6] = [
    (0, |now| now.u.to_vec()),
    (1, |now| now.velocity.to_vec()),
    (1, |now| now.grad.as_flattened().to_vec()),
    (2, |now| now.acceleration.to_vec()),
    (2, |now| now.grad_rate.as_flattened().to_vec()),
    (2, |now| now.second.as_flattened().as_flattened().to_vec()),
];

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Jump {
    pub(crate) order: usize,
    /// Position (m) of the jump.
    pub(crate) place: Vec<f64>,
    /// Time (s) of the jump.
    pub(crate) time: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes([f64; GROUPS.len()]);

impl Sizes {
    /// Returns the length (m) over which the displacement changes: the square root of the ratio of
    /// its size to the size of its second derivatives. For a sine this is the wavelength divided by
    /// 2 pi.
    pub(crate) fn length(&self) -> f64 {
        (self.0[0] / self.0[5]).sqrt()
    }

    /// Returns the length (m) over which the displacement gradient changes.
    pub(crate) fn gradient_length(&self) -> f64 {
        self.0[2] / self.0[5]
    }
}

pub(crate) fn sizes(problem: &Problem, until: f64) -> Sizes {
    let mut sizes = [0.0_f64; GROUPS.len()];
    for line in lines(problem) {
        for share in TIMES {
            for (_, place) in line.inside(problem) {
                let now = problem.motion.derivatives(&place, share * until);
                for (size, (_, values)) in sizes.iter_mut().zip(&GROUPS) {
                    *size = values(&now).iter().fold(*size, |a, b| a.max(b.abs()));
                }
            }
        }
    }
    Sizes(sizes)
}

pub(crate) fn lowest_jump(problem: &Problem, until: f64) -> Option<Jump> {
    let Sizes(sizes) = sizes(problem, until);
    let length = problem.from.iter().zip(&problem.to).map(|(a, b)| b - a).fold(0.0, f64::max);
    let [u, velocity, grad, ..] = sizes;
    let natural = [u, u / until, u / length, velocity / until, velocity / length, grad / length];
    for (index, (order, values)) in GROUPS.iter().enumerate() {
        if !(sizes[index] > ROUNDING * natural[index]) {
            continue;
        }
        let least = LEAST * sizes[index];
        for line in lines(problem) {
            for time in TIMES.map(|share| share * until) {
                let at = |place: &[f64]| values(&problem.motion.derivatives(place, time));
                if let Some(place) = line.jump(problem, least, &at) {
                    return Some(Jump { order: *order, place, time });
                }
            }
        }
    }
    None
}

struct LocalLine {
    axis: usize,
    from: Vec<f64>,
    to: f64,
}

impl LocalLine {
    fn place(&self, x: f64) -> Vec<f64> {
        let mut place = self.from.clone();
        place[self.axis] = x;
        place
    }

    fn inside<'a>(&'a self, problem: &'a Problem) -> impl Iterator<Item = (usize, Vec<f64>)> + 'a {
        let count = INTERVALS[problem.dimension().clamp(1, 3) - 1];
        let from = self.from[self.axis];
        let place = move |k: usize| self.place(from + (self.to - from) * k as f64 / count as f64);
        let places = (0..=count).map(move |k| (k, place(k)));
        places.filter(|(_, place)| problem.holds(place))
    }

    fn jump(
        &self,
        problem: &Problem,
        least: f64,
        at: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<f64>> {
        let mut before: Option<(usize, f64, Vec<f64>)> = None;
        for (k, place) in self.inside(problem) {
            let (x, values) = (place[self.axis], at(&place));
            if let Some((_, from, old)) = before.filter(|(last, ..)| last + 1 == k) {
                let jump = (0..values.len())
                    .find_map(|i| self.bisect((from, old[i]), (x, values[i]), i, least, at));
                if jump.is_some() {
                    return jump;
                }
            }
            before = Some((k, x, values));
        }
        None
    }

    fn bisect(
        &self,
        mut low: (f64, f64),
        mut high: (f64, f64),
        i: usize,
        least: f64,
        at: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<f64>> {
        let point = POINT * (self.to - self.from[self.axis]);
        // A difference that is not finite does not count as a jump.
        while (high.1 - low.1).abs() >= least && (high.1 - low.1).is_finite() {
            let x = 0.5 * (low.0 + high.0);
            if high.0 - low.0 <= point {
                return Some(self.place(x));
            }
            let middle = (x, at(&self.place(x))[i]);
            let is_low = (middle.1 - low.1).abs() >= (high.1 - middle.1).abs();
            (low, high) = if is_low { (low, middle) } else { (middle, high) };
        }
        None
    }
}

fn lines(problem: &Problem) -> Vec<LocalLine> {
    let d = problem.dimension();
    let count = LINES[d.clamp(1, 3) - 1];
    let mut lines = Vec::new();
    for axis in 0..d {
        for number in 0..count.pow(d as u32 - 1) {
            let mut rest = number;
            let mut from = problem.from.clone();
            for other in (0..d).filter(|other| *other != axis) {
                let share = (0.5 + (rest % count) as f64) / count as f64;
                from[other] += (problem.to[other] - problem.from[other]) * share;
                rest /= count;
            }
            lines.push(LocalLine { axis, from, to: problem.to[axis] });
        }
    }
    lines
}
