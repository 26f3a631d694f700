//! Heat conduction: temperatures of particles, and nodal fields of temperature and heat flow.
//!
//! `rho c dT/dt = div(k grad T) + rho s` on the current configuration, integrated by forward Euler
//! (Tao, Zheng, Zhang & Chen 2016, Int. J. Appl. Mech. 8; de Vaucorbeil, Nguyen, Sinaie & Wu 2020,
//! Adv. Appl. Mech. 53, section on heat conduction):
//!
//! ```text
//! T_i    = sum_p m_p (T_p + g_p . (x_i - x_p)) N_i / m_i       or the prescribed value
//! g_p    = sum_i T_i grad N_i                                  grad T of the particle
//! Q_i    = -sum_p V_p k g_p . grad N_i + sum_p m_p s_p N_i + flow through faces
//! T_p   += dt sum_i Q_i/(c m_i) N_i                            as FLIP: increments only
//! ```
//!
//! The published scheme maps only T_p, without the slope. The temperature of a node is then a
//! weighted mean of the temperatures of nearby particles. At a wall this mean differs from the wall
//! value. With linear functions, the slope at the wall is too small by a third, and at a face with
//! heat flux the error is not of second order. With `g_p`, the slope of the previous step (as in
//! TPIC), the map reproduces a linear field, also at the wall.
//!
//! The method is of second order in space and of first order in time. The sum of `Q_i` is the heat
//! flow into the body, to round-off. The method neglects heat from plastic work, viscosity and
//! compression, and assumes a constant conductivity.

