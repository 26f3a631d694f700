//! Text of strangers.

/// Text of a stranger in one line, at most 200 characters of it.
pub(super) fn printable(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// An error of the JSON library without the names of Rust types.
pub(super) fn plain(error: &serde_json::Error) -> String {
    const EXPECTED: [(&str, &str); 8] = [
        ("u64", "a whole number, zero or more"),
        ("usize", "a whole number, zero or more"),
        ("f64", "a number"),
        ("a sequence", "a list"),
        ("a map", "an object"),
        ("internally tagged enum Answer", "an object with a `type`"),
        ("a boolean", "`true` or `false`"),
        ("a string", "a text"),
    ];
    let text = error.to_string();
    if text.starts_with("data did not match any variant of untagged enum") {
        return "a column is a list of numbers, or `{\"f64\": [OFFSET, COUNT]}`".to_owned();
    }
    let Some((found, rest)) = text.split_once(", expected ") else { return text };
    let (expected, place) = rest.split_once(" at line ").unwrap_or((rest, "1"));
    let known = EXPECTED.iter().find(|(name, _)| *name == expected);
    let expected = match known {
        Some((_, plain)) => plain,
        None if expected.starts_with("struct ") => "an object",
        None => expected,
    };
    format!("{found}, expected {expected} at line {place}")
}
