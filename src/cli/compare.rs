//! `mpm-verify compare`.

use super::args::{CompareArgs, Page};
use super::output;
use super::status::{BAD_INPUT, FAILED, PASSED};
use mpm_verify::report::compare;
use mpm_verify::report::compare::{ReportComparison, ReportDocument, Unreadable};
use mpm_verify::suite::yaml::Diagnostic;
use std::fs;
use std::ops::Range;
use std::path::Path;

/// Prints what moved between two runs. Both files are read first: who has two bad ones learns of
/// both.
pub(super) fn compare(args: &CompareArgs) -> u8 {
    let tolerance = args.tolerance;
    if !(tolerance.is_finite() && tolerance >= 0.0) {
        let message = "expected a share of at least 0, such as 0.001";
        output::complain(&format!("error: --tolerance {tolerance}: {message}"));
        return BAD_INPUT;
    }
    let (old, new) = match (document(&args.old), document(&args.new)) {
        (Ok(old), Ok(new)) => (old, new),
        (old, new) => {
            for diagnostic in [old.err(), new.err()].into_iter().flatten() {
                output::diagnose(&diagnostic);
            }
            return BAD_INPUT;
        }
    };
    print(&compare::compare(&old, &new, tolerance), args.format)
}

/// Prints a comparison, and gives the exit status that it stands for.
pub(super) fn print(found: &ReportComparison, format: Page) -> u8 {
    output::print(&match format {
        Page::Text => compare::text(found),
        Page::Markdown => compare::markdown(found),
        Page::Json => compare::json(found),
    });
    if found.is_worse() { FAILED } else { PASSED }
}

fn document(path: &Path) -> Result<ReportDocument, Diagnostic> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|error| {
        let message = format!("this file cannot be read: {error}");
        Diagnostic::about(&file, &message)
    })?;
    ReportDocument::read(&text).map_err(|unreadable| {
        let Unreadable { message, place } = unreadable;
        let diagnostic = match place {
            Some(place) => Diagnostic::at(&file, &text, bytes(&text, place), &message),
            None => Diagnostic::about(&file, &message),
        };
        let help = "expected the document that `mpm-verify run --format json` prints";
        diagnostic.with_help(help)
    })
}

/// The byte at a line and a column, which is counted in bytes.
fn bytes(text: &str, (line, column): (usize, usize)) -> Range<usize> {
    let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let at = (start + column - 1).min(text.len());
    at..at + 1
}
