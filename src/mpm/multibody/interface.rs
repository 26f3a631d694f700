//! Nodes at which bodies meet: those to which more than one gives mass.

use crate::mpm::step::solver::Solver;

/// Nodes at which bodies meet, in their order.
#[derive(Debug)]
pub(in crate::mpm) struct InterfaceNodes(Vec<usize>);

impl InterfaceNodes {
    /// Capacity for all nodes of the grid that `bodies` share.
    pub(in crate::mpm) fn of<const D: usize>(bodies: &[Solver<D>]) -> Self {
        Self(Vec::with_capacity(bodies.first().map_or(0, |body| body.grid().nodes())))
    }

    /// Finds the nodes anew.
    pub(in crate::mpm) fn find<const D: usize>(&mut self, bodies: &[Solver<D>]) {
        self.0.clear();
        let Some(first) = bodies.first() else { return };
        let present =
            |node: usize| bodies.iter().filter(|body| body.grid().mass[node] > 0.0).count();
        self.0.extend((0..first.grid().nodes()).filter(|node| present(*node) > 1));
    }

    /// The nodes.
    pub(in crate::mpm) fn nodes(&self) -> &[usize] {
        &self.0
    }
}
