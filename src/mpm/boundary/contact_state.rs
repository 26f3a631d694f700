//! How what meets with friction touches: a node and a wall, or two bodies at a node.

use crate::subject::{Checkpoint, Memory};

/// What Coulomb's law makes of a meeting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mpm) enum Touch {
    /// They do not touch.
    Free,
    /// They slide along each other.
    Slides,
    /// They move as one.
    Sticks,
}

impl Memory for Touch {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let mut number = *self as u64;
        checkpoint.visit(&mut number);
        match number {
            0 => *self = Self::Free,
            1 => *self = Self::Slides,
            2 => *self = Self::Sticks,
            _ => checkpoint.refuse(),
        }
    }
}
