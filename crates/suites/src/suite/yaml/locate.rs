//! Locates a value in a file after parsing.

use super::tree::TreeNode;
use super::{Diagnostic, Place, Source};
use std::ops::Range;

/// One step into a map or a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Into the value of a key.
    Key(String),
    /// Into a list entry; indices start at zero.
    Index(usize),
}

impl From<&str> for Step {
    fn from(key: &str) -> Self {
        Self::Key(key.to_owned())
    }
}

impl From<usize> for Step {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Path(Vec<Step>);

impl Path {
    pub(crate) fn top(keys: &str) -> Self {
        Self(keys.split('.').map(Step::from).collect())
    }

    pub(crate) fn then(&self, step: impl Into<Step>) -> Self {
        let mut longer = self.0.clone();
        longer.push(step.into());
        Self(longer)
    }

    pub(crate) fn steps(&self) -> &[Step] {
        &self.0
    }
}

impl Source {
    /// Returns the position of a value; for a list or a map, the position of its first character.
    pub fn value_at(&self, path: &[Step]) -> Option<Place> {
        self.node(path).map(|node| Place::of(self.text(), self.token(node)))
    }

    /// Returns a diagnostic about the value at `path`; about the file if there is no such value.
    pub fn diagnostic_at(&self, path: &[Step], message: &str) -> Diagnostic {
        match self.value_at(path) {
            Some(place) => self.diagnostic(place, message),
            None => Diagnostic::about(self.name(), message),
        }
    }

    /// Returns the position of the key in the last step of `path`.
    pub fn key_at(&self, path: &[Step]) -> Option<Place> {
        let (last, path) = path.split_last()?;
        match (self.node(path)?, last) {
            (TreeNode::Map(map), Step::Key(key)) => {
                let (key, _) = map.entry(key)?;
                Some(Place::of(self.text(), self.scalar(*key).range.clone()))
            }
            _ => None,
        }
    }

    /// Returns the position of a byte range within a text value, such as one name in a formula.
    ///
    /// If the file does not contain the value verbatim (escapes, several lines), returns the
    /// position of the whole value.
    pub fn within(&self, path: &[Step], bytes: Range<usize>) -> Option<Place> {
        let node = self.node(path)?;
        let verbatim = match node {
            TreeNode::Scalar(scalar) => self.scalar(*scalar).verbatim(self.text()),
            _ => None,
        };
        let part = verbatim.and_then(|value| {
            let end = value.start.checked_add(bytes.end)?;
            (bytes.start <= bytes.end && end <= value.end).then(|| value.start + bytes.start..end)
        });
        Some(Place::of(self.text(), part.unwrap_or_else(|| self.token(node))))
    }

    pub(crate) fn text_at(&self, path: &[Step]) -> Option<&str> {
        match self.node(path)? {
            TreeNode::Scalar(scalar) => Some(&self.scalar(*scalar).value),
            _ => None,
        }
    }

    fn node(&self, path: &[Step]) -> Option<&TreeNode> {
        path.iter().try_fold(self.root(), |node, step| match (node, step) {
            (TreeNode::List(list), Step::Index(index)) => list.entries.get(*index),
            (TreeNode::Map(map), Step::Key(key)) => map.entry(key).map(|(_, value)| value),
            _ => None,
        })
    }

    fn token(&self, node: &TreeNode) -> Range<usize> {
        match node {
            TreeNode::Empty(start) => self.token_at(*start),
            TreeNode::Scalar(scalar) => self.scalar(*scalar).range.clone(),
            TreeNode::List(list) => list.start..list.start + 1,
            TreeNode::Map(map) => self.token_at(map.start),
        }
    }
}
