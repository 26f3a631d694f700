//! Columns of a body as a profile of memory, and as fields to look at.

use crate::mpm::effect::Effect;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::subject::{BodyFields, Column, ColumnSize, Holder, Profile, StateField};

/// Profile of a step of a body with these effects and columns, without its passes and visits.
pub(in crate::mpm) fn profile<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    effects: &[Box<dyn Effect<D>>],
    columns: &[Column<'_>],
) -> Profile {
    let sizes = columns.iter().map(|column| column.size);
    Profile {
        effects: effects.iter().map(|effect| effect.name()).collect(),
        particles: particles.len(),
        nodes: grid.nodes(),
        columns: sizes.filter(|size| size.entries > 0).collect(),
        ..Profile::default()
    }
}

/// The columns that have numbers for every particle or every node. Of two with one name the first.
pub(in crate::mpm) fn fields<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    columns: &[Column<'_>],
) -> BodyFields {
    let of = |holder: Holder, entries: usize| {
        let mut fields: Vec<StateField> = Vec::new();
        for column in columns {
            let ColumnSize { name, .. } = column.size;
            let is_whole = column.size.holder == holder && column.size.entries == entries;
            if is_whole && fields.iter().all(|field| field.name != name) {
                fields.extend(column.field());
            }
        }
        fields
    };
    BodyFields {
        particles: particles.len(),
        of_particles: of(Holder::Particle, particles.len()),
        origin: grid.origin.iter().copied().collect(),
        h: grid.h,
        counts: grid.counts.to_vec(),
        of_nodes: of(Holder::Node, grid.nodes()),
    }
}
