//! `run --repeat`: the spread between repeated runs of a level.

use super::bar;
use super::library::Maker;
use crate::common::folder::assert_contains;
use crate::common::valid_suite;
use mpm_verify::external::{LevelProblem, SolverFactory};
use mpm_verify::report;
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{Failure, RunCounters, Samples, Subject, SubjectError};
use mpm_verify::suite::Extent;
use mpm_verify::verify::{CaseOutcome, Exclusion, LevelOutcome, SuiteOutcome};
use std::sync::atomic::{AtomicU64, Ordering};

/// Finite differences whose displacements differ between runs by up to `noise` (m) at every
/// particle, as if each run added in another order.
struct Unsteady {
    noise: f64,
    runs: AtomicU64,
}

struct Perturbed {
    solver: Box<dyn Subject>,
    noise: f64,
    run: u64,
}

impl Subject for Perturbed {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.solver.step(dt)
    }

    fn sample(&self, samples: &mut Samples) {
        self.solver.sample(samples);
        // A linear congruential generator, with another stream for each run.
        let mut state = self.run.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        for u in &mut samples.displacement {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let share = (state >> 11) as f64 / (1_u64 << 53) as f64;
            *u += self.noise * (2.0 * share - 1.0);
        }
    }

    fn counters(&self) -> RunCounters {
        self.solver.counters()
    }
}

impl SolverFactory for Unsteady {
    fn name(&self) -> &'static str {
        "unsteady"
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let solver = Maker("differences").subject(problem)?;
        let run = self.runs.fetch_add(1, Ordering::Relaxed);
        Ok(Box::new(Perturbed { solver, noise: self.noise, run }))
    }
}

/// Runs each level of the suite three times with the unsteady solver.
fn repeated(noise: f64) -> SuiteOutcome {
    let solver = Unsteady { noise, runs: AtomicU64::new(1) };
    let suite = under(&valid_suite(&bar()), &solver, false).expect("a convergence study");
    Runner::over(&suite, Extent::Usual).judging(&solver).repeating(3).run(&|| ())
}

fn levels(case: &CaseOutcome) -> &[LevelOutcome] {
    &case.convergence().expect("a convergence study").levels
}

#[test]
fn a_deterministic_solver_has_no_spread() {
    let found = repeated(0.0);
    let case = &found.cases[0];
    for level in levels(case) {
        assert_eq!(level.spread.map(f64::to_bits), Some(0));
    }
    assert_eq!(case.verdict, "converging", "{}", case.reason);
    let text = report::text(&found);
    assert!(text.contains("spread between runs, in the norm of the error"), "{text}");
}

/// In the RMS norm, two of three runs differ by `noise` times the root of 2/3 on average.
#[test]
fn the_spread_is_the_difference_between_runs() {
    let steady = repeated(0.0);
    let noise = levels(&steady.cases[0]).last().expect("a level").error / 20.0;
    let found = repeated(noise);
    for level in levels(&found.cases[0]) {
        let spread = level.spread.expect("a spread");
        assert!(spread > 0.4 * noise && spread < 1.5 * noise, "{spread}");
        assert_eq!(level.exclusion(), None);
    }
}

#[test]
fn a_level_whose_spread_exceeds_a_tenth_of_its_error_does_not_count() {
    let steady = repeated(0.0);
    let errors: Vec<f64> = levels(&steady.cases[0]).iter().map(|level| level.error).collect();
    let [.., coarser, finest] = errors[..] else { panic!("two levels or more") };
    assert!(coarser > 2.0 * finest, "{errors:?}");
    // The spread is about 0.8 of the noise. This is 1/7 of the finest error, and less of the other
    // errors.
    let found = repeated(finest / 6.0);
    let case = &found.cases[0];
    let exclusions: Vec<_> = levels(case).iter().map(LevelOutcome::exclusion).collect();
    assert_eq!(exclusions.last(), Some(&Some(Exclusion::Spread)), "{:?}", levels(case));
    assert_eq!(exclusions[..exclusions.len() - 1], vec![None; exclusions.len() - 1]);
    assert_eq!(case.verdict, "too few levels", "{}", case.reason);
    let remark = "not counted because the spread between runs exceeds a tenth of the error";
    assert!(case.reason.contains(remark), "{}", case.reason);
    let json = report::json(std::slice::from_ref(&found));
    assert_contains(&json, &[r#""excluded_by": "spread""#, r#""counts": false"#, r#""spread": "#]);
}

#[cfg(unix)]
mod command_line {
    use super::super::bar;
    use super::super::program::solver_of;
    use crate::cli::{Folder, SOUND};

    /// Each run of each of the four levels must have its own process.
    #[test]
    fn each_run_has_a_new_process() {
        let folder = Folder::with("bar.yaml", bar());
        let logging = "echo $$ >>log\necho '{\"type\":\"ready\"}'";
        let script = solver_of("h * h");
        folder.write("solver.sh", script.replace("echo '{\"type\":\"ready\"}'", logging));
        let found = folder
            .call(&["run", "bar.yaml", "--solver", "sh solver.sh", "--repeat", "3"])
            .ended(SOUND);
        assert!(found.out.contains("spread between runs"), "{}", found.out);
        let log = folder.read("log");
        let mut processes: Vec<&str> = log.lines().collect();
        processes.sort_unstable();
        processes.dedup();
        assert_eq!(processes.len(), 12, "{log}");
    }

    #[test]
    fn a_repetition_without_a_spread_is_refused() {
        let folder = Folder::with("bar.yaml", bar());
        for (arguments, reason) in [
            (&["--repeat", "1"][..], "--repeat 1: a spread needs two runs or more"),
            (&["--repeat", "0"], "--repeat 0: a spread needs two runs or more"),
            (&["--repeat", "101"], "--repeat 101: expected a number from 2 to 100"),
            (&["--repeat", "-3"], "expected a whole number"),
            (&["--repeat", "two"], "expected a whole number"),
            (&["--repeat", "3", "--resume", "kept"], "stored levels have one run each"),
        ] {
            let errors = folder.refused(&[&["run", "bar.yaml"], arguments].concat());
            assert!(errors.contains(reason), "no `{reason}` in {errors}");
        }
    }
}
