//! Tractions on faces, tested by the forces on nodes.

use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    BasisName, Block, BodyOnGrid, Effect, Matrix, Particles, Placement, Quadrilateral, Side,
    Traction, Vector, kernel,
};
use rstest::rstest;

/// A traction `(3 t, Y)` acts on the right face of a plate, which is stretched to twice its length.
/// The force at t = 2 is (12, 2). The face is at x = 2, so the moment about the origin is
/// `2 int Y dY = 4`.
#[rstest]
fn moment_is_exact_at_the_surface(
    #[values(
        BasisName::Linear,
        BasisName::ContiguousGimp,
        BasisName::Cpdi,
        BasisName::QuadraticBSpline
    )]
    basis: BasisName,
    #[values(Placement::Particles, Placement::Surface)] placement: Placement,
) {
    let (from, to) = (Vector::<2>::zeros(), Vector::<2>::new(1.0, 2.0));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 0.25, 2);
    let labels = particles.x0.clone();
    let f = Matrix::<2>::new(2.0, 0.0, 0.0, 1.0);
    let origin = Vector::<2>::new(0.1, 0.1);
    particles.deform(|p| (origin + (f - Matrix::identity()) * labels[p], f));
    particles.track_domains();
    let kernel = kernel::<2>(basis);
    let mut grid = kernel.grid(Vector::zeros(), 0.25, [12, 12], [false; 2]);
    let shear = Box::new(|x: &Vector<2>, t| Vector::<2>::new(3.0 * t, x[1]));
    let mut pull = Traction::at(&particles, 0, Side::High, placement, shear);
    let mut body = BodyOnGrid { particles: &particles, kernel: kernel.as_ref(), grid: &mut grid };
    let visits = pull.add_force(2.0, &mut body);
    if (basis, placement) == (BasisName::Linear, Placement::Particles) {
        assert_eq!(visits, 16 * 4);
    }
    let total = grid.force.iter().fold(Vector::zeros(), |sum, f| sum + f);
    assert_relative_eq!(total, Vector::<2>::new(12.0, 2.0), epsilon = 1e-13);
    let moment = |i: usize| grid.force[i][1] * (basis.place(&grid, i)[0] - origin[0]);
    let moment: f64 = (0..grid.nodes()).map(moment).sum();
    let arm = if placement == Placement::Surface { 2.0 } else { 2.0 - 2.0 * 0.0625 };
    assert_relative_eq!(moment, 2.0 * arm, max_relative = 1e-13);
}

/// A shear traction of 2 Pa acts on the right side of Cook's panel, which is 16 m long and at x =
/// 48 m. Force and moment about the origin must be right for any first corner of the map.
#[rstest]
fn force_and_moment_on_a_side_are_exact(
    #[values(0, 1, 2, 3)] first: usize,
    #[values(BasisName::Linear, BasisName::Cpdi, BasisName::QuadraticBSpline)] basis: BasisName,
    #[values(Placement::Particles, Placement::Surface)] placement: Placement,
) {
    let corners = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]];
    let corners = std::array::from_fn(|i| Vector::from(corners[(first + i) % 4]));
    let panel = Quadrilateral::new(corners).unwrap();
    let mut particles = panel.fill::<2>(1.0, 4.0, 2);
    particles.track_domains();
    let kernel = kernel::<2>(basis);
    let mut grid = kernel.grid(Vector::from([-8.0, -8.0]), 4.0, [20, 24], [false; 2]);
    let shear = Box::new(|_: &Vector<2>, _| Vector::from([0.0, 2.0]));
    let mut pull = Traction::at(&particles, 0, Side::High, placement, shear);
    let mut body = BodyOnGrid { particles: &particles, kernel: kernel.as_ref(), grid: &mut grid };
    pull.add_force(0.0, &mut body);
    let total = grid.force.iter().fold(Vector::zeros(), |sum, f| sum + f);
    assert_relative_eq!(total, Vector::<2>::new(0.0, 32.0), epsilon = 1e-11);
    let moment = |i: usize| grid.force[i][1] * basis.place(&grid, i)[0];
    let moment: f64 = (0..grid.nodes()).map(moment).sum();
    let depth = if placement == Placement::Surface { 0.0 } else { 0.5 * particles.spacing[0] };
    assert_relative_eq!(moment, 32.0 * (48.0 - depth), max_relative = 1e-12);
}
