//! `run --repeat`: the spread between repeated runs of a level.

use super::bar;
use crate::common::folder::assert_contains;
use crate::common::solver::solver;
use crate::common::{errors, levels, valid_suite};
use crate::testing::OwnSolver;
use approx::assert_relative_eq;
use mpm_verify::external::SolverFactory;
use mpm_verify::report;
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{Failure, RunCounters, Samples, Subject};
use mpm_verify::suite::Extent;
use mpm_verify::verify::{Exclusion, LevelOutcome, SuiteOutcome};
use rstest::rstest;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// A subject whose displacements are larger by `offset` (m), and whose steps fail if `fails`.
struct Perturbed {
    sound: Box<dyn Subject>,
    offset: f64,
    fails: bool,
}

impl Subject for Perturbed {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let stopped = Failure::External("stopped".to_owned());
        if self.fails { Err(stopped) } else { self.sound.step(dt) }
    }

    fn sample(&self, samples: &mut Samples) {
        self.sound.sample(samples);
        samples.displacement.iter_mut().for_each(|u| *u += self.offset);
    }

    fn counters(&self) -> RunCounters {
        self.sound.counters()
    }
}

/// Runs each level of the suite three times, with displacements that are larger by 0, 3 and 1 times
/// `noise` (m). Run number `fails` of the finest level fails. Errors are divided by 1e-6 m.
fn repeated(noise: f64, fails: Option<usize>) -> SuiteOutcome {
    let runs: Mutex<BTreeMap<u64, usize>> = Mutex::default();
    let solver = solver("unsteady", |problem| {
        let cells = problem.grid.cells[0];
        let mut runs = runs.lock().unwrap();
        let run = runs.entry(cells).or_default();
        *run += 1;
        let offset = [0.0, 3.0, 1.0][(*run - 1) % 3] * noise;
        let fails = cells >= 12 && fails == Some(*run);
        Ok(Box::new(Perturbed { sound: OwnSolver.subject(problem)?, offset, fails }))
    });
    let text = bar().replace("observe:", "judge: {scale: 1e-6}\nobserve:");
    let suite = under(&valid_suite(&text), &solver, false).expect("a convergence study");
    Runner::over(&suite, Extent::Usual).judging(&solver).repeating(3).run(&|| ())
}

/// The spread of each level is three times the noise, divided by the scale. The errors are those of
/// the first run.
#[rstest]
#[case::below_a_tenth_of_the_finest_error(0.099, "converging", None)]
#[case::above_a_tenth_of_the_finest_error(0.101, "too few levels", Some(Exclusion::Spread))]
fn a_level_counts_up_to_a_spread_of_a_tenth_of_its_error(
    #[case] share: f64,
    #[case] verdict: &str,
    #[case] finest: Option<Exclusion>,
) {
    let steady = repeated(0.0, None);
    assert!(report::text(&steady).contains("spread between runs, in the norm of the error"));
    assert!(levels(&steady.cases[0]).iter().all(|level| level.spread.map(f64::to_bits) == Some(0)));
    let errors = errors(&steady.cases[0]);
    let error = errors[3];
    assert!(errors[2] > 2.0 * error, "{errors:?}");
    let found = repeated(share * error * 1e-6 / 3.0, None);
    let case = &found.cases[0];
    for (level, error_of_steady) in levels(case).iter().zip(&errors) {
        assert_relative_eq!(level.spread.expect("a spread"), share * error, max_relative = 1e-6);
        assert_eq!(level.error, *error_of_steady);
    }
    let exclusions: Vec<_> = levels(case).iter().map(LevelOutcome::exclusion).collect();
    assert_eq!(exclusions, [None, None, None, finest]);
    assert_eq!(case.verdict, verdict, "{}", case.reason);
    if finest.is_some() {
        let remark =
            "not counted because the spread between runs exceeds a tenth of the error: 12 cells";
        assert!(case.reason.contains(remark), "{}", case.reason);
        let json = report::json(std::slice::from_ref(&found));
        let keys = [r#""excluded_by": "spread""#, r#""counts": false"#, r#""spread": "#];
        assert_contains(&json, &keys);
    }
}

#[test]
fn failure_of_a_later_run_names_the_run() {
    let found = repeated(0.0, Some(2));
    let failures: Vec<_> =
        levels(&found.cases[0]).iter().map(|one| one.run.failure.clone()).collect();
    let failure = failures[3].as_deref().unwrap_or_default();
    assert!(failure.starts_with("run 2 of 3: the solver stopped (step 1, t = "), "{failures:?}");
    assert_eq!(failures[..3], [None, None, None]);
}
