//! A stated force per unit mass that depends on place and time.

use super::contract::{LoadEntry, LoadWords};
use super::fields::{component, of_place_and_time, sources};
use crate::exact::Term;
use crate::exact::formula::{Formula, Hoisted};
use crate::mpm::{BodyForce, Effect, Vector};
use crate::suite::model::load::{BodySite, BuildEffect, SceneLoad};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Longest formula that is taken apart for its places, with its sums written out.
const MOST_OPERATIONS: u64 = 5000;

/// Force per unit mass (m/s2), formulas of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[serde(transparent)]
pub(crate) struct BodyForceSpec(Vec<NumberText>);

impl LoadWords for BodyForceSpec {
    fn example(vector: &str) -> String {
        vector.to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        entry.refuse_second("a body force")?;
        Ok(Arc::new(BodyForceLoad(entry.of_place_and_time(&entry.path, &self.0)?)))
    }
}

/// Force per unit mass (m/s2), one formula of the coordinates and t for each component.
#[derive(Debug)]
struct BodyForceLoad(Vec<Formula>);

impl Term for BodyForceLoad {
    fn stated(&self, i: usize, label: &[f64], t: f64) -> f64 {
        component(&self.0, i, label, t)
    }

    fn is_body_force(&self) -> bool {
        true
    }
}

impl SceneLoad for BodyForceLoad {
    fn rows(&self) -> Vec<(String, String)> {
        vec![("body force".to_owned(), format!("{} m/s2", sources(&self.0)))]
    }
}

impl<const D: usize> BuildEffect<D> for BodyForceLoad {
    /// The formula of a force may be too long to be taken apart.
    fn build(&self, _: &mut BodySite<'_, D>) -> Result<Box<dyn Effect<D>>, String> {
        if self.0.iter().any(|formula| formula.operations() > MOST_OPERATIONS) {
            return Ok(Box::new(BodyForce::pointwise(of_place_and_time(&self.0))));
        }
        let formulas = self.0.clone();
        let mut places = None;
        Ok(Box::new(BodyForce::new(Box::new(move |t, labels: &[Vector<D>], b| {
            let places = places.get_or_insert_with(|| {
                let mut places = Hoisted::new(&formulas, D + 1);
                for label in labels {
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
