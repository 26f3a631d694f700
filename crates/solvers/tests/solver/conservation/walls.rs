//! Bodies between walls, and on periodic axes.

use super::{conservative, momentum, some};
use crate::common::{DT, H, free_body, in_dimension, scattered_stress};
use mpm_solvers::mpm::{
    BasisName, Block, Fixed, Particles, Prescribed, PrescribedVelocity, Roller, SchemeName,
    SetForce, Setup, Side, Solver, TransferName, Vector, VelocityField,
};
use mpm_subject::{Start, Subject};
use rstest::rstest;

const CELLS: usize = 4;

/// Creates a body that fills a grid of [`CELLS`] cells along every axis, moves and is under stress.
/// Only the last axis has walls, if `walls` is set.
fn full<const D: usize>(
    method: (BasisName, TransferName),
    scheme: SchemeName,
    walls: bool,
) -> Setup<D> {
    let mut setup = free_body::<D>(method, scheme);
    let (from, to) = (Vector::zeros(), Vector::from_element(H * CELLS as f64));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
    for p in 0..particles.len() {
        let (x, k) = (particles.x[p], p as f64);
        particles.v[p] = Vector::from_fn(|i, _| 0.3 + 0.1 * libm::sin(3.0 * x[(i + 1) % D]));
        particles.sigma[p] = scattered_stress(k);
    }
    let periodic = std::array::from_fn(|axis| axis < D - 1 || !walls);
    setup.grid = setup.kernel.grid(Vector::zeros(), H, [CELLS; D], periodic);
    setup.particles = particles;
    setup
}

fn nothing_is_lost_around_the_corner<const D: usize>(scheme: SchemeName, start: Start) {
    for method in conservative(D) {
        let setup = Setup { start, ..full::<D>(method, scheme, false) };
        let mut solver = Solver::new(setup).unwrap();
        let before = momentum(solver.particles());
        (0..100).for_each(|_| solver.step(DT).unwrap());
        let mass: f64 = solver.grid().mass.iter().sum();
        let body: f64 = solver.particles().mass.iter().sum();
        assert!((mass - body).abs() <= 1e-14 * body, "{method:?}");
        let change = (momentum(solver.particles()) - before).norm() / before.norm();
        assert!(change <= 1e-13, "{method:?}: relative change {change:.1e}");
        assert!(solver.counters().crossings.unwrap() > 0, "{method:?}: particles change cells");
    }
}

/// Asserts that walls change only the momentum along their normal.
fn slides<const D: usize>(scheme: SchemeName) {
    for method in conservative(D) {
        let mut setup = full::<D>(method, scheme, true);
        setup.particles.v.iter_mut().for_each(|v| v[D - 1] *= 0.1);
        for side in [Side::Low, Side::High] {
            setup.boundary.push(Box::new(Roller::face(&setup.grid, D - 1, side)));
        }
        let mut solver = Solver::new(setup).unwrap();
        let before = momentum(solver.particles());
        (0..100).for_each(|_| solver.step(DT).unwrap());
        let change = (momentum(solver.particles()) - before) / before.norm();
        for axis in 0..D - 1 {
            assert!(change[axis].abs() <= 1e-13, "{method:?}: change {change:?}");
        }
        assert!(change[D - 1].abs() > 1e-3, "{method:?}: the walls hold nothing");
    }
}

/// Returns a velocity along the first axis that changes with time.
fn swing<const D: usize>() -> VelocityField<D> {
    Box::new(|_, t| {
        assert!(t >= 0.0, "no velocity is asked for before the start");
        Vector::from_fn(|i, _| if i == 0 { libm::sin(30.0 * t + 0.5) } else { 0.0 })
    })
}

/// Returns the displacement under the velocity [`swing`] over `steps` steps, by the midpoint rule.
fn path<const D: usize>(steps: usize) -> Vector<D> {
    (0..steps).map(|k| swing()(&Vector::zeros(), (k as f64 + 0.5) * DT) * DT).sum()
}

fn far<const D: usize>(solver: &Solver<D>, steps: usize, p: usize) -> f64 {
    let particles = solver.particles();
    let path = path::<D>(steps);
    (particles.x[p] - particles.x0[p] - path).norm() / path.norm()
}

