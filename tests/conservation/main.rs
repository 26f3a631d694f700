//! What a step keeps, what it gives exactly, and what it says when it cannot go on.

#[path = "../common/mod.rs"]
mod common;

mod angular;
mod failure;
mod motion;
mod single_particle;
mod transfer;
