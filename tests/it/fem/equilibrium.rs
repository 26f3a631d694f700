//! Tests of equilibrium, samples, counters and errors of bars.

use super::{bar_at_rest, run};
use approx::assert_relative_eq;
use mpm_verify::fem::{Bar, BarSetup, Element, Mass, Sampling, SetupError, pointwise};
use mpm_verify::subject::{Failure, Samples, Site, Subject};
use rstest::rstest;

const STRETCH: f64 = 1.3;

fn neo_hookean(def_grad: f64) -> f64 {
    50.0 * (def_grad - 1.0 / def_grad)
}

/// Patch test: a uniform strain is in the discrete space, and its stress is in equilibrium.
#[rstest]
fn uniform_stretch_remains_in_equilibrium(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
    #[values([true, false], [false, true], [false, false])] fixed: [bool; 2],
) {
    let held_at = if fixed[1] { 2.0 } else { 0.0 };
    let stretched = move |x| (STRETCH - 1.0) * (x - held_at);
    let pull = |fixed: bool| -> Option<mpm_verify::fem::TimeFunction> {
        (!fixed).then(|| Box::new(|_| neo_hookean(STRETCH)) as _)
    };
    let bar = run(
        BarSetup {
            element,
            mass,
            fixed,
            law: Box::new(neo_hookean),
            traction: fixed.map(pull),
            initial_displacement: Box::new(stretched),
            ..bar_at_rest(2.0, 100.0, 1.0)
        },
        1.0,
        2e-3,
    );
    for (&x, &u) in bar.nodes().iter().zip(bar.nodal_displacements()) {
        assert_relative_eq!(u, stretched(x), epsilon = 1e-12);
    }
    assert_relative_eq!(bar.counters().min_j, STRETCH, epsilon = 1e-12);
}

#[rstest]
fn a_free_bar_falls(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
) {
    let setup = BarSetup {
        element,
        mass,
        fixed: [false; 2],
        body_force: Some(pointwise(|_, _| -9.81)),
        ..bar_at_rest(2.0, 100.0, 1.0)
    };
    let bar = run(setup, 0.5, 2e-3);
    for (u, v) in bar.nodal_displacements().iter().zip(bar.nodal_velocities()) {
        assert_relative_eq!(*u, -0.5 * 9.81 * 0.25, max_relative = 1e-11);
        assert_relative_eq!(v, -9.81 * 0.5, max_relative = 1e-11);
    }
}

#[rstest]
fn samples_cover_the_bar(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Sampling::Inside, Sampling::Nodes)] sampling: Sampling,
) {
    let (initial_displacement, initial_velocity) = (Box::new(|x| 0.1 * x), Box::new(|x| 3.0 * x));
    let start = bar_at_rest(2.0, 100.0, 1.0);
    let setup = BarSetup { element, initial_displacement, initial_velocity, sampling, ..start };
    let bar = Bar::new(setup).unwrap();
    let mut samples = Samples::default();
    bar.sample(&mut samples);
    let count = samples.len();
    bar.sample(&mut samples); // replaces the previous samples
    let lengths = [&samples.label, &samples.displacement, &samples.velocity].map(Vec::len);
    assert_eq!(lengths, [count; 3]);
    assert_eq!((samples.dimension, samples.len()), (1, count));
    assert_relative_eq!(samples.weight.iter().sum::<f64>(), 2.0, epsilon = 1e-14);
    for ((&x, &u), &v) in samples.label.iter().zip(&samples.displacement).zip(&samples.velocity) {
        assert_relative_eq!(u, 0.1 * x, epsilon = 1e-14);
        assert_relative_eq!(v, 3.0 * x, epsilon = 1e-14);
    }
}

/// Eight elements have two points and two nodes each, and each pair is visited once for the strain
/// and once for the forces.
#[test]
fn every_visit_is_counted() {
    let mut bar = Bar::new(bar_at_rest(2.0, 100.0, 1.0)).unwrap();
    assert_eq!(bar.counters().transfers, 32);
    bar.step(1e-3).unwrap();
    assert_eq!(bar.counters().transfers, 32 + 64);
}

fn start() -> BarSetup {
    bar_at_rest(1.0, 1e5, 1e3)
}

