//! Messages of our own, sent through the error type of a deserializer.
//!
//! A deserializer's error is one string, and the YAML library writes a path in front of it and
//! a position behind. Fences around the parts let them be found again; no file can forge them,
//! because a source with control characters is refused.

use serde::de;

const FENCE: char = '\u{1f}';

/// A refusal to raise while deserializing: what is wrong, what was expected, what to do.
///
/// `label` and `help` may be empty. [`read`](super::read()) shows the three as they are, at the
/// place of the innermost value that was being read.
pub fn refuse<E: de::Error>(message: &str, label: &str, help: &str) -> E {
    let [message, label, help] = [message, label, help].map(|part| part.replace(FENCE, " "));
    E::custom(format!("{FENCE}{message}{FENCE}{label}{FENCE}{help}{FENCE}"))
}

/// Message, label and help of a refusal, if `error` is the text of one.
pub(crate) fn refused(error: &str) -> Option<[&str; 3]> {
    let mut parts = error.split(FENCE).skip(1);
    Some([parts.next()?, parts.next()?, parts.next()?])
}
