//! Tests of orders in space and time, stability limits and energy conservation of bars.

use super::{bar_at_rest, orders, rms, run, vibrating_bar};
use crate::common::{built_in_source, cases};
use mpm_verify::fem::Element::{Linear, Quadratic};
use mpm_verify::fem::Mass::{Consistent, Lumped};
use mpm_verify::fem::Sampling::{Inside, Nodes};
use mpm_verify::fem::{Bar, BarSetup, Element, Mass, Sampling, pointwise};
use mpm_verify::subject::{Start, Subject};
use rstest::rstest;
use std::f64::consts::PI;

/// Returns the exact displacement `u = v0/w sin(pi X / (2L)) sin(w t)`.
fn exact(x: f64, t: f64) -> f64 {
    let omega = PI / 50.0 * 10.0;
    0.1 / omega * libm::sin(PI * x / 50.0) * libm::sin(omega * t)
}

const UNTIL: f64 = 0.5;

/// Time step (s). The resulting time error is below 1e-12 m. The smallest errors of these tests are
/// 3e-12 m at the nodes (64 quadratic elements) and 3e-9 m inside the elements.
const DT: f64 = 2e-5;

/// For elements of degree k, the order is k + 1 inside the elements and 2k at the nodes. Lumping
/// preserves the order 2k, because the quadrature at the Lobatto points to which it is equivalent
/// is exact for the mass up to degree 2k - 1 (Fried & Malkus, *Int. J. Solids Struct.* 11, 1975).
#[rstest]
#[case(Linear, Lumped, Inside, 2.0)]
#[case(Linear, Consistent, Inside, 2.0)]
#[case(Quadratic, Lumped, Inside, 3.0)]
#[case(Quadratic, Consistent, Inside, 3.0)]
#[case(Linear, Lumped, Nodes, 2.0)]
#[case(Linear, Consistent, Nodes, 2.0)]
#[case(Quadratic, Lumped, Nodes, 4.0)]
#[case(Quadratic, Consistent, Nodes, 4.0)]
fn the_vibrating_bar_shows_the_formal_order(
    #[case] element: Element,
    #[case] mass: Mass,
    #[case] sampling: Sampling,
    #[case] formal: f64,
) {
    let error = |cells| {
        let bar = run(vibrating_bar(cells, element, mass), UNTIL, DT);
        rms(&bar, sampling, |x| exact(x, UNTIL))
    };
    let observed = orders(&[4, 8, 16, 32, 64].map(error));
    println!("{element:?} {mass:?} {sampling:?} {observed:.2?}");
    // At the nodes of lumped quadratic elements, the first pair of meshes is pre-asymptotic.
    for order in &observed[1..] {
        assert!((order - formal).abs() < 0.25, "{observed:?}");
    }
    assert!((observed[3] - formal).abs() < 0.05, "{observed:?}");
}

/// The bar of the suite is fixed on the left and pulled on the right. The signs of displacement,
/// velocity and traction change in its mirror image.
#[test]
fn mirror_image_of_a_pulled_bar_has_its_orders() {
    let suite = built_in_source("fem-pulled-bar").text().replace("left: fixed", "right: fixed");
    let suite = suite.replace("on: right", "on: left").replace("k*X", "k*(L - X)");
    for case in cases(&suite.replace("[\"", "[\"-")) {
        assert!(case.passed(), "{}: {}", case.case, case.reason);
    }
}

/// Creates a column of ten elements (wave speed 10 m/s) under suddenly applied gravity.
fn column(start: Start) -> BarSetup {
    let body_force = Some(pointwise(|_, _| -9.81));
    BarSetup { cells: 10, start, body_force, ..bar_at_rest(1.0, 1e5, 1e3) }
}

/// Interpolates nodal values of the column at x = 0.77 m.
fn between(nodal: &[f64]) -> f64 {
    0.3 * nodal[7] + 0.7 * nodal[8]
}

/// Returns displacement and velocity at a point of the column after 0.1 s, computed in `steps`
/// steps.
fn seen(start: Start, steps: u32) -> [f64; 2] {
    let bar = run(column(start), 0.1, 0.1 / f64::from(steps));
    let velocities: Vec<f64> = bar.nodal_velocities().collect();
    [between(bar.nodal_displacements()), between(&velocities)]
}

