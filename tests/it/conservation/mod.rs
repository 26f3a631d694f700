//! Conserved sums of a step, its exact results, and its errors.

mod angular;
mod failure;
mod hostile;
mod motion;
mod single_particle;
mod transfer;
mod walls;

use crate::common::{methods, pairs};
use mpm_verify::mpm::{BasisName, TransferName};

/// Taylor least squares keeps the momentum of every cell in P2G, but its nodal masses are not those
/// that G2P would need to give the change of momentum back: the only transfer that claims less.
fn conservative(dimension: usize) -> impl Iterator<Item = (BasisName, TransferName)> {
    some(dimension).filter(|(_, transfer)| *transfer != TransferName::Tls)
}

/// The methods in one and two dimensions; in space, where a run costs ten times as much, every
/// basis with FLIP and every transfer with linear functions or, where that means nothing, with
/// GIMP.
fn some(dimension: usize) -> impl Iterator<Item = (BasisName, TransferName)> {
    let in_space = |(basis, transfer): &(BasisName, TransferName)| match transfer {
        TransferName::Flip => true,
        TransferName::Mls => *basis == BasisName::UniformGimp,
        _ => *basis == BasisName::Linear,
    };
    let all: Vec<_> =
        if dimension < 3 { methods().collect() } else { pairs().filter(in_space).collect() };
    all.into_iter()
}
