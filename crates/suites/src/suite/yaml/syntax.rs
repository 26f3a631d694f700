//! Errors about text that is not YAML, in plain English, at the place of the mistake.

use super::{Diagnostic, MAX_NESTING, Place};
use std::borrow::Cow;
use std::ops::Range;

pub(crate) struct InvalidText<'t> {
    pub(crate) name: &'t str,
    pub(crate) text: &'t str,
    pub(crate) at: usize,
    pub(crate) problem: &'t str,
    /// End of the last event of the parser (byte offset).
    pub(crate) events_end: usize,
    /// Offsets of the brackets that are open at the end of this event.
    pub(crate) brackets: Vec<usize>,
}

/// The brackets at the place of an error.
enum Brackets {
    /// All are closed.
    Closed,
    /// Offset of the innermost open bracket.
    Open(usize),
    /// Offsets of a bracket and of another kind of bracket that closes it.
    Crossed(usize, usize),
}

impl InvalidText<'_> {
    /// Returns the error. Unclosed brackets and quotes are located where they start.
    pub(crate) fn explain(&self) -> Diagnostic {
        let Self { text, at, .. } = *self;
        let is = |problem: &str| self.problem.contains(problem);
        let first = text[at..].chars().next().unwrap_or('\n');
        if is("recursion limit") {
            return too_deep(self.name, text, at);
        }
        if matches!(first, '*' | '&') && (is("anchor") || is("alias")) {
            return unneeded(self.name, text, "anchors and aliases", at);
        }
        if first == '!' && (is("tag") || is("handle")) {
            return unneeded(self.name, text, "tags", at);
        }
        if is("comment intercepting") {
            return self.unexpected_line();
        }
        if is("must be followed by a valid YAML whitespace") && text[..at].ends_with('\t') {
            return self
                .at(at - 1..at, "expected a space here, found a tab")
                .with_help("replace the tab by a space");
        }
        if matches!(first, '"' | '\'') || is("invalid trailing content") {
            return self.quote();
        }
        match (self.brackets(), first) {
            (Brackets::Crossed(start, end), _) => self.crossed(start, end),
            (Brackets::Open(start), _) if self.shows_unclosed(start) => self.unclosed(start),
            (Brackets::Closed, ']' | '}') if is("misplaced bracket") => {
                let opening = if first == ']' { '[' } else { '{' };
                self.here(&format!("`{first}` without a `{opening}` before it"))
            }
            (Brackets::Closed, _) if is_indented_by_tab(text, at) => tab(self.name, text, at),
            _ if is("tab") => tab(self.name, text, at),
            _ => self.translated(),
        }
    }

    fn here(&self, message: &str) -> Diagnostic {
        self.at(self.at..self.at + 1, message)
    }

    fn at(&self, range: Range<usize>, message: &str) -> Diagnostic {
        Diagnostic::at(self.name, self.text, range, message)
    }

    fn line(&self, at: usize) -> usize {
        Place::of(self.text, at..at).line()
    }

    fn translated(&self) -> Diagnostic {
        let Self { text, mut at, .. } = *self;
        let (message, help) = self.message_and_help();
        let before = text[line_start(text, at)..at].trim_end();
        if message == KEY_EXPECTED && before.trim_start() == "-" {
            at = line_start(text, at) + before.len() - 1;
        }
        self.at(name_range(text, at), &message).with_help(help)
    }

    fn message_and_help(&self) -> (Cow<'static, str>, &'static str) {
        let known = MESSAGES.iter().find(|(problem, ..)| self.problem.contains(problem));
        match known {
            Some((_, message, help)) => (Cow::Borrowed(message), help),
            None => (Cow::Owned(format!("this is not valid YAML: {}", self.problem)), ""),
        }
    }

    /// Returns the error for the line after a comment, if this line continues no value.
    fn unexpected_line(&self) -> Diagnostic {
        let Self { text, at, .. } = *self;
        let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
        let at = text.len() - text[end..].trim_start().len();
        if is_indented_by_tab(text, at) {
            return tab(self.name, text, at);
        }
        self.at(name_range(text, at), KEY_EXPECTED).with_help(KEY_HELP)
    }

    fn quote(&self) -> Diagnostic {
        let Self { text, at, .. } = *self;
        let rest = &text[at..];
        let unclosed = |start: usize, message: &str| {
            self.at(start..start + 1, message).with_label("no matching quote")
        };
        if self.problem.contains("invalid trailing content") {
            let start = self.opening_quote().filter(|start| text[*start..at].contains('\n'));
            return match start {
                Some(start) => {
                    let message = format!("this quote is closed only on line {}", self.line(at));
                    unclosed(start, &message).with_help("close it on its line")
                }
                None => self.translated(),
            };
        }
        match rest.chars().next() {
            Some(quote) if !rest[1..].contains(quote) => unclosed(at, "this quote is never closed"),
            _ if self.problem.contains("invalid indentation") => {
                unclosed(at, "this quote is not closed on its line")
                    .with_help("close it, or indent the following lines more than their key")
            }
            _ => {
                let (message, help) = self.message_and_help();
                self.at(unknown_escape(text, at), &message).with_help(help)
            }
        }
    }

    fn opening_quote(&self) -> Option<usize> {
        let rest = self.text.get(self.events_end..self.at)?;
        let quote = rest.find(['"', '\''])?;
        Some(self.events_end + quote)
    }

    /// Whether the bracket at `start` is not closed: the text ends, or a line has at most its
    /// indentation. If the whole file is in brackets, lines need no indentation.
    fn shows_unclosed(&self, start: usize) -> bool {
        let Self { text, at, .. } = *self;
        if text[at..].trim().is_empty() {
            return true;
        }
        let outer = self.brackets.first().map_or(start, |outer| start.min(*outer));
        let is_whole = text[..outer].trim().is_empty();
        !is_whole
            && line_start(text, at) > start
            && indentation(text, at) <= indentation(text, start)
    }

    fn unclosed(&self, start: usize) -> Diagnostic {
        let bracket = &self.text[start..=start];
        if self.text[self.at..].trim().is_empty() {
            let closing = if bracket == "[" { ']' } else { '}' };
            return self
                .at(start..start + 1, &format!("this `{bracket}` is never closed"))
                .with_label(&format!("no matching `{closing}`"));
        }
        let line = self.line(self.at);
        self.at(start..start + 1, &format!("this `{bracket}` is not closed before line {line}"))
            .with_label("no matching bracket")
            .with_help("close it; lines inside brackets need more indentation than their key")
    }

    fn crossed(&self, start: usize, end: usize) -> Diagnostic {
        let (bracket, closing) = (&self.text[start..=start], &self.text[end..=end]);
        let place = Place::of(self.text, end..end + 1);
        let (line, column) = (place.line(), place.column());
        let message = format!("this `{bracket}` is not closed before a `{closing}`");
        self.at(start..start + 1, &message)
            .with_label("no matching bracket")
            .with_help(&format!("the `{closing}` is on line {line}, column {column}"))
    }

    /// Finds the brackets at the error. The parser reads at most a few lines ahead of its events,
    /// so only these lines are searched.
    fn brackets(&self) -> Brackets {
        let Self { text, at, events_end, .. } = *self;
        let mut open = self.brackets.clone();
        let (mut quote, mut is_comment, mut before) = (None, false, '\n');
        let end = at + usize::from(text[at..].starts_with([']', '}']));
        let mut characters =
            text[..end].char_indices().skip_while(|(offset, _)| *offset < events_end);
        while let Some((offset, c)) = characters.next() {
            let can_start = matches!(before, '\n' | ':' | ',' | '[' | '{' | '-' | '?');
            match c {
                '\\' if quote == Some('"') => {
                    characters.next();
                }
                _ if quote.is_some() => quote = quote.filter(|quote| *quote != c),
                '\n' => is_comment = false,
                _ if is_comment => continue,
                '#' if text[..offset].ends_with([' ', '\t', '\n']) => is_comment = true,
                '"' | '\'' if can_start => quote = Some(c),
                '[' | '{' if can_start => open.push(offset),
                ']' | '}' => match open.pop() {
                    Some(start) if text[start..].starts_with('[') != (c == ']') => {
                        return Brackets::Crossed(start, offset);
                    }
                    _ => {}
                },
                _ => {}
            }
            if !matches!(c, ' ' | '\t' | '\r') {
                before = c;
            }
        }
        open.last().map_or(Brackets::Closed, |start| Brackets::Open(*start))
    }
}

