//! Input of the page.

use crate::verify::SuiteOutcome;

/// A suite that has run, and the file that it came from.
#[derive(Debug, Clone, Copy)]
pub struct SuiteSource<'a> {
    /// Results.
    pub outcome: &'a SuiteOutcome,
    /// Name of the file, without folders: these are the machine's.
    pub file: &'a str,
    /// Text of the file.
    pub yaml: &'a str,
    /// SVG sketch of the scene, where the suite has one.
    pub sketch: Option<&'a str>,
}
