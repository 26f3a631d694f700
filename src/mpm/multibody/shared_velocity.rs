//! Bodies with one velocity field, as in the original MPM: at every node that they share they have
//! the velocity of their common mass, `sum_b m_b v_b / sum_b m_b`, and the acceleration.
//!
//! Momentum is that of all bodies together, and no body can slide along another or leave it.

use super::coupling::Coupling;
use super::interface::InterfaceNodes;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::step::schedule::CouplingPoint;
use crate::mpm::step::solver::Solver;
use crate::subject::Column;

/// One velocity field for all bodies.
pub(in crate::mpm) struct SharedVelocity(InterfaceNodes);

impl SharedVelocity {
    pub(in crate::mpm) fn of<const D: usize>(bodies: &[Solver<D>]) -> Self {
        Self(InterfaceNodes::of(bodies))
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

impl<const D: usize> Coupling<D> for SharedVelocity {
    fn name(&self) -> Option<&'static str> {
        None
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_nodes("interface node", self.0.nodes())]
    }

    fn reads_velocity(&self) -> bool {
        false
    }

    fn nodes(&self) -> &[usize] {
        self.0.nodes()
    }

    fn couple(&mut self, at: CouplingPoint, bodies: &mut [Solver<D>], _: f64) {
        match at {
            CouplingPoint::Mass => self.0.find(bodies),
            CouplingPoint::Velocity | CouplingPoint::StrainVelocity => {
                self.share(bodies, |grid| &mut grid.velocity);
            }
            CouplingPoint::Strained => {}
            CouplingPoint::Acceleration => self.share(bodies, |grid| &mut grid.acceleration),
        }
    }
}
