//! Thermal condition on a face of the grid: temperature, heat flux or heat transfer.
//!
//! Every basis of this crate conforms to the walls of the grid: along the normal, one function is 1
//! at the wall, and all others are 0. The wall nodes therefore have the temperature of the face.
//! The face area of node i is `sum_p A_p N_i` over the layer of particles at the face, with N_i
//! evaluated along the face only. Heat enters at the face and not at the particles half a spacing
//! inside, because that would cause an error of first order.
//!
//! Areas are those of the reference configuration. The face must stay at the end of the grid.

use super::surface::{Placement, Surface};
use crate::mpm::basis::BasisName;
use crate::mpm::boundary::{Side, nodes};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use mpm_subject::Column;

/// A number as a function of position (m) and time (s).
pub type ScalarField = Box<dyn Fn(&[f64], f64) -> f64 + Send>;

/// Heat inflow (W/m^(D-1)) as a function of position (m), time (s) and local temperature (K).
pub type HeatInflow = Box<dyn Fn(&[f64], f64, f64) -> f64 + Send>;

/// Condition on a face that is not insulated: a prescribed temperature, or a prescribed heat flux
/// that may depend on the temperature.
pub enum Thermal {
    /// Temperature (K): Dirichlet condition.
    Temperature(ScalarField),
    /// Heat inflow: Neumann or Robin condition.
    Inflow(HeatInflow),
}

/// A thermal condition on a face of the grid at which the body ends.
pub struct ThermalBoundary<const D: usize> {
    condition: Thermal,
    axis: usize,
    wall: usize,
    nodes: Vec<(usize, Vector<D>)>,
    layer: Vec<usize>,
    /// Area of the face per particle of the layer (m^(D-1)).
    area: f64,
    /// Area of the face per node (m^(D-1)).
    share: Vec<f64>,
}

impl<const D: usize> ThermalBoundary<D> {
    /// Imposes `condition` on the face `side` of `axis`. `basis` is the basis of `grid`.
    pub fn new(
        grid: &Grid<D>,
        basis: BasisName,
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        condition: Thermal,
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

    pub(super) fn columns(&self) -> [Column<'_>; 3] {
        [
            Column::of_particles("face layer", &self.layer),
            Column::of_nodes("face nodes", &self.nodes),
            Column::of_nodes("face area", &self.share),
        ]
    }

    /// If the temperature is prescribed, sets the `temperature` (K) of the face nodes at time `t`
    /// (s).
    pub(super) fn hold_temperature(&self, t: f64, temperature: &mut [f64]) {
        if let Thermal::Temperature(value) = &self.condition {
            for (i, x) in &self.nodes {
                let x = x.as_slice();
                temperature[*i] = value(x, t);
            }
        }
    }

    /// If the temperature is prescribed, sets the temperature `rate` (K/s) of the face nodes from
    /// `t` to `t + dt` (s).
    pub(super) fn hold_rate(&self, t: f64, dt: f64, rate: &mut [f64]) {
        if let Thermal::Temperature(value) = &self.condition {
            for (i, x) in &self.nodes {
                let x = x.as_slice();
                rate[*i] = (value(x, t + dt) - value(x, t)) / dt;
            }
        }
    }

    /// Adds the flow through the face at time `t` (s) to the `flow` (W) into each node, for the
    /// given nodal temperatures (K). Returns the number of visited particle-node pairs.
    pub(super) fn let_in(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        temperature: &[f64],
        flow: &mut [f64],
    ) -> u64 {
        // For a prescribed temperature, layer and areas are empty, so this call does nothing.
        self.gather_shares(particles, kernel, grid);
        if let Thermal::Inflow(density) = &self.condition {
            for (i, x) in &self.nodes {
                let x = x.as_slice();
                flow[*i] += self.share[*i] * density(x, t, temperature[*i]);
            }
        }
        self.layer.len() as u64 * kernel.support()
    }

    /// Computes the face area of each face node. The layer of particles may contribute to any node;
    /// each contribution is added to the face node on the same normal.
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
