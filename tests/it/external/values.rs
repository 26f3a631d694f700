//! Values that the harness passes to solvers: constants in the message `problem`, and fields at
//! requested points and times.

use super::program::{HELLO, SECOND_ORDER};
use crate::cli::{Folder, SOUND};
use crate::common::folder::{assert_contains, flat};
use crate::common::{built_in_source, built_in_suite, valid_suite};
use mpm_verify::external::{
    Capabilities, FieldName, FieldPlaces, LevelProblem, ProgramLimits, SolverFactory, SolverProgram,
};
use mpm_verify::study::{level_problem, needs};
use mpm_verify::subject::Samples;
use rstest::rstest;
use serde_json::{Value, json};

/// A body with every load and condition of the protocol.
const LOADED: &str = r#"suite: loaded
title: A body with many loads
source: a test
parameters: {p: 3, g: 9.5, mu: 0.25, f: 7}
scene:
  dimension: 2
  body: {box: {from: [0, 0], to: [1, 0.5]}}
  material: {linear_elastic: {young: 100, poisson: 0.3, density: 2}}
  sets:
    part: {box: {from: [0.5, 0], to: [1, 0.25]}}
    tail: {box: {from: [0, 0.25], to: [0.25, 0.5]}}
  boundary: {left: {velocity: ["Y*t", "g*t"]}, bottom: {friction: mu}}
  loads:
    - gravity: ["0", "-g*t"]
    - body_force: ["p*X*t", "1"]
    - damping: "2*g"
    - local_damping: 0.2
    - artificial_viscosity: {linear: 1, quadratic: 2}
    - traction: {on: right, value: ["p*Y", "2*p"]}
    - pressure: {on: top, value: "p*t"}
    - force: {on: part, value: [f, "f*t"]}
    - velocity: {on: tail, value: [mu, "2*mu"]}
run: {until: 0.01, dt: 0.005}
refine: {cells: 4, ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: usl}
expect:
  - drift: {mass: 1e-13}
    because: masses are constant
"#;

/// Creates the message `hello` of a solver of version 2 that supports all of these.
fn hello() -> String {
    json!({
        "type": "hello", "protocol": 2, "name": "asking", "version": "1",
        "capabilities": {
            "dimensions": [1, 2],
            "laws": ["linear_elastic", "neo_hookean", "drucker_prager"],
            "conditions": ["free", "fixed", "friction", "velocity"],
            "loads": [
                "gravity", "body_force", "damping", "local_damping", "artificial_viscosity",
                "traction", "pressure", "force", "velocity",
            ],
            "columns": ["stress"],
            "manufactured": true, "initial_deformation": true, "initial_stress": true,
            "displacement_force": true, "several_bodies": true,
        }
    })
    .to_string()
}

/// Creates a script that sends `requests` during its set-up, stores the problem and the answers in
/// the file `log`, and then exits.
fn script(requests: &[Value]) -> String {
    let ask = |request: &Value| format!("echo '{request}'; read -r m; echo \"$m\" >>log\n");
    let ask: String = requests.iter().map(ask).collect();
    format!(
        "read -r m; echo '{}'; read -r m\ncase \"$m\" in *'\"bye\"'*) exit 0;; esac\n\
         echo \"$m\" >>log\n{ask}echo '{{\"type\":\"ready\"}}'; read -r m\n\
         echo '{{\"type\":\"failed\",\"reason\":\"done\"}}'\n",
        hello()
    )
}

/// Returns the problem of `suite`, and the answers to `requests`.
fn answers(suite: &str, requests: &[Value]) -> Vec<Value> {
    let folder = Folder::with("suite.yaml", suite);
    folder.write("solver.sh", script(requests));
    let found = folder.call(&["run", "suite.yaml", "--solver", "sh solver.sh"]);
    assert!(found.out.contains("the solver reports: done"), "{}{}", found.out, found.errors);
    let parse = |line: &str| serde_json::from_str(line).expect("JSON");
    folder.read("log").lines().map(parse).collect()
}

