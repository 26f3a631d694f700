//! Positions of all values of a file, from the events of a YAML parser.
//!
//! Rules that hold for all keys are checked on the way: one document without anchors, aliases,
//! tags and merge keys, names as keys, no duplicate keys, finite numbers, and limits on the nesting
//! depth and on the number of entries. The typed parser comes afterwards. It would report a
//! duplicate key only after the value of the key, accepts `.nan`, and its cost is quadratic in the
//! nesting depth.

use super::phrase::syntax;
use super::{Diagnostic, MAX_ENTRIES, MAX_NESTING, Place};
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError};
use std::collections::HashMap;
use std::ops::Range;

/// A plain, quoted or block scalar that is not empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Scalar {
    /// Extent with quotes, or from the indicator of a block to its last visible character.
    pub(crate) range: Range<usize>,
    style: ScalarStyle,
    /// The text without quotes, with escapes resolved and lines folded.
    pub(crate) value: String,
}

impl Scalar {
    /// Returns the byte range of the value without quotes; `None` if it has escapes or folded
    /// lines.
    pub(crate) fn verbatim(&self, text: &str) -> Option<Range<usize>> {
        let quotes = usize::from(self.is_quoted());
        let inside = self.range.start + quotes..self.range.end - quotes;
        (text.get(inside.clone())? == self.value).then_some(inside)
    }

    pub(crate) fn is_quoted(&self) -> bool {
        matches!(self.style, ScalarStyle::SingleQuoted | ScalarStyle::DoubleQuoted)
    }
}

/// A value of a file. A scalar is an index into the list of all scalars.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum TreeNode {
    /// No value, at this offset.
    Empty(usize),
    Scalar(usize),
    List(ListNode),
    Map(MapNode),
}

/// A list and the offset of its first character.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ListNode {
    pub(crate) start: usize,
    pub(crate) entries: Vec<TreeNode>,
}

/// A map and the offset of its first character. Keys are scalars; no text occurs twice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MapNode {
    pub(crate) start: usize,
    pub(crate) entries: Vec<(usize, TreeNode)>,
    keys: HashMap<String, usize>,
}

impl MapNode {
    /// Returns key and value of the entry whose key has this text.
    pub(crate) fn entry(&self, key: &str) -> Option<&(usize, TreeNode)> {
        self.entries.get(*self.keys.get(key)?)
    }
}

/// Parses the positions of a text. Returns all scalars in order, and the value of the file.
///
/// # Errors
/// The first violation of a rule, or the reason why the text is not YAML.
pub(crate) fn tree(name: &str, text: &str) -> Result<(Vec<Scalar>, TreeNode), Diagnostic> {
    let offsets = if text.is_ascii() {
        Vec::new()
    } else {
        text.char_indices().map(|(offset, _)| offset).collect()
    };
    let mut builder = TreeBuilder { name, text, offsets, scalars: Vec::new(), open: Vec::new() };
    let mut documents = 0;
    let mut root = TreeNode::Empty(text.len());
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| builder.not_yaml(&error))?;
        let range = builder.offset(span.start.index())..builder.offset(span.end.index());
        let is_content = !matches!(event, Event::DocumentStart(_) | Event::DocumentEnd);
        if let Event::DocumentStart(_) = event {
            documents += 1;
        }
        if documents > 1 && (is_content || !range.is_empty()) && event != Event::DocumentEnd {
            return Err(builder.second_document(range.start));
        }
        if let Some(node) = builder.event(event, range)? {
            root = node;
        }
    }
    Ok((builder.scalars, root))
}

/// A list or map whose end is not reached.
enum OpenNode {
    List(ListNode),
    /// The key is that of the next value.
    Map(MapNode, Option<usize>),
}

impl OpenNode {
    fn start(&self) -> usize {
        match self {
            Self::List(list) => list.start,
            Self::Map(map, _) => map.start,
        }
    }
}

struct TreeBuilder<'t> {
    name: &'t str,
    text: &'t str,
    /// Byte offsets of all characters; empty if each character is one byte.
    offsets: Vec<usize>,
    scalars: Vec<Scalar>,
    open: Vec<OpenNode>,
}

