//! Markdown, as far as the documents use it: headings, links, spans of code, fenced blocks.

/// One document.
#[derive(Debug)]
pub(crate) struct Document {
    /// Path from the root of the repository.
    pub(crate) file: String,
    /// Lines outside of fenced blocks, with their numbers.
    lines: Vec<(usize, String)>,
    pub(crate) blocks: Vec<Block>,
}

/// A fenced block.
#[derive(Debug)]
pub(crate) struct Block {
    /// Where its fence opens.
    pub(crate) line: usize,
    /// The last line of text before it that is not empty.
    pub(crate) before: String,
    pub(crate) language: String,
    pub(crate) text: String,
}

/// A part of a line of text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) line: usize,
    pub(crate) text: String,
}

impl Document {
    pub(crate) fn new(file: &str, text: &str) -> Self {
        let mut document = Self { file: file.to_owned(), lines: Vec::new(), blocks: Vec::new() };
        let mut open: Option<Block> = None;
        let mut before = String::new();
        for (line, text) in (1..).zip(text.lines()) {
            match (text.trim_start().strip_prefix("```"), open.take()) {
                (Some(_), Some(block)) => document.blocks.push(block),
                (Some(language), None) => {
                    let language = language.trim().to_owned();
                    let before = before.clone();
                    open = Some(Block { line, before, language, text: String::new() });
                }
                (None, Some(mut block)) => {
                    block.text += text;
                    block.text += "\n";
                    open = Some(block);
                }
                (None, None) => {
                    if !text.trim().is_empty() {
                        text.trim().clone_into(&mut before);
                    }
                    document.lines.push((line, text.to_owned()));
                }
            }
        }
        document
    }

    /// The text outside of fenced blocks, without its line breaks.
    pub(crate) fn prose(&self) -> String {
        self.lines.iter().map(|(_, line)| line.trim()).collect::<Vec<_>>().join(" ")
    }

    /// Targets of links, `](target)`.
    pub(crate) fn links(&self) -> Vec<Span> {
        self.spans(|text| {
            let pieces = text.split("](").skip(1);
            pieces.filter_map(|piece| piece.split([')', ' ']).next()).collect()
        })
    }

    /// Spans of code between two backticks.
    pub(crate) fn code_spans(&self) -> Vec<Span> {
        self.spans(|text| {
            let pieces: Vec<&str> = text.split('`').collect();
            let inside = pieces.iter().skip(1).step_by(2).take(pieces.len() / 2);
            inside.copied().filter(|piece| !piece.is_empty()).collect()
        })
    }

    fn spans<'a>(&'a self, find: impl Fn(&'a str) -> Vec<&'a str>) -> Vec<Span> {
        let in_line = |(line, text): &'a (usize, String)| {
            let spans = find(text).into_iter();
            spans.map(|text| Span { line: *line, text: text.to_owned() }).collect::<Vec<_>>()
        };
        self.lines.iter().flat_map(in_line).collect()
    }

    /// Headings, as links name them: small letters, hyphens for spaces, no other signs.
    pub(crate) fn headings(&self) -> impl Iterator<Item = String> {
        let heads = self.lines.iter().filter(|(_, text)| text.starts_with('#'));
        heads.map(|(_, text)| {
            let title = text.trim_start_matches('#').trim().to_lowercase();
            let kept = title.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
    }
}
