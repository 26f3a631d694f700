//! Messages of the protocol for a body that starts deformed and rotated, under every load and
//! condition, and for two bodies. States and results of a solver.

use super::answer::{Answer, ColumnText, Hello, Points, State, StatedCapabilities};
use super::error::ProgramError;
use super::frame::{MessageFrame, Outgoing, read_one};
use super::inquiry::Inquiry;
use super::results::{ResultLevel, read_level};
use super::solver::{PROTOCOL, problem_message};
use super::subject::ProgramSubject;
use crate::external::capabilities::{Capabilities, ProblemNeeds, SMALL_STRAIN};
use crate::external::{
    BodyForceField, FieldName, FieldPlaces, HandedNumber, LevelProblem, protocol_schema,
};
use crate::study::{level_problem, needs_of_suite};
use crate::subject::{Failure, GradientParameter, Precision, Samples, Subject};
use crate::suite::model::Suite;
use crate::suite::yaml::Source;
use rstest::rstest;
use serde_json::{Value, json};
use std::sync::atomic::AtomicUsize;
use std::sync::{Arc, Mutex};

/// F = (1.2, -0.3; 0.4 + 0.1 (Y - 2), 1.05 + 0.1 (X + 0.5))
const LOADED: &str = r#"suite: loaded
title: A rotated body with many loads
source: a test
parameters: {p: 3, g: 9.5, mu: 0.25, f: 7}
scene:
  dimension: 2
  body: {box: {from: [-0.5, 2], to: [0.5, 2.5]}}
  material: {neo_hookean: {young: 100, poisson: 0.3, density: 2}}
  sets:
    part: {box: {from: [0, 2], to: [0.5, 2.25]}}
    tail: {box: {from: [-0.5, 2.25], to: [-0.25, 2.5]}}
  boundary: {left: {velocity: ["Y*t", "g*t"]}, bottom: {friction: mu}}
  initial_displacement: ["0.15 + 0.2*(X + 0.5) - 0.3*(Y - 2)", "(0.4 + 0.1*(Y - 2))*(X + 0.5) + 0.05*(Y - 2)"]
  initial_velocity: ["X*Y", "2*Y"]
  initial_stress: {xx: "4*X", xy: "Y", yy: "-X*Y"}
  loads:
    - gravity: ["0", "-g*t"]
    - body_force: ["p*X*t + ux", "1 - 2*uy"]
    - damping: "2*g"
    - local_damping: 0.2
    - artificial_viscosity: {linear: 1, quadratic: 2}
    - traction: {on: right, value: ["p*Y", "2*p"]}
    - pressure: {on: top, value: "p*t"}
    - force: {on: part, value: [f, "f*t"]}
    - velocity: {on: tail, value: [mu, "2*mu"]}
run: {until: 0.012, dt: 0.002, instants: 3}
refine: {cells: 4, ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: usl}
expect:
  - drift: {mass: 1e-13}
    because: masses are constant
"#;

fn two() -> LevelProblem {
    problem(&two_bodies())
}

/// Returns a suite of two bodies in contact, with the run of [`LOADED`].
fn two_bodies() -> String {
    const SCENE: &str = r#"  bodies:
    - body: {box: {from: [0, 0], to: [1, 0.5]}}
      material: {hencky: {young: 100, poisson: 0.2, density: 3}}
      initial_velocity: [1, "X"]
      initial_stress: {yy: -5}
    - body: {box: {from: [0, 0.5], to: [0.5, 1]}}
      material: {linear_elastic: {young: 70, poisson: 0.1, density: 5}}
      initial_displacement: ["0.1*(Y - 0.5)", 0]
  contact: {friction: 0.3}
  boundary: {bottom: fixed}
  loads:
    - gravity: [0.5, -2]
"#;
    let (head, _) = LOADED.split_once("parameters:").expect("parameters");
    let (_, run) = LOADED.split_once("run:").expect("a run");
    format!("{head}scene:\n  dimension: 2\n{SCENE}run:{run}")
}

fn load(text: &str) -> Suite {
    let source = Source::from_text("suite.yaml", text).expect("a text");
    Suite::load(&source).unwrap_or_else(|error| panic!("{error}"))
}

fn problem(text: &str) -> LevelProblem {
    let suite = load(text);
    let plan = suite.convergence().expect("a study of an order");
    let level = plan.refine.levels[0];
    level_problem(&suite.name, plan, &plan.cases[0], level).expect("a problem")
}

/// Reads a message of either side.
fn parse(message: Outgoing) -> (Value, Vec<u8>) {
    let bytes = message.into_bytes();
    let longest = AtomicUsize::new(bytes.len());
    let frame = read_one(&mut bytes.as_slice(), &longest).expect("a message").expect("a message");
    (serde_json::from_slice(&frame.line).expect("JSON"), frame.bytes)
}