impl TreeBuilder<'_> {
    /// Adds an event. Returns the value of the file when it is complete.
    fn event(
        &mut self,
        event: Event<'_>,
        range: Range<usize>,
    ) -> Result<Option<TreeNode>, Diagnostic> {
        let start = range.start;
        if self.bracket().is_none() && is_node(&event) && self.is_indented_by_tab(start) {
            return Err(self.tab(start));
        }
        match event {
            Event::Alias(_) => Err(self.unneeded("anchors and aliases", start)),
            Event::Scalar(_, _, 1.., _)
            | Event::SequenceStart(1.., _)
            | Event::MappingStart(1.., _) => {
                Err(self.unneeded("anchors and aliases", self.last('&', start)))
            }
            Event::Scalar(_, _, _, Some(_))
            | Event::SequenceStart(_, Some(_))
            | Event::MappingStart(_, Some(_)) => Err(self.unneeded("tags", self.last('!', start))),
            Event::Scalar(value, style, ..) => {
                let node = self.scalar(&value, style, range)?;
                self.add(node)
            }
            Event::SequenceStart(..) => {
                let is_flow = self.text[start..].starts_with('[');
                // The list of a key may have the indentation of the key. The event of such a list
                // is after the dash.
                let start = if is_flow { start } else { self.last('-', start) };
                self.open(OpenNode::List(ListNode { start, entries: Vec::new() }))
            }
            Event::MappingStart(..) => {
                let map = MapNode { start, entries: Vec::new(), keys: HashMap::new() };
                self.open(OpenNode::Map(map, None))
            }
            Event::SequenceEnd | Event::MappingEnd => match self.open.pop() {
                Some(OpenNode::List(list)) => self.add(TreeNode::List(list)),
                Some(OpenNode::Map(map, _)) => self.add(TreeNode::Map(map)),
                None => Ok(None),
            },
            _ => Ok(None),
        }
    }

    fn scalar(
        &mut self,
        value: &str,
        style: ScalarStyle,
        Range { mut start, mut end }: Range<usize>,
    ) -> Result<TreeNode, Diagnostic> {
        match style {
            ScalarStyle::Plain if value.is_empty() => return Ok(TreeNode::Empty(start)),
            ScalarStyle::Plain => {
                let is_key = matches!(self.open.last(), Some(OpenNode::Map(_, None)));
                if let Some(found) = not_finite(value).filter(|_| !is_key) {
                    let message = format!("expected a finite number, found {found}");
                    let label = "a finite number is expected here";
                    return Err(self.diagnostic(start..end, &message).with_label(label));
                }
            }
            ScalarStyle::Literal | ScalarStyle::Folded => {
                (start, end) = (self.block_indicator(start), self.text[..end].trim_end().len());
            }
            ScalarStyle::SingleQuoted | ScalarStyle::DoubleQuoted => {
                end = self.end_of_quoted(start);
            }
        }
        self.scalars.push(Scalar { range: start..end.max(start), style, value: value.to_owned() });
        Ok(TreeNode::Scalar(self.scalars.len() - 1))
    }

    /// Returns the end of the quoted scalar that starts at offset `start`. The range of the event
    /// also contains the blanks and the comment that follow.
    fn end_of_quoted(&self, start: usize) -> usize {
        let bytes = self.text.as_bytes();
        let (quote, mut at) = (bytes[start], start + 1);
        while at < bytes.len() {
            let is_pair = bytes[at] == b'\'' && bytes.get(at + 1) == Some(&b'\'');
            match bytes[at] {
                b'\\' if quote == b'"' => at += 2,
                b'\'' if quote == b'\'' && is_pair => at += 2,
                byte if byte == quote => return at + 1,
                _ => at += 1,
            }
        }
        bytes.len()
    }

    /// Returns the offset of the `|` or `>` of a block scalar with content at offset `content`.
    fn block_indicator(&self, content: usize) -> usize {
        let header = self.text[..content].trim_end();
        let line = header.rfind('\n').map_or(0, |at| at + 1);
        let header = &header[line..];
        let header = header.find(" #").map_or(header, |comment| &header[..comment]);
        header.rfind(['|', '>']).map_or(content, |at| line + at)
    }

    fn open(&mut self, node: OpenNode) -> Result<Option<TreeNode>, Diagnostic> {
        if let Some(OpenNode::Map(_, None)) = self.open.last() {
            let is_list = matches!(node, OpenNode::List(_));
            let found = if is_list { "a list" } else { "a map (`key: value`)" };
            return Err(self.key_is_no_name(node.start(), found));
        }
        if self.open.len() >= MAX_NESTING {
            return Err(self.too_deep(node.start()));
        }
        self.open.push(node);
        Ok(None)
    }

    /// Adds a key or value to the innermost list or map. Returns the node if there is none.
    fn add(&mut self, node: TreeNode) -> Result<Option<TreeNode>, Diagnostic> {
        let Self { open, scalars, .. } = self;
        let (start, entries, what) = match open.last_mut() {
            None => return Ok(Some(node)),
            Some(OpenNode::List(list)) => {
                list.entries.push(node);
                (list.start, list.entries.len(), "list")
            }
            Some(OpenNode::Map(map, key)) => match (key.take(), node) {
                (Some(name), value) => {
                    map.entries.push((name, value));
                    (map.start, map.entries.len(), "map")
                }
                (None, TreeNode::Scalar(name)) => {
                    let text = scalars[name].value.clone();
                    let is_merge = text == "<<";
                    let is_second = map.keys.insert(text, map.entries.len()).is_some();
                    *key = Some(name);
                    if is_merge || is_second {
                        return Err(self.refused_key(name, is_merge));
                    }
                    return Ok(None);
                }
                (None, node) => {
                    let at = if let TreeNode::Empty(at) = node { at } else { map.start };
                    return Err(self.key_is_no_name(at, "nothing"));
                }
            },
        };
        if entries <= MAX_ENTRIES {
            return Ok(None);
        }
        let message = format!("this {what} has more than {MAX_ENTRIES} entries");
        Err(self.diagnostic(start..start + 1, &message))
    }

    fn offset(&self, character: usize) -> usize {
        if self.offsets.is_empty() {
            return character.min(self.text.len());
        }
        self.offsets.get(character).copied().unwrap_or(self.text.len())
    }

    /// Whether a tab is in the indentation of the line of offset `at`. The YAML parser accepts some
    /// such tabs, but not the parser of the typed values.
    fn is_indented_by_tab(&self, at: usize) -> bool {
        let line = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        self.text[line..at].trim_start_matches(' ').starts_with('\t')
    }

    /// Returns the offset of the last `c` at or before the offset `at`.
    fn last(&self, c: char, at: usize) -> usize {
        let end = at + self.text[at..].chars().next().map_or(0, char::len_utf8);
        self.text[..end].rfind(c).unwrap_or(at)
    }
}

