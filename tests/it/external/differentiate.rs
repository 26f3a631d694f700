//! Answers to `differentiate` that violate the protocol, as shell scripts. Also invalid gradient
//! suites.

use super::gradient::SUITE;
use crate::cli::{BAD_INPUT, FAILED, Folder, SOUND};
use crate::common::folder::flat;
use rstest::rstest;

const HELLO: &str = r#"{"type":"hello","protocol":1,"name":"odd","version":"1","capabilities":{"dimensions":[1],"laws":["corotated"],"conditions":["free","fixed"],"gradients":["young","density","initial_velocity"]}}"#;

/// Creates a script that logs the request after the problem, and then runs `then`.
fn script(hello: &str, then: &str) -> String {
    let logging = format!("echo \"$m\" >> requests\n{then}");
    super::misbehaving::script(&logging).replace(super::program::HELLO, hello)
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

/// Answers are scripts, or the rest of a message that begins with the type `gradient`.
#[rstest]
#[case(r#""value":1,"gradient":[1]}"#, "sent a gradient of 1 numbers, expected 3: young, density,")]
#[case(r#""value":1,"gradient":[1,2,3,4]}"#, "sent a gradient of 4 numbers, expected 3: young,")]
#[case(
    r#""value":1,"gradient":[1,NaN,3]}"#,
    "answered `differentiate` with NaN, which is not a finite number; requested: young, density"
)]
#[case(
    r#""value":1,"gradient":[1,2,-Infinity]}"#,
    "answered `differentiate` with Infinity, which is not a finite number; requested: young"
)]
#[case(r#""value":1,"gradient":[1e999,2,3]}"#, "sent an invalid message (number out of range")]
#[case(r#""value":1,"gradient":"young"}"#, "expected a list at line 1")]
#[case(r#""value":1,"gradient":{"young":1}}"#, "expected a list at line 1")]
#[case(r#""gradient":[1,2,3]}"#, "missing field `value`")]
#[case(r#"echo '{"type":"state","columns":{}}'"#, "answered `differentiate` with `state`")]
#[case(r#"echo '{"type":"failed","reason":"adjoint: NaN at step 17"}'"#, "adjoint: NaN at step 17")]
#[case("exit 3", "the solver ended without an answer (exit status 3)")]
fn a_gradient_that_breaks_the_protocol_fails(#[case] then: &str, #[case] words: &str) {
    let then = if then.starts_with('"') {
        format!(r#"echo '{{"type":"gradient",{then}'"#)
    } else {
        then.to_owned()
    };
    let (code, said, _) = run(&script(HELLO, &then));
    // Nothing is expected of this solver, so the run succeeds.
    assert_eq!(code, SOUND, "{said}");
    assert!(said.contains("odd-{young,density,initial-velocity} explored a failed"), "{said}");
    assert!(said.contains(words), "no `{words}` in\n{said}");
}

#[test]
fn a_refused_request_is_not_applicable_and_has_the_form_of_the_protocol() {
    let refusal = r#"echo '{"type":"cannot","reason":"no gradient of mean_displacement"}'"#;
    let (code, said, requests) = run(&script(HELLO, refusal));
    assert_eq!(code, FAILED, "{said}");
    assert!(said.contains("odd-{young,density,initial-velocity} not applicable a"), "{said}");
    assert!(said.contains("no gradient of mean_displacement"), "{said}");
    let request: serde_json::Value =
        serde_json::from_str(requests.lines().next().expect("a request")).expect("JSON");
    assert_eq!(request["type"], "differentiate");
    assert_eq!(request["of"], serde_json::json!({"functional": "mean_displacement", "axis": 0}));
    let parameters = serde_json::json!(["young", "density", "initial_velocity"]);
    assert_eq!(request["with_respect_to"], parameters);
    assert_eq!(request["from"], 0.0);
    assert!(request["steps"].as_u64().is_some() && request["dt"].as_f64().is_some());
}

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
#[case("mean_displacement: {", "mean_velocity: {", "unknown name `mean_velocity`")]
#[case("{axis: 0}", "{axis: 1}", "the axis is 1")]
#[case("mean_displacement: {", "position_of: {particle: 16, ", "a whole number from 0 to 15")]
#[case("to: {young: E", "to: {yuong: E", "did you mean `young`?")]
#[case("to: {young: E", "to: {young: F", "`F` is not a parameter of this suite")]
#[case("to: {young: E", "to: {young: rho", "does not set the parameter `young`")]
#[case(
    "{young: E, density: rho, initial_velocity: v0}",
    "{}",
    "`with_respect_to` names no parameter"
)]
#[case("  cells: 32", "  cells: 33", "no level has 33 cells")]
#[case("points: 11", "points: 1", "a sweep of 1 points")]
#[case("within: 0.002", "within: 1", "half of the interval is 1")]
#[case("parameter: young", "parameter: poisson", "`poisson` is not among `with_respect_to`")]
#[case(
    "external: {name: numpy-mpm}",
    "mpm: {basis: linear, transfer: flip, scheme: musl}",
    "a gradient study needs an external solver"
)]
#[case("state: smooth", "state: smoth", "did you mean `smooth`?")]
#[case("\"v0*sin(pi*X/(2*L))\"]", "\"E*v0*sin(pi*X/(2*L))\"]", "initial_velocity")]
#[case("until: 1.3", "until: [1.3, 2]", "a single end time")]
#[case("until: 1.3", "until: 1.3, instants: 10", "the end of the run only")]
#[case("dt: \"0.4*h\"", "dt: {courant: 0.4}", "must not depend on the method")]
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
    let words = "the exact solution of a gradient study must be a displacement";
    assert!(said.contains(words), "{said}");
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
