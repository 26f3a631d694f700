//! Converts Rust text to tokens, without comments, strings, characters and lifetimes.

/// A word, a number or a sign of the code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Token {
    pub(crate) text: String,
    pub(crate) line: usize,
}

/// The tokens of `text`. `::` is one token; every other sign is a separate token.
pub(crate) fn tokens(text: &str) -> Vec<Token> {
    let mut rest = text;
    let mut line = 1;
    let mut found = Vec::new();
    while let Some(first) = rest.chars().next() {
        let silent = comment(rest).or_else(|| quoted(rest));
        let length = silent.unwrap_or_else(|| match first {
            _ if rest.starts_with("::") => 2,
            c if is_word(c) => word(rest),
            c => c.len_utf8(),
        });
        let (piece, after) = rest.split_at(length);
        if silent.is_none() && !first.is_whitespace() {
            let text = piece.strip_prefix("r#").unwrap_or(piece).to_owned();
            found.push(Token { text, line });
        }
        line += piece.matches('\n').count();
        rest = after;
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn word(text: &str) -> usize {
    let raw = if text.starts_with("r#") { 2 } else { 0 };
    raw + text[raw..].find(|c| !is_word(c)).unwrap_or(text.len() - raw)
}

/// Length of the comment at the start of `text`; block comments nest.
fn comment(text: &str) -> Option<usize> {
    if text.starts_with("//") {
        return Some(text.find('\n').unwrap_or(text.len()));
    }
    if !text.starts_with("/*") {
        return None;
    }
    let (mut at, mut depth) = (2, 1);
    while depth > 0 {
        let next = text[at..].find("/*").unwrap_or(usize::MAX);
        let Some(end) = text[at..].find("*/") else { return Some(text.len()) };
        depth = if next < end { depth + 1 } else { depth - 1 };
        at += next.min(end) + 2;
    }
    Some(at)
}

/// Length of the string, character or lifetime at the start of `text`.
fn quoted(text: &str) -> Option<usize> {
    let prefix = ["br", "cr", "b", "c", "r", ""].into_iter().find(|prefix| {
        text.strip_prefix(prefix).is_some_and(|body| {
            body.trim_start_matches('#').starts_with('"')
                || (matches!(*prefix, "" | "b") && body.starts_with('\''))
        })
    })?;
    let body = &text[prefix.len()..];
    let hashes = body.len() - body.trim_start_matches('#').len();
    let length = if body.starts_with('\'') {
        character(body)
    } else if prefix.ends_with('r') {
        let close = format!("\"{}", "#".repeat(hashes));
        let open = hashes + 1;
        body[open..].find(&close).map_or(body.len(), |at| open + at + close.len())
    } else if hashes == 0 {
        closed(body, '"')
    } else {
        return None;
    };
    Some(prefix.len() + length)
}

/// Length of `'a'`, `'\n'` or the lifetime `'a`.
fn character(text: &str) -> usize {
    let mut inside = text[1..].chars();
    match (inside.next(), inside.next()) {
        (Some('\\'), _) | (_, Some('\'')) => closed(text, '\''),
        _ => 1 + word(&text[1..]),
    }
}

/// Length up to the next `quote` that no backslash precedes.
fn closed(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if c == quote && !escaped {
            return at + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    text.len()
}
