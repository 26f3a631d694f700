//! Profile of a step of several bodies: equal columns of all bodies are one column.

use super::coupling::Coupling;
use crate::subject::{ColumnSize, Profile};

/// One profile of all bodies and their coupling. Every body has a grid, so nodes are those of all.
pub(in crate::mpm) fn of<const D: usize>(
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
        add(&mut all.columns, body.columns);
    }
    if let Some(coupling) = coupling {
        all.effects.extend(coupling.name());
        let sizes = coupling.columns().into_iter().map(|column| column.size);
        all.columns.extend(sizes.filter(|column| column.entries > 0));
    }
    all
}

/// Adds the columns of one body to those of others, each to the one that is the same; a second of
/// the same body (two walls) to the second.
fn add(all: &mut Vec<ColumnSize>, body: Vec<ColumnSize>) {
    let kind = |column: &ColumnSize| (column.name, column.holder, column.bytes);
    let known = all.len();
    let mut taken = vec![false; known];
    for column in body {
        let same = (0..known).find(|&k| !taken[k] && kind(&all[k]) == kind(&column));
        match same {
            Some(k) => {
                taken[k] = true;
                all[k].entries += column.entries;
            }
            None => all.push(column),
        }
    }
}
