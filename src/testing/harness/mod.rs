//! Generates a test for each case of each suite in a folder.
//!
//! There are two independent kinds of check. Comparisons with theory are asserted in plain Rust, so
//! that no environment variable and no snapshot command can accept a failure. Reports are compared
//! with snapshots: `cargo insta review` shows changes and accepts them.

mod gate;

use crate::external::SolverFactory;
use gate::Gate;
use libtest_mimic::Arguments;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

/// Number of tests that may wait for their cases at the same time, per rayon thread.
const WAITING: usize = 4;

/// Runs the suites of a folder as tests. `SUITE::CASE` compares a case with its expectation,
/// `SUITE::report` compares the report of a suite with its snapshot, and `SUITE::conformance`
/// checks that a solver conforms to the contract of `Subject`. `FILE::parse` fails if a file is not
/// a valid suite.
///
/// Example: `tests/verification.rs`, for which `Cargo.toml` sets `harness = false`:
///
/// ```no_run
/// # mod of_yours {
/// #     use mpm_verify::prelude::*;
/// #     pub struct MySolver;
/// #     impl SolverFactory for MySolver {
/// #         fn name(&self) -> &str { "mine" }
/// #         fn subject(&self, _: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
/// #             todo!()
/// #         }
/// #     }
/// # }
/// # use of_yours::MySolver;
/// fn main() -> std::process::ExitCode {
///     mpm_verify::testing::SuiteFolder::new("verification").judging(MySolver).main()
/// }
/// ```
///
/// Suites are found when the tests run, so new files need no registration.
pub struct SuiteFolder(Gate);

impl SuiteFolder {
    /// Tests the suites of a folder, relative to the root of the package, with their methods.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        let folder = folder.into();
        Self(Gate { snapshots: folder.clone(), folder, solver: None, with_overview: false })
    }

    /// Tests a solver in place of the methods of the suites. The observed order is compared with
    /// the expectation of the suite for this solver or, without one, with the order that the solver
    /// states. A case that needs a missing capability is ignored with the reason.
    #[must_use]
    pub fn judging(mut self, solver: impl SolverFactory + 'static) -> Self {
        // The tests exist until the end of the process, so the solver must too.
        self.0.solver = Some(Box::leak(Box::new(solver)));
        self
    }

    /// Sets the folder of the snapshots; the default is the folder of the suites.
    #[must_use]
    pub fn snapshots(mut self, folder: impl Into<PathBuf>) -> Self {
        self.0.snapshots = folder.into();
        self
    }

    /// Adds two snapshots that cover all suites. `OVERVIEW` contains the result of each case and
    /// the matrix of problems and methods; `profile` contains the memory and passes of a step.
    #[must_use]
    pub fn with_overview(mut self) -> Self {
        self.0.with_overview = true;
        self
    }

    /// Runs the tests with the command line of `cargo test` or nextest.
    pub fn main(self) -> ExitCode {
        // A test with a changed snapshot panics, and a backtrace would not help.
        std::panic::set_hook(Box::new(|panic| eprintln!("{panic}")));
        if self.run(std::env::args_os()) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
    }

    /// Runs the tests that a command line selects, and returns whether all of them passed.
    pub fn run<Words>(&self, words: Words) -> bool
    where
        Words: IntoIterator,
        Words::Item: Into<OsString> + Clone,
    {
        let mut arguments = Arguments::from_iter(words);
        // Cases run on rayon threads, and a test thread only waits. With more test threads, a rayon
        // thread that finishes its part of one case can start another case.
        arguments.test_threads =
            arguments.test_threads.or(Some(WAITING * rayon::current_num_threads()));
        let found = libtest_mimic::run(&arguments, self.0.trials());
        eprint!("{}", gate::slowest_cases());
        let is_whole = arguments.filter.is_none() && arguments.skip.is_empty() && !arguments.list;
        if is_whole && self.0.solver.is_some() && found.num_passed + found.num_failed == 0 {
            eprintln!("error: no case is applicable to the solver");
            return false;
        }
        !found.has_failed()
    }
}