fn numbers(column: &Value, bytes: &[u8]) -> Vec<f64> {
    let column: ColumnText = serde_json::from_value(column.clone()).expect("a column");
    let count = column.count();
    column.numbers("values", count, bytes).expect("numbers")
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?}");
    for (value, expected) in found.iter().zip(expected) {
        let error = (value - expected).abs();
        assert!(error <= 1e-12 * expected.abs().max(1.0), "{what}: {found:?}, not {expected}");
    }
}

/// The message of [`LOADED`] without its particles and without the texts for reports.
const MESSAGE: &str = r#"{
"type": "problem", "suite": "loaded", "dimension": 2, "plane": "strain", "contact": null,
"grid": {"origin": [-0.5, 2.0], "h": 0.25, "cells": [7, 5], "periodic": [false, false]},
"faces": [
    {"name": "left", "axis": 0, "high": false, "at": -0.5, "condition": "velocity",
     "values": {}, "asked": {"velocity": ["reference_position", "t"]}},
    {"name": "right", "axis": 0, "high": true, "at": 0.5, "condition": "free",
     "values": {}, "asked": {}},
    {"name": "bottom", "axis": 1, "high": false, "at": 2.0, "condition": "friction",
     "values": {"coefficient": 0.25}, "asked": {}},
    {"name": "top", "axis": 1, "high": true, "at": 2.5, "condition": "free",
     "values": {}, "asked": {}}],
"materials": [
    {"law": "neo_hookean", "parameters": {"young": 100.0, "poisson": 0.3}, "density": 2.0}],
"bodies": [{"shape": "box", "from": [-0.5, 2.0], "to": [0.5, 2.5]}],
"loads": [
    {"load": "gravity", "values": {}, "asked": {"acceleration": ["t"]}},
    {"load": "body_force", "values": {},
     "asked": {"acceleration": ["reference_position", "t", "displacement"]}},
    {"load": "damping", "values": {"rate": 19.0}, "asked": {}},
    {"load": "local_damping", "values": {"share": 0.2}, "asked": {}},
    {"load": "artificial_viscosity", "asked": {},
     "values": {"linear": 1.0, "quadratic": 2.0, "wave_speed": SPEED}},
    {"load": "traction", "face": "right", "values": {},
     "asked": {"traction": ["reference_position"]}},
    {"load": "pressure", "face": "top", "values": {}, "asked": {"pressure": ["t"]}},
    {"load": "force", "values": {"volume": 0.125}, "asked": {"force": ["t"]},
     "region": {"name": "part", "from": [0.0, 2.0], "to": [0.5, 2.25]}},
    {"load": "velocity", "values": {"velocity": [0.25, 0.5]}, "asked": {},
     "region": {"name": "tail", "from": [-0.5, 2.25], "to": [-0.25, 2.5]}}],
"body_force": "asked", "particles_per_cell": 4,
"steps": 6, "dt": 0.002, "until": 0.012, "instants": [2, 4, 6]}"#;

#[rstest]
fn message_has_the_whole_problem(#[values(false, true)] binary: bool) {
    let problem = problem(LOADED);
    let (mut message, bytes) = parse(problem_message(&problem, binary));
    for (name, column) in problem.particles.columns() {
        let sent = &message["particles"][name];
        assert_eq!(sent.is_object(), binary);
        assert_eq!(numbers(sent, &bytes), column, "{name}");
    }
    assert_eq!(message["bytes"].as_u64().unwrap_or(0) as usize, bytes.len());
    let message = message.as_object_mut().expect("an object");
    message.retain(|key, _| key != "particles" && key != "bytes");
    for load in message["loads"].as_array_mut().expect("loads") {
        load.as_object_mut().expect("an object").remove("rows");
    }
    // sqrt of the modulus 100 (1 - nu)/((1 + nu) (1 - 2 nu)) over the density
    let speed = (70.0 / 0.52 / 2.0_f64).sqrt();
    let expected = MESSAGE.replace("SPEED", &speed.to_string());
    let expected: Value = serde_json::from_str(&expected).expect("JSON");
    assert_eq!(Value::Object(message.clone()), expected);
}

