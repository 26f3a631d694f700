//! The manufactured body force of a run: at the same places, step after step.

use super::motion::{Derivatives, Places};
use super::problem::Problem;
pub use super::problem::SharedForces;
use crate::subject::PlaneState;
use std::sync::Arc;

/// The manufactured body force at places that have been given once.
pub struct Forcing {
    problem: Problem,
    places: Box<dyn Places>,
    /// The places (m), if a term, the stress or the density depends on them.
    labels: Vec<Vec<f64>>,
    /// Forces computed by other runs, with the number of the set of places.
    shared: Option<(Arc<SharedForces>, usize)>,
}

impl Forcing {
    /// The force of `problem` at `labels` (m), D numbers each.
    pub fn new<'a>(problem: &Problem, labels: impl Iterator<Item = &'a [f64]>) -> Self {
        let labels: Vec<Vec<f64>> = labels.map(<[f64]>::to_vec).collect();
        let places = problem.motion.at_places(labels.iter().map(Vec::as_slice));
        let varies = problem.terms.iter().any(|term| !term.is_uniform());
        let needed = varies
            || !problem.initial_stress.is_none()
            || problem.density.uniform().is_none()
            || problem.plane == PlaneState::Axisymmetric;
        let number =
            |shared: &Arc<SharedForces>| (shared.clone(), shared.number_of(labels.concat()));
        let shared = problem.shared_forces.as_ref().map(number);
        let labels = if needed { labels } else { Vec::new() };
        Self { problem: problem.clone(), places, labels, shared }
    }

    /// Writes the force (m/s2) at each place at time `t` (s), as given by
    /// [`Problem::manufactured_force`]. Allocates only for shared forces.
    pub fn at<T>(&mut self, t: f64, into: &mut [T], make: impl Fn([f64; 3]) -> T) {
        let dimension = self.problem.dimension();
        if let Some(known) = self.shared.as_ref().and_then(|(forces, at)| forces.get(*at, t)) {
            for (force, known) in into.iter_mut().zip(known.chunks_exact(dimension)) {
                *force = make(std::array::from_fn(|i| known.get(i).copied().unwrap_or(0.0)));
            }
            return;
        }
        let mut found = Vec::new();
        let uniform: [f64; 3] = std::array::from_fn(|i| self.problem.uniform(i, t));
        self.places.set_time(t);
        let mut now = Derivatives::default();
        for (place, force) in into.iter_mut().enumerate() {
            self.places.derivatives(place, &mut now);
            let label = self.labels.get(place).map_or(&[][..], Vec::as_slice);
            self.problem.complete(label, &mut now);
            let whole = self.problem.balance(label, t, &now);
            let mut left = [0.0; 3];
            for (i, left) in left.iter_mut().enumerate().take(dimension) {
                let stated = uniform[i] + self.problem.placed(i, label, t, &now.u);
                *left = whole[i] - stated - self.problem.resistance(i, label, t, &now, stated);
            }
            if self.shared.is_some() {
                found.extend_from_slice(&left[..dimension]);
            }
            *force = make(left);
        }
        if let Some((forces, at)) = &self.shared {
            forces.put(*at, t, found);
        }
    }
}