/// A run with a much smaller step on the same mesh is the reference. From rest and under a constant
/// load, [`Start::AtZero`] computes the exact motion shifted by half a step, so the displacement is
/// of first order and the velocity of second order.
#[rstest]
#[case(Start::AtZero, [1.0, 2.0])]
#[case(Start::HalfStepBack, [2.0, 2.0])]
fn start_determines_the_order_in_time(#[case] start: Start, #[case] formal: [f64; 2]) {
    let reference = seen(Start::HalfStepBack, 51_200);
    for (quantity, formal) in formal.into_iter().enumerate() {
        let error = |steps| (seen(start, steps)[quantity] - reference[quantity]).abs();
        let observed = orders(&[100, 200, 400, 800].map(error));
        println!("{start:?} {quantity} {observed:.3?}");
        assert!(observed.iter().all(|order| (order - formal).abs() < 0.1), "{observed:?}");
    }
}

#[test]
fn change_of_step_preserves_second_order() {
    let exact = seen(Start::HalfStepBack, 51_200);
    let error = |pairs: u32| {
        let mut bar = Bar::new(column(Start::HalfStepBack)).unwrap();
        let dt = 0.1 / (3.0 * f64::from(pairs));
        for _ in 0..pairs {
            bar.step(dt).unwrap();
            bar.step(2.0 * dt).unwrap();
        }
        (between(bar.nodal_displacements()) - exact[0]).abs()
    };
    let observed = orders(&[50, 100, 200, 400].map(error));
    assert!(observed.iter().all(|order| (order - 2.0).abs() < 0.1), "{observed:?}");
}

/// A free bar under the load `b = 6 t` moves by `u = t^3`.
#[test]
fn varying_load_is_evaluated_at_the_time_of_the_displacements() {
    let error = |steps| {
        let body_force = Some(pointwise(|_, t| 6.0 * t));
        let setup = BarSetup { body_force, fixed: [false; 2], ..bar_at_rest(1.0, 1e3, 1e3) };
        run(setup, 1.0, 1.0 / f64::from(steps)).nodal_displacements()[0] - 1.0
    };
    let observed = orders(&[20, 40, 80].map(error).map(f64::abs));
    assert!(observed.iter().all(|order| (order - 2.0).abs() < 1e-3), "{observed:?}");
}

/// A bar survives `c dt / h` slightly below the limit in the documentation of
/// [`mpm_verify::fem`], and fails slightly above the limit.
#[rstest]
#[case(Linear, Lumped, 1.0)]
#[case(Linear, Consistent, 1.0 / libm::sqrt(3.0))]
#[case(Quadratic, Lumped, 1.0 / libm::sqrt(6.0))]
#[case(Quadratic, Consistent, 1.0 / libm::sqrt(15.0))]
fn stability_limit_agrees_with_theory(
    #[case] element: Element,
    #[case] mass: Mass,
    #[case] limit: f64,
) {
    let survives = |courant: f64| {
        let mut bar = Bar::new(vibrating_bar(40, element, mass)).unwrap();
        let dt = courant * (25.0 / 40.0) / 10.0;
        (0..2000).all(|_| bar.step(dt).is_ok())
    };
    assert!(survives(0.98 * limit));
    assert!(!survives(1.02 * limit));
}

/// Returns the total energy of linear elements with a lumped mass, `E = 100 Pa`, `rho = 1 kg/m3`.
fn energy(bar: &Bar) -> f64 {
    let h = bar.nodes()[1];
    let last = bar.nodes().len() - 1;
    let mass = |i| if i == 0 || i == last { 0.5 * h } else { h };
    let kinetic: f64 = bar.nodal_velocities().enumerate().map(|(i, v)| mass(i) * v * v).sum();
    let stretched = bar.nodal_displacements().windows(2).map(|u| (u[1] - u[0]) * (u[1] - u[0]));
    0.5 * (kinetic + stretched.sum::<f64>() * 100.0 / h)
}

/// With a symplectic step the energy error is as small after 100 periods as after one.
#[rstest]
fn energy_stays_bounded(#[values(Start::AtZero, Start::HalfStepBack)] start: Start) {
    let mut bar = Bar::new(BarSetup { start, ..vibrating_bar(16, Linear, Lumped) }).unwrap();
    let initial = energy(&bar);
    let mut worst_of_period = || {
        let mut worst = 0.0_f64;
        for _ in 0..200 {
            bar.step(0.05).unwrap();
            worst = worst.max((energy(&bar) / initial - 1.0).abs());
        }
        worst
    };
    let worst: Vec<f64> = (0..100).map(|_| worst_of_period()).collect();
    assert!(worst[0] < 0.02, "{worst:?}");
    assert!(worst.iter().all(|&now| now < 1.02 * worst[0]), "{worst:?}");
}
