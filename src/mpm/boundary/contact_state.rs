//! Contact state under Coulomb friction, of a node at a wall or of two bodies at a node.

use crate::subject::{Checkpoint, Entry, Memory};

/// State of a contact by Coulomb's law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mpm) enum ContactState {
    /// They do not touch.
    Separated,
    /// They slide along each other.
    Slip,
    /// They move as one.
    Stick,
}

impl Entry for ContactState {}

impl Memory for ContactState {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let mut number = *self as u64;
        checkpoint.visit(&mut number);
        match number {
            0 => *self = Self::Separated,
            1 => *self = Self::Slip,
            2 => *self = Self::Stick,
            _ => checkpoint.refuse(),
        }
    }
}
