//! Solvers that a user of the library implements in Rust.

use super::bar;
use crate::common::solver::{Solver, prescribed, solver};
use crate::common::{built_in_suite, valid_suite};
use mpm_verify::embedded;
use mpm_verify::external::Capabilities;
use mpm_verify::study::{Runner, lacking, under};
use mpm_verify::subject::Failure;
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::CaseResult;
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
