//! Finds the end of a scalar, by the rules of its YAML style.

use super::Diagnostic;
use super::scan::{Scalar, Scanner, Style};
use std::ops::Range;

impl Scanner<'_> {
    pub(crate) fn plain_scalar(&mut self) -> Result<(), Diagnostic> {
        self.may_be_key();
        let start = self.at;
        let mut end = start;
        let mut after_break = false;
        while !self.at_document_mark() && self.byte(0) != Some(b'#') {
            while !self.blank(0) && !self.ends_plain() {
                self.at += 1;
                end = self.at;
                after_break = false;
            }
            if !self.blank(0) || self.byte(0).is_none() {
                break;
            }
            after_break = self.blanks_in_plain(after_break)?;
            if !self.in_flow() && self.column() < self.least_column() {
                break;
            }
        }
        self.key_allowed = after_break;
        self.keep(start..end, Style::Plain);
        Ok(())
    }

    /// Skips blanks and line breaks. Returns whether there was a line break since the last word.
    fn blanks_in_plain(&mut self, mut after_break: bool) -> Result<bool, Diagnostic> {
        while let Some(byte) = self.byte(0) {
            match byte {
                b'\t' if after_break && self.column() < self.least_column() => {
                    return Err(self.tab());
                }
                b' ' | b'\t' | b'\r' => self.at += 1,
                b'\n' => {
                    self.line_break();
                    after_break = true;
                }
                _ => break,
            }
        }
        Ok(after_break)
    }

    fn ends_plain(&self) -> bool {
        match self.byte(0) {
            Some(b':') => {
                self.blank(1)
                    || self.in_flow()
                        && matches!(self.byte(1), Some(b',' | b'?' | b'[' | b']' | b'{' | b'}'))
            }
            Some(b',' | b'[' | b']' | b'{' | b'}') => self.in_flow(),
            _ => false,
        }
    }

    /// Returns the minimum column of text in the current block.
    fn least_column(&self) -> usize {
        self.indents.last().map_or(0, |indent| indent + 1)
    }

    pub(crate) fn quoted_scalar(&mut self, quote: u8) -> Result<(), Diagnostic> {
        self.may_be_key();
        let start = self.at;
        let escapes = quote == b'"';
        self.at += 1;
        loop {
            match self.byte(0) {
                None => {
                    return Err(self
                        .diagnostic(start..start + 1, "this quote is never closed")
                        .with_label("no matching quote"));
                }
                Some(b'\n') => self.line_break(),
                // An escaped line break is still a line break.
                Some(b'\\') if escapes && !matches!(self.byte(1), None | Some(b'\n' | b'\r')) => {
                    self.at += 2;
                }
                Some(byte) if byte == quote && !escapes && self.byte(1) == Some(quote) => {
                    self.at += 2;
                }
                Some(byte) if byte == quote => break,
                Some(_) => self.at += 1,
            }
        }
        self.at += 1;
        self.key_allowed = false;
        let style = if escapes { Style::DoubleQuoted } else { Style::SingleQuoted };
        self.keep(start..self.at, style);
        Ok(())
    }

    pub(crate) fn block_scalar(&mut self) {
        let start = self.at;
        let mut indent = self.stated_indent();
        let mut deepest_blank = 0;
        self.skip_line();
        let mut end = self.at;
        while self.byte(0).is_some() {
            self.line_break();
            let spaces = self.text[self.at..].bytes().take_while(|byte| *byte == b' ').count();
            if matches!(self.byte(spaces), Some(b'\n' | b'\r')) {
                deepest_blank = deepest_blank.max(spaces);
            } else if self.byte(spaces).is_none()
                || spaces
                    < *indent
                        .get_or_insert(deepest_blank.max(spaces).max(self.least_column()).max(1))
            {
                break;
            } else {
                self.skip_line();
                end = self.at;
                continue;
            }
            self.skip_line();
        }
        self.key_allowed = true;
        self.keep(start..end, Style::Block);
    }

    /// Returns the explicit indentation of a block header such as `|2-`.
    fn stated_indent(&self) -> Option<usize> {
        let digit = (1..=2).find_map(|ahead| self.byte(ahead).filter(u8::is_ascii_digit))?;
        Some(self.indents.last().copied().unwrap_or(0) + usize::from(digit - b'0'))
    }

    fn keep(&mut self, range: Range<usize>, style: Style) {
        self.scalars.push(Scalar { range, style });
    }
}
