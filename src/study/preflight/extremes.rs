//! Extremes of an exact motion, on a raster of the body and the run and at the places and times of
//! its survey, which resolve a narrow pulse.

use crate::exact::{Derivatives, Problem, Survey};
use crate::study::describe::amplitude::raster;

/// Intervals of the raster along each axis, by dimension.
const ALONG: [usize; 3] = [16, 8, 4];

/// Intervals of the raster over the run.
const OVER: usize = 8;

/// The largest values that a motion takes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Extremes {
    /// Of |u| (m), axis by axis.
    pub(crate) displacement: [f64; 3],
    /// Of the displacement gradient.
    pub(crate) gradient: f64,
    /// Of the second derivatives of the displacement along the axes (1/m).
    pub(crate) curvature: f64,
    /// Of the speed (m/s).
    pub(crate) speed: f64,
    /// Of the acceleration (m/s^2).
    pub(crate) acceleration: f64,
    /// Of the components of the initial stress (Pa).
    pub(crate) initial_stress: f64,
    /// The lowest and the highest place (m) that the body reaches, axis by axis.
    pub(crate) reach: [(f64, f64); 3],
}

impl Extremes {
    /// Extremes of the motion that `problem` claims.
    pub(crate) fn of(problem: &Problem) -> Self {
        let labels = raster(problem, ALONG[problem.dimension().clamp(1, 3) - 1]);
        let mut motion = problem.motion.at_places(labels.iter().map(Vec::as_slice));
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let of_place = |label: &Vec<f64>| problem.initial_stress.at(label);
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

    /// The largest displacement (m) along any axis.
    pub(crate) fn largest_displacement(&self) -> f64 {
        self.displacement.iter().fold(0.0, |a, b| a.max(*b))
    }
}