#[test]
fn constants_of_loads_and_conditions_are_numbers() {
    let problem = &answers(LOADED, &[])[0];
    let face = |name: &str| {
        let mut faces = problem["faces"].as_array().expect("faces").iter();
        faces.find(|face| face["name"] == name).expect("a face").clone()
    };
    assert_eq!(face("bottom")["values"], json!({"coefficient": 0.25}));
    assert_eq!(face("left")["values"], json!({}));
    assert_eq!(face("left")["asked"], json!({"velocity": ["reference_position", "t"]}));
    assert_eq!((&face("right")["values"], &face("right")["asked"]), (&json!({}), &json!({})));
    let speed = (100.0 * 0.7 / (1.3 * 0.4) / 2.0_f64).sqrt();
    for (load, on, values, asked) in [
        ("gravity", Value::Null, json!({}), json!({"acceleration": ["t"]})),
        (
            "body_force",
            Value::Null,
            json!({}),
            json!({"acceleration": ["reference_position", "t"]}),
        ),
        ("damping", Value::Null, json!({"rate": 19.0}), json!({})),
        ("local_damping", Value::Null, json!({"share": 0.2}), json!({})),
        (
            "artificial_viscosity",
            Value::Null,
            json!({"linear": 1.0, "quadratic": 2.0, "wave_speed": speed}),
            json!({}),
        ),
        ("traction", json!("right"), json!({}), json!({"traction": ["reference_position"]})),
        ("pressure", json!("top"), json!({}), json!({"pressure": ["t"]})),
        ("force", json!("part"), json!({"volume": 0.125}), json!({"force": ["t"]})),
        ("velocity", json!("tail"), json!({"velocity": [0.25, 0.5]}), json!({})),
    ] {
        let mut loads = problem["loads"].as_array().expect("loads").iter();
        let found = loads.find(|found| found["load"] == load).expect("a load");
        assert_eq!((&found["values"], &found["asked"]), (&values, &asked), "{load}");
        let place = found.get("face").or(found["region"].get("name"));
        assert_eq!(place.cloned().unwrap_or_default(), on, "{load}");
    }
    let part = json!({"name": "part", "from": [0.5, 0.0], "to": [1.0, 0.25]});
    assert!(problem["loads"].as_array().expect("loads").iter().any(|load| load["region"] == part));
}

#[test]
fn loads_and_conditions_have_values_at_requested_places_and_times() {
    let list = answers(LOADED, &[]);
    let number = |name: &str| {
        let mut loads = list[0]["loads"].as_array().expect("loads").iter();
        format!("load:{}", loads.position(|load| load["load"] == name).expect("a load"))
    };
    let on = |of: &str, t: f64, places: &[f64]| json!({"type": "values", "of": of, "t": t, "reference_position": places});
    let uniform = |of: &str, t: f64| json!({"type": "values", "of": of, "t": t});
    let cases = [
        (on("face:left", 2.0, &[0.0, 0.5, 0.0, 0.1]), vec![1.0, 19.0, 0.2, 19.0]),
        (on(&number("traction"), 2.0, &[1.0, 0.5]), vec![1.5, 6.0]),
        (uniform(&number("pressure"), 2.0), vec![6.0]),
        (on(&number("pressure"), 2.0, &[0.3, 0.5, 0.4, 0.5]), vec![6.0, 6.0]),
        (uniform(&number("gravity"), 2.0), vec![0.0, -19.0]),
        (on(&number("body_force"), 2.0, &[0.5, 0.1]), vec![3.0, 1.0]),
        (uniform(&number("damping"), 2.0), vec![19.0]),
        (uniform(&number("force"), 2.0), vec![7.0, 14.0]),
        (uniform(&number("velocity"), 2.0), vec![0.25, 0.5]),
        (on("body_force", 2.0, &[0.5, 0.1]), vec![3.0, -18.0]),
    ];
    let requests: Vec<Value> = cases.iter().map(|(request, _)| request.clone()).collect();
    let found = answers(LOADED, &requests);
    for ((request, values), found) in cases.iter().zip(&found[1..]) {
        assert_eq!(found["values"], json!(values), "{request}");
        assert_eq!((&found["type"], &found["of"]), (&json!("values"), &request["of"]));
    }
}

