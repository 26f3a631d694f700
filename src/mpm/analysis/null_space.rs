//! Null space of the map to the grid: the part of the particles' velocities without nodal momentum.
//!
//! With N the map from nodes to particles and M the particle masses, velocities are `v = N w + v0`
//! in one way in which v0 gives no node any momentum, `N^T M v0 = 0`: v0 lies in the null space of
//! the map to the grid, and no force ever answers it (Brackbill 1988; Gritton & Berzins 2017, Comp.
//! Part. Mech. 4). w is the least-squares fit `N^T M N w = N^T M v`, whose matrix is the consistent
//! mass matrix. That may be singular, which conjugate gradients allow; the lumped one stands
//! in for its inverse, so that a round applies the map to the grid and back, the operator of PIC
//! and XPIC, once.

use crate::mpm::algebra::Vector;
use crate::mpm::grid::Grid;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::kernel::request::ParticleField;
use crate::mpm::particles::Particles;
use crate::mpm::solver::Solver;

/// Energy of the residual, as a share of the whole, that counts as rounding.
const ROUNDING: f64 = 1e-26;

/// Rounds at most. A mode that PIC multiplies by l is found in about `1/sqrt(l)` of them.
const MOST: usize = 200;

impl<const D: usize> Solver<D> {
    /// Kinetic energy (J) of the part of the particles' velocities that lies in the null space of
    /// the map to the grid, where the particles are now. Walls do not matter: they hold nodes, and
    /// this part gives nothing to any.
    pub fn null_space_energy(&self) -> f64 {
        let (kernel, particles) = (self.setup.kernel.as_ref(), &self.setup.particles);
        0.5 * square(particles, &null_part(kernel, &self.setup.grid, particles))
    }
}

/// The part v0 of the velocities (m/s), by conjugate gradients.
fn null_part<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<Vector<D>> {
    let masses = masses(kernel, grid, particles);
    let to_nodes = |v: &[Vector<D>], nodal: &mut [Vector<D>]| {
        kernel.p2g_momentum(particles, ParticleField { v, affine: None }, grid, nodal);
    };
    let mut rest = particles.v.clone();
    let mut momentum = vec![Vector::zeros(); grid.nodes()];
    let (mut along, mut mapped) = (momentum.clone(), rest.clone());
    let (size, mut before) = (square(particles, &rest), f64::INFINITY);
    for _ in 0..MOST {
        to_nodes(&rest, &mut momentum);
        let seen = seen(&masses, &momentum);
        // A comparison that NaN fails, so that it ends the loop and stays in the residual.
        if !(seen > ROUNDING * size) {
            break;
        }
        let keep = seen / before;
        for ((along, p), m) in along.iter_mut().zip(&momentum).zip(&masses) {
            *along = *along * keep + divided(p, *m);
        }
        kernel.g2p(grid, &along, particles, (0.0, 1.0), &mut mapped);
        let step = seen / square(particles, &mapped);
        for (rest, mapped) in rest.iter_mut().zip(&mapped) {
            *rest -= mapped * step;
        }
        before = seen;
    }
    rest
}

/// Nodal masses (kg) where the particles are now; those of the grid are of the step that has moved
/// them.
fn masses<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<f64> {
    let ones = vec![Vector::from_element(1.0); particles.len()];
    let mut nodal = vec![Vector::zeros(); grid.nodes()];
    kernel.p2g_momentum(particles, ParticleField { v: &ones, affine: None }, grid, &mut nodal);
    nodal.iter().map(|mass| mass[0]).collect()
}

fn divided<const D: usize>(momentum: &Vector<D>, mass: f64) -> Vector<D> {
    if mass > 0.0 { momentum / mass } else { Vector::zeros() }
}

/// Twice the kinetic energy (J) of nodes with these momenta.
fn seen<const D: usize>(masses: &[f64], momentum: &[Vector<D>]) -> f64 {
    masses.iter().zip(momentum).map(|(m, p)| divided(p, *m).dot(p)).sum()
}

