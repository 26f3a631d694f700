//! Causes that a diagnosis finds without changing the method, for methods of this crate and for
//! external solvers.

use crate::common::folder::{assert_contains, flat};
use crate::common::solver::solver;
use crate::common::{edited, read_suite};
use mpm_verify::report;
use mpm_verify::study::{self, diagnose, preflight, under};
use mpm_verify::suite::LevelPlan;
use mpm_verify::suite::yaml::Severity;
use mpm_verify::verify::{Diagnosis, KnownCauseKind};
use rstest::rstest;
use std::sync::LazyLock;

/// Budget of predicted time (s) for the runs of a case.
const BUDGET: f64 = 60.0;

/// Budget (s) that is too small for any changed run.
const NO_RUNS: f64 = 1e-9;

/// The bar of [`preflight`](super::preflight) with larger displacements, for a whole period.
static BAR: LazyLock<String> = LazyLock::new(|| {
    let edits = [
        ("a: 1e-8", "a: 1e-4"),
        (", end: 0.05", ""),
        ("  grid: {from: [0], to: [1.5]}\n", ""),
        ("until: end", "until: 0.4"),
        ("[6, 12, 18, 24]", "[8, 12, 16, 24, 32]"),
    ];
    let (before, _) = super::preflight::BAR.split_once("judge:").expect("a quantity");
    edited(before, &edits)
});

/// A bar with a manufactured displacement; `GRID`, `FACES`, `U`, `UNTIL` and `METHOD` are replaced.
const MANUFACTURED: &str = r#"suite: bar
title: Bar
source: a textbook
parameters: {c: 10}
scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
GRID  material: {neo_hookean: {young: "c^2", poisson: 0, density: 1}}
  boundary: {FACES}
manufactured:
  displacement: ["U"]
run: {until: UNTIL, dt: "0.2*h/c"}
refine: {cells: [6, 12, 18, 24], ppc: 2}
methods:
  - mpm: {METHOD}
"#;

const LINEAR: &str = "basis: linear, transfer: flip, scheme: musl";

fn manufactured(grid: &str, faces: &str, u: &str, until: &str, method: &str) -> String {
    let text = MANUFACTURED.replace("GRID", grid).replace("FACES", faces).replace("METHOD", method);
    text.replace("UNTIL", until).replace("\"U\"", &format!("\"{u}\""))
}

fn diagnosis(text: &str, budget: f64) -> Diagnosis {
    let (source, suite) = read_suite(text);
    diagnose(&suite, &source, 0, budget, None).expect("a run").expect("an order")
}

/// Returns the text of a diagnosis without line breaks. Asserts that it contains no NaN.
fn page(found: &Diagnosis) -> String {
    let page = flat(&report::diagnosis(found));
    assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    page
}

/// Diagnoses the first method as an external solver.
fn external_diagnosis(text: &str, budget: f64) -> Diagnosis {
    let (source, own) = read_suite(text);
    let plan = own.convergence().expect("a convergence study");
    let solver = solver("external", |problem| {
        let (first, h) = (plan.refine.levels[0], problem.grid.h);
        let cells = (first.cells as f64 * first.h / h).round() as u64;
        let level = LevelPlan { cells, h, dt: problem.dt, ppc: problem.particles_per_cell };
        study::subject(plan, plan.cases[0].method, level)
    });
    let suite = under(&own, &solver, false).expect("a convergence study");
    diagnose(&suite, &source, 0, budget, Some(&solver)).expect("a run").expect("an order")
}

/// Returns the diagnoses of the first method, also as an external solver.
fn both(text: &str, budget: f64) -> [Diagnosis; 2] {
    [diagnosis(text, budget), external_diagnosis(text, budget)]
}

