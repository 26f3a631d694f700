//! The part of the velocities that contributes no momentum to any node.

use crate::common;
use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    BasisName, Block, ParticleField, Particles, SchemeName, Solver, TransferName, Vector, kernel,
};
use mpm_subject::Perturbable;

const CELLS: usize = 4;

/// Creates a body that fills a periodic grid, with `per_axis` particles in a cell and velocities
/// `v`.
fn body<const D: usize>(
    basis: BasisName,
    per_axis: usize,
    v: impl Fn(usize) -> Vector<D>,
) -> Solver<D> {
    let to = Vector::from_element(CELLS as f64);
    let block = Block { from: Vector::zeros(), to, density: 2.0 };
    let mut particles = Particles::fill(&block, 1.0, per_axis);
    // Positions differ from cell to cell, so there is no symmetry.
    for (p, x) in particles.x.iter_mut().enumerate() {
        *x += Vector::from_element(if per_axis > 1 { 0.1 * libm::sin(p as f64) } else { 0.0 });
        particles.v[p] = v(p);
    }
    let method = (basis, TransferName::Flip);
    let mut setup = common::body(method, SchemeName::Musl, particles, (1.0, CELLS));
    setup.grid = setup.kernel.grid(Vector::zeros(), 1.0, [CELLS; D], [true; D]);
    Solver::new(setup).unwrap()
}

/// Returns twice the kinetic energy (J) of particles with these velocities.
fn square<const D: usize>(particles: &Particles<D>, v: &[Vector<D>]) -> f64 {
    particles.mass.iter().zip(v).map(|(m, v)| m * v.norm_squared()).sum()
}

/// Returns the kinetic energy of the velocities `found`, as a fraction of the total kinetic energy.
fn share<const D: usize>(found: &[Vector<D>], particles: &Particles<D>) -> f64 {
    square(particles, found) / square(particles, &particles.v)
}

/// There is one particle in the middle of each cell, and the signs alternate (Brackbill 1988).
#[test]
fn alternating_velocities_are_in_the_null_space() {
    let solver = body(BasisName::Linear, 1, |p| Vector::<1>::new([1.0, -1.0][p % 2]));
    let found = solver.null_space_velocity();
    assert_relative_eq!(share(&found, solver.particles()), 1.0, max_relative = 1e-14);
    assert_eq!(solver.null_space_energy(), 0.5 * square(solver.particles(), &found));
}

fn of_any_velocity<const D: usize>() {
    for &basis in BasisName::ALL {
        let any =
            |p: usize| Vector::<D>::from_fn(|i, _| libm::sin(((p * D + i) * (p * D + i)) as f64));
        // A cell has more particles than nodes for any basis.
        let mut solver = body(basis, 3, any);
        let (particles, found) = (solver.particles(), solver.null_space_velocity());
        let lost = share(&found, particles);
        assert!((0.1..0.97).contains(&lost), "{basis:?}: {lost}");
        // This part contributes no momentum to any node,
        let (kernel, mut grid) = (kernel::<D>(basis), solver.grid().clone());
        kernel.p2g_mass(particles, &mut grid);
        let mut nodal = vec![Vector::zeros(); grid.nodes()];
        let shown = ParticleField { v: &found, affine: None };
        kernel.p2g_momentum(particles, shown, &grid, &mut nodal);
        let nodes = nodal.iter().zip(&grid.mass).filter(|(_, m)| **m > 0.0);
        let seen: f64 = nodes.map(|(momentum, m)| momentum.norm_squared() / m).sum();
        assert!(seen < 1e-24 * square(particles, &particles.v), "{basis:?}");
        // and the remaining part is orthogonal to it.
        let rest = particles.v.iter().zip(&found).map(|(v, found)| v - found);
        let rest: Vec<f64> = rest.flat_map(|v| v.data.0[0]).collect();
        solver.set_state(&rest);
        let again = share(&solver.null_space_velocity(), solver.particles());
        assert!(again < 1e-18, "{basis:?}: {again}");
    }
}

#[test]
fn velocity_splits_into_grid_and_null_space_parts() {
    of_any_velocity::<1>();
    of_any_velocity::<2>();
}

#[test]
fn nan_velocity_has_a_nan_energy() {
    let mut solver = body(BasisName::Linear, 2, |_| Vector::<1>::new(1.0));
    let state: Vec<f64> = (0..8).map(|p| if p == 3 { f64::NAN } else { 1.0 }).collect();
    solver.set_state(&state);
    assert!(solver.null_space_energy().is_nan());
}
