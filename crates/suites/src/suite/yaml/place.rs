//! A range within one line of a file.

use std::ops::Range;

/// Position in a file (line and column from one) and length, counted in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    line: usize,
    column: usize,
    length: usize,
    start: usize,
    end: usize,
}

impl Place {
    /// Returns the position of a byte range of `text`. A range of several lines is cut at the end
    /// of the first line.
    ///
    /// Any range is valid, because its ends are moved into the text and to character boundaries. A
    /// range that starts at the end of the text is moved to just after the last visible character.
    pub fn of(text: &str, range: Range<usize>) -> Self {
        let start = if range.start >= text.len() {
            text.trim_end().len()
        } else {
            (0..=range.start).rfind(|at| text.is_char_boundary(*at)).unwrap_or(0)
        };
        let line_end = line_around(text, start).end;
        let end = (range.end.clamp(start, line_end)..=line_end)
            .find(|at| text.is_char_boundary(*at))
            .unwrap_or(line_end);
        let line_start = line_around(text, start).start;
        Self {
            line: 1 + text[..line_start].matches('\n').count(),
            column: 1 + text[line_start..start].chars().count(),
            length: text[start..end].chars().count(),
            start,
            end,
        }
    }

    /// Returns the line number, starting at one.
    pub fn line(self) -> usize {
        self.line
    }

    /// Returns the column in characters, starting at one.
    pub fn column(self) -> usize {
        self.column
    }

    /// Returns the number of characters; zero for a position between two characters.
    pub fn length(self) -> usize {
        self.length
    }

    /// Returns the byte range.
    pub fn bytes(self) -> Range<usize> {
        self.start..self.end
    }
}

/// Returns the byte range of the line that contains `offset`, without its line break.
pub(crate) fn line_around(text: &str, offset: usize) -> Range<usize> {
    let start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
    let end = text[offset..].find('\n').map_or(text.len(), |at| offset + at);
    let visible = text[start..end].strip_suffix('\r').map_or(end, |line| start + line.len());
    start..visible.max(offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::first("ab: c", 0..2, (1, 1, 2))]
    #[case::counts_characters("é: ü\nñ: x", 11..12, (2, 4, 1))]
    #[case::cut_at_the_line("ab\ncd", 1..5, (1, 2, 1))]
    #[case::carriage_return("ab\r\ncd", 0..6, (1, 1, 2))]
    #[case::end_of_text("ab\n\n", 4..4, (1, 3, 0))]
    #[case::inside_a_character("é", 1..1, (1, 1, 1))]
    #[case::far_outside("ab", 90..95, (1, 3, 0))]
    #[case::nothing("", 0..3, (1, 1, 0))]
    fn counts(
        #[case] text: &str,
        #[case] range: Range<usize>,
        #[case] want: (usize, usize, usize),
    ) {
        let place = Place::of(text, range);
        assert_eq!((place.line(), place.column(), place.length()), want);
    }
}