#[test]
fn constant_body_force_is_a_value_and_a_missing_one_is_none() {
    let (before, rest) = LOADED.split_once("    - gravity").expect("gravity");
    let (_, after) = rest.split_once("    - damping").expect("damping");
    let schema: Value = serde_json::from_str(&protocol_schema()).expect("JSON");
    let kinds = &schema["$defs"]["request"]["oneOf"][1]["allOf"][1]["properties"]["body_force"];
    let kinds = kinds["enum"].as_array().expect("a list");
    for (loads, kind, constant, values) in [
        ("- gravity: [3.5, -2]", "constant", json!([3.5, -2.0]), [3.5, -2.0]),
        ("- gravity: [0.5, \"t\"]", "asked", Value::Null, [0.5, 1.5]),
        ("", "none", Value::Null, [0.0, 0.0]),
    ] {
        let problem = problem(&format!("{before}    {loads}\n    - damping{after}"));
        let (message, _) = parse(problem_message(&problem, false));
        let stated = (&message["body_force"], &message["body_force_value"]);
        assert_eq!(stated, (&json!(kind), &constant));
        assert!(kinds.contains(&json!(kind)), "the schema has {kinds:?}");
        let found = answer(&problem, 1, &json!({"type": "body_force", "t": 1.5})).expect("values");
        assert_eq!(found.1, values.repeat(32));
    }
}

#[test]
fn each_body_has_its_own_columns_and_material() {
    let problem = two();
    let (message, _) = parse(problem_message(&problem, false));
    assert_eq!(message["contact"], json!({"law": "coulomb", "coefficient": 0.3}));
    let shape = |from: [f64; 2], to: [f64; 2]| json!({"shape": "box", "from": from, "to": to});
    let shapes = json!([shape([0.0, 0.0], [1.0, 0.5]), shape([0.0, 0.5], [0.5, 1.0])]);
    assert_eq!(message["bodies"], shapes);
    let material = |law: &str, young: f64, poisson: f64, density: f64| {
        let parameters = json!({"young": young, "poisson": poisson});
        json!({"law": law, "parameters": parameters, "density": density})
    };
    let materials =
        json!([material("hencky", 100.0, 0.2, 3.0), material("linear_elastic", 70.0, 0.1, 5.0)]);
    assert_eq!(message["materials"], materials);
    let particles = &problem.particles;
    assert_eq!(particles.len(), 48);
    for (p, label) in particles.reference_position.chunks_exact(2).enumerate() {
        let is_upper = label[1] > 0.5;
        assert_eq!(particles.body[p], f64::from(u8::from(is_upper)));
        assert_eq!(particles.mass[p], if is_upper { 5.0 / 64.0 } else { 3.0 / 64.0 });
        let u = particles.position[2 * p] - label[0];
        let v = &particles.velocity[2 * p..2 * p + 2];
        let f = &particles.deformation_gradient[4 * p..4 * p + 4];
        if is_upper {
            assert_near(&[u], &[0.1 * (label[1] - 0.5)], "displacement");
            assert_eq!((v, f), (&[0.0, 0.0][..], &[1.0, 0.1, 0.0, 1.0][..]));
        } else {
            assert_eq!((u, v, f), (0.0, &[1.0, label[0]][..], &[1.0, 0.0, 0.0, 1.0][..]));
        }
        let s0 = if is_upper { 0.0 } else { -5.0 };
        assert_eq!(particles.initial_stress[4 * p..4 * p + 4], [0.0, 0.0, 0.0, s0]);
    }
}

#[test]
fn capability_that_one_body_of_two_needs_is_required() {
    let needs = needs_of_suite(&load(&two_bodies())).expect("a study of solvers");
    assert_eq!(needs.laws, ["hencky", "linear_elastic"]);
    // The lower body is stressed, and the upper one starts deformed.
    assert!(needs.initial_stress && needs.initial_deformation);
}

/// Returns the answer to a request and its values, which version 2 sends as bytes.
fn answer(
    problem: &LevelProblem,
    version: u64,
    request: &Value,
) -> Result<(Value, Vec<f64>), String> {
    let mut inquiry = Inquiry::new(problem, version, version > 1);
    inquiry.allow(1);
    let line = request.to_string().into_bytes();
    let answer = Answer::read(&MessageFrame { line, bytes: Vec::new() });
    let request = answer.map_err(|error| error.to_string())?.request().expect("a request");
    let answer = inquiry.answer(request, &[]).map_err(|error| error.to_string())?;
    let (answer, bytes) = parse(answer);
    assert_eq!(answer["values"].is_object(), version > 1);
    let values = numbers(&answer["values"], &bytes);
    Ok((answer, values))
}

/// Returns a request at places (m), for which `t` is null if it needs no time.
fn at(of: &str, t: impl Into<Value>, places: &[f64]) -> Value {
    let t: Value = t.into();
    let mut request = json!({"type": "values", "of": of, "t": t});
    if !places.is_empty() {
        request["reference_position"] = json!(places);
    }
    request
}

