//! Properties of an exact motion: amplitude, extremes, and the residual of a linearised solution.
//!
//! Extremes are computed at regular points of the body and the run, and at the points of a
//! `Survey`, which resolve narrow pulses.

use crate::exact::{Derivatives, Problem, Survey};
use crate::suite::NormName;
use crate::suite::evaluator::shown;
use crate::suite::model::Suite;

pub(crate) fn amplitude(problem: &Problem) -> String {
    const PER_AXIS: usize = 20;
    const GOLDEN: usize = 8;
    let places = raster(problem, PER_AXIS);
    let labels: Vec<&[f64]> = places.iter().map(Vec::as_slice).collect();
    let mut motion = problem.motion.slopes_at_places(&labels);
    let (mut displacement, mut gradient) = (0.0_f64, 0.0_f64);
    let mut now = Derivatives::default();
    let even = (0..=PER_AXIS).map(|step| step as f64 / PER_AXIS as f64);
    // At regular times, a motion with whole periods in each interval would appear to be at rest.
    let golden = (1..=GOLDEN).map(|step| (step as f64 * 0.618_034).fract());
    for share in even.chain(golden) {
        motion.set_time(problem.until * share);
        for place in 0..places.len() {
            motion.derivatives(place, &mut now);
            displacement = now.u.iter().fold(displacement, |a, b| a.max(b.abs()));
            gradient = now.grad.iter().flatten().fold(gradient, |a, b| a.max(b.abs()));
        }
    }
    format!("largest |u| {displacement:.3e} m, largest |grad u| {gradient:.3e}")
}

pub(crate) fn raster(problem: &Problem, intervals: usize) -> Vec<Vec<f64>> {
    let points = lattice(&problem.from, &problem.to, intervals);
    points.filter(|place| problem.holds(place)).collect()
}

/// Returns the points of a regular lattice between two corners (m).
pub(crate) fn lattice(
    from: &[f64],
    to: &[f64],
    intervals: usize,
) -> impl Iterator<Item = Vec<f64>> {
    let point = move |mut rest: usize| {
        let corners = from.iter().zip(to);
        let coordinate = |(a, b): (&f64, &f64)| {
            let share = (rest % (intervals + 1)) as f64 / intervals as f64;
            rest /= intervals + 1;
            a + (b - a) * share
        };
        corners.map(coordinate).collect::<Vec<f64>>()
    };
    (0..(intervals + 1).pow(from.len() as u32)).map(point)
}

/// Number of sampling intervals along each axis, by dimension.
const ALONG: [usize; 3] = [16, 8, 4];

const OVER: usize = 8;

#[derive(Debug, Clone, Default)]
pub(crate) struct Extremes {
    /// Largest |u| (m) along each axis.
    pub(crate) displacement: [f64; 3],
    /// Largest displacement gradient.
    pub(crate) gradient: f64,
    /// Largest second derivative of the displacement along the axes (1/m).
    pub(crate) curvature: f64,
    /// Largest speed (m/s).
    pub(crate) speed: f64,
    /// Largest acceleration (m/s^2).
    pub(crate) acceleration: f64,
    /// Largest component of the initial stress (Pa).
    pub(crate) initial_stress: f64,
    /// Lowest and highest position (m) of the body along each axis.
    pub(crate) reach: [(f64, f64); 3],
}

impl Extremes {
    pub(crate) fn of(problem: &Problem) -> Self {
        let labels = raster(problem, ALONG[problem.dimension().clamp(1, 3) - 1]);
        let labels: Vec<&[f64]> = labels.iter().map(Vec::as_slice).collect();
        let mut motion = problem.motion.at_places(&labels);
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let of_place = |label: &&[f64]| problem.initial_stress.at(label);
        let components = labels.iter().flat_map(of_place).flatten();
        let initial_stress = components.fold(0.0, |most: f64, c| most.max(c.abs()));
        let mut all = Self { initial_stress, reach: [none; 3], ..Self::default() };
        let mut now = Derivatives::default();
        for step in 0..=OVER {
            motion.set_time(problem.until * (step as f64 / OVER as f64));
            for (place, label) in labels.iter().enumerate() {
                motion.derivatives(place, &mut now);
                all.take(label, &now);
            }
        }
        let survey = Survey::new(problem);
        survey.motion().for_each(|(label, now)| all.take(label, now));
        all
    }

