//! A surface traction, carried by the layer of particles that lies at the surface.
//!
//! `f_ext_i += sum_p p0 A_p N_i(x_p)` over that layer, with A_p the particle's reference share of
//! the surface. The body need not end on a node: the force follows the particles (Wobbes & Tielen
//! 2015, Steffen's bar), so it acts half a particle spacing inside the surface.

use super::{contract::Effect, name::EffectName};
use crate::{
    mpm::{algebra::Vector, boundary::Side, grid::Grid, kernel::Kernel, particles::Particles},
    subject::Column,
};

/// Traction p0(t) (Pa, per reference area) on one face of the body.
pub struct Traction<const D: usize> {
    value: Box<dyn Fn(f64) -> Vector<D> + Send>,
    layer: Vec<usize>,
    area: f64,
}

impl<const D: usize> Traction<D> {
    /// Marks the outermost layer of `particles` on `side` of `axis`.
    pub fn on(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        value: Box<dyn Fn(f64) -> Vector<D> + Send>,
    ) -> Self {
        let sign = match side {
            Side::Low => -1.0,
            Side::High => 1.0,
        };
        let height = |p: &Vector<D>| sign * p[axis];
        let top = particles.x0.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
        let reach = top - 0.5 * particles.spacing[axis];
        let layer = (0..particles.len()).filter(|&p| height(&particles.x0[p]) > reach).collect();
        let area = (0..D).filter(|&a| a != axis).map(|a| particles.spacing[a]).product();
        Self { value, layer, area }
    }
}

impl<const D: usize> Effect<D> for Traction<D> {
    fn name(&self) -> EffectName {
        EffectName::Traction
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_particles("layer", &self.layer)]
    }

    fn add_force(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        let force = (self.value)(t) * self.area;
        for &p in &self.layer {
            kernel.p2g_point_force(particles, p, &force, grid);
        }
        self.layer.len() as u64 * kernel.support()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::{BasisName, Block, kernel};
    use approx::assert_relative_eq;

    #[test]
    fn the_whole_force_reaches_the_grid() {
        let block = Block {
            from: Vector::<2>::new(0.0, 0.0),
            to: Vector::<2>::new(1.0, 2.0),
            density: 1.0,
        };
        let particles = Particles::fill(&block, 0.25, 2);
        let kernel = kernel::<2>(BasisName::Linear);
        let mut grid = kernel.grid(Vector::zeros(), 0.25, [6, 8], [false; 2]);
        let value = Box::new(|t| Vector::<2>::new(3.0 * t, 0.5));
        let mut pull = Traction::on(&particles, 0, Side::High, value);
        assert_eq!(pull.add_force(2.0, &particles, kernel.as_ref(), &mut grid), 16 * 4);
        let total = grid.force.iter().fold(Vector::zeros(), |sum, f| sum + f);
        assert_relative_eq!(total, Vector::<2>::new(12.0, 1.0), max_relative = 1e-14);
    }
}
