//! Loops of P2G and G2P for scalars.

use super::Loops;
use super::scalar_contract::Scalars;
use crate::mpm::basis::Basis;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;

impl<const D: usize, B: Basis> Scalars<D> for Loops<B> {
    fn p2g_scalar(
        &self,
        particles: &Particles<D>,
        (value, slope): (&[f64], &[Vector<D>]),
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar", particles.len());
        column.fill(0.0);
        for (p, m) in particles.mass.iter().enumerate() {
            let (value, slope) = (value[p] * *m, slope[p] * *m);
            B::visit(grid, particles, p, |i| {
                column[i.node] += (value + slope.dot(&i.offset)) * i.weight;
            });
        }
    }

    fn p2g_flow(
        &self,
        particles: &Particles<D>,
        (slope, factor): (&[Vector<D>], f64),
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar flux", particles.len());
        column.fill(0.0);
        for (p, vol) in particles.vol.iter().enumerate() {
            let flow = slope[p] * (factor * vol);
            B::visit(grid, particles, p, |i| column[i.node] += flow.dot(i.gradient));
        }
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
        B::visit(grid, particles, p, |i| column[i.node] += amount * i.weight);
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
        for (p, value) in value.iter_mut().enumerate() {
            let mut sum = 0.0;
            B::visit(grid, particles, p, |i| sum += field[i.node] * i.weight);
            *value += sum * factor;
        }
    }

    fn g2p_slope(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        slope: &mut [Vector<D>],
    ) {
        self.tally.add("g2p scalar gradient", particles.len());
        for (p, slope) in slope.iter_mut().enumerate() {
            slope.fill(0.0);
            B::visit(grid, particles, p, |i| *slope += i.gradient * field[i.node]);
        }
    }
}