#[rstest]
#[case::on_all_levels("\"4*h/c\"", "on all levels", "4.00 times")]
#[case::on_the_first_levels("\"40*h^2/c\"", "on the levels with 8 cells, 12 cells, 16 cells.", "")]
#[case::automatic("{courant: 4}", "on all levels", "2.00 [2.00")]
fn a_step_beyond_the_stable_step_is_the_cause(
    #[case] dt: &str,
    #[case] levels: &str,
    #[case] words: &str,
) {
    for found in both(&BAR.replace("\"0.2*h/c\"", dt), BUDGET) {
        let text = page(&found);
        assert_contains(&text, &[&format!("longer than the stable step, {levels}"), words]);
        if dt == "\"4*h/c\"" {
            assert_contains(&text, &["Remedy: `dt: {courant: 0.5}`", "2.00 [2.00"]);
            assert!(found.runs.is_empty(), "{text}");
        }
    }
}

#[rstest]
#[case::stable("0.9*h/c")]
#[case::short("0.1*h/c")]
fn a_stable_step_is_no_cause(#[case] dt: &str) {
    for found in both(&BAR.replace("0.2*h/c", dt), NO_RUNS) {
        assert!(found.finding(KnownCauseKind::UnstableStep).is_none(), "{found:#?}");
    }
}

#[rstest]
#[case::outwards("v*t*X", "[0.5]")]
#[case::inwards("-v*t*X", "[-0.5]")]
fn a_wall_that_moves_along_its_normal_is_the_cause(#[case] u: &str, #[case] velocity: &str) {
    let faces = format!("left: fixed, right: {{velocity: {velocity}}}");
    let text = manufactured("", &faces, &u.replace('v', "0.5"), "1", LINEAR);
    for found in both(&text, BUDGET) {
        let text = page(&found);
        assert_contains(
            &text,
            &[
                "but walls are fixed at the end of the grid",
                "let the wall move only along its surface",
            ],
        );
        assert!(!text.contains("larger `grid`"), "{text}");
    }
}

/// The end of the bar moves by 0.05 m, but the grid ends at the end of the bar.
#[test]
fn a_larger_grid_is_recommended_for_a_free_end() {
    let grid = "  grid: {from: [0], to: [1]}\n";
    let u = "0.05*sin(pi*X/2)*sin(5*pi*t)";
    for found in both(&manufactured(grid, "left: fixed", u, "0.1", LINEAR), BUDGET) {
        assert!(found.finding(KnownCauseKind::OutsideGrid).is_some() && found.runs.is_empty());
        let words = ["the grid ends where the body moves to", "a larger `grid` in `scene`"];
        assert_contains(&page(&found), &words);
    }
}

/// Due to rounding, the last particle is at 0.9000000000000001 m.
#[test]
fn a_particle_on_a_wall_is_named_with_the_refusal() {
    let u = "1e-4*sin(pi*X/0.9)*sin(10*pi*t)";
    let text = manufactured("", "left: fixed, right: fixed", u, "0.05", LINEAR);
    let text = text.replace("to: [1]", "to: [0.9]").replace("6, 12, 18, 24", "10, 20, 40, 80");
    let text = text.replace("methods:", "particles: {shift: [0.5]}\nmethods:");
    let (source, suite) = read_suite(&text);
    let refused = diagnose(&suite, &source, 0, BUDGET, None).expect_err("a particle is lost");
    let parts = ["left the domain", "particles start on a wall", "a smaller `shift`"];
    assert_contains(&refused, &parts);
    assert!(!refused.contains("larger `grid`"), "{refused}");
}

/// Creates a bar that flies into a wall. The velocity jumps across the wave.
fn impact(norm: &str) -> String {
    let text = BAR.replace("a*omega*sin(pi*X/2)", "-1e-3*sign(X)");
    let text = text.replace("a*sin(pi*X/2)*sin(omega*t)", "-1e-3*min(t, X/c)");
    let text = text.replace("{a: 1e-4, c: 10, omega: \"pi/2*c\"}", "{c: 10}");
    let text =
        text.replace("until: 0.4", "until: 0.05").replace("8, 12, 16, 24, 32", "20, 40, 80, 160");
    format!("{text}judge: {{{norm}}}\n")
}