use super::contract::Effect;
use super::thermal_face::ThermalBoundary;
use crate::mpm::foundation::algebra::{Vector, inverse, times, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use mpm_subject::{Column, Failure, Site};
use std::any::Any;

/// Function that writes the heat per unit mass and time (W/kg) of every particle at a time (s).
///
/// The heat may depend on T_p at the start of the step, but not on T_i, because T_i would need
/// another pass.
///
/// With a sink s = -r c T, linear functions and equally spaced particles, forward Euler is stable
/// for dt < 2/(4 k/(rho c h^2) + r). The crate does not predict this limit, so a suite file with a
/// sink must specify the time step.
pub type HeatSource<const D: usize> = Box<dyn FnMut(f64, &Particles<D>, &mut [f64]) + Send>;

/// Heat conduction in the body.
pub struct Heat<const D: usize> {
    conductivity: f64,
    capacity: f64,
    source: Option<(HeatSource<D>, Vec<f64>)>,
    faces: Vec<ThermalBoundary<D>>,
    /// Temperature gradients g_p of the particles (K/m).
    slope: Vec<Vector<D>>,
    /// Nodal temperatures T_i (K).
    temperature: Vec<f64>,
    /// Heat flows Q_i into the nodes (W), later converted to temperature rates (K/s).
    flow: Vec<f64>,
}

impl<const D: usize> Heat<D> {
    /// Creates heat conduction in `particles`, with conductivity k (W/(m K), per m^(3-D)) and heat
    /// capacity c (J/(kg K)). Also sets the particle temperatures (K): `initial` returns the
    /// temperature and its gradient with respect to X at a reference position.
    pub fn new(
        conductivity: f64,
        capacity: f64,
        particles: &mut Particles<D>,
        initial: impl Fn(&Vector<D>) -> (f64, Vector<D>),
    ) -> Self {
        let (temperature, mut slope): (Vec<f64>, Vec<Vector<D>>) =
            particles.x0.iter().map(initial).unzip();
        particles.temperature = temperature;
        for (slope, f) in slope.iter_mut().zip(&particles.def_grad) {
            // If F has no inverse, the solver rejects the initial state.
            *slope = inverse(f).map_or_else(zeros, |back| times(&back.transpose(), slope));
        }
        let (temperature, flow) = (Vec::new(), Vec::new());
        let (source, faces) = (None, Vec::new());
        Self { conductivity, capacity, source, faces, slope, temperature, flow }
    }

    /// Adds a heat source in the body.
    #[must_use]
    pub fn with_source(self, source: HeatSource<D>) -> Self {
        let amount = vec![0.0; self.slope.len()];
        Self { source: Some((source, amount)), ..self }
    }

    /// Adds conditions on faces; a face without a condition is insulated. Where faces meet, a
    /// prescribed temperature has precedence over a flux, and a later prescribed temperature over
    /// an earlier one.
    #[must_use]
    pub fn with_faces(self, faces: Vec<ThermalBoundary<D>>) -> Self {
        Self { faces, ..self }
    }

    /// Returns T_i (K) and g_p (K/m) of the last step.
    pub fn fields(&self) -> (&[f64], &[Vector<D>]) {
        (&self.temperature, &self.slope)
    }

    /// Computes T_i and g_p at time `t` (s).
    fn show(&mut self, t: f64, particles: &Particles<D>, kernel: &dyn Kernel<D>, grid: &Grid<D>) {
        self.temperature.resize(grid.nodes(), 0.0);
        self.flow.resize(grid.nodes(), 0.0);
        let (value, column) = (&particles.temperature, &mut self.temperature);
        kernel.p2g_scalar(particles, value, &self.slope, grid, column);
        for (value, m) in self.temperature.iter_mut().zip(&grid.mass) {
            *value = if *m > 0.0 { *value / *m } else { 0.0 };
        }
        for face in &self.faces {
            face.hold_temperature(t, &mut self.temperature);
        }
        kernel.g2p_slope(grid, &self.temperature, particles, &mut self.slope);
    }

    /// Computes Q_i at time `t` (s). Returns the number of visited particle-node pairs.
    fn gather(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
    ) -> u64 {
        let mut visits = particles.len() as u64 * kernel.support();
        let flow = &mut self.flow;
        kernel.p2g_flow(particles, &self.slope, -self.conductivity, grid, flow);
        if let Some((source, amount)) = &mut self.source {
            source(t, particles, amount);
            for (p, (s, m)) in amount.iter().zip(&particles.mass).enumerate() {
                kernel.p2g_amount(particles, p, s * m, grid, flow);
            }
            visits += particles.len() as u64 * kernel.support();
        }
        for face in &mut self.faces {
            visits += face.let_in(t, particles, kernel, grid, &self.temperature, flow);
        }
        visits
    }
}

impl<const D: usize> Effect<D> for Heat<D> {
    fn name(&self) -> &'static str {
        "heat"
    }

    fn makes_stress(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let source = self.source.as_ref().map_or(&[][..], |(_, amount)| amount);
        let mut columns = vec![
            Column::of_particles("grad T", &self.slope),
            Column::of_particles("heat source", source),
            Column::of_nodes("temperature", &self.temperature),
            Column::of_nodes("heat flow", &self.flow),
        ];
        columns.extend(self.faces.iter().flat_map(ThermalBoundary::columns));
        columns
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(self.slope.clone()))
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let Some(state) = state.downcast_ref() {
            self.slope.clone_from(state);
        }
    }

    fn state_passes(&self) -> &'static [&'static str] {
        &["P2G(temperature)", "G2P(grad T)", "P2G(heat flow)", "G2P(temperature)"]
    }

    fn integrate_state(
        &mut self,
        t: f64,
        dt: f64,
        particles: &mut Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
    ) -> Result<u64, Failure> {
        self.show(t, particles, kernel, grid);
        let visits = self.gather(t, particles, kernel, grid);
        for (flow, m) in self.flow.iter_mut().zip(&grid.mass) {
            *flow = if *m > 0.0 { *flow / (self.capacity * *m) } else { 0.0 };
        }
        for face in &self.faces {
            face.hold_rate(t, dt, &mut self.flow);
        }
        let mut temperature = std::mem::take(&mut particles.temperature);
        kernel.g2p_scalar(grid, &self.flow, particles, dt, &mut temperature);
        particles.temperature = temperature;
        if let Some(p) = particles.temperature.iter().position(|value| !value.is_finite()) {
            let (quantity, site) = ("temperature", Site::Particle(p));
            return Err(Failure::NonFinite { quantity, site });
        }
        Ok(visits + 3 * particles.len() as u64 * kernel.support())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Matrix;
    use approx::assert_relative_eq;

    /// If a body starts stretched and sheared, the solver uses the temperature gradient with
    /// respect to x: `F^T grad T = Grad T`.
    #[test]
    fn slopes_at_the_start_are_those_of_the_deformed_body() {
        let mut body = Particles::cubes([2, 1]);
        body.track_deformation();
        let f = Matrix::<2>::new(2.0, 0.5, 0.0, 4.0);
        body.def_grad.fill(f);
        let along = Vector::<2>::new(3.0, -1.0);
        let heat = Heat::new(1.0, 1.0, &mut body, |x| (along.dot(x), along));
        for slope in heat.fields().1 {
            assert_relative_eq!(f.transpose() * slope, along, max_relative = 1e-15);
        }
        assert_eq!(body.temperature, [1.0, 4.0]);
    }
}