/// A polygon that is stretched, moves and is under stress at the start.
const STRETCHED: &str = r#"suite: stretched
title: A polygon that starts stretched
source: a test
scene:
  dimension: 2
  body: {polygon: [[0, 0], [1, 0], [0, 0.5]]}
  material: {neo_hookean: {young: 100, poisson: 0.3, density: 2}}
  initial_displacement: ["0.1*X", "0"]
  initial_velocity: ["X*Y", "2*Y"]
  initial_stress: {yy: "4*X"}
run: {until: 0.01, dt: 0.005}
refine: {cells: 4, ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: usl}
expect:
  - drift: {mass: 1e-13}
    because: masses are constant
"#;

#[test]
fn the_initial_state_is_known_at_any_place_of_the_body() {
    // The second point is on the slanting side, up to rounding.
    let places = [0.25, 0.125, 1.0 - 0.2, 0.1 + 1e-12];
    let request = |of: &str| json!({"type": "values", "of": of, "reference_position": places});
    let names = ["displacement", "velocity", "deformation_gradient", "initial_stress", "stress"];
    let found = answers(STRETCHED, &names.map(request));
    let near = |k: usize, expected: &[f64]| {
        let values: Vec<f64> = serde_json::from_value(found[k]["values"].clone()).expect("numbers");
        assert_eq!(values.len(), expected.len());
        for (value, expected) in values.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-9, "{}: {value}, not {expected}", names[k - 1]);
        }
    };
    near(1, &[0.025, 0.0, 0.08, 0.0]);
    near(2, &[0.03125, 0.25, 0.08, 0.2]);
    near(3, &[1.1, 0.0, 0.0, 1.0, 1.1, 0.0, 0.0, 1.0]);
    near(4, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 3.2]);
    let (lambda, mu, j): (f64, f64, f64) = (30.0 / (1.3 * 0.4), 50.0 / 1.3, 1.1);
    let spherical = lambda * j.ln() / j;
    let along = spherical + mu / j * (j * j - 1.0);
    near(5, &[along, 0.0, 0.0, spherical + 1.0 / j, along, 0.0, 0.0, spherical + 3.2 / j]);
    let shape = json!({
        "shape": "polygon", "from": [0.0, 0.0], "to": [1.0, 0.5],
        "corners": [[0.0, 0.0], [1.0, 0.0], [0.0, 0.5]],
    });
    assert_eq!(found[0]["bodies"], json!([shape]));
}

fn problem_of(name: &str) -> LevelProblem {
    let suite = built_in_suite(name);
    let plan = suite.convergence().expect("a study of an order");
    level_problem(name, plan, &plan.cases[0], plan.refine.levels[0]).expect("a problem")
}

/// A load step is a step of length 1. The problem must state the number of load steps.
#[test]
fn load_steps_are_passed_to_solvers_that_list_them() {
    let suite = built_in_suite("load-steps-hencky");
    let plan = suite.convergence().expect("a study of an order");
    for case in &plan.cases {
        let steps = if case.name.ends_with("-20") { 20 } else { 1 };
        let problem = level_problem("load-steps-hencky", plan, case, plan.refine.levels[0]);
        let problem = problem.expect("a problem");
        assert_eq!((problem.load_steps, problem.steps, problem.dt), (Some(steps), steps, 1.0));
        assert_eq!(problem.instants.last(), Some(&steps));
        assert_eq!(json!(problem)["load_steps"], json!(steps));
    }
    let conditions = ["free", "fixed"];
    let able = Capabilities::of(&[1], &["hencky"], &conditions, &["gravity"]);
    assert_eq!(able.lacking(&needs(plan)), ["load_steps"]);
    let able = Capabilities { load_steps: true, ..able };
    assert!(able.lacking(&needs(plan)).is_empty());
    assert!(json!(problem_of("vibrating-bar")).get("load_steps").is_none());
}

