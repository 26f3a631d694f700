//! Positions of all values of a file, from the events of a YAML parser.
//!
//! Rules that hold for all keys are checked on the way: one document without anchors, aliases,
//! tags and merge keys, names as keys, no duplicate keys, finite numbers, and limits on the nesting
//! depth and on the number of entries. The typed parser comes afterwards. It would report a
//! duplicate key only after the value of the key, accepts `.nan`, and its cost is quadratic in the
//! nesting depth.

use super::syntax::{InvalidText, is_indented_by_tab, tab, too_deep, unneeded};
use super::{Diagnostic, MAX_ENTRIES, MAX_NESTING};
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span};
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
    /// Returns the range of the value without quotes, unless it has escapes or folded lines.
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
    pub(crate) fn entry(&self, key: &str) -> Option<&(usize, TreeNode)> {
        self.entries.get(*self.keys.get(key)?)
    }
}

/// Parses the positions of a text: all scalars in order, and the value of the file.
pub(crate) fn tree(name: &str, text: &str) -> Result<(Vec<Scalar>, TreeNode), Diagnostic> {
    build(name, text, Parser::new_from_str(text))
}

/// Builds the tree from the events of a parser. Takes no event after an error.
pub(super) fn build<'t>(
    name: &str,
    text: &'t str,
    events: impl Iterator<Item = Result<(Event<'t>, Span), ScanError>>,
) -> Result<(Vec<Scalar>, TreeNode), Diagnostic> {
    let offsets = if text.is_ascii() {
        Vec::new()
    } else {
        text.char_indices().map(|(offset, _)| offset).collect()
    };
    if let Some(at) = directive(text) {
        let message = "directives are not supported";
        return Err(Diagnostic::at(name, text, at..at + 1, message).with_help("delete this line"));
    }
    let mut builder = TreeBuilder {
        name,
        text,
        offsets,
        scalars: Vec::new(),
        open: Vec::new(),
        events_end: 0,
        root: TreeNode::Empty(text.len()),
    };
    let mut documents = 0;
    for event in events {
        let (event, span) = event.map_err(|error| builder.not_yaml(&error))?;
        let range = builder.offset(span.start.index())..builder.offset(span.end.index());
        documents += usize::from(matches!(event, Event::DocumentStart(_)));
        let is_in_text = !matches!(event, Event::DocumentStart(false) | Event::DocumentEnd);
        if documents > 1 && is_in_text {
            return Err(builder.second_document(range.start));
        }
        builder.event(event, range)?;
    }
    Ok((builder.scalars, builder.root))
}

/// Returns the offset of the first directive other than `%YAML`. Some directives make the parser's
/// positions wrong.
fn directive(text: &str) -> Option<usize> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.starts_with('%') && !(line.starts_with("%YAML ") && line.is_ascii()) {
            return Some(at);
        }
        if !line.starts_with(['%', '#']) && !line.trim().is_empty() {
            return None;
        }
        at += line.len();
    }
    None
}

struct OpenNode {
    collection: Collection,
    /// Whether the list or map is written in brackets.
    is_flow: bool,
}

enum Collection {
    List(ListNode),
    /// The map, and the key whose value has not been parsed yet.
    Map(MapNode, Option<usize>),
}

impl Collection {
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
    /// End of the last event (byte offset).
    events_end: usize,
    root: TreeNode,
}

