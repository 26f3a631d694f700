//! Interprets bytes as two documents to be compared: snapshots, or the JSON of runs.

use mpm_verify::report::compare::{ReportDocument, compare, text};

/// Reads the two parts before and after the first zero byte. Compares them with each other, and
/// each with itself. Panics if this fails, or if a document differs from itself.
pub(crate) fn differences(bytes: &[u8]) {
    let middle = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len() / 2);
    let [old, new] =
        [&bytes[..middle], &bytes[middle..]].map(|part| String::from_utf8_lossy(part).into_owned());
    let snapshots = |text: &str| ReportDocument::of_snapshots(text, |_, _| Some(text.to_owned()));
    shown(&snapshots(&old), &snapshots(&new));
    let [old, new] = [&old, &new].map(|text| ReportDocument::read(text.trim_matches('\0')));
    if let (Ok(old), Ok(new)) = (old, new) {
        shown(&old, &new);
    }
}

fn shown(old: &ReportDocument, new: &ReportDocument) {
    assert!(!text(&compare(old, new, 0.01)).is_empty());
}