#[rstest]
#[case::no_cells(BarSetup { cells: 0, ..start() }, SetupError::Cells(0))]
#[case::too_many(BarSetup { cells: (1 << 24) + 1, ..start() }, SetupError::Cells((1 << 24) + 1))]
#[case::empty(BarSetup { to: 0.0, ..start() }, SetupError::Interval { from: 0.0, to: 0.0 })]
#[case::reversed(BarSetup { to: -1.0, ..start() }, SetupError::Interval { from: 0.0, to: -1.0 })]
#[case::weightless(BarSetup { density: 0.0, ..start() }, SetupError::Density(0.0))]
#[case::negative(BarSetup { density: -1.0, ..start() }, SetupError::Density(-1.0))]
#[case::pulled_where_fixed(
    BarSetup { traction: [Some(Box::new(|_| 1.0)), None], ..start() },
    SetupError::TractionAtFixedEnd("left")
)]
fn invalid_setup_is_refused(#[case] setup: BarSetup, #[case] expected: SetupError) {
    assert_eq!(Bar::new(setup).err(), Some(expected));
}

#[rstest]
#[case::from(BarSetup { from: f64::NAN, ..start() })]
#[case::to(BarSetup { to: f64::INFINITY, ..start() })]
#[case::length(BarSetup { from: -1.7e308, to: 1.7e308, ..start() })]
#[case::density(BarSetup { density: f64::NAN, ..start() })]
#[case::heavy(BarSetup { density: f64::INFINITY, ..start() })]
#[case::displacement(BarSetup { initial_displacement: Box::new(|_| f64::NAN), ..start() })]
#[case::velocity(BarSetup { initial_velocity: Box::new(|x| 1.0 / (x - 1.0)), ..start() })]
fn non_finite_setup_is_refused(#[case] setup: BarSetup) {
    assert!(Bar::new(setup).is_err());
}

#[test]
fn an_inverted_start_is_refused() {
    let setup = BarSetup { initial_displacement: Box::new(|x| -2.0 * x), ..start() };
    let inverted = Failure::Inverted { site: Site::Element(0), j: -1.0 };
    assert_eq!(Bar::new(setup).err(), Some(SetupError::Initial(inverted)));
}

/// Half of the bar is at rest. The moving half inverts element 4 of 8 within the step.
#[test]
fn inversion_is_reported_with_its_element_in_the_same_step() {
    let initial_velocity = Box::new(|x| if x > 0.5 { -10.0 } else { 0.0 });
    let mut bar = Bar::new(BarSetup { initial_velocity, ..start() }).unwrap();
    let failure = bar.step(0.1).unwrap_err();
    let Failure::Inverted { site: Site::Element(4), j } = failure else { panic!("{failure}") };
    assert!(j < 0.0);
    assert!(bar.counters().min_j <= j);
}

/// Node 0 is fixed, so node 1 is the first with an invalid force. The traction acts on the last
/// node.
#[rstest]
#[case::law(BarSetup { law: Box::new(|_| f64::NAN), ..start() }, 1)]
#[case::body_force(BarSetup { body_force: Some(pointwise(|_, t| 1.0 / t)), ..start() }, 1)]
#[case::traction(BarSetup { traction: [None, Some(Box::new(|t| 1.0 / t))], ..start() }, 8)]
fn non_finite_force_is_reported_with_its_node(
    #[case] setup: BarSetup,
    #[case] node: usize,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
) {
    let mut bar = Bar::new(BarSetup { mass, ..setup }).unwrap();
    let site = Site::Node(node);
    assert_eq!(bar.step(1e-3), Err(Failure::NonFinite { quantity: "force", site }));
}

#[test]
fn nan_step_length_is_a_failure() {
    let initial_velocity = Box::new(|x| x);
    let mut bar = Bar::new(BarSetup { initial_velocity, ..start() }).unwrap();
    let (quantity, site) = ("deformation gradient", Site::Element(0));
    assert_eq!(bar.step(f64::NAN), Err(Failure::NonFinite { quantity, site }));
}

/// Both ends of the only element are fixed: no node can move, and the step succeeds.
#[test]
fn bar_without_free_nodes_does_not_move() {
    let mut bar = Bar::new(BarSetup {
        cells: 1,
        fixed: [true; 2],
        mass: Mass::Consistent,
        body_force: Some(pointwise(|_, _| -9.81)),
        ..start()
    })
    .unwrap();
    bar.step(1e-3).unwrap();
    assert!(bar.nodal_displacements().iter().all(|u| u.abs() < 1e-300));
}
