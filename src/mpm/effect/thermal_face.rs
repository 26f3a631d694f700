//! Thermal condition on a face of the grid: temperature, heat flux or heat transfer.
//!
//! The functions of every basis of this crate conform to the walls of the grid: along the normal
//! one function is 1 there, and all others are 0. So the nodes of the wall have the temperature of
//! the face, and `sum_p A_p N_i` over the layer of particles at the face, evaluated along the face
//! only, is the share of the face of node i. Heat enters at the face itself, not at the particles
//! half a spacing inside: that would be an error of first order.
//!
//! Areas are those of the reference body, as for tractions. The face does not move away from the
//! end of the grid.

use super::surface::{Placement, Surface};
use crate::mpm::basis::BasisName;
use crate::mpm::boundary::{Side, nodes};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::subject::Column;

/// A number as a function of place and time (s).
pub type ScalarField<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> f64 + Send>;

/// Inflow of heat (W/m^(D-1)) as a function of place, time (s) and the temperature (K) there.
pub type HeatInflow<const D: usize> = Box<dyn Fn(&Vector<D>, f64, f64) -> f64 + Send>;

/// Condition on a face that is not insulated. A field of second order in space has two kinds of
/// conditions: a given value, or a given flux, which may depend on the value.
pub enum Thermal<const D: usize> {
    /// A temperature (K): Dirichlet's condition.
    Temperature(ScalarField<D>),
    /// Heat that enters: Neumann's condition, or Robin's.
    Inflow(HeatInflow<D>),
}

/// A face of the grid at which the body ends.
pub struct ThermalBoundary<const D: usize> {
    condition: Thermal<D>,
    axis: usize,
    wall: usize,
    /// Nodes and their positions (m).
    nodes: Vec<(usize, Vector<D>)>,
    /// Particles next to the face.
    layer: Vec<usize>,
    /// Area of the face per particle of the layer (m^(D-1)).
    area: f64,
    /// Area of the face per node (m^(D-1)).
    share: Vec<f64>,
}

impl<const D: usize> ThermalBoundary<D> {
    /// `condition` on the face `side` of `axis` of `grid`, which has the functions of `basis`.
    pub fn new(
        grid: &Grid<D>,
        basis: BasisName,
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        condition: Thermal<D>,
    ) -> Self {
        let place = |i| (i, basis.place(grid, i));
        let Surface { layer, area, .. } = Surface::new(particles, axis, side, Placement::Particles);
        let held = matches!(condition, Thermal::Temperature(_));
        Self {
            condition,
            axis,
            wall: if side == Side::Low { 0 } else { grid.counts[axis] - 1 },
            nodes: nodes(grid, axis, side).into_iter().map(place).collect(),
            layer: if held { Vec::new() } else { layer },
            area,
            share: if held { Vec::new() } else { vec![0.0; grid.nodes()] },
        }
    }

    /// Columns for particles and nodes.
    pub(super) fn columns(&self) -> [Column<'_>; 3] {
        [
            Column::of_particles("face layer", &self.layer),
            Column::of_nodes("face nodes", &self.nodes),
            Column::of_nodes("face area", &self.share),
        ]
    }

    /// Sets the `temperature` (K) of the nodes of the face at time `t` (s), if it is prescribed.
    pub(super) fn hold_temperature(&self, t: f64, temperature: &mut [f64]) {
        if let Thermal::Temperature(value) = &self.condition {
            for (i, x) in &self.nodes {
                temperature[*i] = value(x, t);
            }
        }
    }

    /// Sets the temperature `rate` (K/s) of the nodes of the face from `t` to `t + dt` (s), if the
    /// temperature is prescribed.
    pub(super) fn hold_rate(&self, t: f64, dt: f64, rate: &mut [f64]) {
        if let Thermal::Temperature(value) = &self.condition {
            for (i, x) in &self.nodes {
                rate[*i] = (value(x, t + dt) - value(x, t)) / dt;
            }
        }
    }

    /// Adds the flow through the face at time `t` (s) to the `flow` (W) into each node, whose
    /// temperatures (K) are given; returns the particle-node pairs visited.
    pub(super) fn let_in(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        temperature: &[f64],
        flow: &mut [f64],
    ) -> u64 {
        // A face whose temperature is given has neither a layer nor shares.
        self.gather_shares(particles, kernel, grid);
        if let Thermal::Inflow(density) = &self.condition {
            for (i, x) in &self.nodes {
                flow[*i] += self.share[*i] * density(x, t, temperature[*i]);
            }
        }
        self.layer.len() as u64 * kernel.support()
    }

    /// Computes the share of the face of each of its nodes: contributions of the layer of particles
    /// to any node are added to the node of the face on the same normal.
    fn gather_shares(&mut self, particles: &Particles<D>, kernel: &dyn Kernel<D>, grid: &Grid<D>) {
        self.share.fill(0.0);
        for &p in &self.layer {
            kernel.p2g_amount(particles, p, self.area, grid, &mut self.share);
        }
        let stride: usize = grid.counts[..self.axis].iter().product();
        for node in 0..self.share.len() {
            let index = grid.index_on_axis(node, self.axis);
            if index != self.wall {
                let amount = std::mem::take(&mut self.share[node]);
                self.share[node - index * stride + self.wall * stride] += amount;
            }
        }
    }
}
