//! How complaints put things.

use crate::nearest::nearest;
use crate::suite::yaml::NumberText;

/// A number as an author would write it: 1e300 rather than a one and 300 zeros.
pub(crate) fn shown(value: f64) -> String {
    NumberText::Number(value).to_string()
}

/// The name that was most likely meant, or all `known` ones.
pub(crate) fn suggestion(kind: &str, name: &str, known: &[&str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known {kind}: {}", known.join(", ")),
    }
}
