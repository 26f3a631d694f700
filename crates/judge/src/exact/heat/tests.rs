//! Tests with temperatures that solve the heat equation, and wrong ones that must be refused.

use super::check::{HeatMagnitudes, interior};
use super::{Conduction, HeatFace, HeatFacePoint, HeatForcing, Temperature, ThermalCondition};
use crate::exact::formula::Formula;
use crate::exact::random::Random;
use crate::exact::{Motion, Violation};
use rstest::rstest;
use std::sync::Arc;

const NAMES: [&str; 4] = ["X", "Y", "Z", "t"];

fn bind(source: &str, dimension: usize) -> Formula {
    bind_to(&["t"], source, dimension)
}

fn bind_to(further: &[&str], source: &str, dimension: usize) -> Formula {
    let names: Vec<&str> = NAMES[..dimension].iter().chain(further).copied().collect();
    crate::exact::tests::bind(source, &names)
}

#[derive(Debug)]
enum Ends {
    Insulated,
    Temperature(Formula),
    Flux(Formula),
    Convection { coefficient: f64, ambient: Formula },
    Periodic,
}

impl ThermalCondition for Ends {
    fn check(&self, point: &dyn HeatFacePoint) -> Result<(), Violation> {
        match self {
            Self::Insulated => point.lets_in("is insulated", 0.0, 0.0),
            Self::Temperature(value) => point.has_temperature(point.value(value)),
            Self::Flux(value) => {
                point.lets_in("has a given flux", point.value(value), point.value(value).abs())
            }
            Self::Convection { coefficient, ambient } => {
                let given = coefficient * (point.value(ambient) - point.temperature());
                point.lets_in("is cooled", given, coefficient * point.largest_temperature())
            }
            Self::Periodic => point.continues_on_opposite_face(),
        }
    }
}

/// Creates a box from 0 to 1 with rho0 c = 6 and k = 3, insulated on all faces.
fn insulated(dimension: usize, temperature: &str) -> Conduction {
    let face = |i: usize| HeatFace {
        name: ["left", "right", "bottom", "top", "back", "front"][i],
        axis: i / 2,
        high: i % 2 == 1,
        condition: Arc::new(Ends::Insulated),
    };
    Conduction {
        from: vec![0.0; dimension],
        to: vec![1.0; dimension],
        density: 2.0,
        conductivity: 3.0,
        capacity: 3.0,
        source: None,
        initial: None,
        faces: (0..2 * dimension).map(face).collect(),
        temperature: Temperature::new(bind(temperature, dimension), dimension),
        motion: None,
        manufactured: false,
        until: 0.3,
        tolerance: 1e-8,
    }
}

fn bar(temperature: &str, ends: [Ends; 2]) -> Conduction {
    let mut bar = insulated(1, temperature);
    for (face, condition) in bar.faces.iter_mut().zip(ends) {
        face.condition = Arc::new(condition);
    }
    bar
}

fn refused(problem: &Conduction, words: &str) -> Violation {
    let found = problem.check().unwrap_err();
    assert!(found.condition.contains(words), "{found}");
    found
}

/// The diffusivity is kappa = k/(rho0 c) = 1/2.
#[rstest]
#[case(1, "5 + cos(pi*X)*exp(-pi^2*t/2)")]
#[case(2, "5 + cos(pi*X)*cos(2*pi*Y)*exp(-5*pi^2*t/2)")]
#[case(3, "5 + cos(pi*X)*cos(pi*Y)*cos(pi*Z)*exp(-3*pi^2*t/2)")]
fn a_decaying_mode_passes(#[case] dimension: usize, #[case] temperature: &str) {
    insulated(dimension, temperature).check().unwrap();
}

#[test]
fn a_stated_source_is_part_of_the_equation() {
    let made = insulated(1, "cos(pi*X)*(1 + t)");
    let source = |text: &str| Some(bind(text, 1));
    let sound = "3*cos(pi*X) + 3*pi^2*cos(pi*X)*(1 + t)/2";
    Conduction { source: source(sound), ..made.clone() }.check().unwrap();
    let wrong = "3*cos(pi*X) - 3*pi^2*cos(pi*X)*(1 + t)/2";
    let found = refused(&Conduction { source: source(wrong), ..made.clone() }, "heat equation");
    assert_eq!(found.unit, "W/kg");
    Conduction { manufactured: true, ..made }.check().unwrap();
}

/// The source term `-4 rho0 c (T - 5)` adds 4/s to the decay rate of a mode.
#[rstest]
fn source_may_depend_on_the_exact_temperature(#[values(1, 2, 3)] dimension: usize) {
    let fin = |source: &str| Conduction {
        source: Some(bind_to(&["t", "T"], source, dimension)),
        ..insulated(dimension, "5 + cos(pi*X)*exp(-(pi^2/2 + 4)*t)")
    };
    fin("-12*(T - 5)").check().unwrap();
    refused(&fin("-12*T"), "heat equation");
    refused(&fin("-12*(t - 5)"), "heat equation");
}