impl TreeBuilder<'_> {
    fn event(&mut self, event: Event<'_>, range: Range<usize>) -> Result<(), Diagnostic> {
        let start = range.start;
        let in_brackets = self.brackets().next().is_some();
        let is_flow = self.text[start..range.end.max(start)].starts_with(['[', ']', '{', '}']);
        if !in_brackets && is_node(&event) && is_indented_by_tab(self.text, start) {
            return Err(tab(self.name, self.text, start));
        }
        // The event of a document without `---` has the range of the first token.
        let is_ahead = matches!(event, Event::DocumentStart(false));
        let end = if is_ahead { 0 } else { range.end };
        self.content(event, range, is_flow)?;
        self.events_end = self.events_end.max(end);
        Ok(())
    }

    /// Adds the value that an event starts, completes or contains.
    fn content(
        &mut self,
        event: Event<'_>,
        range: Range<usize>,
        is_flow: bool,
    ) -> Result<(), Diagnostic> {
        let start = range.start;
        match event {
            Event::Alias(_)
            | Event::Scalar(_, _, 1.., _)
            | Event::SequenceStart(1.., _)
            | Event::MappingStart(1.., _) => Err(self.unneeded("anchors and aliases", '&', start)),
            Event::Scalar(_, _, _, Some(_))
            | Event::SequenceStart(_, Some(_))
            | Event::MappingStart(_, Some(_)) => Err(self.unneeded("tags", '!', start)),
            Event::Scalar(value, style, ..) => {
                let node = self.scalar(&value, style, range)?;
                self.add(node)
            }
            Event::SequenceStart(..) => {
                let start = if is_flow { start } else { self.dash(start) };
                let list = ListNode { start, entries: Vec::new() };
                self.open(OpenNode { collection: Collection::List(list), is_flow })
            }
            Event::MappingStart(..) => {
                let map = MapNode { start, entries: Vec::new(), keys: HashMap::new() };
                self.open(OpenNode { collection: Collection::Map(map, None), is_flow })
            }
            Event::SequenceEnd | Event::MappingEnd => {
                let Some(OpenNode { collection, is_flow: opened }) = self.open.pop() else {
                    return Ok(());
                };
                // The parser accepts `}` as the end of `a: 1` in `[a: 1}`.
                if is_flow && !opened {
                    return Err(self.invalid(start, "misplaced bracket"));
                }
                self.add(match collection {
                    Collection::List(list) => TreeNode::List(list),
                    Collection::Map(map, _) => TreeNode::Map(map),
                })
            }
            _ => Ok(()),
        }
    }

    fn scalar(
        &mut self,
        value: &str,
        style: ScalarStyle,
        Range { mut start, mut end }: Range<usize>,
    ) -> Result<TreeNode, Diagnostic> {
        match style {
            ScalarStyle::Plain if value.is_empty() => {
                let colon = usize::from(self.text[start..].starts_with(':'));
                return Ok(TreeNode::Empty(start + colon));
            }
            ScalarStyle::Plain => {
                let is_key = self.is_at_key();
                if let Some(kind) = not_finite(value).filter(|_| !is_key) {
                    let message = format!("expected a finite number, found {kind}");
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

    /// Returns the end of a quoted scalar. The range of its event includes a comment.
    fn end_of_quoted(&self, start: usize) -> usize {
        let bytes = self.text.as_bytes();
        let Some(&quote) = bytes.get(start) else { return start };
        let mut at = start + 1;
        while let Some(&byte) = bytes.get(at) {
            match byte {
                b'\\' if quote == b'"' => at += 2,
                b'\'' if quote == byte && bytes.get(at + 1) == Some(&byte) => at += 2,
                _ if byte == quote => return at + 1,
                _ => at += 1,
            }
        }
        bytes.len()
    }

    /// Returns the offset of the `|` or `>` between the last event and the content of a block.
    fn block_indicator(&self, content: usize) -> usize {
        let mut at = self.events_end.min(content);
        for line in self.text[at..content].split_inclusive('\n') {
            let before_comment = line.find('#').map_or(line, |comment| &line[..comment]);
            if let Some(indicator) = before_comment.find(['|', '>']) {
                return at + indicator;
            }
            at += line.len();
        }
        content
    }

    fn open(&mut self, node: OpenNode) -> Result<(), Diagnostic> {
        let start = node.collection.start();
        if self.is_at_key() {
            let is_list = matches!(node.collection, Collection::List(_));
            let found = if is_list { "a list" } else { "a map (`key: value`)" };
            return Err(self.key_is_no_name(start, found));
        }
        if self.open.len() >= MAX_NESTING {
            return Err(too_deep(self.name, self.text, start));
        }
        self.open.push(node);
        Ok(())
    }

    /// Adds a complete key or value to the innermost list or map. Outside of all, it is the root.
    fn add(&mut self, node: TreeNode) -> Result<(), Diagnostic> {
        let Some(OpenNode { collection, .. }) = self.open.last_mut() else {
            self.root = node;
            return Ok(());
        };
        let (start, entries, what) = match collection {
            Collection::List(list) => {
                list.entries.push(node);
                (list.start, list.entries.len(), "list")
            }
            Collection::Map(map, key) => match (key.take(), node) {
                (Some(name), value) => {
                    map.entries.push((name, value));
                    (map.start, map.entries.len(), "map")
                }
                (None, TreeNode::Scalar(name)) => {
                    let text = self.scalars[name].value.clone();
                    let is_merge = text == "<<";
                    let is_second = map.keys.insert(text, map.entries.len()).is_some();
                    *key = Some(name);
                    if is_merge || is_second {
                        return Err(self.key_error(name, is_merge));
                    }
                    return Ok(());
                }
                (None, TreeNode::Empty(at)) => return Err(self.key_is_no_name(at, "nothing")),
                // `open` refuses them.
                (None, TreeNode::List(_) | TreeNode::Map(_)) => return Ok(()),
            },
        };
        if entries <= MAX_ENTRIES {
            return Ok(());
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

    fn is_at_key(&self) -> bool {
        let innermost = self.open.last().map(|open| &open.collection);
        matches!(innermost, Some(Collection::Map(_, None)))
    }

    fn brackets(&self) -> impl Iterator<Item = usize> {
        let brackets = self.open.iter().filter(|open| open.is_flow);
        brackets.map(|open| open.collection.start())
    }

    /// Returns the offset of the dash of a block list, whose event may be at its first entry.
    fn dash(&self, start: usize) -> usize {
        let mut line_start = self.events_end.min(start);
        for line in self.text[line_start..start].split_inclusive('\n') {
            let rest = line.trim_start();
            if rest.starts_with('-') {
                return line_start + line.len() - rest.len();
            }
            line_start += line.len();
        }
        start
    }

    fn diagnostic(&self, range: Range<usize>, message: &str) -> Diagnostic {
        Diagnostic::at(self.name, self.text, range, message)
    }

    fn second_document(&self, at: usize) -> Diagnostic {
        self.diagnostic(at..at + 1, "a second document starts here")
            .with_label("a suite is one document")
            .with_help("put each suite in a file of its own")
    }

    /// Returns the error for an anchor, alias or tag; the indicator `c` may precede the value.
    fn unneeded(&self, what: &str, c: char, at: usize) -> Diagnostic {
        let is_here = self.text[at..].starts_with(['&', '*', '!']);
        let at = if is_here { at } else { self.text[..at].rfind(c).unwrap_or(at) };
        unneeded(self.name, self.text, what, at)
    }

    fn key_is_no_name(&self, at: usize, found: &str) -> Diagnostic {
        self.diagnostic(at..at + 1, &format!("expected a name as key, found {found}"))
            .with_label("a name as key is expected here")
    }

    fn key_error(&self, key: usize, is_merge: bool) -> Diagnostic {
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

    fn not_yaml(&self, error: &ScanError) -> Diagnostic {
        self.invalid(self.offset(error.marker().index()), error.info())
    }

    fn invalid(&self, at: usize, problem: &str) -> Diagnostic {
        let (name, text, brackets) = (self.name, self.text, self.brackets().collect());
        InvalidText { name, text, at, problem, events_end: self.events_end, brackets }.explain()
    }
}

fn is_node(event: &Event<'_>) -> bool {
    matches!(event, Event::Scalar(..) | Event::SequenceStart(..) | Event::MappingStart(..))
}

/// Returns `infinity` or `NaN` if a plain scalar is such a number.
fn not_finite(text: &str) -> Option<&'static str> {
    if let ".nan" | ".NaN" | ".NAN" = text {
        return Some("NaN");
    }
    match text.strip_prefix(['+', '-']).unwrap_or(text) {
        ".inf" | ".Inf" | ".INF" => Some("infinity"),
        _ => None,
    }
}
