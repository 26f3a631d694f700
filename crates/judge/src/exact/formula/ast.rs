//! The syntax tree of a formula.

use std::ops::Range;

use super::builtin::Binary;
use super::unary::Unary;

/// A parsed formula whose names are not resolved.
#[derive(Debug, Clone)]
pub struct Expr {
    source: String,
    /// Children precede their parents; the root is last. Drop and clone therefore do not recurse.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) kind: NodeKind,
    pub(super) span: Range<usize>,
}

/// Kinds of nodes. Children are indices in the list of nodes.
#[derive(Debug, Clone)]
pub(super) enum NodeKind {
    Number(f64),
    /// A constant, a variable or the parameter of a function.
    Name(String),
    /// The index of an enclosing sum; 0 is the outermost sum.
    Index(usize),
    Negate(usize),
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
    Call(String, Vec<usize>),
    Sum(Sum),
}

/// A sum, `sum(index, from, to, body)`.
#[derive(Debug, Clone)]
pub(super) struct Sum {
    pub(super) index: String,
    pub(super) index_span: Range<usize>,
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) body: usize,
}

impl Expr {
    pub(super) fn new(source: &str, nodes: Vec<Node>) -> Self {
        Self { source: source.to_owned(), nodes }
    }

    /// Returns the parsed text.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Returns free names (not builtins, functions, sum indices) with spans, in reading order.
    pub fn names(&self) -> Vec<(String, Range<usize>)> {
        self.collect(|kind| match kind {
            NodeKind::Name(name) => Some(name),
            _ => None,
        })
    }

    /// Returns all calls of user functions with the spans of the function names, in reading order.
    pub fn calls(&self) -> Vec<(String, Range<usize>)> {
        self.collect(|kind| match kind {
            NodeKind::Call(name, _) => Some(name),
            _ => None,
        })
    }

    pub(super) fn root(&self) -> usize {
        self.nodes.len() - 1
    }

    pub(super) fn node(&self, at: usize) -> &Node {
        &self.nodes[at]
    }

    pub(super) fn sums(&self) -> impl Iterator<Item = &Sum> {
        self.nodes.iter().filter_map(|node| match &node.kind {
            NodeKind::Sum(sum) => Some(sum),
            _ => None,
        })
    }

    fn collect(&self, pick: impl Fn(&NodeKind) -> Option<&String>) -> Vec<(String, Range<usize>)> {
        let mut found: Vec<_> = self
            .nodes
            .iter()
            .filter_map(|node| pick(&node.kind).map(|name| (name.clone(), node.head(name))))
            .collect();
        found.sort_by_key(|(_, span)| span.start);
        found
    }
}

impl Node {
    pub(super) fn head(&self, name: &str) -> Range<usize> {
        self.span.start..self.span.start + name.len()
    }
}
