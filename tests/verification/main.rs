//! The gate: every case of every suite is a test, named `SUITE::CASE`; see [`SuiteFolder`].

use mpm_verify::testing::SuiteFolder;
use std::process::ExitCode;

fn main() -> ExitCode {
    SuiteFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/verification")).with_overview().main()
}