    fn take(&mut self, label: &[f64], now: &Derivatives) {
        let size = |field: &[f64; 3]| field.iter().fold(0.0, |sum, x| sum + x * x).sqrt();
        for (axis, x) in label.iter().enumerate() {
            self.displacement[axis] = self.displacement[axis].max(now.u[axis].abs());
            let (low, high) = self.reach[axis];
            self.reach[axis] = (low.min(x + now.u[axis]), high.max(x + now.u[axis]));
        }
        self.gradient = now.grad.iter().flatten().fold(self.gradient, |a, b| a.max(b.abs()));
        let along_axes = now.second.iter().flat_map(|of| (0..3).map(|a| of[a][a]));
        self.curvature = along_axes.fold(self.curvature, |a, b| a.max(b.abs()));
        self.speed = self.speed.max(size(&now.velocity));
        self.acceleration = self.acceleration.max(size(&now.acceleration));
    }

    /// Returns the largest absolute coordinate (m) that a point of the body reaches during the run.
    pub(crate) fn largest_coordinate(&self) -> f64 {
        let ends = self.reach.iter().flat_map(|(low, high)| [low.abs(), high.abs()]);
        ends.filter(|x| x.is_finite()).fold(0.0, f64::max)
    }

    /// Returns the largest displacement (m) along an axis.
    pub(crate) fn largest_displacement(&self) -> f64 {
        self.displacement.iter().fold(0.0, |a, b| a.max(*b))
    }
}

/// Maximum change (rad) of the phase of a quasi-static motion while a wave crosses the body. The
/// second harmonic of the motion then has at most a fifth of the lowest frequency of the body.
const SLOW: f64 = 0.3;

/// Residual of a linearised solution, and the error that it causes.
#[derive(Debug, Clone, Copy)]
pub struct Linearisation {
    /// Residual of the equation of motion and of tractions, relative to their terms.
    pub residual: f64,
    /// Estimated error (m) of the displacement at the end, or the largest one during the run if the
    /// suite judges the largest error over the instants.
    pub error: f64,
}

impl Linearisation {
    /// Computes residual and error of the solution of `problem` after a time `t` (s), if it is
    /// linearised. `motion` contains the extremes of the problem.
    ///
    /// The error is the root mean square of the first correction, if this is available
    /// ([`Problem::first_correction`]). Otherwise the error is estimated from the residual, within
    /// about a factor of ten:
    ///
    /// Inertia and stress terms are each as large as the acceleration a = omega^2 u, so a residual
    /// r is a force 2 r a per unit mass. The error due to this force is r a t^2 at first. Later it
    /// is r a t/omega if the force is in resonance with a mode, like the second harmonic of a wave
    /// without dispersion. A stiff body of length L is displaced at most like a fixed bar, by r a
    /// L^2/c^2. At rest the error is about r u.
    pub(crate) fn of(problem: &Problem, motion: &Extremes, t: f64, norm: NormName) -> Option<Self> {
        problem.linearised.as_ref()?;
        let (residual, u) = (problem.residual(), motion.largest_displacement());
        let omega = if u > 0.0 { (motion.acceleration / u).sqrt() } else { 0.0 };
        let lengths = problem.from.iter().zip(&problem.to).map(|(from, to)| to - from);
        let crossing = lengths.fold(0.0, f64::max) / problem.wave_speed();
        let (turned, waved) = (omega * t, omega * crossing);
        let growth = turned * turned.min(1.0);
        let growth = if waved < SLOW { growth.min(waved * waved) } else { growth };
        let growth = if problem.at_rest { 1.0 } else { growth };
        let computed = problem.first_correction(t).map(|correction| {
            if norm.is_over_instants() { correction.largest } else { correction.at_end }
        });
        let error = computed.unwrap_or(residual * u * growth);
        Some(Self { residual, error })
    }
}

/// Computes residual and error over the run of a suite, if its exact solution is linearised.
pub fn linearisation(suite: &Suite) -> Option<Linearisation> {
    let plan = suite.convergence()?;
    let problem = plan.exact.as_ref()?;
    Linearisation::of(problem, &Extremes::of(problem), problem.until, plan.norm)
}

/// Returns the row of a report with residual, tolerance, error and reason.
pub(crate) fn row(problem: &Problem, norm: NormName) -> String {
    let Some(stated) = &problem.linearised else { return String::new() };
    let left = Linearisation::of(problem, &Extremes::of(problem), problem.until, norm);
    let when = if norm.is_over_instants() { "during the run" } else { "at the end" };
    let (residual, error) = left.map_or((f64::NAN, f64::NAN), |left| (left.residual, left.error));
    let allowed = shown(stated.tolerance);
    format!(
        "the exact solution is approximate: its equations have a residual of {residual:.1e} times \
         their terms (tolerance: {allowed}), which causes an error of about {error:.0e} m {when}. \
         Reason for the tolerance: {}",
        stated.because
    )
}
