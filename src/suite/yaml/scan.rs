//! Scans a file before parsing: checks its nesting depth and refuses unsupported features.
//!
//! The cost of the YAML parser is quadratic in the nesting depth, and the depth limit of the parser
//! applies too late. The scan follows the parser's rules for the start of tokens, and builds no
//! values. It stops at text that is not YAML; the parser then reports the reason. The scan records
//! the extent of each scalar for the carets of diagnostics. It also reports unclosed brackets and
//! quotes, which the parser would only report at the end of the file.

use super::{Diagnostic, MAX_NESTING, Place};
use std::ops::Range;

/// The extent of one scalar with its quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Scalar {
    pub(crate) range: Range<usize>,
    pub(crate) style: Style,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    Plain,
    SingleQuoted,
    DoubleQuoted,
    Block,
}

impl Scalar {
    /// Returns the byte range of the value without quotes; `None` if it has escapes or folded
    /// lines.
    pub(crate) fn verbatim(&self, text: &str) -> Option<Range<usize>> {
        let Range { start, end } = self.range;
        let (inside, altered) = match self.style {
            Style::Plain => (start..end, '\n'),
            Style::SingleQuoted => (start + 1..end - 1, '\''),
            Style::DoubleQuoted => (start + 1..end - 1, '\\'),
            Style::Block => return None,
        };
        let words = text.get(inside.clone())?;
        (!words.contains([altered, '\n'])).then_some(inside)
    }

    pub(crate) fn is_quoted(&self) -> bool {
        matches!(self.style, Style::SingleQuoted | Style::DoubleQuoted)
    }
}

/// Returns the scalars of a text in order, or the reason for refusing the text.
pub(crate) fn scan(name: &str, text: &str) -> Result<Vec<Scalar>, Diagnostic> {
    let mut scanner = Scanner {
        name,
        text,
        at: 0,
        line_start: 0,
        indents: Vec::new(),
        open: Vec::new(),
        key_allowed: true,
        possible_key: None,
        document: DocumentState::Before,
        scalars: Vec::new(),
    };
    while scanner.step()? == Next::More {}
    Ok(scanner.scalars)
}

/// State of the scan. Its methods are named after rules of YAML.
pub(crate) struct Scanner<'t> {
    pub(crate) name: &'t str,
    pub(crate) text: &'t str,
    pub(crate) at: usize,
    line_start: usize,
    /// Columns of the enclosing block lists and maps.
    pub(crate) indents: Vec<usize>,
    /// Offsets of the open brackets.
    pub(crate) open: Vec<usize>,
    /// Whether a key may start at this position.
    pub(crate) key_allowed: bool,
    /// Start of a token that becomes a key if a `:` follows on the same line.
    pub(crate) possible_key: Option<usize>,
    document: DocumentState,
    pub(crate) scalars: Vec<Scalar>,
}

#[derive(Clone, Copy, PartialEq)]
enum DocumentState {
    Before,
    Inside,
    Ended,
}

#[derive(PartialEq)]
enum Next {
    More,
    Stop,
}

impl Scanner<'_> {
    fn step(&mut self) -> Result<Next, Diagnostic> {
        self.skip_blanks()?;
        let Some(byte) = self.byte(0) else {
            self.all_closed()?;
            return Ok(Next::Stop);
        };
        if self.column() == 0 && byte == b'%' && self.document == DocumentState::Before {
            self.skip_line();
            return Ok(Next::More);
        }
        if self.open.is_empty() {
            let column = self.column();
            self.indents.retain(|indent| *indent <= column);
        }
        if self.at_document_mark() {
            return self.document_mark(byte);
        }
        if self.document == DocumentState::Ended {
            return Err(self.second_document());
        }
        self.document = DocumentState::Inside;
        self.token(byte)
    }

    fn token(&mut self, byte: u8) -> Result<Next, Diagnostic> {
        let indicator = self.blank(1);
        match byte {
            b'[' | b'{' => self.bracket()?,
            b']' | b'}' => self.closing_bracket(byte)?,
            b',' => self.pass(true),
            b'-' if indicator => return self.block_indicator(),
            b'?' if indicator || self.in_flow() => return self.block_indicator(),
            b':' if indicator || self.in_flow() => return self.value_indicator(),
            b'*' | b'&' => return Err(self.unneeded("anchors and aliases", byte)),
            b'!' => return Err(self.unneeded("tags", byte)),
            b'|' | b'>' if !self.in_flow() => self.block_scalar(),
            b'\'' | b'"' => self.quoted_scalar(byte)?,
            b'|' | b'>' | b'#' | b'%' | b'@' | b'`' | b'\t' => return Ok(Next::Stop),
            _ => self.plain_scalar()?,
        }
        Ok(Next::More)
    }

    fn skip_blanks(&mut self) -> Result<(), Diagnostic> {
        while let Some(byte) = self.byte(0) {
            match byte {
                b' ' | b'\r' => self.at += 1,
                b'\t' if self.in_flow() || !self.key_allowed => self.at += 1,
                b'\t' => return Err(self.tab()),
                b'#' => self.skip_line(),
                b'\n' => {
                    self.line_break();
                    self.key_allowed |= !self.in_flow();
                }
                _ => break,
            }
        }
        Ok(())
    }

    fn bracket(&mut self) -> Result<(), Diagnostic> {
        self.may_be_key();
        self.open.push(self.at);
        self.pass(true);
        self.nesting()
    }

    fn closing_bracket(&mut self, byte: u8) -> Result<(), Diagnostic> {
        let opening = if byte == b']' { '[' } else { '{' };
        let Some(start) = self.open.pop() else {
            let message = format!("`{}` without a `{opening}` before it", byte as char);
            return Err(self.diagnostic(self.here(), &message));
        };
        if !self.text[start..].starts_with(opening) {
            return Err(self.crossed(start, byte));
        }
        self.pass(false);
        Ok(())
    }

    /// Handles `- ` and `? `, which open a block list or map in their column.
    fn block_indicator(&mut self) -> Result<Next, Diagnostic> {
        if self.in_flow() {
            self.pass(false);
            return Ok(Next::More);
        }
        if !self.key_allowed {
            return Ok(Next::Stop);
        }
        self.indent(self.column())?;
        self.possible_key = None;
        self.pass(true);
        Ok(Next::More)
    }

    /// Handles `:`, which makes the preceding text on the line a key of a block map.
    fn value_indicator(&mut self) -> Result<Next, Diagnostic> {
        let key = self.possible_key.take().filter(|key| *key >= self.line_start);
        match key {
            _ if self.in_flow() => {
                self.possible_key = key;
                self.pass(false);
            }
            Some(key) => {
                self.indent(key - self.line_start)?;
                self.pass(false);
            }
            None if self.key_allowed => {
                self.indent(self.column())?;
                self.pass(true);
            }
            None => return Ok(Next::Stop),
        }
        Ok(Next::More)
    }

    fn document_mark(&mut self, byte: u8) -> Result<Next, Diagnostic> {
        self.all_closed()?;
        self.document = match (byte, self.document) {
            (b'-', DocumentState::Before) => DocumentState::Inside,
            (b'-', _) => return Err(self.second_document()),
            (_, DocumentState::Before) => DocumentState::Before,
            _ => DocumentState::Ended,
        };
        self.indents.clear();
        self.possible_key = None;
        self.at += 3;
        self.key_allowed = false;
        Ok(Next::More)
    }

    fn indent(&mut self, column: usize) -> Result<(), Diagnostic> {
        if self.indents.last().is_none_or(|indent| *indent < column) {
            self.indents.push(column);
        }
        self.nesting()
    }
}

