//! Answers to `differentiate` that violate the protocol, as shell scripts. Also invalid gradient
//! suites.

use crate::cli::{BAD_INPUT, FAILED, Folder, SOUND};
use crate::common::folder::flat;
use rstest::rstest;

const SUITE: &str = include_str!("../../../verification/gradients/gradient-bar.yaml");

const HELLO: &str = r#"{"type":"hello","protocol":1,"name":"odd","version":"1","capabilities":{"dimensions":[1],"laws":["corotated"],"conditions":["free","fixed"],"gradients":["young","density","initial_velocity"]}}"#;

/// Creates a script that is correct until it receives the request after the problem, and then runs
/// `then`.
fn script(hello: &str, then: &str) -> String {
    format!(
        "read -r m; echo '{hello}'\nread -r m || exit 0\ncase \"$m\" in *bye*) exit 0;; esac\n\
         echo '{{\"type\":\"ready\"}}'\nread -r m\necho \"$m\" >> requests\n{then}\n"
    )
}

/// Runs `script` on the suite. Returns exit status, output and requests.
fn run(script: &str) -> (i32, String, String) {
    let folder = Folder::with("bar.yaml", SUITE);
    folder.write("solver.sh", script);
    let found = folder.call(&["run", "bar.yaml", "--solver", "sh solver.sh"]);
    let requests = std::fs::read_to_string(folder.path().join("requests")).unwrap_or_default();
    let said = found.out + &found.errors;
    (found.code, flat(&said), requests)
}

#[rstest]
#[case::too_few(
    r#"echo '{"type":"gradient","value":1,"gradient":[1]}'"#,
    "sent a gradient of 1 numbers, expected 3: young, density, initial_velocity"
)]
#[case::too_many(
    r#"echo '{"type":"gradient","value":1,"gradient":[1,2,3,4]}'"#,
    "sent a gradient of 4 numbers, expected 3: young, density, initial_velocity"
)]
#[case::nan(
    r#"echo '{"type":"gradient","value":1,"gradient":[1,NaN,3]}'"#,
    "answered `differentiate` with NaN, which is not a finite number; requested: young, density"
)]
#[case::infinity(
    r#"echo '{"type":"gradient","value":1,"gradient":[1,2,-Infinity]}'"#,
    "answered `differentiate` with Infinity, which is not a finite number; requested: young"
)]
#[case::too_large_a_number(
    r#"echo '{"type":"gradient","value":1,"gradient":[1e999,2,3]}'"#,
    "sent an invalid message (number out of range"
)]
#[case::text(
    r#"echo '{"type":"gradient","value":1,"gradient":"young"}'"#,
    "expected a list at line 1"
)]
#[case::by_name(
    r#"echo '{"type":"gradient","value":1,"gradient":{"young":1}}'"#,
    "expected a list at line 1"
)]
#[case::no_value(r#"echo '{"type":"gradient","gradient":[1,2,3]}'"#, "missing field `value`")]
#[case::another_type(
    r#"echo '{"type":"state","columns":{}}'"#,
    "answered `differentiate` with `state`"
)]
#[case::broken(
    r#"echo '{"type":"failed","reason":"adjoint: NaN at step 17"}'"#,
    "adjoint: NaN at step 17"
)]
#[case::a_crash("exit 3", "the solver ended without an answer (exit status 3)")]
fn a_gradient_that_breaks_the_protocol_fails(#[case] then: &str, #[case] words: &str) {
    let (code, said, _) = run(&script(HELLO, then));
    // Nothing is expected of this solver, so the run succeeds.
    assert_eq!(code, SOUND, "{said}");
    assert!(said.contains("odd-{young,density,initial-velocity} explored a failed"), "{said}");
    assert!(said.contains(words), "no `{words}` in\n{said}");
}

#[test]
fn a_refusal_is_not_applicable_with_its_reason() {
    let refusal = r#"echo '{"type":"cannot","reason":"no gradient of mean_displacement"}'"#;
    let (code, said, _) = run(&script(HELLO, refusal));
    assert_eq!(code, FAILED, "{said}");
    assert!(said.contains("odd-{young,density,initial-velocity} not applicable a"), "{said}");
    assert!(said.contains("no gradient of mean_displacement"), "{said}");
}

#[test]
fn the_request_has_the_form_of_the_protocol() {
    let refusal = r#"echo '{"type":"cannot","reason":"none"}'"#;
    let (.., requests) = run(&script(HELLO, refusal));
    let request: serde_json::Value =
        serde_json::from_str(requests.lines().next().expect("a request")).expect("JSON");
    assert_eq!(request["type"], "differentiate");
    assert_eq!(request["of"], serde_json::json!({"functional": "mean_displacement", "axis": 0}));
    let parameters = serde_json::json!(["young", "density", "initial_velocity"]);
    assert_eq!(request["with_respect_to"], parameters);
    assert_eq!(request["from"], 0.0);
    assert!(request["steps"].as_u64().is_some() && request["dt"].as_f64().is_some());
}

