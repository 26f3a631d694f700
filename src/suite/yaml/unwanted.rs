//! Diagnostics of the scan.

use super::scan::Scanner;
use super::{Diagnostic, MAX_NESTING, Place};
use std::ops::Range;

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

    /// A bracket closed by one of the other kind: what is missing is at the first of the two.
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
