//! Text of strangers.

/// Text of a stranger in one line, at most 200 characters of it.
pub(super) fn printable(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