#[rstest]
#[case::rms("norm: rms", "at most about 1.00 in the rms norm")]
#[case::l1("norm: l1", "at most about 1.33 in the l1 norm")]
#[case::velocity("of: velocity, norm: l1", "at most about 0.67 in the l1 norm of the velocity")]
fn a_kink_in_the_exact_solution_comes_before_partial_remedies(
    #[case] norm: &str,
    #[case] limit: &str,
) {
    for found in both(&impact(norm), BUDGET) {
        let text = page(&found);
        assert_contains(&text, &["Cause: the exact solution is not smooth: it has a kink", limit]);
        assert!(!text.contains("mass: consistent") && !found.runs.is_empty(), "{text}");
    }
}

/// The formula contains `abs`, but is smooth inside the body.
#[test]
fn a_function_with_a_kink_outside_the_body_is_no_cause() {
    let found = diagnosis(
        &BAR.replace("[\"a*sin(pi*X/2)*sin(omega*t)\"]", "[\"a*sin(pi*abs(X)/2)*sin(omega*t)\"]")
            .replace("linear, transfer: flip, scheme: musl", "linear, transfer: flip, scheme: usf"),
        NO_RUNS,
    );
    assert!(found.finding(KnownCauseKind::NotSmooth).is_none(), "{found:#?}");
}

/// The pulse in a periodic bar has a width of 0.03 m. The coarsest cells are nearly as wide.
#[test]
fn removal_of_too_coarse_levels_is_recommended() {
    let exact = "a*exp(-((X - 0.4 - c*t)/0.03)^2)";
    let velocity = "2*a*c*(X - 0.4)/0.03^2*exp(-((X - 0.4)/0.03)^2)";
    let text = BAR.replace("a*omega*sin(pi*X/2)", velocity);
    let text = text.replace("a*sin(pi*X/2)*sin(omega*t)", exact);
    let text = text.replace("{a: 1e-4, c: 10, omega: \"pi/2*c\"}", "{a: 1e-6, c: 10}");
    let initial = "  initial_displacement: [\"a*exp(-((X - 0.4)/0.03)^2)\"]\n  initial_velocity";
    let text = text.replace("left: fixed", "left: periodic, right: periodic");
    let text = text.replace("  initial_velocity", initial).replace("until: 0.4", "until: 0.02");
    for found in both(&text.replace("8, 12, 16, 24, 32", "40, 80, 160, 320, 640"), NO_RUNS) {
        let cause = "Cause: the first levels are too coarse";
        assert_contains(&page(&found), &[cause, "Remedy: leave out the level with 40 cells"]);
    }
}

/// MLS has order 1 at fixed walls, and order 2 if there are none.
#[rstest]
#[case::walls("left: fixed, right: fixed", "sin(pi*X)", true)]
#[case::no_walls("left: periodic, right: periodic", "sin(2*pi*X)", false)]
fn the_gradients_of_mls_at_walls_are_the_cause(
    #[case] faces: &str,
    #[case] shape: &str,
    #[case] has_walls: bool,
) {
    let u = format!("1e-4*{shape}*sin(10*pi*t)");
    let method = "basis: quadratic_bspline, transfer: mls, scheme: musl";
    let text = manufactured("", faces, &u, "0.05", method);
    let found = diagnosis(&text.replace("6, 12, 18, 24", "10, 20, 40, 80"), BUDGET);
    let text = page(&found);
    assert_eq!(text.contains("the velocity gradients at walls: `mls` fits"), has_walls, "{text}");
}

/// Creates a column under its weight.
fn column(loads: &str) -> String {
    let text = BAR.replace("exact:", "equilibrium:");
    let text = text.replace("a*sin(pi*X/2)*sin(omega*t)", "-g/c^2*(X - X^2/2)");
    let text = text.replace("  initial_velocity: [\"a*omega*sin(pi*X/2)\"]\n", loads);
    text.replace("{a: 1e-4, c: 10, omega: \"pi/2*c\"}", "{g: 0.01, c: 10}")
}

/// Returns the findings of `check` about missing dissipation.
fn of_check(text: &str) -> Vec<Severity> {
    let (source, suite) = read_suite(text);
    let all = preflight(&suite, &source).into_iter();
    let about = all.filter(|found| found.message().contains("removes energy"));
    about.map(|found| found.severity()).collect()
}