/// Runs a layer of one cell between two walls that oscillate along themselves: the velocity of
/// every node is prescribed.
fn follows<const D: usize>(scheme: SchemeName, start: Start) {
    let bases = [BasisName::Linear, BasisName::UniformGimp, BasisName::ContiguousGimp];
    for method in some(D).filter(|(basis, _)| bases.contains(basis)) {
        let mut setup = full::<D>(method, scheme, true);
        let (from, mut to) = (Vector::zeros(), Vector::from_element(H * CELLS as f64));
        let (mut cells, periodic) = ([CELLS; D], std::array::from_fn(|axis| axis < D - 1));
        (cells[D - 1], to[D - 1]) = (1, H);
        setup.particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
        setup.grid = setup.kernel.grid(from, H, cells, periodic);
        setup.particles.v.fill(swing()(&from, 0.0));
        setup.start = start;
        for side in [Side::Low, Side::High] {
            let wall = Prescribed::face(&setup.grid, method.0, D - 1, side, swing());
            setup.boundary.push(Box::new(wall));
        }
        let mut solver = Solver::new(setup).unwrap();
        for steps in 1..=50 {
            solver.step(DT).unwrap();
            let far = far(&solver, steps, 0);
            assert!(far <= 1e-13, "{method:?} after {steps} steps: {far:.1e} behind its walls");
        }
        let (now, last) = (49.5 * DT, solver.particles().v[0]);
        let lag = (last - swing()(&Vector::zeros(), now)).norm();
        assert!(lag <= 1e-13, "{method:?}: the velocity is {lag:.1e} m/s behind");
    }
}

/// Where walls meet, the last condition of the list applies.
#[test]
fn fixed_wall_overrides_a_moving_wall_at_the_corner() {
    let method = (BasisName::Linear, TransferName::Flip);
    let setup = full::<2>(method, SchemeName::Usl, true);
    let mut setup =
        Setup { grid: setup.kernel.grid(Vector::zeros(), H, [CELLS; 2], [false; 2]), ..setup };
    let grid = &setup.grid;
    let driven = Prescribed::face(grid, method.0, 1, Side::High, swing());
    let fixed = Fixed::face(grid, 0, Side::Low);
    setup.boundary = vec![Box::new(driven), Box::new(fixed)];
    let (corner, next) = (grid.node(&[0, CELLS]), grid.node(&[1, CELLS]));
    let mut solver = Solver::new(setup).unwrap();
    (0..3).for_each(|_| solver.step(DT).unwrap());
    assert_eq!(solver.grid().velocity[corner].norm(), 0.0);
    let expected = swing::<2>()(&Vector::zeros(), 2.5 * DT);
    assert!((solver.grid().velocity[next] - expected).norm() <= 1e-14);
}

/// Asserts that the particles of a set follow the prescribed motion, for any motion of the rest of
/// the body.
fn set_follows<const D: usize>(scheme: SchemeName, start: Start) {
    for method in some(D) {
        let mut setup = Setup { start, ..free_body::<D>(method, scheme) };
        let members = [0, 1, 3];
        setup.effects.push(Box::new(PrescribedVelocity::on(&setup.particles, &members, swing())));
        let mut solver = Solver::new(setup).unwrap();
        for steps in 1..=30 {
            solver.step(DT).unwrap();
            for p in members {
                let far = far(&solver, steps, p);
                assert!(far <= 1e-12, "{method:?} after {steps} steps: {far:.1e} off its way");
            }
        }
    }
}

fn impulse_arrives<const D: usize>(scheme: SchemeName) {
    let force = |t: f64| Vector::<D>::from_fn(|i, _| 1e-3 * (1.0 + t + i as f64));
    for method in conservative(D) {
        let mut setup = free_body::<D>(method, scheme);
        let members: Vec<usize> = (0..setup.particles.len()).filter(|p| p % 3 == 1).collect();
        setup.effects.push(Box::new(SetForce::on(&setup.particles, &members, Box::new(force))));
        let mut solver = Solver::new(setup).unwrap();
        let mut expected = momentum(solver.particles());
        for step in 0..50 {
            solver.step(DT).unwrap();
            expected += force(f64::from(step) * DT) * DT;
        }
        let change = (momentum(solver.particles()) - expected).norm() / expected.norm();
        assert!(change <= 1e-13, "{method:?}: relative difference {change:.1e}");
    }
}

/// A periodic body conserves mass and momentum, rollers carry no force along themselves, layers
/// follow moving walls, and sets follow their velocity, or take up the impulse of a force.
#[rstest]
fn walls_and_sets_have_their_exact_effect_on_the_motion(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, nothing_is_lost_around_the_corner(scheme, start));
    in_dimension!(dimension, set_follows(scheme, start));
    if dimension > 1 {
        in_dimension!(dimension, follows(scheme, start));
    }
    if start == Start::AtZero {
        in_dimension!(dimension, slides(scheme));
        in_dimension!(dimension, impulse_arrives(scheme));
    }
}
