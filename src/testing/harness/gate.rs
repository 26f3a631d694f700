//! Tests of a suite: comparisons with theory and with the snapshot, and run times of cases.

use crate::external::SolverFactory;
use crate::report;
use crate::study::{Runner, lacking, under};
use crate::suite::yaml::Source;
use crate::suite::{Suite, violations};
use crate::testing::conformance::examined;
use crate::verify::{CaseOutcome, SuiteOutcome};
use insta::{Comparator, Settings, Snapshot, assert_snapshot};
use libtest_mimic::{Completion, Failed, Trial};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf, absolute};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

pub(super) struct Gate {
    pub(super) folder: PathBuf,
    pub(super) snapshots: PathBuf,
    pub(super) solver: Option<&'static dyn SolverFactory>,
    pub(super) with_overview: bool,
}

impl Gate {
    /// Returns the tests for all files, or a failing test if the folder contains no suites.
    pub(super) fn trials(&self) -> Vec<Trial> {
        let shown = self.folder.display();
        let nothing = |why: String| vec![broken("suites::exist", why)];
        let files = match Source::files_in(&self.folder) {
            Ok(files) if files.is_empty() => {
                return nothing(format!("no suite in the folder {shown}"));
            }
            Ok(files) => files,
            Err(error) => return nothing(format!("{shown}: {error}")),
        };
        // In parallel, because the check of an exact solution takes 0.1 s.
        let found: Vec<_> = files.par_iter().map(|file| self.of_file(file)).collect();
        let (mut trials, mut suites) = (Vec::new(), Vec::new());
        for (cases, suite) in found {
            trials.extend(cases);
            suites.extend(suite);
        }
        // Report tests come last: each one blocks a thread until all its cases are complete.
        trials.extend(suites.iter().map(report));
        if self.with_overview {
            trials.extend(self.of_all(suites));
        }
        trials
    }

    fn of_all(&self, suites: Vec<Arc<SharedSuite>>) -> [Trial; 2] {
        let suites: Arc<[Arc<SharedSuite>]> = suites.into();
        let trial = |name: &'static str, text: fn(&[SuiteOutcome]) -> String| {
            let (suites, folder) = (Arc::clone(&suites), self.snapshots.clone());
            Trial::test(name, move || {
                let outcomes: Vec<SuiteOutcome> =
                    suites.iter().map(|suite| suite.outcome().clone()).collect();
                compare_snapshot(name, &text(&outcomes), &folder)
            })
        };
        [trial("OVERVIEW", report::overview), trial("profile", report::profiles)]
    }

    fn of_file(&self, file: &Path) -> (Vec<Trial>, Option<Arc<SharedSuite>>) {
        let stem = stem(file);
        let unusable = |why: String| (vec![broken(&format!("{stem}::parse"), why)], None);
        let load = |source: Source| Suite::load(&source).map(|suite| (source, suite));
        match Source::read(file).and_then(load) {
            Ok((_, suite)) if suite.name != stem => unusable(format!(
                "the file {} contains the suite `{}`: rename one of them",
                file.display(),
                suite.name
            )),
            Ok((source, suite)) => self.of_suite(source, suite, &self.snapshots_of(file)),
            Err(diagnostic) => unusable(diagnostic.to_string()),
        }
    }

    fn snapshots_of(&self, file: &Path) -> PathBuf {
        let folder = file.parent().unwrap_or(Path::new(""));
        self.snapshots.join(folder.strip_prefix(&self.folder).unwrap_or(Path::new("")))
    }

    fn of_suite(
        &self,
        source: Source,
        suite: Suite,
        snapshots: &Path,
    ) -> (Vec<Trial>, Option<Arc<SharedSuite>>) {
        let suite = match self.solver {
            None => suite,
            Some(solver) => match judged(&suite, solver) {
                Ok(suite) => suite,
                Err(why) => {
                    let name = format!("{}::{}", suite.name, solver.name());
                    let ignored = move || Ok(Completion::ignored_with(&why));
                    return (vec![Trial::ignorable_test(name, ignored)], None);
                }
            },
        };
        let (trials, suite) = trials(source, suite, snapshots, self.solver);
        (trials, Some(suite))
    }
}

fn judged(suite: &Suite, solver: &dyn SolverFactory) -> Result<Suite, String> {
    let suite =
        under(suite, solver, true).ok_or("the suite examines internals of the built-in methods")?;
    match lacking(&suite, solver) {
        lacks if lacks.is_empty() => Ok(suite),
        lacks => Err(format!("the solver lacks {}", lacks.join(", "))),
    }
}