/// Fields at the particles must equal the columns of the particles, to the last bit.
#[rstest]
#[case::one_dimension("vibrating-bar")]
#[case::deformed("mms-axis-aligned-2d")]
#[case::rate_form("released-bar")]
#[case::annulus("expanding-ring")]
#[case::several_bodies_with_stress("sliding-layers")]
#[case::three_dimensions("geostatic-slope-3d")]
#[case::revolution("mms-axisymmetric")]
#[case::soil_under_stress("geostatic-mohr-coulomb")]
#[case::plane_stress("mms-plane-stress")]
#[case::quadrilateral("mms-polygon")]
fn fields_agree_with_the_particles(#[case] name: &str) {
    let problem = problem_of(name);
    let (fields, particles) = (problem.fields.expect("fields"), &problem.particles);
    let bodies: Vec<usize> = particles.body.iter().map(|body| *body as usize).collect();
    let at = FieldPlaces::new(&particles.reference_position, &bodies);
    let of = |field| fields.values(field, 0.0, &at).expect("values");
    let moved = particles.position.iter().zip(&particles.reference_position);
    let u: Vec<f64> = moved.map(|(x, label)| x - label).collect();
    let displacement = of(FieldName::Displacement);
    assert!(displacement.iter().zip(&u).all(|(a, b)| (a - b).abs() < 1e-12), "{name}");
    assert_eq!(of(FieldName::Velocity), particles.velocity);
    assert_eq!(of(FieldName::DeformationGradient), particles.deformation_gradient);
    assert_eq!(of(FieldName::Stress), particles.stress);
    if !particles.initial_stress.is_empty() {
        assert_eq!(of(FieldName::InitialStress), particles.initial_stress);
    }
    if !particles.initial_stress_across.is_empty() {
        assert_eq!(of(FieldName::InitialStressAcross), particles.initial_stress_across);
    }
    if bodies.iter().all(|body| *body == 0) {
        assert_eq!(fields.bodies(&particles.reference_position), Ok(bodies));
    }
}

/// A law with a yield surface needs the normal stresses out of the plane.
#[test]
fn normal_stress_out_of_the_plane_is_known_for_a_law_that_yields() {
    let soil = STRETCHED
        .replace("neo_hookean: {", "drucker_prager: {friction: 0.3, dilation: 0, strength: 9, ")
        .replace("  initial_displacement: [\"0.1*X\", \"0\"]\n", "")
        .replace("{yy: \"4*X\"}", "{yy: \"-4*X\", zz: \"-2*X\"}");
    let places = [0.25, 0.125, 0.5, 0.1];
    let request = |of: &str| json!({"type": "values", "of": of, "reference_position": places});
    let found = answers(&soil, &["initial_stress_across", "stress"].map(request));
    assert_eq!(found[1]["values"], json!([-0.5, -1.0]));
    assert_eq!(found[2]["values"], json!([0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -2.0]));
}

/// Nodes on the rim of a disk belong to the disk, and the stress on the axis of a body of
/// revolution is defined.
#[test]
fn nodes_on_a_rim_and_on_an_axis_are_inside() {
    let ring = problem_of("expanding-ring");
    let (centre, radii) = (ring.bodies[0].centre.clone().expect("a centre"), ring.bodies[0].radii);
    let fields = ring.fields.expect("fields");
    for radius in radii.expect("radii") {
        for k in 0..60 {
            let angle = f64::from(k) * 0.1047;
            let place =
                |radius: f64| [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()];
            assert_eq!(fields.bodies(&place(radius)), Ok(vec![0]), "{angle}");
        }
    }
    let [inner, outer] = radii.expect("radii");
    for radius in [0.99 * inner, 1.01 * outer] {
        let found = fields.bodies(&[centre[0] + radius, centre[1]]);
        let reason = found.expect_err("an error").to_string();
        assert!(reason.contains("is outside the body"), "{reason}");
    }
    let mms = problem_of("mms-axisymmetric");
    let place = [mms.bodies[0].from[0], mms.bodies[0].from[1]];
    let at = FieldPlaces::new(&place, &[0]);
    let stress = mms.fields.expect("fields").values(FieldName::Stress, 0.0, &at);
    assert!(stress.is_ok(), "{stress:?}");
}

