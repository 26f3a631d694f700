//! Set-ups that are no bar, and bars that stop being one.

use rstest::rstest;

use super::bar_at_rest;
use crate::fem::setup::MOST_CELLS;
use crate::fem::{Bar, BarSetup, Mass, SetupError, pointwise};
use crate::subject::{Failure, Site, Subject};

fn start() -> BarSetup {
    bar_at_rest(1.0, 1e5, 1e3)
}

#[rstest]
#[case::no_cells(BarSetup { cells: 0, ..start() }, SetupError::Cells(0))]
#[case::too_many(BarSetup { cells: MOST_CELLS + 1, ..start() }, SetupError::Cells(MOST_CELLS + 1))]
#[case::empty(BarSetup { to: 0.0, ..start() }, SetupError::Interval { from: 0.0, to: 0.0 })]
#[case::reversed(BarSetup { to: -1.0, ..start() }, SetupError::Interval { from: 0.0, to: -1.0 })]
#[case::weightless(BarSetup { density: 0.0, ..start() }, SetupError::Density(0.0))]
#[case::negative(BarSetup { density: -1.0, ..start() }, SetupError::Density(-1.0))]
#[case::pulled_where_fixed(
    BarSetup { traction: [Some(Box::new(|_| 1.0)), None], ..start() },
    SetupError::TractionAtFixedEnd("left")
)]
fn nonsense_is_refused(#[case] setup: BarSetup, #[case] expected: SetupError) {
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
fn what_is_not_finite_is_refused(#[case] setup: BarSetup) {
    assert!(Bar::new(setup).is_err());
}

#[test]
fn an_inverted_start_is_refused() {
    let setup = BarSetup { initial_displacement: Box::new(|x| -2.0 * x), ..start() };
    let inverted = Failure::Inverted { site: Site::Element(0), j: -1.0 };
    assert_eq!(Bar::new(setup).err(), Some(SetupError::Initial(inverted)));
}

/// Half of the bar is at rest; element 4 of 8 is run over within the step.
#[test]
fn an_inversion_names_its_element_in_the_step_that_makes_it() {
    let initial_velocity = Box::new(|x| if x > 0.5 { -10.0 } else { 0.0 });
    let mut bar = Bar::new(BarSetup { initial_velocity, ..start() }).unwrap();
    let failure = bar.step(0.1).unwrap_err();
    let Failure::Inverted { site: Site::Element(4), j } = failure else { panic!("{failure}") };
    assert!(j < 0.0);
    assert!(bar.counters().min_j <= j);
}

/// The first node is fixed, and the traction fails at the last one.
#[rstest]
#[case::law(BarSetup { law: Box::new(|_| f64::NAN), ..start() }, 1)]
#[case::body_force(BarSetup { body_force: Some(pointwise(|_, t| 1.0 / t)), ..start() }, 1)]
#[case::traction(BarSetup { traction: [None, Some(Box::new(|t| 1.0 / t))], ..start() }, 8)]
fn a_force_that_is_not_finite_names_its_node(
    #[case] setup: BarSetup,
    #[case] node: usize,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
) {
    let mut bar = Bar::new(BarSetup { mass, ..setup }).unwrap();
    let site = Site::Node(node);
    assert_eq!(bar.step(1e-3), Err(Failure::NonFinite { quantity: "force", site }));
}

#[test]
fn a_step_without_length_in_numbers_is_a_failure() {
    let initial_velocity = Box::new(|x| x);
    let mut bar = Bar::new(BarSetup { initial_velocity, ..start() }).unwrap();
    let (quantity, site) = ("deformation gradient", Site::Element(0));
    assert_eq!(bar.step(f64::NAN), Err(Failure::NonFinite { quantity, site }));
}

/// Nothing is left to move, and nothing breaks: both ends of the only element are fixed.
#[test]
fn a_bar_without_free_nodes_stands() {
    let mut bar = Bar::new(BarSetup {
        cells: 1,
        fixed: [true; 2],
        mass: Mass::Consistent,
        body_force: Some(pointwise(|_, _| -9.81)),
        ..start()
    })
    .unwrap();
    bar.step(1e-3).unwrap();
    assert!(bar.displacement_at(0.5).abs() < 1e-300);
}
