//! Conservation over whole steps of a free body.

use super::{conservative, momentum};
use crate::common::{DT, body, free_body, in_dimension};
use approx::assert_abs_diff_eq;
use mpm_solvers::mpm::{
    BasisName, Block, Damping, Gravity, LinearElastic, Matrix, NeoHookean, Particles, SchemeName,
    Setup, Solver, TransferName, Vector, VolumeName,
};
use mpm_subject::{Start, Subject};
use rstest::rstest;

const STEPS: usize = 40;

/// Returns the sum of |m v|, the scale for round-off in the momentum.
fn size<const D: usize>(particles: &Particles<D>) -> f64 {
    particles.v.iter().zip(&particles.mass).map(|(v, m)| v.norm() * m).sum()
}

/// Volumes are averaged in more than one dimension only.
fn momentum_is_kept<const D: usize>(scheme: SchemeName, start: Start) {
    let volumes = &VolumeName::ALL[..D.min(2)];
    let each = |method| volumes.iter().map(move |volume| (method, *volume));
    for (method, volume) in conservative(D).flat_map(each) {
        let mut setup = free_body::<D>(method, scheme);
        (setup.start, setup.volume) = (start, volume);
        if volume == VolumeName::Averaged {
            setup.material = Box::new(NeoHookean::new(2.0, 0.49));
        }
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

/// The last particle of the body is exactly on a node, and the node ahead of it has no mass. With
/// linear functions this node receives a force V sigma/h from the particle, which is lost, and its
/// zero velocity strains the particle by v dt/h.
#[rstest]
fn linear_functions_fail_for_a_body_that_ends_on_a_node(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(TransferName::Flip, TransferName::Apic)] transfer: TransferName,
    #[values(BasisName::Linear, BasisName::ContiguousGimp)] basis: BasisName,
    #[values(0.0, -1e-3)] beside: f64,
) {
    let from = Vector::<1>::from([1.25 + beside]);
    let mut particles =
        Particles::fill(&Block { from, to: from.add_scalar(2.0), density: 1.0 }, 1.0, 2);
    let (v, stress, dt) = (0.3, 0.01, 0.01);
    particles.v.fill(Vector::from([v]));
    particles.sigma.fill(Matrix::from_element(stress));
    let before = momentum(&particles)[0];
    let material = Box::new(LinearElastic::new(1e-9, 0.0));
    let setup = Setup { material, ..body((basis, transfer), scheme, particles, (1.0, 8)) };
    let mut solver = Solver::new(setup).unwrap();
    solver.step(dt).unwrap();
    let is_blind = basis == BasisName::Linear && beside == 0.0;
    let (lost, strain) = if is_blind { (0.5 * stress * dt, v * dt) } else { (0.0, 0.0) };
    let change = momentum(solver.particles())[0] - before;
    // Under USF the strain has already changed the volume.
    assert_abs_diff_eq!(change, lost, epsilon = 1e-13 + strain * lost);
    assert_abs_diff_eq!(solver.counters().min_j, 1.0 - strain, epsilon = 1e-5);
}

/// Gravity grows with time. A step from t to t + dt must use its value at t.
/// [`Start::HalfStepBack`] adds half a step at t = 0.
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

/// The damping rate grows with time. A step must use its value in the middle of the step, t.
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

/// A free body conserves linear momentum. Gravity changes it by its impulse, and damping by its
/// rate.
#[rstest]
fn momentum_changes_only_by_loads(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, momentum_is_kept(scheme, start));
    in_dimension!(dimension, impulse_arrives(scheme, start));
    in_dimension!(dimension, slows_down(scheme, start));
}
