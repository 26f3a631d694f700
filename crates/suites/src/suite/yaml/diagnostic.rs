//! An error in a file, and its position.

use super::place::{Place, line_around};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// Maximum length of a text in a diagnostic (characters), because keys may be very long.
const MAX_WORDS: usize = 300;

/// Maximum length of advice (characters), because advice may list many names.
const MAX_HELP: usize = 500;

/// Severity of the diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A hint that requires no change.
    Note,
    /// The suite runs, but probably not as its author intends.
    Warning,
    /// The suite cannot be used.
    Error,
}

/// An error, warning or note about a file: message, position, and correct form.
///
/// `Display` formats a diagnostic like an error of `rustc`, with the source line and a caret.
/// [`Diagnostic::one_line`] is for editors and logs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic(Box<Parts>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Parts {
    severity: Severity,
    code: Option<&'static str>,
    file: String,
    message: String,
    label: Option<String>,
    help: Option<String>,
    excerpt: Option<Excerpt>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Excerpt {
    place: Place,
    line: String,
    underlined: Range<usize>,
}

impl Diagnostic {
    /// Creates a diagnostic about a whole file.
    pub fn about(file: &str, message: &str) -> Self {
        Self(Box::new(Parts {
            severity: Severity::Error,
            code: None,
            file: printable(file),
            message: printable(message),
            label: None,
            help: None,
            excerpt: None,
        }))
    }

    /// Creates a diagnostic about a byte range of `text`, the contents of `file`.
    pub fn at(file: &str, text: &str, range: Range<usize>, message: &str) -> Self {
        let place = Place::of(text, range);
        let bytes = place.bytes();
        let line = line_around(text, bytes.start);
        let mut diagnostic = Self::about(file, message);
        diagnostic.0.excerpt = Some(Excerpt {
            place,
            line: text[line.clone()].to_owned(),
            underlined: bytes.start - line.start..bytes.end - line.start,
        });
        diagnostic
    }

    /// Sets the code, which stands in brackets after the severity.
    #[must_use]
    pub fn with_code(mut self, code: &'static str) -> Self {
        self.0.code = Some(code);
        self
    }

    /// Sets the label under the caret. The label describes the expected value.
    #[must_use]
    pub fn with_label(mut self, label: &str) -> Self {
        self.0.label = Some(printable(label)).filter(|label| !label.is_empty());
        self
    }

    /// Adds advice for the author.
    #[must_use]
    pub fn with_help(mut self, help: &str) -> Self {
        self.0.help = Some(shortened(help, MAX_HELP)).filter(|help| !help.is_empty());
        self
    }

    /// Sets the severity; the default is an error.
    #[must_use]
    pub fn with_severity(mut self, severity: Severity) -> Self {
        self.0.severity = severity;
        self
    }

    /// Returns the severity of the diagnostic.
    pub fn severity(&self) -> Severity {
        self.0.severity
    }

    /// Returns the code of the diagnostic; `None` without a code.
    pub fn code(&self) -> Option<&'static str> {
        self.0.code
    }

    /// Returns the file name, as given by the user.
    pub fn file(&self) -> &str {
        &self.0.file
    }

    /// Returns the position of the error; `None` if the diagnostic concerns the whole file.
    pub fn place(&self) -> Option<Place> {
        self.0.excerpt.as_ref().map(|excerpt| excerpt.place)
    }

    /// Returns the error message.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Returns the label under the caret.
    pub fn label(&self) -> Option<&str> {
        self.0.label.as_deref()
    }

    /// Returns the advice for the author.
    pub fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Formats the diagnostic as `file:line:column: message`.
    pub fn one_line(&self) -> String {
        let Parts { file, message, .. } = &*self.0;
        match self.place() {
            Some(place) => format!("{file}:{}:{}: {message}", place.line(), place.column()),
            None => format!("{file}: {message}"),
        }
    }

    /// Returns the text of `Display`, with terminal colours.
    pub fn styled(&self) -> String {
        Renderer::styled().render(&[self.group()])
    }

    fn group(&self) -> Group<'_> {
        let (level, name) = match self.severity() {
            Severity::Note => (Level::NOTE, "note: "),
            Severity::Warning => (Level::WARNING, "warning: "),
            Severity::Error => (Level::ERROR, "error: "),
        };
        let indent = name.len() + self.0.code.map_or(0, |code| code.len() + 2);
        let title = level.primary_title(folded(self.message(), WIDTH - indent));
        let title = match self.0.code {
            Some(code) => title.id(code),
            None => title,
        };
        let group = match &self.0.excerpt {
            None => title.element(Origin::path(self.file())),
            Some(excerpt) => title.element(
                Snippet::source(excerpt.line.as_str())
                    .line_start(excerpt.place.line())
                    .path(self.file())
                    .annotation(
                        AnnotationKind::Primary
                            .span(excerpt.underlined.clone())
                            .label(self.label()),
                    ),
            ),
        };
        match self.help() {
            Some(help) => {
                group.element(Level::HELP.message(folded_advice(help, WIDTH - HELP_INDENT)))
            }
            None => group,
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&Renderer::plain().render(&[self.group()]))
    }
}

impl std::error::Error for Diagnostic {}

/// Breaks a text at spaces into lines of at most `most` characters, except for longer words.
fn folded(text: &str, most: usize) -> String {
    let (mut folded, mut column) = (String::new(), 0);
    for word in text.split(' ') {
        let width = word.chars().count();
        let fits = column + 1 + width <= most;
        let separator = if folded.is_empty() {
            ""
        } else if fits {
            " "
        } else {
            "\n"
        };
        column = if fits { column + separator.len() } else { 0 } + width;
        folded.push_str(separator);
        folded.push_str(word);
    }
    folded
}

/// Folds advice. Each part, such as a command, begins a line of its own.
fn folded_advice(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.split("; ").map(|part| folded(part, most)).collect::<Vec<_>>().join(";\n")
}

/// Maximum length of a printed line (characters).
const WIDTH: usize = 100;

/// Maximum indent of advice (characters), below line numbers of five digits.
const HELP_INDENT: usize = 15;

/// Makes a text safe for a terminal: one line, no invisible characters, limited length.
fn printable(words: &str) -> String {
    shortened(words, MAX_WORDS)
}

fn shortened(words: &str, most: usize) -> String {
    let mut safe = String::new();
    for (count, c) in words.chars().enumerate() {
        if count == most {
            safe.push('…');
            break;
        }
        if c.is_control() || reorders(c) {
            safe.extend(c.escape_unicode());
        } else {
            safe.push(c);
        }
    }
    safe
}

/// Whether `c` is a bidirectional control character, which reorders a line in a terminal.
fn reorders(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}