#[test]
fn requests_have_the_values_of_the_suite() {
    let problem = problem(LOADED);
    let place = [0.25, 2.1];
    let (x, y) = (place[0] + 0.5, place[1] - 2.0);
    let f = [1.2, -0.3, 0.4 + 0.1 * y, 1.05 + 0.1 * x];
    let j: f64 = f[0] * f[3] - f[1] * f[2];
    let [a, b, c] = [1.0, 2.1, -0.25 * 2.1];
    let (mu, lambda) = (100.0 / 2.6, 30.0 / (1.3 * 0.4));
    // mu (F F^T - I) + lambda ln J I + F S0 F^T, divided by J
    let stress = |i: usize, k: usize| {
        let [p, q, r, s] = [f[2 * i], f[2 * i + 1], f[2 * k], f[2 * k + 1]];
        let unit = if i == k { 1.0 } else { 0.0 };
        let pushed = a * p * r + b * (p * s + q * r) + c * q * s;
        (mu * (p * r + q * s - unit) + lambda * j.ln() * unit + pushed) / j
    };
    let cauchy = vec![stress(0, 0), stress(0, 1), stress(1, 0), stress(1, 1)];
    let displaced = |of: &str| {
        let mut request = at(of, 2.0, &place);
        request["displacement"] = json!([0.125, 2.0]);
        request
    };
    let mut first_version = displaced("body_force");
    first_version["type"] = json!("body_force");
    let none = Value::Null;
    for (request, values) in [
        (at("face:left", 2.0, &[-0.5, 2.5, -0.5, 2.1]), vec![5.0, 19.0, 4.2, 19.0]),
        (at("load:0", 2.0, &[]), vec![0.0, -19.0]),
        (displaced("load:1"), vec![1.625, -3.0]),
        (displaced("body_force"), vec![1.625, -22.0]),
        (first_version.clone(), vec![1.625, -22.0]),
        (at("load:2", 2.0, &[]), vec![19.0]),
        (at("load:5", 2.0, &[0.5, 2.5]), vec![7.5, 6.0]),
        (at("load:6", 2.0, &[]), vec![6.0]),
        (at("load:6", 2.0, &[0.3, 2.5, 0.4, 2.5]), vec![6.0, 6.0]),
        (at("load:7", 2.0, &[]), vec![7.0, 14.0]),
        (at("load:8", 2.0, &[]), vec![0.25, 0.5]),
        (
            at("displacement", none.clone(), &place),
            vec![0.15 + 0.2 * x - 0.3 * y, (0.4 + 0.1 * y) * x + 0.05 * y],
        ),
        (at("velocity", 0.0, &place), vec![0.25 * 2.1, 4.2]),
        (at("deformation_gradient", none.clone(), &place), f.to_vec()),
        (at("initial_stress", none.clone(), &place), vec![a, b, b, c]),
        (at("initial_stress_across", none.clone(), &place), vec![0.0]),
        (at("stress", none.clone(), &place), cauchy),
        (at("velocity", none, &[]), problem.particles.velocity.clone()),
    ] {
        let (answer, found) = answer(&problem, PROTOCOL, &request).expect("values");
        assert_near(&found, &values, &request.to_string());
        let kind = &request["type"];
        let of = if kind == "values" { request["of"].clone() } else { Value::Null };
        assert_eq!((&answer["type"], &answer["of"]), (kind, &of));
    }
}

/// A law with a yield surface needs the normal stresses out of the plane.
#[test]
fn normal_stress_out_of_the_plane_is_known_for_a_law_that_yields() {
    let (before, rest) = LOADED.split_once("  initial_displacement").expect("a displacement");
    let (_, after) = rest.split_once("  loads").expect("loads");
    let soil = before
        .replace("neo_hookean: {", "drucker_prager: {friction: 0.3, dilation: 0, strength: 9, ");
    let stress = "  initial_stress: {xx: \"-X - 2\", yy: -2.5, xy: 0.5, zz: \"-Y\"}\n";
    let problem = problem(&format!("{soil}{stress}  loads{after}"));
    for (of, expected) in [
        ("initial_stress_across", vec![-2.1]),
        ("initial_stress", vec![-2.25, 0.5, 0.5, -2.5]),
        ("stress", vec![-2.25, 0.5, 0.5, -2.5]),
    ] {
        let found = answer(&problem, PROTOCOL, &at(of, Value::Null, &[0.25, 2.1])).expect("values");
        assert_near(&found.1, &expected, of);
    }
    let (first, across) =
        (&problem.particles.reference_position, &problem.particles.initial_stress_across);
    assert_near(across, &first.chunks_exact(2).map(|x| -x[1]).collect::<Vec<_>>(), "across");
}