/// The message must name the rim of a pressure. The values of the pressure are defined only on this
/// circle.
#[test]
fn pressure_on_a_rim_is_passed_to_solvers() {
    let name = "pressurised-cylinder-in-plane";
    let tube = problem_of(name);
    let load = serde_json::to_value(&tube.loads[0]).expect("JSON");
    assert_eq!((&load["load"], &load["rim"]), (&json!("pressure"), &json!("inner")));
    assert_eq!((load.get("face"), &load["values"]["pressure"]), (None, &json!(1e-5)));

    // The pressure becomes a formula of the position. On the rim it equals Lame's pressure.
    let text = built_in_source(name).text().to_owned();
    let text = text.replace("value: p}", "value: \"p*(X^2 + Y^2)/a^2\"}");
    let suite = valid_suite(&text);
    let plan = suite.convergence().expect("a study of an order");
    assert!(needs(plan).loaded_rims);
    let case = &plan.cases[0];
    let tube = level_problem(name, plan, case, plan.refine.levels[0]).expect("a problem");
    let fields = tube.fields.expect("fields");
    let at =
        |place: &[f64; 2]| fields.values(FieldName::Load(0), 0.0, &FieldPlaces::new(place, &[0]));
    let on_rim = at(&[0.6, -0.8]).expect("a place on the rim");
    assert!((on_rim[0] / 1e-5 - 1.0).abs() < 1e-14, "{on_rim:?}");
    let reason = at(&[0.6, 0.9]).expect_err("a place inside").to_string();
    assert!(reason.contains("is not on the inner rim, whose radius is 1 m"), "{reason}");
}

