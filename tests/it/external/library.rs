//! Solvers that a user of the library implements in Rust, and solvers that a suite lists.

use super::bar;
use crate::common::solver::{Solver, prescribed, solver};
use crate::common::{built_in_suite, levels, valid_suite};
use crate::testing::OwnSolver;
use mpm_verify::embedded;
use mpm_verify::external::{Capabilities, SolverFactory};
use mpm_verify::study::{Runner, lacking, under};
use mpm_verify::subject::Failure;
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Extent, ExternalMethod, Suite};
use mpm_verify::verify::{CaseOutcome, CaseResult};
use rayon::prelude::*;
use rstest::rstest;

#[test]
fn refused_problem_is_not_applicable() {
    let refusing = solver("refusing", |_| Err("a left end that is held".into()));
    let suite = under(&valid_suite(&bar()), &refusing, true).expect("a convergence study");
    let found = Runner::new(&suite).judging(&refusing).case(0, &|| ());
    let result = (found.result().name(), found.verdict.as_str());
    assert_eq!(result, ("not applicable", "not applicable"));
    assert!(found.reason.contains("a left end that is held"), "{}", found.reason);
}

#[test]
fn a_solver_that_fails_in_its_setup_fails_the_case() {
    let failing = solver("failing", |_| Err(Failure::External("out of memory".to_owned()).into()));
    for name in ["vibrating-bar", "crossing-energy"] {
        let suite = built_in_suite(name);
        let suite = under(&suite, &failing, true).expect("a study of solvers");
        let found = Runner::over(&suite, Extent::Usual).judging(&failing).case(0, &|| ());
        assert!(!found.passed(), "{name}: {} {}", found.verdict, found.reason);
        assert!(found.unmet.iter().any(|unmet| unmet.text.contains("out of memory")), "{name}");
    }
}

/// The suite has the law `linear_elastic`, small strains and `any_law`.
#[rstest]
#[case::isotropic_elastic("hencky", true)]
#[case::plastic("j2", false)]
fn only_isotropic_elastic_laws_replace_a_law_at_small_strains(
    #[case] law: &'static str,
    #[case] replaces: bool,
) {
    let suite = built_in_suite("lame-square");
    let able = Some(Capabilities::of(&[2], &[law], &["free"], &[]));
    let solver = Solver { able, ..solver("of-law", |_| Err("nothing runs here".into())) };
    let judged = under(&suite, &solver, false).expect("a suite for solvers");
    assert_eq!(lacking(&judged, &solver).is_empty(), replaces);
    let plan = judged.convergence().expect("a convergence study");
    let own = suite.convergence().expect("a convergence study").scene.material.parameters();
    assert_eq!(plan.scene.material.parameters(), own);
    assert_eq!(plan.scene.material.name(), if replaces { law } else { "linear_elastic" });
}

/// Suites whose judged quantity does not change, or has its initial value at the end.
const UNCHANGED: &str = "\
    geostatic-column geostatic-drucker-prager geostatic-mohr-coulomb geostatic-slope \
    geostatic-slope-3d load-steps-geostatic-drucker-prager pressurised-cylinder \
    pressurised-cylinder-in-plane rotating-block spinning-disk sticking-block sticking-layers \
    time-step-auto translating-stressed-bar translating-stressed-plate vibrating-bar-long";

/// A suite whose displacement vanishes at the end would accept a solver that does nothing.
#[test]
fn motionless_solver_passes_no_other_suite() {
    let motionless = solver("motionless", |problem| {
        Ok(prescribed(problem, |problem, _, samples| {
            let start = &problem.particles;
            let displaced = start.position.iter().zip(&start.reference_position);
            samples.displacement = displaced.map(|(x, label)| x - label).collect();
            samples.velocity.clone_from(&start.velocity);
            samples.stress.clone_from(&start.stress);
        }))
    });
    let passes = |name: &&str| {
        let source = embedded::source(name).expect("a suite").expect("a text").trusted();
        let suite = Suite::load(&source).expect("a sound suite");
        let Some(judged) = under(&suite, &motionless, true) else { return false };
        if judged.convergence().is_none() {
            return false;
        }
        let runner = Runner::over(&judged, Extent::Usual).judging(&motionless);
        let cases = (0..judged.case_names().len()).map(|case| runner.case(case, &|| ()));
        cases.into_iter().any(|case| case.result() == CaseResult::Pass)
    };
    let names: Vec<&str> = embedded::names().collect();
    let found: Vec<&str> = names.into_par_iter().filter(passes).collect();
    assert_eq!(found.join(" "), UNCHANGED);
}

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
    for level in levels(&cases[0]) {
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
