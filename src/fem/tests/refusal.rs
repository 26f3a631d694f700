//! What is no bar, and what stops being one.

use rstest::rstest;

use super::bar_at_rest;
use crate::{
    fem::{Bar, Mass, Setup, SetupError, pointwise, setup::MOST_CELLS},
    subject::{Failure, Site, Subject},
};

fn start() -> Setup {
    bar_at_rest(1.0, 1e5, 1e3)
}

#[rstest]
#[case::no_cells(Setup { cells: 0, ..start() }, SetupError::Cells(0))]
#[case::too_many(Setup { cells: MOST_CELLS + 1, ..start() }, SetupError::Cells(MOST_CELLS + 1))]
#[case::empty(Setup { to: 0.0, ..start() }, SetupError::Interval { from: 0.0, to: 0.0 })]
#[case::reversed(Setup { to: -1.0, ..start() }, SetupError::Interval { from: 0.0, to: -1.0 })]
#[case::weightless(Setup { density: 0.0, ..start() }, SetupError::Density(0.0))]
#[case::negative(Setup { density: -1.0, ..start() }, SetupError::Density(-1.0))]
#[case::pulled_where_fixed(
    Setup { traction: [Some(Box::new(|_| 1.0)), None], ..start() },
    SetupError::TractionAtFixedEnd("left")
)]
fn nonsense_is_refused(#[case] setup: Setup, #[case] expected: SetupError) {
    assert_eq!(Bar::new(setup).err(), Some(expected));
}

#[rstest]
#[case::from(Setup { from: f64::NAN, ..start() })]
#[case::to(Setup { to: f64::INFINITY, ..start() })]
#[case::length(Setup { from: -1.7e308, to: 1.7e308, ..start() })]
#[case::density(Setup { density: f64::NAN, ..start() })]
#[case::heavy(Setup { density: f64::INFINITY, ..start() })]
#[case::displacement(Setup { initial_displacement: Box::new(|_| f64::NAN), ..start() })]
#[case::velocity(Setup { initial_velocity: Box::new(|x| 1.0 / (x - 1.0)), ..start() })]
fn what_is_not_finite_is_refused(#[case] setup: Setup) {
    assert!(Bar::new(setup).is_err());
}

#[test]
fn an_inverted_start_is_refused() {
    let setup = Setup { initial_displacement: Box::new(|x| -2.0 * x), ..start() };
    let inverted = Failure::Inverted { site: Site::Element(0), j: -1.0 };
    assert_eq!(Bar::new(setup).err(), Some(SetupError::Initial(inverted)));
}

/// Half of the bar is at rest; element 4 of 8 is run over within the step.
#[test]
fn an_inversion_names_its_element_in_the_step_that_makes_it() {
    let initial_velocity = Box::new(|x| if x > 0.5 { -10.0 } else { 0.0 });
    let mut bar = Bar::new(Setup { initial_velocity, ..start() }).unwrap();
    let failure = bar.step(0.1).unwrap_err();
    let Failure::Inverted { site: Site::Element(4), j } = failure else { panic!("{failure}") };
    assert!(j < 0.0);
    assert!(bar.counters().min_j <= j);
}

/// The first node is fixed, and the traction fails at the last one.
#[rstest]
#[case::law(Setup { law: Box::new(|_| f64::NAN), ..start() }, 1)]
#[case::body_force(Setup { body_force: Some(pointwise(|_, t| 1.0 / t)), ..start() }, 1)]
#[case::traction(Setup { traction: [None, Some(Box::new(|t| 1.0 / t))], ..start() }, 8)]
fn a_force_that_is_not_finite_names_its_node(
    #[case] setup: Setup,
    #[case] node: usize,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
) {
    let mut bar = Bar::new(Setup { mass, ..setup }).unwrap();
    let site = Site::Node(node);
    assert_eq!(bar.step(1e-3), Err(Failure::NonFinite { quantity: "force", site }));
}

#[test]
fn a_step_without_length_in_numbers_is_a_failure() {
    let initial_velocity = Box::new(|x| x);
    let mut bar = Bar::new(Setup { initial_velocity, ..start() }).unwrap();
    let (quantity, site) = ("deformation gradient", Site::Element(0));
    assert_eq!(bar.step(f64::NAN), Err(Failure::NonFinite { quantity, site }));
}

/// Nothing is left to move, and nothing breaks: both ends of the only element are fixed.
#[test]
fn a_bar_without_free_nodes_stands() {
    let mut bar = Bar::new(Setup {
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