fn is_node(event: &Event<'_>) -> bool {
    matches!(event, Event::Scalar(..) | Event::SequenceStart(..) | Event::MappingStart(..))
}

/// The characters after a backslash in a quoted text.
const ESCAPES: &str = "0abt\tnvfre \"/\\N_LPxuU\n";

/// Returns what a plain scalar is, if it is a number for YAML but not finite.
fn not_finite(text: &str) -> Option<&'static str> {
    match text.strip_prefix(['+', '-']).unwrap_or(text) {
        ".inf" | ".Inf" | ".INF" => Some("infinity"),
        ".nan" | ".NaN" | ".NAN" => Some("NaN"),
        _ => None,
    }
}

/// Errors.
impl TreeBuilder<'_> {
    fn diagnostic(&self, range: Range<usize>, message: &str) -> Diagnostic {
        Diagnostic::at(self.name, self.text, range, message)
    }

    fn second_document(&self, at: usize) -> Diagnostic {
        self.diagnostic(at..at + 1, "a second document starts here")
            .with_label("a suite is one document")
            .with_help("put each suite in a file of its own")
    }

    fn unneeded(&self, what: &str, at: usize) -> Diagnostic {
        let start = self.text[at..].chars().next().unwrap_or_default();
        self.diagnostic(at..at + 1, &format!("{what} are not supported"))
            .with_label(&format!("a value cannot start with `{start}`"))
            .with_help("put text in quotes; give a value a name under `parameters`")
    }

    fn too_deep(&self, at: usize) -> Diagnostic {
        let message = format!("lists and maps nest more than {MAX_NESTING} deep");
        self.diagnostic(at..at + 1, &message)
    }

    fn key_is_no_name(&self, at: usize, found: &str) -> Diagnostic {
        self.diagnostic(at..at + 1, &format!("expected a name as key, found {found}"))
            .with_label("a name as key is expected here")
    }

    fn refused_key(&self, key: usize, is_merge: bool) -> Diagnostic {
        let Scalar { range, value, .. } = &self.scalars[key];
        if is_merge {
            return self
                .diagnostic(range.clone(), "merge keys are not supported")
                .with_label("a key cannot be `<<`")
                .with_help("write the keys out; give a value a name under `parameters`");
        }
        self.diagnostic(range.clone(), &format!("the key `{value}` is given twice"))
            .with_label("the second time")
            .with_help("keep one of the two")
    }

    /// Returns the error for a text that is not YAML. Unclosed brackets and quotes are located
    /// where they start.
    fn not_yaml(&self, error: &ScanError) -> Diagnostic {
        let at = self.offset(error.marker().index());
        let rest = &self.text[at..];
        let first = rest.chars().next();
        let here = |message: &str| self.diagnostic(at..at + 1, message);
        let is = |problem: &str| error.info().contains(problem);
        match (first, self.bracket()) {
            _ if is("recursion limit") => self.too_deep(at),
            _ if is("unknown anchor") => self.unneeded("anchors and aliases", at),
            _ if is("tab") => self.tab(at),
            (Some(quote @ ('"' | '\'')), _) if !rest[1..].contains(quote) => {
                here("this quote is never closed").with_label("no matching quote")
            }
            (Some(closing @ (']' | '}')), None) if is("misplaced bracket") => {
                let opening = if closing == ']' { '[' } else { '{' };
                here(&format!("`{closing}` without a `{opening}` before it"))
            }
            (Some(closing @ (']' | '}')), Some(start)) if !self.closes(start, closing) => {
                self.crossed(start, at, closing)
            }
            (_, Some(start)) if rest.trim().is_empty() => {
                let (opening, closing) =
                    if self.closes(start, ']') { ('[', ']') } else { ('{', '}') };
                self.diagnostic(start..start + 1, &format!("this `{opening}` is never closed"))
                    .with_label(&format!("no matching `{closing}`"))
            }
            (_, Some(start)) if is("invalid indentation") || is("illegal placement") => {
                let (bracket, line) = (&self.text[start..=start], error.marker().line());
                let message = format!("this `{bracket}` is not closed before line {line}");
                self.diagnostic(start..start + 1, &message)
                    .with_label("no matching bracket")
                    .with_help("lines inside brackets need more indentation than their key")
            }
            _ => {
                let (message, help) = syntax(error.info()).unwrap_or((error.info(), ""));
                self.diagnostic(self.word_or_escape(at), message).with_help(help)
            }
        }
    }

    /// Returns the offset of the innermost bracket that is open.
    fn bracket(&self) -> Option<usize> {
        let mut open = self.open.iter().rev().map(OpenNode::start);
        open.find(|start| self.text[*start..].starts_with(['[', '{']))
    }

    /// Returns the range of the name at `at`, or of the first unknown escape in a quoted text, or
    /// of one character.
    fn word_or_escape(&self, at: usize) -> Range<usize> {
        let rest = &self.text[at..];
        if rest.starts_with('"') {
            let mut escapes = rest.match_indices('\\').map(|(offset, _)| at + offset);
            let known =
                |offset: &usize| self.text[offset + 1..].starts_with(|c| ESCAPES.contains(c));
            while let Some(offset) = escapes.next() {
                if !known(&offset) {
                    return offset..offset + 1;
                }
                if self.text[offset + 1..].starts_with('\\') {
                    escapes.next();
                }
            }
        }
        let is_name = |c: char| c.is_alphanumeric() || "_-.".contains(c);
        let length = rest.find(|c| !is_name(c)).unwrap_or(rest.len());
        at..at + length.max(1)
    }

    fn closes(&self, start: usize, closing: char) -> bool {
        self.text[start..].starts_with('[') == (closing == ']')
    }

    /// Returns the error for the first tab in the line of offset `at`.
    fn tab(&self, at: usize) -> Diagnostic {
        let line = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let at = self.text[line..].find('\t').map_or(at, |tab| line + tab);
        self.diagnostic(at..at + 1, "tab used for indentation; YAML needs spaces")
            .with_label("a tab")
    }

    /// Returns the error for a closing bracket at `end` that does not match the opening bracket at
    /// `start`.
    fn crossed(&self, start: usize, end: usize, closing: char) -> Diagnostic {
        let bracket = &self.text[start..=start];
        let place = Place::of(self.text, end..end + 1);
        let (line, column) = (place.line(), place.column());
        self.diagnostic(
            start..start + 1,
            &format!("this `{bracket}` is not closed before a `{closing}`"),
        )
        .with_label("no matching bracket")
        .with_help(&format!("the `{closing}` is on line {line}, column {column}"))
    }
}
