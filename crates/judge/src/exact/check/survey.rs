//! Samples a problem: positions and times of the checks, and the largest terms.
//!
//! Events (positions with a time) are distributed evenly. If terms are large only in a small part,
//! events are added close to the largest terms, to resolve narrow pulses. Residuals are divided by
//! the largest term at all events, because terms far from a pulse are only rounding errors.

use super::event::{BROAD, EVENTS, Event, FACE_EVENTS, SpaceTimeBox, greatest, largest};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;

/// Number of rounds that add events close to the largest terms.
const ROUNDS: usize = 8;

const ADDED: usize = 16;

/// Minimum share of evenly distributed events at which a resolved quantity has half its maximum.
const RESOLVED: f64 = 1.0 / 16.0;

/// Maximum distance of an added event in the first round, relative to the size of the body and the
/// duration of the run. Each round halves this distance.
const REACH: f64 = 1.0 / 32.0;

/// The largest magnitudes of a motion and of the terms in its equation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Magnitudes {
    pub(crate) displacement: f64,
    pub(crate) velocity: f64,
    pub(crate) acceleration: f64,
    pub(crate) gradient: f64,
    /// Second derivatives of the displacement along each axis (1/m).
    pub(crate) curvature: f64,
    /// Stress scale (Pa): modulus times displacement gradient, plus the initial stress.
    pub(crate) stress: f64,
    /// Divergence of the stress (N/m3).
    pub(crate) divergence: f64,
    /// Body force (N/m3).
    pub(crate) force: f64,
    /// Sum of the magnitudes of all terms of the equation of motion (N/m3).
    pub(crate) terms: f64,
}

impl Magnitudes {
    const COUNT: usize = 9;

    fn at(
        problem: &Problem,
        event: &Event,
        now: &Derivatives,
        [divergence, force]: &[[f64; 3]; 2],
    ) -> Self {
        let initial = problem.initial_stress.at(&event.label);
        let density = problem.density.at(&event.label);
        let gradient = greatest(now.grad.iter().map(largest));
        // In a tube at rest, the hoop term balances the other terms of Div P.
        let hoops = largest(&problem.hoop_force(&event.label, event.t, now));
        let terms = (0..problem.dimension()).map(|i| {
            let inertia = density * now.acceleration[i];
            inertia.abs() + divergence[i].abs() + (density * force[i]).abs() + hoops
        });
        Self {
            displacement: largest(&now.u),
            velocity: largest(&now.velocity),
            acceleration: largest(&now.acceleration),
            gradient,
            curvature: greatest(now.second.iter().flatten().map(largest)),
            stress: problem.modulus() * gradient + greatest(initial.iter().map(largest)),
            divergence: largest(divergence),
            force: density * largest(force),
            terms: terms.sum(),
        }
    }

    fn to_array(self) -> [f64; Self::COUNT] {
        let Self { displacement, velocity, acceleration, gradient, curvature, .. } = self;
        let Self { stress, divergence, force, terms, .. } = self;
        [
            displacement,
            velocity,
            acceleration,
            gradient,
            curvature,
            stress,
            divergence,
            force,
            terms,
        ]
    }

    /// Returns the larger value of each magnitude; NaN if either value is NaN.
    fn larger(self, other: Self) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        let all: [f64; Self::COUNT] = std::array::from_fn(|i| greatest([a[i], b[i]].into_iter()));
        let [displacement, velocity, acceleration, gradient, curvature, ..] = all;
        let [.., stress, divergence, force, terms] = all;
        let first = Self { displacement, velocity, acceleration, gradient, ..self };
        Self { curvature, stress, divergence, force, terms, ..first }
    }
}

#[derive(Debug)]
pub(crate) struct SurveyPoint {
    pub(crate) event: Event,
    pub(crate) now: Derivatives,
    /// Divergence of the stress (N/m3).
    pub(crate) divergence: [f64; 3],
    /// Body force (m/s2).
    pub(crate) force: [f64; 3],
    sizes: Magnitudes,
}

/// The motion of a problem at many events (positions with times), and its largest terms.
#[derive(Debug)]
pub struct Survey {
    /// Evenly distributed events, followed by those close to the largest terms.
    pub(crate) points: Vec<SurveyPoint>,
    /// The largest magnitudes over all bodies of a scene.
    pub largest: Magnitudes,
    /// Number of events at which conditions on a face are checked.
    pub(crate) face_events: usize,
}

impl Survey {
    /// Evaluates the motion of `problem`.
    pub fn new(problem: &Problem) -> Self {
        let mut random = Random::new(1);
        let mut spread = |count: usize| -> Vec<SurveyPoint> {
            let events = events(problem, count, &mut random);
            events.into_iter().map(|event| point(problem, event)).collect()
        };
        let mut points = spread(EVENTS / BROAD);
        let mut face_events = FACE_EVENTS / BROAD;
        if !(0..Magnitudes::COUNT).all(|quantity| is_broad(&points, quantity)) {
            points = spread(EVENTS);
            face_events = FACE_EVENTS;
            for quantity in 0..Magnitudes::COUNT {
                concentrate(problem, &mut points, quantity, &mut random);
            }
        }
        let none = Magnitudes::default();
        let largest = points.iter().fold(none, |all, point| all.larger(point.sizes));
        Self { points, largest, face_events }
    }

