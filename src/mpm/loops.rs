//! The particle-node loops: the only place where a basis meets particles and grid.
//!
//! Sums run over particles in their order and over nodes in theirs, so results are the same bits
//! everywhere. Transfers are made of these loops and need none of their own: they exist once for
//! each basis and dimension.

use super::{
    algebra::{Matrix, Vector, dyad},
    basis::{Basis, BasisName, Domain, with_basis},
    grid::Grid,
    kernel::{Kernel, Shown},
    moments::Moments,
    particles::Particles,
};
use std::marker::PhantomData;

/// Builds the kernel of the basis that a suite names.
pub fn kernel<const D: usize>(basis: BasisName) -> Box<dyn Kernel<D>> {
    with_basis!(basis, B => Box::new(Loops::<B>(PhantomData)))
}

/// The (stateless) kernel of basis `B`.
pub(super) struct Loops<B>(PhantomData<B>);

impl<const D: usize, B: Basis> Kernel<D> for Loops<B> {
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.mass);
        column.fill(0.0);
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| column[i.node] += m * i.weight);
        }
        grid.mass = column;
    }

    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: Shown<'_, D>,
        grid: &Grid<D>,
        column: &mut [Vector<D>],
    ) {
        column.fill(Vector::zeros());
        for (p, (m, v)) in particles.mass.iter().zip(shown.v).enumerate() {
            let momentum = v * *m;
            let Some((affine, moments)) = shown.affine else {
                B::visit(grid, particles, p, |i| column[i.node] += momentum * i.weight);
                continue;
            };
            let (slope, mean) = (affine[p] * *m, moments.mean[p]);
            B::visit(grid, particles, p, |i| {
                column[i.node] += (momentum + slope * (i.offset - mean)) * i.weight;
            });
        }
    }

    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.force);
        column.fill(Vector::zeros());
        for p in 0..particles.len() {
            let flux = particles.flux(p);
            B::visit(grid, particles, p, |i| column[i.node] -= flux * i.gradient);
        }
        grid.force = column;
    }

    fn p2g_affine_force(&self, particles: &Particles<D>, moments: &Moments<D>, grid: &mut Grid<D>) {
        let mut column = std::mem::take(&mut grid.force);
        column.fill(Vector::zeros());
        for p in 0..particles.len() {
            let (slope, mean) = (particles.flux(p) * moments.inverse[p], moments.mean[p]);
            B::visit(grid, particles, p, |i| {
                column[i.node] -= slope * (i.offset - mean) * i.weight;
            });
        }
        grid.force = column;
    }

    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, particles, p, |i| column[i.node] += force * i.weight);
        grid.force = column;
    }

    fn g2p(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        (keep, factor): (f64, f64),
        value: &mut [Vector<D>],
    ) {
        for (p, value) in value.iter_mut().enumerate() {
            let mut sum = Vector::zeros();
            B::visit(grid, particles, p, |i| sum += field[i.node] * i.weight);
            *value = *value * keep + sum * factor;
        }
    }

    fn g2p_gradient(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        gradient: &mut [Matrix<D>],
    ) {
        for (p, gradient) in gradient.iter_mut().enumerate() {
            gradient.fill(0.0);
            B::visit(grid, particles, p, |i| *gradient += dyad(&field[i.node], i.gradient));
        }
    }

    fn g2p_moment(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        (particles, moments): (&Particles<D>, &Moments<D>),
        (keep, factor): (f64, f64),
        moment: &mut [Matrix<D>],
    ) {
        for (p, moment) in moment.iter_mut().enumerate() {
            let (mut sum, mean) = (Matrix::zeros(), moments.mean[p]);
            B::visit(grid, particles, p, |i| {
                sum += dyad(&field[i.node], &(i.offset - mean)) * i.weight;
            });
            *moment = *moment * keep + sum * factor;
        }
    }

    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>) {
        for p in 0..particles.len() {
            let (mut mean, mut second) = (Vector::zeros(), Matrix::zeros());
            B::visit(grid, particles, p, |i| {
                mean += i.offset * i.weight;
                second += dyad(&i.offset, &i.offset) * i.weight;
            });
            moments.set(p, mean, second - dyad(&mean, &mean), grid.h);
        }
    }

    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    ) {
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| {
                B::visit(grid, particles, p, |j| entry(i.node, j.node, m * i.weight * j.weight));
            });
        }
    }

    fn g2p_position(&self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        for p in 0..particles.len() {
            let mut v = Vector::zeros();
            B::visit(grid, particles, p, |i| v += grid.velocity[i.node] * i.weight);
            *particles.position_mut(p) += v * dt;
        }
    }

    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    ) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, particles, p, |i| column[i.node] += moment * i.gradient);
        grid.force = column;
    }

    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    ) {
        gradient.fill(Vector::zeros());
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| gradient[i.node] += i.gradient * *m);
        }
    }

    fn support(&self) -> u64 {
        B::support(D)
    }

    fn domain(&self) -> Domain {
        B::DOMAIN
    }

    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D> {
        let counts = std::array::from_fn(|axis| B::count(cells[axis], periodic[axis]));
        Grid::new(origin, h, cells, periodic, counts)
    }
}