#[test]
fn equilibrium_without_damping_is_the_cause() {
    let text = column("  loads:\n    - gravity: [-g]\n");
    assert_eq!(of_check(&text), [Severity::Warning]);
    for found in both(&text, BUDGET) {
        let text = page(&found);
        let parts = ["nothing removes energy", "the body oscillates about its equilibrium"];
        assert_contains(&text, &parts);
        assert!(found.runs.is_empty(), "{text}");
    }
}

#[rstest]
#[case::zero_damping("    - gravity: [-g]\n    - damping: 0\n", &[Severity::Warning])]
#[case::slow_load("    - gravity: [\"-g*min(t/0.3, 1)\"]\n", &[Severity::Note])]
#[case::damped("    - gravity: [-g]\n    - damping: 30\n", &[])]
#[case::local_damping("    - gravity: [-g]\n    - local_damping: 0.5\n", &[])]
fn check_warns_of_an_equilibrium_without_damping(
    #[case] loads: &str,
    #[case] expected: &[Severity],
) {
    assert_eq!(of_check(&column(&format!("  loads:\n{loads}"))), expected);
}

/// The damping is too weak for the duration of the run.
#[test]
fn a_body_that_has_not_come_to_rest_is_the_cause() {
    let text = column("  loads:\n    - gravity: [-g]\n    - damping: 6\n");
    let found = diagnosis(&text.replace("until: 0.4", "until: 1"), BUDGET);
    assert_contains(&page(&found), &["the body has not come to rest at the end of the run"]);
}

/// Strains of 1e-2 cause an error of second order in the amplitude.
#[test]
fn error_with_a_tenth_of_the_amplitude_is_printed_unscaled() {
    let text = BAR.replace("1e-4", "0.02").replace("until: 0.4", "until: 0.1");
    let text = text
        .replace("scheme: musl", "scheme: musl, frame: total_lagrangian, start: half_step_back");
    let found = diagnosis(&text, BUDGET);
    let run = found.runs.iter().find(|run| run.change == "a tenth of the amplitude");
    let run = run.expect("a run with a tenth of the amplitude");
    let (cause, _) = found.found().unwrap_or_else(|| panic!("no cause: {found:#?}"));
    assert!(cause.change == run.change && run.ratio < 0.2, "{found:#?}");
    assert!((run.ratio - run.error / found.finest_error).abs() <= 1e-12, "{run:#?}");
    assert!((run.relative_ratio / run.ratio - 10.0).abs() <= 1e-9, "{run:#?}");
    let of =
        format!("is {:.3e}, 1/{:.0} of {:.3e}", run.error, 1.0 / run.ratio, found.finest_error);
    assert_contains(&page(&found), &[of.as_str(), "; relative to the exact solution, it is "]);
}

/// The error of a sum is divided by the size of the sum, which decreases with the amplitude.
#[test]
fn a_sum_is_compared_with_its_own_size() {
    let text = BAR.replace("1e-4", "0.02").replace("until: 0.4", "until: 0.1");
    let found = diagnosis(&format!("{text}judge: {{of: kinetic_energy}}\n"), BUDGET);
    let run = found.runs.iter().find(|run| run.change == "a tenth of the amplitude");
    let run = run.unwrap_or_else(|| panic!("{found:#?}"));
    assert!((run.relative_ratio / run.ratio - 1.0).abs() <= 1e-6, "{run:#?}");
}

#[test]
fn settings_of_an_external_solver_are_not_changed() {
    let text = BAR.replace("scheme: musl", "scheme: usf").replace("until: 0.4", "until: 0.1");
    let found = external_diagnosis(&text, BUDGET);
    assert!(!found.is_sound() && !found.runs.is_empty(), "{found:#?}");
    let is_setting =
        |change: &str| ["`", "the consistent mass"].iter().any(|s| change.starts_with(s));
    assert!(found.runs.iter().all(|run| !is_setting(&run.change)), "{found:#?}");
    assert_contains(&page(&found), &["are not changed, because the solver is external"]);
}
