//! Bodies with one velocity field, as in the original MPM: at every node that they share they have
//! the velocity of their common mass, `sum_b m_b v_b / sum_b m_b`, and the acceleration.
//!
//! Momentum is that of all bodies together, and no body can slide along another or leave it.

use super::{coupling::Coupling, interface::Meeting};
use crate::{
    mpm::{algebra::Vector, grid::Grid, solver::Solver},
    subject::Column,
};

/// One field for all bodies.
pub(in crate::mpm) struct Shared(Meeting);

impl Shared {
    pub(in crate::mpm) fn of<const D: usize>(bodies: &[Solver<D>]) -> Self {
        Self(Meeting::of(bodies))
    }

    fn share<const D: usize>(
        &self,
        bodies: &mut [Solver<D>],
        field: fn(&mut Grid<D>) -> &mut [Vector<D>],
    ) {
        for &i in self.0.nodes() {
            let (mut mass, mut sum) = (0.0, Vector::zeros());
            for body in bodies.iter_mut() {
                let grid = &mut body.setup.grid;
                mass += grid.mass[i];
                sum += field(grid)[i] * grid.mass[i];
            }
            for body in bodies.iter_mut().filter(|body| body.setup.grid.mass[i] > 0.0) {
                field(&mut body.setup.grid)[i] = sum / mass;
            }
        }
    }
}

impl<const D: usize> Coupling<D> for Shared {
    fn name(&self) -> Option<&'static str> {
        None
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_nodes("meeting", self.0.nodes())]
    }

    fn reads_velocity(&self) -> bool {
        false
    }

    fn meet(&mut self, bodies: &mut [Solver<D>]) {
        self.0.find(bodies);
    }

    fn nodes(&self) -> &[usize] {
        self.0.nodes()
    }

    fn velocity(&mut self, bodies: &mut [Solver<D>]) {
        self.share(bodies, |grid| &mut grid.velocity);
    }

    fn straining_velocity(&mut self, bodies: &mut [Solver<D>]) {
        self.share(bodies, |grid| &mut grid.velocity);
    }

    fn strained(&mut self, _: &mut [Solver<D>]) {}

    fn acceleration(&mut self, bodies: &mut [Solver<D>], _: f64) {
        self.share(bodies, |grid| &mut grid.acceleration);
    }
}
