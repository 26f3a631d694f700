//! What a step keeps, what it gives exactly, and what it says when it cannot go on.

#[path = "../common/mod.rs"]
mod common;

mod angular;
mod failure;
mod motion;
mod single_particle;
mod transfer;
mod walls;

use common::methods;
use mpm_verify::mpm::{BasisName, TransferName};

/// Taylor least squares keeps the momentum of every cell in P2G, but its nodal masses are not those
/// that G2P would need to give the change of momentum back: the only transfer that claims less.
fn conservative() -> impl Iterator<Item = (BasisName, TransferName)> {
    methods().filter(|(_, transfer)| *transfer != TransferName::Tls)
}