/// Positions on a common boundary need a body, and version 1 permits positions outside the bodies.
#[test]
fn positions_belong_to_bodies() {
    let problem = two();
    let velocity = |places: &[f64], body: Option<usize>, version| {
        let mut request = at("velocity", Value::Null, places);
        if let Some(body) = body {
            request["body"] = json!(body);
        }
        answer(&problem, version, &request).map(|(_, values)| values)
    };
    assert_eq!(velocity(&[0.25, 0.75, 0.75, 0.25], None, 2), Ok(vec![0.0, 0.0, 1.0, 0.75]));
    assert_eq!(velocity(&[0.25, 0.5], Some(0), 2), Ok(vec![1.0, 0.25]));
    assert_eq!(velocity(&[0.25, 0.5], Some(1), 2), Ok(vec![0.0, 0.0]));
    assert_eq!(velocity(&[0.75, 0.75, 0.25, 0.75], None, 1), Ok(vec![1.0, 0.75, 0.0, 0.0]));
    for (places, body, reason) in [
        ([0.25, 0.5], None, "place 0, (0.25, 0.5) m, belongs to the bodies 0 and 1"),
        ([0.75, 0.75], None, "place 0, (0.75, 0.75) m, is outside the body"),
        ([0.25, 0.75], Some(0), "place 0, (0.25, 0.75) m, is outside body 0"),
        ([0.25, 0.75], Some(2), "there is no body 2; the problem has 2"),
    ] {
        let error = velocity(&places, body, 2).expect_err("an error");
        assert!(error.contains(reason), "{error}");
    }
}

#[rstest]
#[case::unknown(json!({"of": "velocty"}), "unknown field; did you mean `velocity`?")]
#[case::unknown_load(json!({"of": "load:9", "t": 0}), "`load:9`: unknown field")]
#[case::no_time(json!({"of": "body_force"}), "the request has no time `t`")]
#[case::a_later_time(
    json!({"of": "stress", "t": 0.5}), "the field is defined at t = 0 only, not at t = 0.5"
)]
#[case::too_few(
    json!({"of": "velocity", "reference_position": [0.1]}),
    "sent 1 numbers in the column `reference_position`, expected 2"
)]
#[case::outside(
    json!({"of": "velocity", "reference_position": [0.1, 2.1, 1.5, 2.2]}),
    "place 1, (1.5, 2.2) m, is outside the body"
)]
#[case::just_outside(
    json!({"of": "velocity", "reference_position": [0.50001, 2.2]}), "place 0, (0.50001, 2.2) m"
)]
#[case::no_body(
    json!({"of": "velocity", "reference_position": [0.1, 2.2], "body": 3}), "there is no body 3"
)]
#[case::beside_the_face(
    json!({"of": "face:left", "t": 0, "reference_position": [0.1, 2.2]}),
    "is not on the face `left`, whose coordinate is -0.5 m"
)]
#[case::beside_the_loaded_face(
    json!({"of": "load:5", "t": 0, "reference_position": [-0.5, 2.2]}),
    "is not on the face `right`, whose coordinate is 0.5 m"
)]
#[case::everywhere_on_a_face(
    json!({"of": "face:left", "t": 0}), "the request has no `reference_position`"
)]
#[case::no_value(json!({"of": "face:right", "t": 0}), "`free` does not depend on the position")]
#[case::no_displacement(
    json!({"of": "body_force", "t": 0}), "depends on the displacement, but the request has no"
)]
#[case::displacement(
    json!({"of": "body_force", "t": 0, "displacement": [0.1, 0.1]}),
    "sent 2 numbers as `displacement`, expected 64"
)]
fn wrong_request_is_refused(#[case] request: Value, #[case] reason: &str) {
    let mut request = request;
    request["type"] = json!("values");
    let error = answer(&problem(LOADED), PROTOCOL, &request).expect_err("an error");
    assert!(error.contains(reason), "no `{reason}` in\n{error}");
}

/// Numbers of the steps after which a state was requested.
type StepNumbers = Arc<Mutex<Vec<u64>>>;

