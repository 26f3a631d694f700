//! Runs one suite like the gate and prints the result of each gate. `ci/defects` builds this
//! program in a scratch copy of the repository, with the defects of this folder behind switches.
//!
//! Arguments: the file of a suite, and the folder of snapshots. Output: one line of JSON with the
//! keys `suite`, `load` (null, or why the suite is refused), `cases` (case, gate and message of
//! each failure) and `drift` (whether the report has changed).

mod gate;

use gate::gate;
use mpm_verify::report;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::SuiteOutcome;
use std::path::Path;
use std::{env, fs};

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [file, snapshots] = &arguments[..] else { panic!("arguments: SUITE.yaml SNAPSHOTS") };
    let name = Path::new(file).file_stem().expect("a file").to_string_lossy().into_owned();
    let found = match Source::read(file).and_then(|source| Suite::load(&source)) {
        Err(refusal) => {
            serde_json::json!({"load": refusal.to_string(), "cases": [], "drift": true})
        }
        Ok(suite) => {
            let outcome = Runner::new(&suite).run(&|| ());
            let snapshot = fs::read_to_string(Path::new(snapshots).join(format!("{name}.snap")));
            let unmet = outcome.cases.iter().flat_map(|case| {
                let gate = |unmet| (case.case.clone(), gate(case, unmet), unmet.to_string());
                case.unmet.iter().map(gate)
            });
            let cases: Vec<_> = unmet.collect();
            let drift = has_drifted(&outcome, &snapshot.expect("a suite has a snapshot"));
            serde_json::json!({"load": null, "cases": cases, "drift": drift})
        }
    };
    println!("{found}");
}

/// Whether the report differs from its snapshot, below whose head it stands.
fn has_drifted(outcome: &SuiteOutcome, snapshot: &str) -> bool {
    !report::drift::same_as_snapshot(snapshot, &report::text(outcome))
}
