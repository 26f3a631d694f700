//! A stated force per unit mass, which may depend on position, time and displacement.

use super::contract::{BodySite, BuildEffect, BuildError, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::Term;
use crate::exact::formula::{Formula, Hoisted, Jet};
use crate::mpm::{BodyForce, Effect, Particles, Vector};
use crate::suite::scene::numbers::{
    LoadNumbers, of_displacement, of_place_and_time, value_with_unit,
};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Formulas with at most this number of operations (counted with unrolled sums) are precomputed for
/// each position.
const MOST_OPERATIONS: u64 = 5000;

/// Force per unit mass (m/s2), formulas of the coordinates, t and the displacement.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct BodyForceSpec(Vec<NumberText>);

impl LoadKeys for BodyForceSpec {
    fn example(vector: &str) -> String {
        vector.to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("a body force")?;
        Ok(Arc::new(BodyForceLoad(entry.of_displacement(&entry.path, &self.0)?)))
    }
}

/// Force per unit mass (m/s2): one formula of the coordinates, t and optionally the displacement
/// for each component.
#[derive(Debug)]
struct BodyForceLoad(Vec<Formula>);

impl BodyForceLoad {
    /// Returns the force in D dimensions as a function of the particle displacements.
    fn of_displacement<const D: usize>(&self, particles: &Particles<D>) -> BodyForce<D> {
        let formulas = self.0.clone();
        let force = BodyForce::new(Box::new(move |t, particles: &Particles<D>, b| {
            let places = particles.x0.iter().zip(particles.positions());
            for (b, (label, x)) in b.iter_mut().zip(places) {
                let u = space(&(x - label));
                let label = label.as_slice();
                *b = Vector::from_fn(|i, _| of_displacement(&formulas[i], label, t, &u));
            }
        }));
        force.with_stiffness(self.stiffness(particles))
    }

    /// Computes an upper bound on the largest eigenvalue (1/s2) of the symmetric part of -db/du,
    /// over all `particles` at the start, from Gershgorin circles.
    fn stiffness<const D: usize>(&self, particles: &Particles<D>) -> f64 {
        let of = |label: &Vector<D>, x: &Vector<D>| {
            let u = space(&(x - label));
            let seeds: [Jet<3>; 3] = std::array::from_fn(|a| Jet::variable(u[a], a));
            let slope: [Jet<3>; D] =
                std::array::from_fn(|i| of_displacement(&self.0[i], label.as_slice(), 0.0, &seeds));
            let held = |i: usize, j: usize| -0.5 * (slope[i].d(j) + slope[j].d(i));
            let circle = |i: usize| {
                let others = (0..D).filter(|j| *j != i).map(|j| held(i, j).abs());
                held(i, i) + others.sum::<f64>()
            };
            (0..D).map(circle).fold(0.0, f64::max)
        };
        let all = particles.x0.iter().zip(particles.positions());
        all.map(|(label, x)| of(label, x)).fold(0.0, f64::max)
    }
}

/// Returns the vector, padded with zeros to three components.
fn space<const D: usize>(vector: &Vector<D>) -> [f64; 3] {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

impl Term for BodyForceLoad {
    fn stated(&self, i: usize, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        self.0.get(i).map_or(0.0, |formula| of_displacement(formula, label, t, u))
    }

    fn depends_on_displacement(&self) -> bool {
        let place_and_time = self.0.len() + 1;
        self.0.iter().any(|formula| formula.variables() > place_and_time)
    }

    fn is_body_force(&self) -> bool {
        true
    }
}

impl SceneLoad for BodyForceLoad {
    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("acceleration", &self.0)
    }

    fn rows(&self) -> Vec<(String, String)> {
        vec![("body force".to_owned(), value_with_unit(&self.0, "m/s2"))]
    }
}

impl<const D: usize> BuildEffect<D> for BodyForceLoad {
    fn build(&self, site: &mut BodySite<'_, D>) -> Result<Box<dyn Effect<D>>, BuildError> {
        if self.depends_on_displacement() {
            return Ok(Box::new(self.of_displacement(site.particles)));
        }
        if self.0.iter().any(|formula| formula.operations() > MOST_OPERATIONS) {
            return Ok(Box::new(BodyForce::pointwise(of_place_and_time(&self.0))));
        }
        let formulas = self.0.clone();
        let mut places = None;
        Ok(Box::new(BodyForce::new(Box::new(move |t, particles: &Particles<D>, b| {
            let places = places.get_or_insert_with(|| {
                let mut places = Hoisted::new(&formulas, D + 1);
                for label in &particles.x0 {
                    places.add(label.as_slice());
                }
                places
            });
            places.set_time(t);
            for (place, b) in b.iter_mut().enumerate() {
                for (b, value) in b.iter_mut().zip(places.eval(place)) {
                    *b = value;
                }
            }
        }))))
    }
}