/// Creates a level that answers each request for a state with `state`, and records the numbers of
/// steps of the requests.
fn new_level(
    problem: &LevelProblem,
    points: Option<Points>,
    state: Value,
) -> Result<(ProgramSubject, StepNumbers), ProgramError> {
    let requested = Arc::new(Mutex::new(Vec::new()));
    let log = Arc::clone(&requested);
    let states = Box::new(move |steps, _: &mut Inquiry| {
        log.lock().expect("a list").push(steps);
        let line = state.to_string().into_bytes();
        match Answer::read(&MessageFrame { line, bytes: Vec::new() })? {
            Answer::State(state) => Ok((*state, Vec::new())),
            other => Err(ProgramError::unexpected("advance", other.name())),
        }
    });
    let known = Capabilities { columns: vec!["stress".to_owned()], ..Capabilities::default() };
    let hello = Hello {
        protocol: PROTOCOL,
        name: "mine".to_owned(),
        version: String::new(),
        formal_order: 2.0,
        precision: Precision::Double,
        capabilities: StatedCapabilities { known, keys: Vec::new() },
    };
    let inquiry = Inquiry::new(problem, PROTOCOL, false);
    let subject = ProgramSubject::new(states, inquiry, problem, points, &[], &hello);
    Ok((subject?, requested))
}

fn samples_of(subject: &dyn Subject) -> Samples {
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    samples
}

/// Returns `count` different numbers.
fn column(first: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| first + 0.25 * k as f64).collect()
}

#[test]
fn level_has_the_initial_state_and_then_the_columns_of_the_solver() {
    let problem = problem(LOADED);
    let (n, particles) = (problem.particles.len(), &problem.particles);
    let state = json!({
        "type": "state", "crossings": 3, "left_domain": 5, "min_j": 0.75,
        "columns": {
            "displacement": column(100.0, 2 * n), "velocity": column(200.0, 2 * n),
            "stress": column(300.0, 4 * n), "stress_across": column(400.0, n),
            "deformation_gradient": column(500.0, 4 * n), "temperature": column(600.0, n),
        },
    });
    let (mut subject, requested) = new_level(&problem, None, state).expect("a level");
    let displaced = particles.position.iter().zip(&particles.reference_position);
    let start = Samples {
        dimension: 2,
        label: particles.reference_position.clone(),
        displacement: displaced.map(|(x, label)| x - label).collect(),
        velocity: particles.velocity.clone(),
        weight: particles.reference_volume.clone(),
        mass: particles.mass.clone(),
        stress: particles.stress.clone(),
        ..Samples::default()
    };
    let debug = |samples: &Samples| format!("{samples:?}");
    assert_eq!(debug(&samples_of(&subject)), debug(&start));
    let wrong = subject.step(0.001).expect_err("another step").to_string();
    assert!(wrong.contains("steps of 0.002 s, not of 0.001 s"), "{wrong}");
    subject.step(0.002).expect("a step");
    assert_eq!(debug(&samples_of(&subject)), debug(&start));
    (2..=6).for_each(|_| subject.step(0.002).expect("a step"));
    assert_eq!(*requested.lock().expect("a list"), [2, 4, 6]);
    let end = Samples {
        displacement: column(100.0, 2 * n),
        velocity: column(200.0, 2 * n),
        stress: column(300.0, 4 * n),
        stress_across: column(400.0, n),
        deformation_gradient: column(500.0, 4 * n),
        temperature: column(600.0, n),
        ..start
    };
    assert_eq!(debug(&samples_of(&subject)), debug(&end));
    let counters = subject.counters();
    let counts = (counters.particles, counters.crossings, counters.left_domain, counters.min_j);
    assert_eq!(counts, (Some(n as u64), Some(3), Some(5), 0.75));
    let totals = subject.totals().expect("totals");
    assert_near(&[totals.mass], &[1.0], "2 kg/m2 on 0.5 m2");
}

/// The mass of a point is its weight times the density. The first state of the points is the
/// initial state of the body.
#[test]
fn points_of_a_solver_have_masses_and_the_initial_state() {
    let problem = problem(LOADED);
    let points = Points {
        reference_position: ColumnText::Numbers(vec![0.25, 2.1, -0.5, 2.5]),
        weight: ColumnText::Numbers(vec![0.5, 0.75]),
    };
    let state = json!({
        "type": "state",
        "columns": {"displacement": [1, 2, 3, 4], "velocity": [5, 6, 7, -8]},
    });
    let (mut subject, _) = new_level(&problem, Some(points), state).expect("a level");
    let start = samples_of(&subject);
    assert_eq!((start.weight, start.mass), (vec![0.5, 0.75], vec![1.0, 1.5]));
    assert_near(&start.displacement, &[0.27, 0.3125, 0.0, 0.025], "displacement");
    assert_near(&start.velocity, &[0.525, 4.2, -1.25, 5.0], "velocity");
    assert_eq!(start.stress.len(), 8);
    (1..=2).for_each(|_| subject.step(0.002).expect("a step"));
    let totals = subject.totals().expect("totals");
    assert_eq!(totals.momentum, [1.0 * 5.0 + 1.5 * 7.0, 1.0 * 6.0 - 1.5 * 8.0, 0.0]);
    assert_eq!((subject.counters().particles, subject.counters().crossings), (None, None));
    assert!(subject.counters().min_j.is_nan() && samples_of(&subject).stress.is_empty());
}

