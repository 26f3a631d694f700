//! Counted passes of scalars.

use super::counting::Counted;
use super::scalar_contract::Scalars;
use crate::mpm::algebra::Vector;
use crate::mpm::grid::Grid;
use crate::mpm::particles::Particles;

impl<const D: usize> Scalars<D> for Counted<D> {
    fn p2g_scalar(
        &self,
        particles: &Particles<D>,
        shown: (&[f64], &[Vector<D>]),
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar", particles.len());
        self.kernel.p2g_scalar(particles, shown, grid, column);
    }

    fn p2g_flow(
        &self,
        particles: &Particles<D>,
        slope_and_factor: (&[Vector<D>], f64),
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar flux", particles.len());
        self.kernel.p2g_flow(particles, slope_and_factor, grid, column);
    }

    fn p2g_amount(
        &self,
        particles: &Particles<D>,
        p: usize,
        amount: f64,
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar source", 1);
        self.kernel.p2g_amount(particles, p, amount, grid, column);
    }

    fn g2p_scalar(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        factor: f64,
        value: &mut [f64],
    ) {
        self.tally.add("g2p scalar", particles.len());
        self.kernel.g2p_scalar(grid, field, particles, factor, value);
    }

    fn g2p_slope(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        slope: &mut [Vector<D>],
    ) {
        self.tally.add("g2p scalar gradient", particles.len());
        self.kernel.g2p_slope(grid, field, particles, slope);
    }
}