/// The first state of a solver with its own sample points must be the initial state at these
/// points.
#[test]
fn points_start_in_the_initial_state() {
    let folder = Folder::new();
    let points =
        r#"{"type":"ready","points":{"reference_position":[0,0.5,0.25,0],"weight":[1,2]}}"#;
    let asking = script(&[]).replace(r#"{"type":"ready"}"#, points);
    let path = folder.write("solver.sh", asking.replace("echo \"$m\" >>log", ""));
    let command = format!("sh {}", path.display());
    let program = SolverProgram::greet(&command, ProgramLimits::default()).expect("a hello");
    let suite = valid_suite(STRETCHED);
    let plan = suite.convergence().expect("a study of an order");
    let problem = level_problem("stretched", plan, &plan.cases[0], plan.refine.levels[0]);
    let subject = program.subject(problem.expect("a problem")).expect("a subject");
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    assert_eq!(samples.displacement, [0.0, 0.0, 0.025, 0.0]);
    assert_eq!(samples.velocity, [0.0, 1.0, 0.0, 0.0]);
    assert_eq!((samples.stress.len(), samples.stress[7]), (8, samples.stress[3] + 1.0 / 1.1));
}

/// If a body force depends on the displacement, the request must contain the displacement.
#[test]
fn a_body_force_takes_the_displacement() {
    let suite = LOADED.replace("\"p*X*t\", \"1\"", "\"p*ux\", \"uy + Y\"");
    let request = json!({
        "type": "values", "of": "body_force", "t": 0, "reference_position": [0.5, 0.25],
        "displacement": [0.125, 2.0],
    });
    let found = answers(&suite, std::slice::from_ref(&request));
    assert_eq!(found[1]["values"], json!([0.375, 2.25]));
    let load = found[0]["loads"]
        .as_array()
        .expect("loads")
        .iter()
        .position(|load| load["load"] == "body_force");
    let load = load.expect("a load");
    let keys = json!(["reference_position", "displacement"]);
    assert_eq!(found[0]["loads"][load]["asked"]["acceleration"], keys);
    let mut request = request;
    request["of"] = json!(format!("load:{load}"));
    assert_eq!(answers(&suite, &[request])[1]["values"], json!([0.375, 2.25]));
}

#[rstest]
#[case::unknown(json!({"of": "velocty"}), "unknown field; did you mean `velocity`?")]
#[case::unknown_load(json!({"of": "load:77", "t": 0}), "`load:77`: unknown field")]
#[case::no_time(json!({"of": "body_force"}), "the request has no time `t`")]
#[case::a_later_time(json!({"of": "stress", "t": 0.5}), "the field is defined at t = 0 only, not at t = 0.5")]
#[case::too_few(json!({"of": "velocity", "reference_position": [0.1]}), "sent 1 numbers in the column `reference_position`, expected 2")]
#[case::outside(json!({"of": "velocity", "reference_position": [0.1, 0.1, 1.5, 0.2]}), "place 1, (1.5, 0.2) m, is outside the body")]
#[case::just_outside(json!({"of": "velocity", "reference_position": [1.00001, 0.2]}), "place 0, (1.00001, 0.2) m, is outside the body")]
#[case::no_body(json!({"of": "velocity", "reference_position": [0.1, 0.2], "body": 3}), "there is no body 3")]
#[case::beside_the_face(json!({"of": "face:left", "t": 0, "reference_position": [0.1, 0.2]}), "is not on the face `left`")]
#[case::everywhere_on_a_face(json!({"of": "face:left", "t": 0}), "the request has no `reference_position`")]
#[case::no_value(json!({"of": "face:right", "t": 0}), "`free` does not depend on the position")]
#[case::displacement(json!({"of": "body_force", "t": 0, "displacement": [0.1, 0.1]}), "sent 2 numbers as `displacement`")]
fn a_wrong_request_fails_the_case(#[case] request: Value, #[case] reason: &str) {
    let mut request = request;
    request["type"] = json!("values");
    fails(&script(&[request]), reason);
}

#[rstest]
#[case::a_word("NaN", "answered with NaN, which is not a finite number")]
#[case::an_infinite_time("1e999", "sent an invalid message")]
fn a_request_with_no_number_fails_the_case(#[case] number: &str, #[case] reason: &str) {
    let request = json!({"type": "values", "of": "velocity", "reference_position": [0.5, 77]});
    fails(&script(&[request]).replace("77", number), reason);
}

#[rstest]
#[case::outside("[2, 0.2]", "[1]", "sent invalid points: place 0, (2, 0.2) m, is outside the body")]
#[case::too_few("[0.5]", "[1]", "sent 1 numbers in the column `reference_position`, expected 2")]
#[case::none("[]", "[]", "sent an empty list of points")]
fn wrong_points_fail_the_case(#[case] places: &str, #[case] weight: &str, #[case] reason: &str) {
    let points = format!(
        r#"{{"type":"ready","points":{{"reference_position":{places},"weight":{weight}}}}}"#
    );
    fails(&script(&[]).replace(r#"{"type":"ready"}"#, &points), reason);
}

#[test]
fn too_many_requests_fail_the_case() {
    let endless =
        "yes '{\"type\":\"values\",\"of\":\"velocity\"}' | head -n 10001 & cat >/dev/null; wait";
    fails(&script(&[]).replace("echo \"$m\" >>log", endless), "requested values 10001 times");
}

/// Asserts that a solver fails for the loaded body, for a `reason`, and passes the bar.
fn fails(script: &str, reason: &str) {
    let folder = Folder::with("loaded.yaml", LOADED);
    folder.write("bar.yaml", super::bar());
    folder.write("wrong.sh", script.split_once("read -r m\n").map_or("", |(_, rest)| rest));
    let sound = SECOND_ORDER.replace("HELLO", &hello().replace("asking", "odd"));
    let branch = "case \"$problem\" in *'\"loaded\"'*) m=$problem; . ./wrong.sh; exit 0;; esac\n\
                  echo '{\"type\":\"ready\"}'";
    folder.write("solver.sh", sound.replacen("echo '{\"type\":\"ready\"}'", branch, 1));
    let command = ["run", "loaded.yaml", "bar.yaml", "--brief", "--solver", "sh solver.sh"];
    let found = folder.call(&command).ended(SOUND);
    let flat = flat(&found.out);
    assert!(flat.contains(reason), "no `{reason}` in\n{}", found.out);
    assert!(flat.contains("explored short-bar::odd converging"), "{}", found.out);
}

/// A solver of version 1 must not receive loads and conditions whose numbers only version 2 passes.
#[test]
fn version_1_lacks_loads_and_conditions_with_numbers() {
    let folder = Folder::with("loaded.yaml", LOADED);
    let older = script(&[]).replace(r#""protocol":2"#, r#""protocol":1"#);
    folder.write("solver.sh", older);
    let found = folder.call(&["check", "loaded.yaml", "--solver", "sh solver.sh"]);
    assert!(found.out.contains("loaded: not applicable, the solver lacks"), "{}", found.out);
    for need in
        ["loads: traction", "loads: damping", "conditions: friction", "conditions: velocity"]
    {
        let said = format!("{need} (available in version 2 of the protocol only)");
        assert!(found.out.contains(&said), "no `{said}` in\n{}", found.out);
    }
    assert!(!found.out.contains("gravity"), "{}", found.out);
    folder.write("solver.sh", script(&[]));
    let found = folder.call(&["check", "loaded.yaml", "--solver", "sh solver.sh"]);
    assert!(found.out.starts_with("loaded: sound"), "{}{}", found.out, found.errors);
    // `run --gate` requires an order of the solver.
    assert!(!found.out.contains("no gate"), "{}", found.out);
}

/// With several suites, the output ends with a summary. With `--quiet` it contains only the
/// summary.
#[test]
fn check_lists_the_suites_that_a_solver_can_run() {
    let folder = Folder::with("suites/loaded.yaml", LOADED);
    folder.write("suites/bar.yaml", super::bar());
    let older = script(&[]).replace(r#""protocol":2"#, r#""protocol":1"#);
    folder.write("solver.sh", older);
    let check = ["check", "suites", "--solver", "sh solver.sh"];
    let found = folder.call(&check);
    assert!(found.out.contains("loaded: not applicable"), "{}", found.out);
    let quiet = folder.call(&[&check[..], &["--quiet"]].concat());
    let expected = "\nthe solver can run 1 of 2 suites:\n  short-bar\nmost frequent missing capabilities, with the number of suites:\n";
    assert!(quiet.out.starts_with(expected), "{}", quiet.out);
    assert!(found.out.ends_with(&quiet.out), "{}", found.out);
}

/// Every command must report an unknown name, also in the list of missing capabilities.
#[rstest]
#[case::check("check", SOUND)]
#[case::run("run", 1)]
fn unknown_names_in_capabilities_are_reported(#[case] command: &str, #[case] code: i32) {
    let folder = Folder::with("bar.yaml", super::bar());
    let misspelt = HELLO
        .replace("\"linear_elastic\"", "\"linear-elastic\"")
        .replace("\"capabilities\":{", "\"capabilities\":{\"periodic_axes\":true,");
    folder.write("solver.sh", format!("read -r m; echo '{misspelt}'; read -r m"));
    let found = folder.call(&[command, "bar.yaml", "--solver", "sh solver.sh"]).ended(code);
    assert_contains(
        &found.errors,
        &[
            "unknown capability `periodic_axes`; known: dimensions, laws",
            "unknown name `linear-elastic` in laws; did you mean `linear_elastic`?",
        ],
    );
    let lacking = "laws: linear_elastic (stated as `linear-elastic`)";
    assert!(flat(&found.out).contains(lacking), "no `{lacking}` in\n{}", found.out);
}
