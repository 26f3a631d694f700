//! A scalar of the file: where it stands, and how it is written.

use std::ops::Range;

/// The extent of one scalar, with its quotes.
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
    /// The bytes that are the value, if they are so one for one: no escape, no folded line.
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
