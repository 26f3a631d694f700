//! Problems of the suites of this repository: load steps, fields and rims. Missing and misspelt
//! capabilities.

use super::program::HELLO;
use crate::cli::{Folder, SOUND};
use crate::common::folder::{assert_contains, flat};
use crate::common::{built_in_source, built_in_suite, valid_suite};
use mpm_verify::external::{Capabilities, FieldName, FieldPlaces, LevelProblem};
use mpm_verify::study::{level_problem, needs};
use rstest::rstest;
use serde_json::json;

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

/// Fields at the particles must equal the columns of the particles, to the last bit: in rate form,
/// of an annulus, of several bodies under stress, of revolution, in plane stress, and of soil.
#[test]
fn fields_agree_with_the_particles() {
    let names = "released-bar expanding-ring sliding-layers geostatic-slope-3d mms-axisymmetric \
                 geostatic-mohr-coulomb mms-plane-stress mms-polygon";
    for name in names.split(' ') {
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

/// With several suites, the output ends with a summary. With `--quiet` it contains only the
/// summary.
#[test]
fn check_lists_the_suites_that_a_solver_can_run() {
    let loaded = super::bar()
        .replace("short-bar", "loaded")
        .replace("scene:\n", "scene:\n  loads: [{traction: {on: right, value: [0]}}]\n");
    let folder = Folder::with("suites/loaded.yaml", loaded);
    folder.write("suites/bar.yaml", super::bar());
    let able = HELLO.replace("\"conditions\"", "\"loads\":[\"traction\"],\"conditions\"");
    folder.write("solver.sh", format!("read -r m; echo '{able}'; read -r m"));
    let check = ["check", "suites", "--solver", "sh solver.sh"];
    let found = folder.call(&check);
    let lacking = "loads: traction (available in version 2 of the protocol only)";
    assert_contains(&flat(&found.out), &["loaded: not applicable, the solver lacks", lacking]);
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