/// A solver without the capability must not receive `differentiate`.
#[test]
fn a_solver_without_gradients_is_not_asked() {
    let without = HELLO.replace(r#","gradients":["young","density","initial_velocity"]"#, "");
    let (code, said, requests) = run(&script(&without, "exit 1"));
    assert_eq!(code, FAILED, "{said}");
    assert!(said.contains("the solver lacks gradients: young"), "{said}");
    assert_eq!(requests, "");
}

#[test]
fn a_misspelt_parameter_among_the_capabilities_is_reported() {
    let misspelt = HELLO.replace(r#"["young","#, r#"["youngs","#);
    let (_, said, _) = run(&script(&misspelt, "exit 1"));
    assert!(said.contains("unknown name `youngs` in gradients; did you mean `young`?"), "{said}");
    assert!(said.contains("gradients: young (stated as `youngs`)"), "{said}");
}

#[rstest]
#[case::an_unknown_functional(
    "mean_displacement: {axis: 0}",
    "mean_velocity: {axis: 0}",
    "unknown name `mean_velocity`"
)]
#[case::an_axis_too_high("{axis: 0}", "{axis: 1}", "the axis is 1")]
#[case::a_particle_that_does_not_exist(
    "mean_displacement: {axis: 0}",
    "position_of: {particle: 16, axis: 0}",
    "the index of the particle is 16"
)]
#[case::an_unknown_parameter(
    "with_respect_to: {young: E",
    "with_respect_to: {yuong: E",
    "did you mean `young`?"
)]
#[case::a_parameter_of_no_suite(
    "with_respect_to: {young: E",
    "with_respect_to: {young: F",
    "`F` is not a parameter of this suite"
)]
#[case::a_parameter_that_sets_another(
    "with_respect_to: {young: E",
    "with_respect_to: {young: rho",
    "does not set the parameter `young`"
)]
#[case::no_parameter(
    "{young: E, density: rho, initial_velocity: v0}",
    "{}",
    "`with_respect_to` names no parameter"
)]
#[case::a_level_that_does_not_exist("  cells: 32", "  cells: 33", "no level has 33 cells")]
#[case::a_sweep_of_one_point("points: 11", "points: 1", "a sweep of 1 points")]
#[case::a_sweep_to_zero("within: 0.002", "within: 1", "half of the interval is 1")]
#[case::a_sweep_of_another(
    "parameter: young",
    "parameter: poisson",
    "`poisson` is not among `with_respect_to`"
)]
#[case::a_method_of_this_crate(
    "external: {name: numpy-mpm}",
    "mpm: {basis: linear, transfer: flip, scheme: musl}",
    "a gradient study needs an external solver"
)]
#[case::an_unknown_state("state: smooth", "state: smoth", "did you mean `smooth`?")]
#[case::a_velocity_of_another_shape(
    "v0*sin(pi*X/(2*L))\"]",
    "E*v0*sin(pi*X/(2*L))\"]",
    "initial_velocity"
)]
#[case::an_end_for_each_case("until: 1.3", "until: [1.3, 2]", "a single end time")]
#[case::instants("until: 1.3", "until: 1.3, instants: 10", "the end of the run only")]
#[case::refined_steps("dt: \"0.4*h\"", "dt: {courant: 0.4}", "must not depend on the method")]
fn a_suite_of_gradients_is_refused(#[case] old: &str, #[case] new: &str, #[case] words: &str) {
    assert!(SUITE.contains(old), "{old}");
    let said = refusal(&SUITE.replace(old, new));
    assert!(said.contains(words), "no `{words}` in\n{said}");
}

/// The error points at the kind of study, because there is no exact solution to point at.
#[test]
fn a_suite_without_an_exact_solution_is_refused_with_a_place() {
    let (before, truth) = SUITE.split_once("exact:\n").expect("the suite has an exact solution");
    let (_, after) = truth.split_once("\ngradient:").expect("the functional follows");
    let said = refusal(&format!("{before}gradient:{after}"));
    assert!(
        said.contains("the exact solution of a gradient study must be a displacement"),
        "{said}"
    );
}

#[test]
fn a_parameter_that_is_zero_is_refused() {
    let suite = SUITE.replace("  L: 1 ", "  nu: 0\n  L: 1 ").replace("poisson: 0", "poisson: nu");
    let suite = suite.replace("{young: E, density: rho, initial_velocity: v0}", "{poisson: nu}");
    let said = refusal(&suite);
    assert!(said.contains("`nu` is 0, but perturbations are relative to its value"), "{said}");
}

/// Returns the error that `check` reports about a suite.
fn refusal(suite: &str) -> String {
    let folder = Folder::with("bar.yaml", suite);
    let found = folder.call(&["check", "bar.yaml"]);
    let said = found.out + &found.errors;
    assert_eq!(found.code, BAD_INPUT, "{said}");
    assert!(said.contains("bar.yaml:"), "{said}");
    said
}
