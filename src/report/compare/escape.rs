//! Texts of files as Markdown that means nothing but them.

/// A code span, in which nothing is markup but its own end, and the bar of a table.
pub(super) fn code(text: &str) -> String {
    let plain = |c: char| match c {
        '`' => "'".to_owned(),
        '|' => "\\|".to_owned(),
        c if c.is_control() => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    format!("`{}`", text.chars().map(plain).collect::<String>())
}

/// Text without any markup, also as an attribute; the arrow of a change is one.
pub(super) fn prose(text: &str) -> String {
    let plain = |c: char| match c {
        c if c.is_control() => "\u{fffd}".to_owned(),
        c if "&<>|`*_[]()~@#!\\:/\"".contains(c) => format!("&#{};", u32::from(c)),
        c => c.to_string(),
    };
    let arrows = text.split(" -> ").map(|part| part.chars().map(plain).collect::<String>());
    arrows.collect::<Vec<_>>().join(" → ")
}
