//! Checks of results before they are timed.

use crate::scene::{H, Method, PER_AXIS};
use mpm_verify::mpm::{
    FrameName, Grid, MassName, MaterialPlan, Matrix, Particles, SchemeName, Setup, Solver, Vector,
    VolumeName, mass_matrix,
};
use mpm_verify::subject::{Start, Subject};

/// Whether `x` is a rounding error of a value of size `scale`; false for NaN.
fn vanishes(x: f64, scale: f64) -> bool {
    x.abs() <= 1e-12 * scale
}

/// Panics if P2G is wrong. Mass and momentum must be conserved, and a uniform stress must give no
/// force on nodes whose function lies inside the body. The body starts one cell from the wall, and
/// so do functions of index 4 and above, including cubic B-splines.
pub(crate) fn check_p2g<const D: usize>(
    id: &str,
    method: &mut Method<D>,
    mut grid: Grid<D>,
    p: &Particles<D>,
) {
    let mut stressed = p.clone();
    stressed.sigma.fill(Matrix::from_fn(|i, j| 1.0 + (i + j) as f64));
    method.p2g(&stressed, &mut grid);

    let mass: f64 = p.mass.iter().sum();
    let kept = grid.mass.iter().sum::<f64>();
    assert!(vanishes(kept - mass, mass), "{id}: not timed, P2G makes mass {kept} of {mass}");

    let momentum: Vector<D> = p.v.iter().zip(&p.mass).map(|(v, m)| v * *m).sum();
    let lost = (grid.velocity.iter().sum::<Vector<D>>() - momentum).norm();
    let scale: f64 = p.v.iter().zip(&p.mass).map(|(v, m)| v.norm() * m).sum();
    assert!(vanishes(lost, scale), "{id}: not timed, P2G changes momentum by {lost}");

    let scale = p.vol.iter().zip(&stressed.sigma).map(|(vol, s)| vol * s.norm() / H).sum();
    let total = grid.force.iter().sum::<Vector<D>>().norm();
    assert!(vanishes(total, scale), "{id}: not timed, internal forces add up to {total}");
    let cell_scale = scale * PER_AXIS.pow(D as u32) as f64 / p.len() as f64;
    let is_inside = |i| (0..D).all(|a| (4..grid.cells[a] - 2).contains(&grid.index_on_axis(i, a)));
    for (i, f) in grid.force.iter().enumerate().filter(|(i, _)| is_inside(*i)) {
        let push = f.norm();
        assert!(vanishes(push, cell_scale), "{id}: not timed, uniform stress pushes {i} by {push}");
    }
}

/// Panics if G2P is wrong: a translating grid must translate the particles.
pub(crate) fn check_g2p<const D: usize>(
    id: &str,
    method: &mut Method<D>,
    mut grid: Grid<D>,
    p: &Particles<D>,
) {
    let velocity = Vector::from_fn(|axis, _| 1.0 + axis as f64);
    let dt = 0.125 * H;
    grid.velocity.fill(velocity);
    grid.acceleration.fill(velocity);
    let mut moved = p.clone();
    moved.v.fill(velocity * (1.0 - dt));
    method.g2p(&grid, dt, &mut moved);
    for k in 0..p.len() {
        let dv = (moved.v[k] - velocity).norm();
        let dx = (moved.x[k] - p.x[k] - velocity * dt).norm();
        let exact = vanishes(dv, 1.0) && vanishes(dx, p.x[k].norm());
        let rigid = vanishes(moved.grad_v[k].norm(), velocity.norm() / H);
        assert!(exact && rigid, "{id}: not timed, G2P bends a translation at particle {k}");
    }
}

/// Creates a solver that has made one step. Panics if the step does not conserve momentum.
pub(crate) fn checked_solver<const D: usize>(
    id: &str,
    dt: f64,
    (scheme, material): (SchemeName, MaterialPlan),
    Method { kernel, transfer, .. }: Method<D>,
    (grid, particles): (Grid<D>, Particles<D>),
) -> Solver<D> {
    let momentum = |p: &Particles<D>| -> Vector<D> { p.v.iter().sum::<Vector<D>>() * p.mass[0] };
    let before = momentum(&particles);
    let (material, start) = (material.build(), Start::AtZero);
    let (effects, boundary) = (Vec::new(), Vec::new());
    let (mass, frame) = (mass_matrix(MassName::Lumped), FrameName::Updated);
    let setup = Setup {
        grid,
        particles,
        kernel,
        transfer,
        mass,
        frame,
        volume: VolumeName::Particle,
        material,
        effects,
        boundary,
        scheme,
        start,
    };
    let mut solver = Solver::new(setup).expect("every particle is inside");
    solver.step(dt).expect("the first step succeeds");
    let p = solver.particles();
    let scale = p.v.iter().map(|v| v.norm() * p.mass[0]).sum();
    let lost = (momentum(p) - before).norm();
    assert!(vanishes(lost, scale), "{id}: not timed, a step changes momentum by {lost}");
    solver
}