#[rstest]
#[case::no_displacement(json!({"columns": {"velocity": [0]}}), "sent no column `displacement`")]
#[case::no_velocity(
    json!({"columns": {"displacement": vec![0; 64]}}), "sent no column `velocity`"
)]
#[case::short(
    json!({"columns": {"displacement": [0]}}), "sent 1 numbers in the column `displacement`, expected 64"
)]
#[case::inverted(
    json!({"columns": {"displacement": vec![0; 64], "velocity": vec![0; 64]}, "min_j": 0.0}),
    "sent 0 as `min_j`, which must be positive"
)]
fn wrong_state_is_a_failure(#[case] state: Value, #[case] reason: &str) {
    let mut state = state;
    state["type"] = json!("state");
    let (mut subject, _) = new_level(&problem(LOADED), None, state).expect("a level");
    subject.step(0.002).expect("a step without a state");
    let Err(Failure::External(found)) = subject.step(0.002) else { panic!("no failure") };
    assert!(found.contains(reason), "{found}");
}

#[rstest]
#[case::outside(vec![2.0, 2.2], vec![1.0], "sent invalid points: place 0, (2, 2.2) m, is outside")]
#[case::too_few(vec![0.5], vec![1.0], "sent 1 numbers in the column `reference_position`")]
#[case::none(vec![], vec![], "sent an empty list of points")]
fn wrong_points_are_refused(
    #[case] places: Vec<f64>,
    #[case] weight: Vec<f64>,
    #[case] reason: &str,
) {
    let [reference_position, weight] = [places, weight].map(ColumnText::Numbers);
    let points = Points { reference_position, weight };
    let error = new_level(&problem(LOADED), Some(points), json!({})).err().expect("an error");
    assert!(error.to_string().contains(reason), "{error}");
}

/// Rows and columns of a table may have any order.
#[test]
fn table_of_results_has_the_states_of_the_particles() {
    let problem = problem(LOADED);
    let n = problem.particles.len();
    let names = "stress_yx u_y F_xy Y v_x stress_zz t F_yx stress_xx v_y X F_xx u_x stress_yy F_yy \
                 stress_xy";
    let names: Vec<&str> = names.split(' ').collect();
    let value = |name: &str, instant: usize, p: usize| {
        let label = &problem.particles.reference_position[2 * p..];
        match name {
            "X" => label[0],
            "Y" => label[1],
            "t" => [0.004, 0.008, 0.012][instant],
            _ => {
                let known = names.iter().position(|known| *known == name).expect("a name");
                (1000 * known + 100 * instant + p) as f64
            }
        }
    };
    let mut rows: Vec<String> = (0..3 * n)
        .map(|row| {
            let cell = |name: &&str| value(name, row / n, row % n).to_string();
            names.iter().map(cell).collect::<Vec<_>>().join(",")
        })
        .collect();
    rows.reverse();
    rows.swap(3, 3 * n - 5);
    let text = format!("{}\n{}\n", names.join(","), rows.join("\n"));
    let level = ResultLevel { name: "4".to_owned(), problem: problem.clone() };
    let found = read_level("4.csv", &text, &level, std::slice::from_ref(&level));
    let states: Vec<State> = found.expect("results").states;
    assert_eq!(states.len(), 3);
    for (instant, state) in states.into_iter().enumerate() {
        let mut columns = state.columns;
        for (name, components) in [
            ("displacement", &["u_x", "u_y"][..]),
            ("velocity", &["v_x", "v_y"]),
            ("stress", &["stress_xx", "stress_xy", "stress_yx", "stress_yy"]),
            ("stress_across", &["stress_zz"]),
            ("deformation_gradient", &["F_xx", "F_xy", "F_yx", "F_yy"]),
        ] {
            let column = columns.remove(name).expect("a column");
            let values = column.numbers(name, n * components.len(), &[]).expect("numbers");
            let of_particle = |p: usize| components.iter().map(move |one| value(one, instant, p));
            assert!(values.into_iter().eq((0..n).flat_map(of_particle)), "{name} {instant}");
        }
    }
    let needs = ProblemNeeds {
        velocity: true,
        columns: vec!["deformation_gradient", "stress_across"],
        ..ProblemNeeds::default()
    };
    let required =
        ["t", "X", "Y", "u_x", "u_y", "v_x", "v_y", "F_xx", "F_xy", "F_yx", "F_yy", "stress_zz"];
    assert_eq!(level.required_columns(&needs), required);
}

