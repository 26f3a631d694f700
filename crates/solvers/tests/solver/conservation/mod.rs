//! Conserved sums of a step, its exact results, and its errors.

mod angular;
mod failure;
mod hostile;
mod motion;
mod single_particle;
mod transfer;
mod walls;

use crate::common::{methods, pairs};
use mpm_solvers::mpm::{BasisName, Particles, TransferName, Vector};

/// Taylor least squares is excluded. It conserves the momentum of every cell in P2G, but G2P would
/// need other nodal masses to return the change of momentum. No other transfer has such a weak
/// property.
fn conservative(dimension: usize) -> impl Iterator<Item = (BasisName, TransferName)> {
    some(dimension).filter(|(_, transfer)| *transfer != TransferName::Tls)
}

/// Methods for whole runs. In 3-D, where a run costs ten times as much, these are every basis with
/// FLIP, and every transfer with linear functions or, if this is invalid, with GIMP.
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

fn momentum<const D: usize>(particles: &Particles<D>) -> Vector<D> {
    particles.v.iter().zip(&particles.mass).map(|(v, m)| v * *m).sum()
}
