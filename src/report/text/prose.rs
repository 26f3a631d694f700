//! Wraps prose for text reports.

/// Maximum length of a line (characters).
pub(crate) const WIDTH: usize = 100;

pub(crate) fn paragraph_lines(lines: &mut Vec<String>, paragraph: &str) {
    wrap(lines, WIDTH, paragraph);
}

/// Wraps `text` to lines of at most 100 characters, each indented by two spaces.
pub fn indented(text: &str) -> String {
    let mut lines = Vec::new();
    wrap(&mut lines, WIDTH - 2, text);
    format!("  {}\n", lines.join("\n  "))
}

/// Adds a row with `key` in the first column and the wrapped `value` in the second.
pub(crate) fn row(lines: &mut Vec<String>, key: &str, value: &str) {
    row_of_width(lines, 14, key, value);
}

/// Adds a heading and one row for each fact, a pair of key and value.
pub(crate) fn section<'a>(
    lines: &mut Vec<String>,
    heading: &str,
    facts: impl Iterator<Item = (&'a str, &'a str)>,
) {
    lines.push(format!("  {heading}"));
    for (key, value) in facts {
        row_of_width(lines, KEYS, &format!("  {}", key.trim()), value);
    }
}

/// Width of the column of keys in a [`section`].
pub(crate) const KEYS: usize = 23;

pub(crate) fn hanging(lines: &mut Vec<String>, mark: &str, paragraph: &str) {
    row_of_width(lines, 4, mark, paragraph);
}

/// Adds a row with `key` in a first column of width `column` and the wrapped `value` in the second.
pub(crate) fn row_of_width(lines: &mut Vec<String>, column: usize, key: &str, value: &str) {
    let mut wrapped = Vec::new();
    wrap(&mut wrapped, WIDTH - column - 2, value);
    for (i, line) in wrapped.iter().enumerate() {
        let key = if i == 0 { format!("{key} ") } else { String::new() };
        lines.push(format!("  {key:column$}{line}").trim_end().to_owned());
    }
}

/// Formats a row with `key` in a first column of width `column`, wrapped if it is too long.
pub fn wrapped_row(column: usize, key: &str, value: &str) -> String {
    let row = format!("  {key:column$} {value}");
    if row.chars().count() <= WIDTH {
        return row + "\n";
    }
    let mut lines = Vec::new();
    row_of_width(&mut lines, column + 1, key, value);
    lines.join("\n") + "\n"
}

/// Formats a number with its noun: `1 suite`, `2 suites`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

pub(crate) fn wrap(lines: &mut Vec<String>, width: usize, prose: &str) {
    let mut line = String::new();
    for word in prose.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
}
