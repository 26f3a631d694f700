//! Couplings of bodies at their interface: the trait, the nodes to which more than one body
//! contributes mass, and the coupling by one velocity field.

use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::step::schedule::CouplingPoint;
use crate::mpm::step::solver::Solver;
use mpm_subject::Column;

/// Coupling of two or more bodies at their interface nodes.
pub(in crate::mpm) trait Coupling<const D: usize>: Send {
    /// Returns the name in suite files, if the coupling is an effect.
    fn name(&self) -> Option<&'static str>;

    /// Returns the columns that the coupling stores per node.
    fn columns(&self) -> Vec<Column<'_>>;

    /// Whether the coupling reads velocities before they advance.
    fn reads_velocity(&self) -> bool;

    /// Couples the bodies at one point of a step of `dt` (s).
    fn couple(&mut self, at: CouplingPoint, bodies: &mut [Solver<D>], dt: f64);
}

/// Lists the nodes to which more than one body contributes mass, in ascending order.
pub(in crate::mpm) fn find_interface<const D: usize>(nodes: &mut Vec<usize>, bodies: &[Solver<D>]) {
    nodes.clear();
    let Some(first) = bodies.first() else { return };
    let present = |node: usize| bodies.iter().filter(|body| body.grid().mass[node] > 0.0).count();
    nodes.extend((0..first.grid().nodes()).filter(|node| present(*node) > 1));
}

/// Coupling by one velocity field for all bodies.
pub(in crate::mpm) struct SharedVelocity(Vec<usize>);

impl SharedVelocity {
    /// Creates the coupling, with capacity for all `nodes` of the grid that the bodies share.
    pub(in crate::mpm) fn new(nodes: usize) -> Self {
        Self(Vec::with_capacity(nodes))
    }

    fn share<const D: usize>(
        &self,
        bodies: &mut [Solver<D>],
        field: fn(&mut Grid<D>) -> &mut [Vector<D>],
    ) {
        for &i in &self.0 {
            let (mut mass, mut sum) = (0.0, zeros());
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
        vec![Column::of_nodes("interface node", &self.0)]
    }

    fn reads_velocity(&self) -> bool {
        false
    }

    fn couple(&mut self, at: CouplingPoint, bodies: &mut [Solver<D>], _: f64) {
        match at {
            CouplingPoint::Mass => find_interface(&mut self.0, bodies),
            CouplingPoint::Velocity | CouplingPoint::StrainVelocity => {
                self.share(bodies, |grid| &mut grid.velocity);
            }
            CouplingPoint::Strained => {}
            CouplingPoint::Acceleration => self.share(bodies, |grid| &mut grid.acceleration),
        }
    }
}
