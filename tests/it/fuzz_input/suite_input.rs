//! Interprets bytes as the text of a suite.

use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};

/// Loads the bytes as a suite. Panics if loading panics, if an error does not name the file, or if
/// an accepted suite cannot be described.
pub(crate) fn load(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let loaded = Source::from_text("suite.yaml", text).and_then(|source| Suite::load(&source));
    match loaded {
        Ok(suite) => state(&suite),
        Err(diagnostic) => is_placed(&diagnostic),
    }
}

fn state(suite: &Suite) {
    let runner = Runner::new(suite);
    assert!(!suite.case_names().is_empty(), "a suite without a case");
    assert!(runner.units() > 0, "a suite without a run");
    assert!(!runner.outcome(Vec::new()).statement.is_empty(), "a suite that states nothing");
}

fn is_placed(diagnostic: &Diagnostic) {
    let shown = diagnostic.to_string();
    assert!(shown.contains("suite.yaml"), "a complaint about nothing: {shown}");
}
