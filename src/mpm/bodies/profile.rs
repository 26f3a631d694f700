//! What a step of several bodies works with: columns of one name are one.

use super::coupling::Coupling;
use crate::subject::{Column, Profile};

/// The profiles of all bodies and of what couples them, as one. Every body has a grid of its own, so
/// nodes are those of all.
pub(super) fn of<const D: usize>(
    bodies: impl Iterator<Item = Profile>,
    coupling: Option<&dyn Coupling<D>>,
) -> Profile {
    let mut all = Profile::default();
    for body in bodies {
        all.particles += body.particles;
        all.nodes += body.nodes;
        for effect in body.effects {
            if !all.effects.contains(&effect) {
                all.effects.push(effect);
            }
        }
        body.columns.into_iter().for_each(|column| add(&mut all.columns, column));
    }
    if let Some(coupling) = coupling {
        all.effects.extend(coupling.name());
        let columns = coupling.columns().into_iter().filter(|column| column.entries > 0);
        columns.for_each(|column| add(&mut all.columns, column));
    }
    all
}

fn add(columns: &mut Vec<Column>, column: Column) {
    let same = |known: &&mut Column| {
        (known.name, known.holder, known.bytes) == (column.name, column.holder, column.bytes)
    };
    match columns.iter_mut().find(same) {
        Some(known) => known.entries += column.entries,
        None => columns.push(column),
    }
}