    /// Evaluates the motions of all bodies of a scene, which share their largest magnitudes.
    pub fn of_each(problems: &[Problem]) -> Vec<Self> {
        let mut all: Vec<Self> = problems.iter().map(Self::new).collect();
        let none = Magnitudes::default();
        let largest = all.iter().fold(none, |most, survey| most.larger(survey.largest));
        let face_events = all.iter().map(|survey| survey.face_events).max().unwrap_or(0);
        for survey in &mut all {
            (survey.largest, survey.face_events) = (largest, face_events);
        }
        all
    }

    /// Returns the reference position and the motion at every event.
    pub fn motion(&self) -> impl Iterator<Item = (&[f64], &Derivatives)> {
        self.points.iter().map(|point| (point.event.label.as_slice(), &point.now))
    }

    /// Returns at most `count` events at which the quantity `of` is at least half of its maximum.
    pub(crate) fn active(&self, count: usize, of: impl Fn(&Magnitudes) -> f64) -> Vec<&Event> {
        let most = greatest(self.points.iter().map(|point| of(&point.sizes)));
        let active: Vec<&Event> = self
            .points
            .iter()
            .filter(|point| of(&point.sizes) >= 0.5 * most)
            .map(|point| &point.event)
            .collect();
        let step = active.len().div_ceil(count.max(1)).max(1);
        active.into_iter().step_by(step).collect()
    }
}

/// Returns events distributed evenly over the body of `problem` and the run.
pub(crate) fn events(problem: &Problem, count: usize, random: &mut Random) -> Vec<Event> {
    let Some(outline) = &problem.outline else {
        return extent(problem).spread(count, |axis| problem.motion.varies_along(axis), random);
    };
    let event = |number: usize| {
        let share = (number as f64 + random.unit()) / count as f64;
        let t = problem.loaded(problem.until * share);
        Event { label: outline.point(random), t }
    };
    (0..count).map(event).collect()
}

pub(crate) fn extent(problem: &Problem) -> SpaceTimeBox<'_> {
    let Problem { from, to, until, .. } = problem;
    SpaceTimeBox { from, to, start: problem.loaded(0.0), end: *until }
}

fn point(problem: &Problem, event: Event) -> SurveyPoint {
    let now = problem.derivatives(&event.label, event.t);
    let divergence = problem.divergence(&event.label, event.t, &now);
    let force = problem.force(&event.label, event.t, &now);
    let sizes = Magnitudes::at(problem, &event, &now, &[divergence, force]);
    SurveyPoint { event, now, divergence, force, sizes }
}

/// Whether a quantity is at least half of its maximum at the share [`RESOLVED`] of the points.
fn is_broad(points: &[SurveyPoint], quantity: usize) -> bool {
    let values = || points.iter().map(|point| point.sizes.to_array()[quantity]);
    let most = greatest(values());
    let active = values().filter(|value| *value >= 0.5 * most).count();
    active as f64 >= RESOLVED * points.len() as f64
}

/// Adds events near those where a quantity is at least half its maximum, ever closer in each round.
fn concentrate(
    problem: &Problem,
    points: &mut Vec<SurveyPoint>,
    quantity: usize,
    random: &mut Random,
) {
    let mut values: Vec<f64> =
        points.iter().map(|point| point.sizes.to_array()[quantity]).collect();
    let mut reach = REACH;
    for _ in 0..ROUNDS {
        let most = greatest(values.iter().copied());
        if !(most > 0.0) {
            return;
        }
        let active: Vec<usize> = (0..values.len()).filter(|i| values[*i] >= 0.5 * most).collect();
        if active.is_empty() {
            return;
        }
        for _ in 0..ADDED {
            let chosen = (random.unit() * active.len() as f64) as usize;
            let near = &points[active[chosen.min(active.len() - 1)]].event;
            let ends = problem.from.iter().zip(&problem.to);
            let mut moved = |x: f64, length: f64| x + reach * length * random.between(-1.0, 1.0);
            let places = near.label.iter().zip(ends.clone());
            let label: Vec<f64> = places.map(|(x, (low, high))| moved(*x, high - low)).collect();
            let t = problem.loaded(moved(near.t, problem.until));
            let in_box = label.iter().zip(ends).all(|(x, (low, high))| low < x && x < high);
            let in_run = t > 0.0 && t <= problem.until;
            if in_box && in_run && problem.holds(&label) {
                points.push(point(problem, Event { label, t }));
                values.extend(points.last().map(|point| point.sizes.to_array()[quantity]));
            }
        }
        reach *= 0.5;
    }
}
