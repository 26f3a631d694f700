//! The two ways between particles and nodes, each a pass that threads may share, and what these keep.

use super::{
    colouring::{Blocks, ParticleBlock},
    g2p::{Gather, are_beside},
    p2g::{Scatter, has_one_field},
    par_split::par_split,
    parallel::{Target, two_colour_schedule},
    request::{G2pRequest, P2gRequest},
};
use crate::mpm::{
    algebra::Vector,
    basis::Basis,
    grid::Grid,
    packed_grid::{Columns, FieldViewMut, PackedField},
    particles::Particles,
    simd,
};
use std::marker::PhantomData;

/// What a pass needs besides particles and grid.
#[derive(Debug, Default)]
pub(in crate::mpm) struct Workspace {
    /// Two fields of nodes, packed.
    fields: [PackedField; 2],
    pub(in crate::mpm) blocks: Blocks,
}

/// Those of two fields that are wanted, in the shape of `grid`; nothing in place of the others.
fn views<'a, const D: usize>(
    fields: &'a mut [PackedField; 2],
    grid: &Grid<D>,
    wanted: [bool; 2],
) -> [FieldViewMut<'a>; 2] {
    let mut wanted = wanted.into_iter();
    fields.each_mut().map(|field| match wanted.next() {
        Some(true) => field.shaped(grid),
        _ => FieldViewMut::none(),
    })
}

/// Packs velocities, and accelerations too if they are wanted.
pub(in crate::mpm) fn pack<const D: usize>(
    [first, second]: &mut [PackedField; 2],
    grid: &Grid<D>,
    velocity: &[Vector<D>],
    wants_acceleration: bool,
) {
    let acceleration = wants_acceleration.then_some(&*grid.acceleration);
    first.pack(grid, velocity, acceleration.filter(|_| are_beside::<D>()));
    if let Some(acceleration) = acceleration.filter(|_| !are_beside::<D>()) {
        second.pack(grid, acceleration, None);
    }
}

impl Workspace {
    /// What `maps` says, into `columns`.
    pub(in crate::mpm) fn scatter<B: Basis, const D: usize>(
        &mut self,
        particles: &Particles<D>,
        maps: &P2gRequest<'_, D>,
        grid: &Grid<D>,
        mut columns: Columns<'_, D>,
    ) {
        let Self { fields, blocks } = self;
        blocks.cut::<B, D>(grid, particles);
        columns.is_one_field = has_one_field(particles, maps);
        let wants_inertia = maps.mass || maps.momentum.is_some();
        let wanted = [wants_inertia, maps.force.is_some() && !columns.is_one_field];
        let add = |block: &ParticleBlock, fields: [FieldViewMut<'_>; 2]| {
            let these = block.particles.clone();
            simd::run(Scatter::<D, B> {
                grid,
                particles,
                these,
                request: maps,
                fields,
                basis: PhantomData,
            });
        };
        // What lies beyond a seam must come back before anything is unpacked.
        let (at_once, after) = if grid.periodic.contains(&true) {
            (None, Some(columns))
        } else {
            (Some(columns), None)
        };
        let target =
            Target { fields: views(fields, grid, wanted), columns: at_once.unwrap_or_default() };
        two_colour_schedule(
            grid,
            blocks.colours.each_ref().map(|colour| &colour[..]),
            target,
            &add,
        );
        let Some(columns) = after else { return };
        for (field, _) in fields.iter_mut().zip(wanted).filter(|(_, wanted)| *wanted) {
            field.fold(grid);
        }
        columns.unpack_all(grid, &views(fields, grid, wanted));
    }

    /// What `takes` says, from `field` in place of the velocities of nodes.
    pub(in crate::mpm) fn gather<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        field: &[Vector<D>],
        takes: G2pRequest<'_, D>,
    ) {
        let fields = &mut self.fields;
        pack(fields, grid, field, takes.change.is_some());
        let fields = fields.each_ref().map(PackedField::view);
        par_split(0..particles.len(), takes, &|these, takes| {
            simd::run(Gather::<D, B> { grid, particles, these, takes, fields, basis: PhantomData });
        });
    }
}