pub(crate) fn too_deep(name: &str, text: &str, at: usize) -> Diagnostic {
    let message = format!("lists and maps nest more than {MAX_NESTING} deep");
    Diagnostic::at(name, text, at..at + 1, &message)
}

/// Returns the error for a feature of YAML that suites do not need.
pub(crate) fn unneeded(name: &str, text: &str, what: &str, at: usize) -> Diagnostic {
    let start = text[at..].chars().next().unwrap_or_default();
    Diagnostic::at(name, text, at..at + 1, &format!("{what} are not supported"))
        .with_label(&format!("a value cannot start with `{start}`"))
        .with_help("put text in quotes; give a value a name under `parameters`")
}

pub(crate) fn tab(name: &str, text: &str, at: usize) -> Diagnostic {
    let line = line_start(text, at);
    let at = text[line..].find('\t').map_or(at, |tab| line + tab);
    Diagnostic::at(name, text, at..at + 1, "tab used for indentation; YAML needs spaces")
        .with_label("a tab")
}

pub(crate) fn is_indented_by_tab(text: &str, at: usize) -> bool {
    text[line_start(text, at)..at].trim_start_matches(' ').starts_with('\t')
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |end| end + 1)
}

/// Returns the indentation of the line of offset `at`, including the dashes of lists.
fn indentation(text: &str, at: usize) -> usize {
    let line = &text[line_start(text, at)..];
    let mut rest = line.trim_start_matches(' ');
    while let Some(entry) = rest.strip_prefix("- ") {
        rest = entry.trim_start_matches(' ');
    }
    line.len() - rest.len()
}