fn broken(name: &str, message: String) -> Trial {
    Trial::test(name, || Err(message.into()))
}

fn stem(file: &Path) -> String {
    file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn conforms(solver: &dyn SolverFactory, suite: &Suite) -> Result<Completion, Failed> {
    match examined(solver, suite) {
        Err(why) => Ok(Completion::ignored_with(why)),
        Ok(breaches) if breaches.is_empty() => Ok(Completion::Completed),
        Ok(breaches) => {
            Err(breaches.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n").into())
        }
    }
}

/// A suite and its outcomes. Each case runs once, even if several tests need it.
struct SharedSuite {
    source: Source,
    suite: &'static Suite,
    runner: Runner<'static>,
    snapshots: PathBuf,
    outcomes: Vec<OnceLock<CaseOutcome>>,
    whole: OnceLock<SuiteOutcome>,
}

impl SharedSuite {
    fn case(&self, index: usize) -> &CaseOutcome {
        self.outcomes[index].get_or_init(|| {
            let start = Instant::now();
            let outcome = self.runner.case(index, &|| ());
            record_time(start.elapsed(), &format!("{}::{}", self.suite.name, outcome.case));
            outcome
        })
    }

    fn hold(&self, index: usize) -> Result<Completion, Failed> {
        let outcome = self.case(index);
        if !outcome.is_tested() {
            return Ok(Completion::ignored_with(&outcome.reason));
        }
        if outcome.passed() {
            return Ok(Completion::Completed);
        }
        let violations = violations(&self.source, &self.suite.name, outcome);
        let violations: Vec<String> = violations.iter().map(ToString::to_string).collect();
        Err(format!("{}\n\n{}", violations.join("\n"), report::case(outcome)).into())
    }

    fn outcome(&self) -> &SuiteOutcome {
        self.whole.get_or_init(|| {
            let cases = (0..self.outcomes.len()).map(|index| self.case(index).clone()).collect();
            self.runner.outcome(cases)
        })
    }

    /// Compares the report with its snapshot, unless no case was run.
    fn compare_report(&self) -> Result<Completion, Failed> {
        let outcome = self.outcome();
        if let [first, ..] = &outcome.cases[..]
            && !outcome.cases.iter().any(CaseOutcome::is_tested)
        {
            return Ok(Completion::ignored_with(&first.reason));
        }
        compare_snapshot(&self.suite.name, &report::text(outcome), &self.snapshots)?;
        Ok(Completion::Completed)
    }
}

fn report(suite: &Arc<SharedSuite>) -> Trial {
    let of_report = Arc::clone(suite);
    Trial::ignorable_test(format!("{}::report", suite.suite.name), move || {
        of_report.compare_report()
    })
}

fn trials(
    source: Source,
    suite: Suite,
    snapshots: &Path,
    solver: Option<&'static dyn SolverFactory>,
) -> (Vec<Trial>, Arc<SharedSuite>) {
    // The tests exist until the end of the process, so the suite must too.
    let suite: &'static Suite = Box::leak(Box::new(suite));
    let names = suite.case_names();
    let runner = Runner::new(suite);
    let shared = Arc::new(SharedSuite {
        source,
        suite,
        runner: match solver {
            Some(solver) => runner.judging(solver),
            None => runner,
        },
        snapshots: snapshots.to_owned(),
        outcomes: names.iter().map(|_| OnceLock::new()).collect(),
        whole: OnceLock::new(),
    });
    let case = |(index, case): (usize, &&str)| {
        let shared = Arc::clone(&shared);
        // Cases without expectations are ignored: a passing test would suggest a met expectation.
        Trial::ignorable_test(format!("{}::{case}", suite.name), move || shared.hold(index))
            .with_ignored_flag(suite.explores())
    };
    let mut trials: Vec<Trial> = names.iter().enumerate().map(case).collect();
    trials.extend(solver.map(|solver| {
        let name = format!("{}::conformance", suite.name);
        Trial::ignorable_test(name, || conforms(solver, suite))
    }));
    (trials, shared)
}

pub(super) fn compare_snapshot(suite: &str, text: &str, folder: &Path) -> Result<(), Failed> {
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(absolute(folder)?);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(ReportDrift));
    let compare = || assert_snapshot!(suite, text);
    let outcome = catch_unwind(AssertUnwindSafe(|| settings.bind(compare)));
    outcome.map_err(|_| {
        let file = folder.join(format!("{suite}.snap"));
        let what = if file.exists() { "differs from" } else { "is not yet stored as" };
        format!(
            "the report of {suite} {what} {} (the difference is printed above).\nIf the change is \
             intended, accept it with `cargo insta review`, or with `INSTA_UPDATE=always cargo \
             test {suite}`, and explain the change in the commit message.",
            file.display()
        )
        .into()
    })
}

/// Compares reports number by number, see [`report::drift`].
#[derive(Clone)]
struct ReportDrift;

impl Comparator for ReportDrift {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (reference.as_text(), test.as_text()) {
            (Some(old), Some(new)) => report::drift::same(&old.to_string(), &new.to_string()),
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}

static CASES: Mutex<Vec<(Duration, String)>> = Mutex::new(Vec::new());

/// Maximum number of cases, and of suites, in the list of the slowest.
const SHOWN: usize = 10;

pub(super) fn record_time(time: Duration, case: &str) {
    CASES.lock().unwrap_or_else(PoisonError::into_inner).push((time, case.to_string()));
}

/// Returns the slowest cases and suites; empty if there are only a few cases.
pub(super) fn slowest_cases() -> String {
    slowest(CASES.lock().unwrap_or_else(PoisonError::into_inner).clone())
}

fn slowest(mut cases: Vec<(Duration, String)>) -> String {
    if cases.len() <= SHOWN {
        return String::new();
    }
    cases.sort_by(|a, b| b.cmp(a));
    let mut text = format!(
        "slowest of {} cases; times include waiting for other cases (`--test-threads 1`: no \
         waiting)\n",
        cases.len()
    );
    let line = |time: &Duration, name: &str| format!("{:>8.2} s  {name}\n", time.as_secs_f64());
    text.extend(cases.iter().take(SHOWN).map(|(time, case)| line(time, case)));
    let mut suites = BTreeMap::<&str, Duration>::new();
    for (time, case) in &cases {
        *suites.entry(case.split("::").next().unwrap_or(case)).or_default() += *time;
    }
    let mut suites: Vec<_> = suites.into_iter().collect();
    suites.sort_by_key(|(_, time)| Reverse(*time));
    text += "slowest suites:\n";
    text.extend(suites.iter().take(SHOWN).map(|(suite, time)| line(time, suite)));
    text + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Cases of 1 to 11 s; suite b has those of 2, 4, 6 and 11 s.
    #[test]
    fn slowest_cases_and_suites_are_listed_with_their_times() {
        let name = |k: u64| if [2, 4, 6, 11].contains(&k) { "b" } else { "a" };
        let case = |k: u64| (Duration::from_millis(1000 * k), format!("{}::{k}", name(k)));
        let line = |k: u64| format!("{k:>5}.00 s  {}::{k}\n", name(k));
        let listed: String = (2..=11).rev().map(line).collect();
        let text = slowest((1..=11).map(case).collect());
        let (first, rest) = text.split_once('\n').expect("several lines");
        assert!(first.starts_with("slowest of 11 cases; "), "{first}");
        let suites = "slowest suites:\n   43.00 s  a\n   23.00 s  b\n\n";
        assert_eq!(rest, format!("{listed}{suites}"));
        assert_eq!(slowest((1..=10).map(case).collect()), "");
    }

    /// The failure message names the snapshot file and the command that accepts the change.
    #[test]
    fn snapshot_failure_names_file_and_accept_command() {
        let folder = std::env::temp_dir().join(format!("mpm-verify-drift-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let said = |suite: &str| {
            let failed =
                compare_snapshot(suite, "error  1.0e-3\n", &folder).expect_err("a difference");
            failed.message().unwrap_or_default().to_owned()
        };
        fs::write(folder.join("bar.snap"), "---\n---\nerror  1.1e-3\n").expect("a snapshot");
        let (kept, new) = (said("bar"), said("beam"));
        fs::remove_dir_all(&folder).expect("the folder");
        assert!(kept.starts_with("the report of bar differs from "), "{kept}");
        assert!(kept.contains("`INSTA_UPDATE=always cargo test bar`"), "{kept}");
        assert!(new.starts_with("the report of beam is not yet stored as "), "{new}");
    }
}
