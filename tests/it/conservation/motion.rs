//! Whole steps of a body that nothing holds.

use super::{conservative, some};
use crate::common::{DT, free_body, in_dimension};
use approx::assert_abs_diff_eq;
use mpm_verify::mpm::{Damping, Gravity, Matrix, Particles, SchemeName, Solver, Vector};
use mpm_verify::subject::{Start, Subject};
use rstest::rstest;

const STEPS: usize = 40;

fn momentum<const D: usize>(particles: &Particles<D>) -> Vector<D> {
    particles.v.iter().zip(&particles.mass).map(|(v, m)| v * *m).sum()
}

/// Sum of |m v|: what round-off in the momentum is measured by.
fn size<const D: usize>(particles: &Particles<D>) -> f64 {
    particles.v.iter().zip(&particles.mass).map(|(v, m)| v.norm() * m).sum()
}

fn momentum_is_kept<const D: usize>(scheme: SchemeName, start: Start) {
    for method in conservative(D) {
        let mut setup = free_body::<D>(method, scheme);
        setup.start = start;
        let mut solver = Solver::new(setup).unwrap();
        let (before, size) = (momentum(solver.particles()), size(solver.particles()));
        for step in 1..=STEPS {
            solver.step(DT).unwrap();
            let change = (momentum(solver.particles()) - before).norm() / size;
            assert!(change <= 1e-13, "{method:?} step {step}: relative change {change:.1e}");
        }
        assert!(solver.counters().crossings.unwrap() > 0, "{method:?}: particles change cells");
    }
}

#[rstest]
fn a_free_body_keeps_its_linear_momentum(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, momentum_is_kept(scheme, start));
}

/// Gravity grows with time; a step from t to t + dt takes it at t. [`Start::HalfStepBack`] adds
/// half a step back at t = 0.
fn impulse_arrives<const D: usize>(scheme: SchemeName, start: Start) {
    let gravity = |t: f64| Vector::<D>::from_fn(|i, _| (i as f64 - 1.5) * (1.0 + t));
    for method in conservative(D) {
        let mut setup = free_body::<D>(method, scheme);
        setup.effects.push(Box::new(Gravity(Box::new(gravity))));
        setup.start = start;
        let mass: f64 = setup.particles.mass.iter().sum();
        let mut expected = momentum(&setup.particles);
        if start == Start::HalfStepBack {
            expected -= gravity(0.0) * (0.5 * DT * mass);
        }
        let mut solver = Solver::new(setup).unwrap();
        let mut time = 0.0;
        for _ in 0..STEPS {
            solver.step(DT).unwrap();
            expected += gravity(time) * (DT * mass);
            time += DT;
        }
        let change = (momentum(solver.particles()) - expected).norm() / size(solver.particles());
        assert!(change <= 1e-12, "{method:?}: relative difference {change:.1e}");
    }
}

#[rstest]
fn momentum_changes_by_the_impulse_of_gravity(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, impulse_arrives(scheme, start));
}

fn translates<const D: usize>(scheme: SchemeName) {
    let velocity = Vector::<D>::from_fn(|i, _| [4.0, -2.8, 1.6][i]);
    for method in some(D) {
        let mut setup = free_body::<D>(method, scheme);
        setup.particles.sigma.fill(Matrix::zeros());
        setup.particles.v.fill(velocity);
        let mut solver = Solver::new(setup).unwrap();
        (0..STEPS).for_each(|_| solver.step(DT).unwrap());
        let after = solver.particles();
        let path = velocity * (STEPS as f64 * DT);
        for (x, x0) in after.x.iter().zip(&after.x0) {
            assert_abs_diff_eq!((x - x0 - path).norm(), 0.0, epsilon = 1e-13);
        }
        let particles = after.len() as u64;
        let crossings = solver.counters().crossings.unwrap();
        assert!(crossings >= particles, "{method:?}: each particle changes its cell");
    }
}

#[rstest]
fn a_rigid_translation_without_stress_moves_every_particle_by_v_t(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    in_dimension!(dimension, translates(scheme));
}

/// The rate grows with time; a step takes that at its middle, t.
fn slows_down<const D: usize>(scheme: SchemeName, start: Start) {
    let rate = |t: f64| 3.0 + 100.0 * t;
    for method in conservative(D) {
        let mut setup = free_body::<D>(method, scheme);
        setup.effects.push(Box::new(Damping(Box::new(rate))));
        setup.start = start;
        let mut solver = Solver::new(setup).unwrap();
        let (before, size) = (momentum(solver.particles()), size(solver.particles()));
        let mut exponent = 0.0;
        for step in 1..=STEPS / 4 {
            solver.step(DT).unwrap();
            exponent += rate(DT * (step - 1) as f64) * DT;
            let expected = before * (-exponent).exp();
            let apart = (momentum(solver.particles()) - expected).norm() / size;
            assert!(apart <= 1e-13, "{method:?} step {step}: {apart:.1e}");
        }
    }
}

#[rstest]
fn a_damped_body_loses_its_momentum_at_the_rate_of_damping(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, slows_down(scheme, start));
}