fn name_range(text: &str, at: usize) -> Range<usize> {
    let is_name = |c: char| c.is_alphanumeric() || "_-.".contains(c);
    let rest = &text[at..];
    let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
    at..at + length.max(1)
}

/// Returns the range of the first unknown escape in the quoted text; otherwise that of the quote.
fn unknown_escape(text: &str, at: usize) -> Range<usize> {
    let mut escapes = text[at..].match_indices('\\').map(|(offset, _)| at + offset);
    while let Some(offset) = escapes.next() {
        let escaped = text[offset + 1..].chars().next().unwrap_or_default();
        if !"0abt\tnvfre \"/\\N_LPxuU\r\n".contains(escaped) {
            return offset..offset + 1;
        }
        if escaped == '\\' {
            escapes.next();
        }
    }
    at..at + 1
}

const KEY_EXPECTED: &str = "expected a key here";
const KEY_HELP: &str =
    "check the indentation, and quotes around text that holds `:`, `#` or quotes";

/// Parts of messages of the parser, with message and help for authors of suites.
const MESSAGES: &[(&str, &str, &str)] = &[
    ("expected ',' or ']'", "expected `,` or `]` here", "entries of a list are separated by `,`"),
    ("expected ',' or '}'", "expected `,` or `}` here", "keys of a map are separated by `,`"),
    ("did not find expected key", KEY_EXPECTED, KEY_HELP),
    (
        "did not find expected '-' indicator",
        "expected `- ` here, as in the entries above",
        "check the indentation",
    ),
    (
        "mapping values are not allowed",
        "`:` is not possible here",
        "check the indentation; put text that holds `: ` in quotes",
    ),
    (
        "illegal placement of ':'",
        "`:` is not possible here",
        "check the brackets; put text that holds `: ` in quotes",
    ),
    (
        "block sequence entries are not allowed",
        "`- ` is not possible here",
        "start the list on a line of its own",
    ),
    (
        "is only valid inside a block",
        "`- ` is not possible inside brackets",
        "entries of a list in brackets are separated by `,`",
    ),
    ("mapping keys are not allowed", "a key is not possible here", "check the indentation"),
    ("simple key expect", "expected `:` after the key", "write `key: value`"),
    ("invalid trailing content", "text after a closing quote", "put the whole value in quotes"),
    (
        "must be followed by a valid YAML whitespace",
        "expected a space before this",
        "write `key: value`",
    ),
    ("comments must be separated", "expected a blank before the comment", "write ` # comment`"),
    ("expected node content", "expected a value here", ""),
    (
        "a block scalar, did not find expected comment or line break",
        "text after `|` or `>` starts on the next line",
        "put text that starts with `|` or `>` in quotes",
    ),
    (
        "a block scalar, found an indentation indicator",
        "text after `|` or `>` starts on the next line",
        "put text that starts with `|` or `>` in quotes",
    ),
    (
        "invalid indentation",
        "text in brackets needs more indentation than its key",
        "indent this line",
    ),
    (
        "wrongly indented line",
        "the indentation of this block of text is unclear",
        "remove the blanks in empty lines before the text",
    ),
    (
        "expected <document",
        "expected the end of the file here",
        "check the indentation and the brackets",
    ),
    ("unexpected character", "a value cannot start with this character", "put the value in quotes"),
    (
        "found unknown escape character",
        "unknown escape in double quotes",
        "use single quotes to keep `\\` as it is",
    ),
];
