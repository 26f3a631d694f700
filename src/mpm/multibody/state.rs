//! State of several bodies as a row of numbers, body after body.

use super::Bodies;
use crate::subject::Perturbable;

impl<const D: usize> Perturbable for Bodies<D> {
    fn fix_configuration(&mut self) {
        self.solvers.iter_mut().for_each(Perturbable::fix_configuration);
        self.compile(true);
    }

    fn state(&self, state: &mut Vec<f64>) {
        joined(state, self.solvers.iter(), Perturbable::state);
    }

    fn set_state(&mut self, state: &[f64]) {
        let (mut rest, mut own) = (state, Vec::new());
        for solver in &mut self.solvers {
            solver.state(&mut own);
            let (mine, others) = rest.split_at(own.len().min(rest.len()));
            solver.set_state(mine);
            rest = others;
        }
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        joined(sizes, self.solvers.iter(), |solver, own| solver.sizes(speed, modulus, own));
    }
}

/// The numbers that `give` writes for each body, body after body.
fn joined<T>(all: &mut Vec<f64>, each: impl Iterator<Item = T>, give: impl Fn(T, &mut Vec<f64>)) {
    all.clear();
    let mut own = Vec::new();
    for one in each {
        give(one, &mut own);
        all.extend_from_slice(&own);
    }
}
