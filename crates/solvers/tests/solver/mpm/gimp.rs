//! Generalized interpolation (GIMP).

use mpm_solvers::mpm::{BasisName, Block, Particles, Vector, kernel};
use rstest::rstest;

/// The fuzzer found this case: a particle domain that extends far outside the grid.
#[rstest]
#[case::negative(-1e30)]
#[case::infinite(f64::INFINITY)]
#[case::nan(f64::NAN)]
fn invalid_domain_length_stays_in_the_grid(#[case] spacing: f64) {
    let kernel = kernel::<1>(BasisName::UniformGimp);
    let (from, to) = (Vector::<1>::new(0.0), Vector::<1>::new(4.0));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
    particles.spacing[0] = spacing;
    let mut grid = kernel.grid(from, 1.0, [4], [false]);
    kernel.p2g_mass(&particles, &mut grid);
    assert_eq!(grid.mass.len(), 5);
}
