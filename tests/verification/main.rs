//! The gate: every case of every suite is a test, named `SUITE::CASE`; `SUITE::report` holds the
//! suite's report against its snapshot, `FILE::parse` stands for a file that cannot be used.
//!
//! Two gates that never mix. Theory is asserted here in plain Rust: no environment variable and no
//! snapshot command can accept it away. Drift is the snapshot: `cargo insta review` shows and
//! accepts it.
//!
//! Suites are found when the tests run: a new file under `verification/` brings its tests along.

mod slowest;

use insta::{Comparator, Settings, Snapshot, assert_snapshot};
use libtest_mimic::{Arguments, Failed, Trial};
use mpm_verify::report;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::CaseOutcome;
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

fn main() -> ExitCode {
    // A snapshot that differs ends in a panic, whose backtrace tells nobody anything.
    std::panic::set_hook(Box::new(|panic| eprintln!("{panic}")));
    let arguments = Arguments::from_args();
    let trials = files().par_iter().flat_map_iter(|file| trials(file)).collect::<Vec<_>>();
    let trials = if trials.is_empty() { vec![nothing_found()] } else { trials };
    let conclusion = libtest_mimic::run(&arguments, trials);
    eprint!("{}", slowest::summary());
    conclusion.exit_code()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("verification")
}

/// Every suite file, sorted by name.
fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "yaml"));
    files.sort();
    files
}

/// No suite at all is a failure, not a success.
fn nothing_found() -> Trial {
    Trial::test("suites::exist", || Err("no suite under verification/".into()))
}

fn trials(file: &Path) -> Vec<Trial> {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let loaded = Source::read(file).and_then(|source| Suite::load(&source));
    match loaded {
        Ok(suite) if suite.name == stem => suite_trials(suite),
        Ok(suite) => {
            let message = format!("{stem}.yaml calls itself `{}`: rename one of them", suite.name);
            vec![Trial::test(format!("{stem}::parse"), || Err(message.into()))]
        }
        Err(diagnostic) => {
            vec![Trial::test(format!("{stem}::parse"), move || Err(diagnostic.to_string().into()))]
        }
    }
}

/// A suite with its outcomes: each case runs once, whichever tests ask for it.
struct Shared {
    suite: &'static str,
    names: Vec<&'static str>,
    runner: Runner<'static>,
    outcomes: Vec<OnceLock<CaseOutcome>>,
}

impl Shared {
    fn case(&self, index: usize) -> &CaseOutcome {
        self.outcomes[index].get_or_init(|| {
            let start = Instant::now();
            let outcome = self.runner.case(index, &|| ());
            slowest::record(start.elapsed(), &format!("{}::{}", self.suite, self.names[index]));
            outcome
        })
    }
}

fn suite_trials(suite: Suite) -> Vec<Trial> {
    // The tests live as long as the process; so does the suite.
    let suite: &'static Suite = Box::leak(Box::new(suite));
    let names = suite.case_names();
    let outcomes = names.iter().map(|_| OnceLock::new()).collect();
    let runner = Runner::new(suite);
    let shared = Arc::new(Shared { suite: &suite.name, names: names.clone(), runner, outcomes });
    let case = |(index, name): (usize, &&str)| {
        let shared = Arc::clone(&shared);
        // Of a suite that explores nothing is expected: it must not look like a gate that passed.
        Trial::test(format!("{}::{name}", suite.name), move || theory(shared.case(index)))
            .with_ignored_flag(suite.explores())
    };
    let mut trials: Vec<Trial> = names.iter().enumerate().map(case).collect();
    let shared = Arc::clone(&shared);
    trials.push(Trial::test(format!("{}::report", suite.name), move || drift(suite, &shared)));
    trials
}

/// The first gate.
fn theory(outcome: &CaseOutcome) -> Result<(), Failed> {
    if outcome.passed() {
        return Ok(());
    }
    Err(format!("{}\n\n{}", outcome.unmet.join("\n"), report::case(outcome)).into())
}

/// The second gate.
fn drift(suite: &Suite, shared: &Shared) -> Result<(), Failed> {
    let cases = (0..shared.outcomes.len()).map(|index| shared.case(index).clone()).collect();
    let text = report::text(&shared.runner.outcome(cases));
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(folder());
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(Drift));
    let compare = || assert_snapshot!(suite.name.clone(), text);
    let outcome = catch_unwind(AssertUnwindSafe(|| settings.bind(compare)));
    outcome.map_err(|_| {
        format!(
            "the report of {0} has drifted from verification/{0}.snap (the difference stands \
             above).\nIf the change is meant, accept it with `cargo insta review`, or with \
             `INSTA_UPDATE=always cargo test {0}::report`, and say in the commit why it moved.",
            suite.name
        )
        .into()
    })
}

/// Compares reports number by number; see [`report::drift`].
#[derive(Clone)]
struct Drift;

impl Comparator for Drift {
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
