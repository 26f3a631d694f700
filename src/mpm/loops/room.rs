//! The two ways between particles and nodes, each a pass that threads may share, and what these keep.

use super::{
    blocks::{Block, Blocks, share},
    gather::{Gather, are_beside},
    halves::halves,
    scatter::{Scatter, has_one_field},
};
use crate::mpm::{
    algebra::Vector,
    basis::Basis,
    four,
    grid::Grid,
    kernel::{Maps, Takes},
    packed::{Packed, ViewMut},
    particles::Particles,
};
use std::marker::PhantomData;

/// What a pass needs besides particles and grid.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Two fields of nodes, packed.
    fields: [Packed; 2],
    pub(super) blocks: Blocks,
}

/// Those of two fields that are wanted, in the shape of `grid`; nothing in place of the others.
fn views<'a, const D: usize>(
    fields: &'a mut [Packed; 2],
    grid: &Grid<D>,
    wanted: [bool; 2],
) -> [ViewMut<'a>; 2] {
    let mut wanted = wanted.into_iter();
    fields.each_mut().map(|field| match wanted.next() {
        Some(true) => field.shaped(grid),
        _ => ViewMut::none(),
    })
}

/// Packs velocities, and accelerations too if they are wanted.
pub(super) fn pack<const D: usize>(
    [first, second]: &mut [Packed; 2],
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

impl Room {
    /// What `maps` says, in packed fields.
    pub(super) fn scatter<B: Basis, const D: usize>(
        &mut self,
        particles: &Particles<D>,
        maps: &Maps<'_, D>,
        grid: &Grid<D>,
    ) -> &[Packed; 2] {
        let Self { fields, blocks } = self;
        blocks.cut::<B, D>(grid, particles);
        let wants_inertia = maps.mass || maps.momentum.is_some();
        let wanted = [wants_inertia, maps.force.is_some() && !has_one_field(particles, maps)];
        let add = |block: &Block, fields: [ViewMut<'_>; 2]| {
            let these = block.particles.clone();
            four::run(Scatter::<D, B> { grid, particles, these, maps, fields, basis: PhantomData });
        };
        let [white, black] = &blocks.colours;
        share(white, views(fields, grid, wanted), &|block, mut fields| {
            fields.iter_mut().for_each(ViewMut::clear);
            add(block, fields);
        });
        share(black, views(fields, grid, wanted), &add);
        for (field, _) in fields.iter_mut().zip(wanted).filter(|(_, wanted)| *wanted) {
            field.fold(grid);
        }
        fields
    }

    /// What `takes` says, from `field` in place of the velocities of nodes.
    pub(super) fn gather<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        field: &[Vector<D>],
        takes: Takes<'_, D>,
    ) {
        let fields = &mut self.fields;
        pack(fields, grid, field, takes.change.is_some());
        let fields = fields.each_ref().map(Packed::view);
        halves(0..particles.len(), takes, &|these, takes| {
            four::run(Gather::<D, B> { grid, particles, these, takes, fields, basis: PhantomData });
        });
    }
}