#[rstest]
fn heat_flows_through_a_periodic_face(#[values("1e-6", "1", "1e6")] size: &str) {
    let ring = |shape: &str| Conduction {
        manufactured: true,
        ..bar(&format!("{size}*(5 + {shape}*exp(-t))"), [Ends::Periodic, Ends::Periodic])
    };
    ring("sin(2*pi*X)").check().unwrap();
    refused(&ring("sin(pi*X)"), "left is periodic, but the heat flux");
    refused(&ring("cos(pi*X)"), "left is periodic, but the temperature");
}

#[rstest]
fn a_warm_body_hides_no_kink(#[values("0", "1e6")] warm: &str) {
    let kink = format!("{warm} + abs(X - 0.4)");
    let problem = insulated(1, &kink);
    let largest = HeatMagnitudes::from_points(&problem, &interior(&problem));
    let found = super::check::balance(&problem, &largest).unwrap_err();
    assert!(found.condition.contains("heat balance"), "{found}");
}

/// The equation holds on both sides of the kink, but the kink itself releases heat.
#[test]
fn weak_form_detects_a_kink() {
    let hold = |value: &str| Ends::Temperature(bind(value, 1));
    refused(&bar("abs(X - 0.4)", [hold("0.4"), hold("0.6")]), "heat balance");
}

#[rstest]
#[case::temperature(Ends::Temperature(bind("7", 1)), "right has a given temperature")]
#[case::insulated(Ends::Insulated, "right is insulated")]
#[case::flux(Ends::Flux(bind("-6", 1)), "right has a given flux")]
#[case::convection(
    Ends::Convection { coefficient: 2.0, ambient: bind("4", 1) },
    "right is cooled"
)]
fn a_wrong_condition_on_a_face_is_refused(#[case] wrong: Ends, #[case] words: &str) {
    // T = 4 + 2 X: 6 W enter at the right and leave at the left.
    let left = || Ends::Flux(bind("-6", 1));
    refused(&bar("4 + 2*X", [left(), wrong]), words);
    for right in [
        Ends::Temperature(bind("6", 1)),
        Ends::Flux(bind("6", 1)),
        Ends::Convection { coefficient: 2.0, ambient: bind("9", 1) },
    ] {
        bar("4 + 2*X", [left(), right]).check().unwrap();
    }
}

#[test]
fn the_start_is_held_to_what_is_stated() {
    let mode = insulated(1, "cos(pi*X)*exp(-pi^2*t/2)");
    let from = |text: &str| Some(bind(text, 1));
    Conduction { initial: from("cos(pi*X)"), ..mode.clone() }.check().unwrap();
    refused(&Conduction { initial: from("1.001*cos(pi*X)"), ..mode }, "initial condition");
}

#[rstest]
#[case("0*X", "zero everywhere")]
#[case("ln(-1 - X)", "finite")]
fn temperature_without_values_is_refused(#[case] temperature: &str, #[case] words: &str) {
    refused(&insulated(1, temperature), words);
}

/// In a plane under simple shear g, `J C^-1 = [[1 + g^2, -g], [-g, 1]]`.
#[test]
fn shear_turns_the_flow() {
    let sheared = Conduction {
        motion: Some(Motion::new(vec![bind("t*Y", 2), bind("0*Y", 2)])),
        source: Some(bind("-3*(1 + t^2)", 2)),
        faces: Vec::new(),
        ..insulated(2, "X^2")
    };
    sheared.check().unwrap();
    refused(&Conduction { motion: None, ..sheared }, "heat equation");
}

/// The source computed during a run is bit-identical to a single evaluation.
#[rstest]
fn source_of_a_run_is_bit_identical_to_single_evaluations(
    #[values(1, 2, 3)] dimension: usize,
    #[values(false, true)] moves: bool,
) {
    let components = (0..dimension).map(|_| bind("sin(X)*t/5", dimension)).collect();
    let problem = Conduction {
        manufactured: true,
        motion: moves.then(|| Motion::new(components)),
        ..insulated(dimension, "cos(X)*exp(-t) + sin(X*t)")
    };
    let mut random = Random::new(1);
    let labels: Vec<Vec<f64>> = (0..5).map(|_| random.point(&problem.from, &problem.to)).collect();
    let mut forcing = HeatForcing::new(&problem, labels.iter().map(Vec::as_slice));
    let mut found = [0.0; 5];
    for t in [0.0, 0.1, 0.2] {
        forcing.at(t, &mut found);
        for (label, found) in labels.iter().zip(found) {
            assert_eq!(found, problem.manufactured_source(label, t), "{label:?}, {t}");
        }
    }
}
