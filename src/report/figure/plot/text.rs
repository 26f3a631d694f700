//! Widths of texts, which SVG leaves to the viewer.
//!
//! The estimate follows `DejaVu Sans`, the widest face of the font stack: what fits there fits
//! in Helvetica too.

/// Estimated width of `text` in pixels at font size `size`.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// Advance width of one character in units of the font size.
fn advance(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | '\'' | ' ' | '.' | ',' | '|' => 0.32,
        'I' | ':' | ';' | '/' | '-' | '(' | ')' | '[' | ']' | 'f' | 't' | 'r' => 0.4,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 0.99,
        'A'..='Z' | '=' | '+' | '<' | '>' | '~' | '\u{2212}' | '×' | '&' | '#' => 0.8,
        // Beyond Latin and Greek the glyphs may be as wide as they are high.
        '\u{0}'..='\u{3ff}' => 0.63,
        _ => 1.0,
    }
}

/// Cuts `text` to `limit` pixels, with an ellipsis where something is missing.
pub(crate) fn shorten(text: &str, size: f64, limit: f64) -> String {
    if width(text, size) <= limit {
        return text.to_owned();
    }
    let mut used = size;
    let mut short: String = text
        .chars()
        .take_while(|&c| {
            used += advance(c) * size;
            used <= limit
        })
        .collect();
    short.truncate(short.trim_end().len());
    short.push('…');
    short
}

/// Breaks `text` into lines of at most `limit` pixels; a line beyond `lines` is not begun, the
/// last one is shortened instead.
pub(crate) fn wrap(text: &str, size: f64, limit: f64, lines: usize) -> Vec<String> {
    let mut wrapped: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = wrapped.len() >= lines;
        match wrapped.last_mut() {
            Some(line) if full || width(&format!("{line} {word}"), size) <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => wrapped.push(word.to_owned()),
        }
    }
    wrapped.iter().map(|line| shorten(line, size, limit)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case("short", 100.0, "short")]
    #[case("cut at a blank and marked", 65.0, "cut at a…")]
    #[case("", 0.0, "")]
    #[case("nothing fits", 1.0, "…")]
    fn shortening(#[case] text: &str, #[case] limit: f64, #[case] short: &str) {
        assert_eq!(shorten(text, 12.0, limit), short);
    }

    #[rstest]
    #[case("one two three four", 2, &["one two", "three f…"])]
    #[case("one two three four", 3, &["one two", "three", "four"])]
    #[case("  ", 2, &[])]
    fn wrapping(#[case] text: &str, #[case] lines: usize, #[case] expected: &[&str]) {
        assert_eq!(wrap(text, 10.0, 46.0, lines), expected);
    }
}