/// The times differ by much less than 0.01 s.
#[test]
fn points_of_a_table_are_those_of_the_first_time() {
    let rows = |t: f64| format!("{t},.25,2.1,.5,{t},0\n{t},-.5,2.5,.75,{t},1\n");
    let text = "t,X,Y,weight,u_x,u_y\n".to_owned() + &[0.004, 0.008, 0.012].map(rows).concat();
    let level = ResultLevel { name: "4".to_owned(), problem: problem(LOADED) };
    let found = read_level("4.csv", &text, &level, &[]).expect("results");
    let displacement = |state: &State| state.columns["displacement"].count();
    assert_eq!(found.states.iter().map(displacement).collect::<Vec<_>>(), [4; 3]);
}

struct NumberedForce;

impl BodyForceField for NumberedForce {
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3] {
        [body as f64, label[0], t]
    }
}

#[test]
fn force_at_places_is_that_of_each_body() {
    let force: Arc<dyn BodyForceField> = Arc::new(NumberedForce);
    let mut values = [[f64::NAN; 3]; 2];
    force.at_places(&[2, 1], &[&[5.0], &[6.0]])(0.5, &mut values);
    assert_eq!(values, [[2.0, 5.0, 0.5], [1.0, 6.0, 0.5]]);
}

/// `sigma = lambda tr(eps) I + 2 mu eps` with E = 70, nu = 0.25: 2 mu = 56 and lambda = 28.
#[test]
fn small_strain_replaces_the_law_and_the_stress_of_the_linear_elastic_body() {
    let mut problem = two();
    problem.materials[1].parameters[1].1 = 0.25;
    let before = problem.particles.stress.clone();
    for f in problem.particles.deformation_gradient[4 * 32..].chunks_exact_mut(4) {
        f.copy_from_slice(&[1.1, 0.3, -0.1, 0.8]);
    }
    problem.replace_by_small_strain();
    assert_eq!(problem.materials[0].law, "hencky");
    assert_eq!(problem.materials[1].law, SMALL_STRAIN);
    let stress = &problem.particles.stress;
    assert_eq!(stress[..4 * 32], before[..4 * 32]);
    for stress in stress[4 * 32..].chunks_exact(4) {
        assert_near(stress, &[5.6 - 2.8, 5.6, 5.6, -11.2 - 2.8], "stress");
    }
}

#[test]
fn parameter_changes_only_its_own_numbers() {
    use GradientParameter as Of;
    let problem = problem(LOADED);
    let parameters = [Of::Young, Of::Poisson, Of::Density, Of::Friction, Of::InitialVelocity];
    let values = |problem: &LevelProblem| parameters.map(|one| problem.parameter(one));
    let stated = [100.0, 0.3, 2.0, 0.25, 1.0].map(Some);
    assert_eq!(values(&problem), stated);
    assert_eq!(problem.parameter(Of::Yield), None);
    assert_eq!(two().parameter(Of::Young), None, "there are two materials");
    let place = [0.25, 2.1];
    for (k, parameter) in parameters.into_iter().enumerate() {
        let changed = problem.clone().with_parameter(parameter, 0.4);
        let mut expected = stated;
        // The problem of a changed velocity has the factor 1 again.
        expected[k] = Some(if parameter == Of::InitialVelocity { 1.0 } else { 0.4 });
        assert_eq!(values(&changed), expected);
        let factor = |of: GradientParameter, factor| if of == parameter { factor } else { 1.0 };
        let [mass, velocity] = [factor(Of::Density, 0.4 / 2.0), factor(Of::InitialVelocity, 0.4)];
        let scaled = |all: &[f64], by: f64| all.iter().map(|one| one * by).collect::<Vec<_>>();
        assert_near(&changed.particles.mass, &scaled(&problem.particles.mass, mass), "mass");
        let velocities = scaled(&problem.particles.velocity, velocity);
        assert_near(&changed.particles.velocity, &velocities, "velocity");
        let fields = changed.fields.as_ref().expect("fields");
        let field = |of| fields.values(of, 0.0, &FieldPlaces::new(&place, &[0])).expect("values");
        assert_near(&field(FieldName::Velocity), &[0.525 * velocity, 4.2 * velocity], "field");
        assert_near(&field(FieldName::Displacement), &[0.27, 0.3125], "displacement");
        let friction = &changed.faces[2].numbers.values;
        let coefficient = if parameter == Of::Friction { 0.4 } else { 0.25 };
        assert_eq!(*friction, [("coefficient", HandedNumber::Scalar(coefficient))]);
    }
}
