//! Solvers that a suite lists among its methods.

use super::bar;
use crate::common::solver::solver;
use crate::common::valid_suite;
use crate::testing::OwnSolver;
use mpm_verify::external::SolverFactory;
use mpm_verify::study::Runner;
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{ExternalMethod, Suite};
use mpm_verify::verify::CaseOutcome;
use rstest::rstest;

fn with_entry(entry: &str) -> String {
    bar().replace("  - fem: {element: linear, mass: lumped}", &format!("  - external: {entry}"))
}

/// Runs the cases of the solver `differences` and of no other method.
fn of_solver(suite: &str) -> Vec<CaseOutcome> {
    let solver = solver("differences", |problem| OwnSolver.subject(problem));
    let (name, precision) = (solver.name(), solver.precision());
    let method = ExternalMethod { name, formal_order: 3.0, precision };
    let suite = valid_suite(suite).of_external(method, None).expect("a convergence study");
    Runner::new(&suite).judging(&solver).run(&|| ()).cases
}

#[test]
fn a_solver_meets_the_expectation_that_the_suite_states() {
    let cases = of_solver(&with_entry("{name: differences}"));
    assert_eq!((cases.len(), cases[0].case.as_str()), (1, "differences"));
    assert_eq!(cases[0].because, "linear basis functions have order 2");
    assert!(cases[0].passed() && cases[0].verdict.contains("converging"), "{}", cases[0].reason);
}

#[test]
fn solver_with_another_name_is_compared_only_with_theory() {
    let cases = of_solver(&with_entry("{name: volumes}"));
    assert_eq!((cases.len(), cases[0].case.as_str()), (1, "differences"));
    assert_eq!(cases[0].expected, None);
}

#[test]
fn without_its_command_a_solver_is_not_applicable_and_others_are_judged() {
    let suite = valid_suite(&with_entry("{name: differences, formal_order: 2}"));
    let cases = Runner::new(&suite).run(&|| ()).cases;
    let results: Vec<_> =
        cases.iter().map(|case| (case.case.as_str(), case.result().name())).collect();
    assert_eq!(results, [("mpm-linear-flip-musl", "pass"), ("differences", "not applicable")]);
    assert_eq!(cases[1].lacks, ["`--solver COMMAND`"]);
}

#[test]
fn automatic_step_of_a_solver_is_a_share_of_the_crossing_time() {
    let text = with_entry("{name: differences}")
        .replace("until: 0.004, dt: \"h/250\"", "until: 0.05, dt: {courant: 0.05}");
    let cases = of_solver(&text);
    let study = cases[0].convergence().expect("a study");
    for level in &study.levels {
        assert!((level.dt / (0.05 * level.h / 10.0) - 1.0).abs() < 0.01, "{}", level.dt);
    }
}

#[rstest]
#[case::a_space("{name: my solver}", "this is not a name for a solver")]
#[case::no_name("{formal_order: 2}", "missing key `name`")]
#[case::no_order("{name: a, formal_order: 0}", "the formal order is 0, but must be above zero")]
#[case::a_high_order("{name: a, formal_order: 21}", "the formal order is 21")]
#[case::another_precision("{name: a, precision: half}", "`half`")]
#[case::a_command("{name: a, command: rm}", "unknown key `command`")]
fn an_entry_with(#[case] entry: &str, #[case] words: &str) {
    let source = Source::from_text("bar.yaml", with_entry(entry)).expect("a text");
    let shown = Suite::load(&source).expect_err("a mistake").to_string();
    assert!(shown.contains(words), "no `{words}` in\n{shown}");
}

#[test]
fn a_solver_needs_particles() {
    let text = with_entry("{name: a}").replace(", ppc: 4}", "}");
    let text = text.replace("  - mpm: {basis: linear, transfer: flip, scheme: musl}\n", "");
    let source = Source::from_text("bar.yaml", &text).expect("a text");
    let shown = Suite::load(&source).expect_err("a mistake").to_string();
    assert!(shown.contains("a solver needs particles, but `refine` has no `ppc`"), "{shown}");
}
