//! The syntax tree of a formula.

use std::ops::Range;

use super::builtin::Binary;
use super::unary::Unary;

/// A parsed formula, not yet bound: its names have no meaning yet.
#[derive(Debug, Clone)]
pub struct Expr {
    source: String,
    /// Children precede their parents and the root is last. A flat list, unlike a tree of boxes, is
    /// dropped and cloned without recursion, also for a long chain of `+`.
    nodes: Vec<Node>,
}

/// One node of the tree, with the bytes it was read from.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) kind: NodeKind,
    pub(super) span: Range<usize>,
}

/// Kinds of nodes. Children are given by their position in the list of nodes.
#[derive(Debug, Clone)]
pub(super) enum NodeKind {
    Number(f64),
    /// A constant, a variable or the parameter of a function.
    Name(String),
    /// The index of the enclosing sum at this level, 0 being the outermost.
    Index(usize),
    Negate(usize),
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
    /// A call of a user function.
    Call(String, Vec<usize>),
    Sum(Sum),
}

/// `sum(index, from, to, body)`.
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

    /// The text that was parsed.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Every occurrence of a free name and its span, in reading order. Builtin names, called
    /// functions and the indices of sums are not free names.
    pub fn names(&self) -> Vec<(String, Range<usize>)> {
        self.collect(|kind| match kind {
            NodeKind::Name(name) => Some(name),
            _ => None,
        })
    }

    /// Every call of a user function and the span of its name, in reading order.
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

    /// All sums of the formula.
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
    /// The span of the name with which this node begins.
    pub(super) fn head(&self, name: &str) -> Range<usize> {
        self.span.start..self.span.start + name.len()
    }
}