/// Twice the kinetic energy (J) of particles with these velocities.
fn square<const D: usize>(particles: &Particles<D>, v: &[Vector<D>]) -> f64 {
    particles.mass.iter().zip(v).map(|(m, v)| m * v.norm_squared()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::kernel::kernel;
    use crate::mpm::{BasisName, Block};
    use approx::assert_relative_eq;
    use rstest::rstest;

    const CELLS: usize = 4;

    /// A body that fills a periodic grid, with `per_axis` particles in a cell and velocities `v`.
    fn body<const D: usize>(
        basis: BasisName,
        per_axis: usize,
        v: impl Fn(usize, &Vector<D>) -> Vector<D>,
    ) -> (Box<dyn Kernel<D>>, Grid<D>, Particles<D>) {
        let kernel = kernel::<D>(basis);
        let grid = kernel.grid(Vector::zeros(), 1.0, [CELLS; D], [true; D]);
        let to = Vector::from_element(CELLS as f64);
        let block = Block { from: Vector::zeros(), to, density: 2.0 };
        let mut particles = Particles::fill(&block, 1.0, per_axis);
        particles.track_domains();
        // No symmetry: places differ from cell to cell.
        for (p, x) in particles.x.iter_mut().enumerate() {
            *x += Vector::from_element(if per_axis > 1 { 0.1 * libm::sin(p as f64) } else { 0.0 });
            particles.v[p] = v(p, x);
        }
        (kernel, grid, particles)
    }

    fn share<const D: usize>(found: &[Vector<D>], particles: &Particles<D>) -> f64 {
        square(particles, found) / square(particles, &particles.v)
    }

    /// One particle in the middle of each cell, and signs that alternate (Brackbill 1988).
    #[test]
    fn what_alternates_in_the_middle_of_cells_is_all_in_the_null_space() {
        let sign = |p: usize, _: &Vector<1>| Vector::<1>::new([1.0, -1.0][p % 2]);
        let (kernel, grid, particles) = body(BasisName::Linear, 1, sign);
        let found = null_part(kernel.as_ref(), &grid, &particles);
        assert_relative_eq!(share(&found, &particles), 1.0, max_relative = 1e-14);
    }

    fn of_any_velocity<const D: usize>() {
        for &basis in BasisName::ALL {
            let any = |p: usize, _: &Vector<D>| {
                Vector::from_fn(|i, _| libm::sin(((p * D + i) * (p * D + i)) as f64))
            };
            let (kernel, grid, mut particles) = body(basis, 2, any);
            let found = null_part(kernel.as_ref(), &grid, &particles);
            let lost = share(&found, &particles);
            assert!((0.1..0.95).contains(&lost), "{basis:?}: {lost}");
            // It gives no node any momentum,
            let mut nodal = vec![Vector::zeros(); grid.nodes()];
            let shown = ParticleField { v: &found, affine: None };
            kernel.p2g_momentum(&particles, shown, &grid, &mut nodal);
            let masses = masses(kernel.as_ref(), &grid, &particles);
            assert!(seen(&masses, &nodal) < 1e-24 * square(&particles, &particles.v), "{basis:?}");
            // and the rest has no such part.
            for (v, found) in particles.v.iter_mut().zip(&found) {
                *v -= found;
            }
            let again = null_part(kernel.as_ref(), &grid, &particles);
            assert!(share(&again, &particles) < 1e-18, "{basis:?}: {}", share(&again, &particles));
        }
    }

    #[rstest]
    #[case::line(of_any_velocity::<1>)]
    #[case::plane(of_any_velocity::<2>)]
    fn a_velocity_is_what_the_grid_can_show_and_a_part_in_the_null_space(#[case] of: fn()) {
        of();
    }

    #[test]
    fn what_is_no_number_stays_none() {
        let any = |p: usize, _: &Vector<1>| Vector::<1>::new(if p == 3 { f64::NAN } else { 1.0 });
        let (kernel, grid, particles) = body(BasisName::Linear, 2, any);
        let found = null_part(kernel.as_ref(), &grid, &particles);
        assert!(square(&particles, &found).is_nan());
    }
}
