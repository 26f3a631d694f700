//! What the page is made of.

use crate::verify::SuiteOutcome;

/// A suite that has run, and the file that it came from.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// What was found.
    pub outcome: &'a SuiteOutcome,
    /// Name of the file, without folders: these are the machine's.
    pub file: &'a str,
    /// What the file says.
    pub yaml: &'a str,
}