impl Scanner<'_> {
    pub(crate) fn byte(&self, ahead: usize) -> Option<u8> {
        self.text.as_bytes().get(self.at + ahead).copied()
    }

    /// Whether a blank, a line break or the end of the text is `ahead` bytes away.
    pub(crate) fn blank(&self, ahead: usize) -> bool {
        matches!(self.byte(ahead), None | Some(b' ' | b'\t' | b'\n' | b'\r'))
    }

    pub(crate) fn in_flow(&self) -> bool {
        !self.open.is_empty()
    }

    /// Returns the column in bytes. Bytes are sufficient, because only ASCII text precedes a block
    /// key or a dash on a line.
    pub(crate) fn column(&self) -> usize {
        self.at - self.line_start
    }

    pub(crate) fn at_document_mark(&self) -> bool {
        let rest = &self.text.as_bytes()[self.at..];
        self.column() == 0
            && (rest.starts_with(b"---") || rest.starts_with(b"..."))
            && self.blank(3)
    }

    pub(crate) fn line_break(&mut self) {
        self.at += 1;
        self.line_start = self.at;
    }

    pub(crate) fn skip_line(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        self.at += rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
    }

    /// Records that the token at this position becomes a key if a `:` follows.
    pub(crate) fn may_be_key(&mut self) {
        if self.key_allowed && !self.in_flow() {
            self.possible_key = Some(self.at);
        }
    }

    fn pass(&mut self, key_allowed: bool) {
        self.at += 1;
        self.key_allowed = key_allowed;
    }

    pub(crate) fn here(&self) -> Range<usize> {
        self.at..self.at + 1
    }
}

impl Scanner<'_> {
    pub(crate) fn nesting(&self) -> Result<(), Diagnostic> {
        if self.open.len() + self.indents.len() <= MAX_NESTING {
            return Ok(());
        }
        let message = format!("lists and maps nest more than {MAX_NESTING} deep");
        Err(self.diagnostic(self.here(), &message))
    }

    pub(crate) fn all_closed(&self) -> Result<(), Diagnostic> {
        let Some(&start) = self.open.last() else { return Ok(()) };
        let bracket = &self.text[start..=start];
        let closing = if bracket == "[" { "]" } else { "}" };
        Err(self
            .diagnostic(start..start + 1, &format!("this `{bracket}` is never closed"))
            .with_label(&format!("no matching `{closing}`")))
    }

    /// Returns the error for a closing bracket that does not match the opening bracket at `start`.
    pub(crate) fn crossed(&self, start: usize, byte: u8) -> Diagnostic {
        let (bracket, byte) = (&self.text[start..=start], byte as char);
        let closing = Place::of(self.text, self.here());
        let (line, column) = (closing.line(), closing.column());
        let message = format!("this `{bracket}` is not closed before a `{byte}`");
        self.diagnostic(start..start + 1, &message)
            .with_label("no matching bracket")
            .with_help(&format!("the `{byte}` is on line {line}, column {column}"))
    }

    pub(crate) fn second_document(&self) -> Diagnostic {
        self.diagnostic(self.here(), "a second document starts here")
            .with_label("a suite is one document")
            .with_help("put each suite in a file of its own")
    }

    pub(crate) fn unneeded(&self, what: &str, byte: u8) -> Diagnostic {
        self.diagnostic(self.here(), &format!("{what} are not supported"))
            .with_label(&format!("a value cannot start with `{}`", byte as char))
            .with_help("put text in quotes; give a value a name under `parameters`")
    }

    pub(crate) fn tab(&self) -> Diagnostic {
        self.diagnostic(self.here(), "tab used for indentation; YAML needs spaces")
            .with_label("a tab")
    }

    pub(crate) fn diagnostic(&self, range: Range<usize>, message: &str) -> Diagnostic {
        Diagnostic::at(self.name, self.text, range, message)
    }
}
