//! Taylor least squares, tested by the sums at nodes.

use approx::assert_abs_diff_eq;
use mpm_solvers::mpm::{
    BasisName, Block, Grid, Matrix, Particles, Stage, Tls, Transfer, Vector, kernel,
};
use rstest::rstest;

/// Creates eight cells with three particles each under a uniform stress. The last particle of the
/// fourth cell has moved into the fifth.
fn uneven() -> (Grid<1>, Particles<1>) {
    let grid = kernel::<1>(BasisName::Linear).grid(Vector::zeros(), 1.0, [8], [true]);
    let block = Block { from: Vector::<1>::new(0.0), to: Vector::<1>::new(8.0), density: 2.0 };
    let mut particles = Particles::fill(&block, 1.0, 3);
    particles.x[11][0] = 4.02;
    particles.sigma.fill(Matrix::<1>::new(5.0));
    (grid, particles)
}

#[test]
fn uniform_stress_exerts_no_force_for_any_particle_counts() {
    let (mut grid, particles) = uneven();
    let kernel = kernel::<1>(BasisName::Linear);
    kernel.p2g_internal_force(&particles, &mut grid);
    assert!(grid.force[4].norm() > 1.0, "the sum over particles does: {}", grid.force[4]);
    let mut tls = Tls::default();
    tls.start(&*kernel, &grid, &particles);
    tls.p2g(&*kernel, &particles, &mut grid, &[Stage::Force]);
    for force in &grid.force {
        assert_abs_diff_eq!(force.norm(), 0.0, epsilon = 1e-13);
    }
}

/// Returns masses and velocities of nodes for a uniform velocity of 3 m/s. One particle is alone in
/// its cell, near the centre; the body is displaced by `beyond` at the start.
fn lone(beyond: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut grid, mut particles) = uneven();
    particles.x[4][0] = 1.51;
    (particles.x[3][0], particles.x[5][0]) = (0.9, 2.1);
    particles.x.iter_mut().for_each(|x| x[0] += beyond);
    particles.v.fill(Vector::<1>::new(3.0));
    let kernel = kernel::<1>(BasisName::Linear);
    let mut tls = Tls::default();
    tls.start(&*kernel, &grid, &particles);
    tls.p2g(&*kernel, &particles, &mut grid, &[Stage::Mass, Stage::Momentum]);
    let momenta = grid.velocity.iter().zip(&grid.mass);
    let velocity = momenta.map(|(momentum, mass)| momentum[0] / mass);
    (grid.mass.clone(), velocity.collect())
}

#[test]
fn single_particle_causes_no_negative_mass() {
    let (mass, velocity) = lone(0.0);
    assert!(mass.iter().all(|mass| *mass > 0.0), "{mass:?}");
    assert_abs_diff_eq!(mass.iter().sum::<f64>(), 16.0, epsilon = 1e-13);
    for v in velocity {
        assert_abs_diff_eq!(v, 3.0, epsilon = 1e-13);
    }
}

#[rstest]
fn result_does_not_depend_on_the_period(#[values(8.0, -16.0)] beyond: f64) {
    for (here, there) in lone(0.0).0.iter().zip(lone(beyond).0) {
        assert_abs_diff_eq!(*here, there, epsilon = 1e-12);
    }
}
