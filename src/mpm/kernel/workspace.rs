//! P2G and G2P on threads, and the memory that they keep.

use super::colouring::{Blocks, ParticleBlock};
use super::g2p::{Gather, are_beside};
use super::p2g::{Scatter, has_one_field};
use super::par_split::par_split;
use super::parallel::{Target, two_colour_schedule};
use super::request::{G2pRequest, P2gRequest};
use super::settings::LoopSettings;
use crate::mpm::algebra::Vector;
use crate::mpm::basis::Basis;
use crate::mpm::grid::Grid;
use crate::mpm::packed_grid::{Columns, FieldViewMut, PackedField};
use crate::mpm::particles::Particles;
use crate::mpm::simd;
use fearless_simd::Level;
use std::marker::PhantomData;

/// Memory of a pass besides particles and grid.
#[derive(Debug)]
pub(in crate::mpm) struct Workspace {
    level: Level,
    /// Two packed fields of nodes.
    fields: [PackedField; 2],
    blocks: Blocks,
}

/// Views of the wanted fields, in the shape of `grid`, empty for the others.
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

/// Packs velocities and, if wanted, accelerations.
fn pack<const D: usize>(
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
    pub(in crate::mpm) fn new(settings: LoopSettings) -> Self {
        Self { level: settings.level, fields: Default::default(), blocks: Blocks::new(settings) }
    }

    /// P2G of all parts of `request` into `columns`.
    pub(in crate::mpm) fn scatter<B: Basis, const D: usize>(
        &mut self,
        particles: &Particles<D>,
        request: &P2gRequest<'_, D>,
        grid: &Grid<D>,
        mut columns: Columns<'_, D>,
    ) {
        let Self { level, fields, blocks } = self;
        blocks.cut::<B, D>(grid, particles);
        columns.is_one_field = has_one_field(particles, request);
        let wants_inertia = request.mass || request.momentum.is_some();
        let wanted = [wants_inertia, request.force.is_some() && !columns.is_one_field];
        let add = |block: &ParticleBlock, fields: [FieldViewMut<'_>; 2]| {
            let range = block.particles.clone();
            let basis = PhantomData;
            let pass = Scatter::<D, B> { grid, particles, range, request, fields, basis };
            simd::run(*level, pass);
        };
        // Sums beyond a periodic end must be folded back before anything is unpacked.
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

    /// G2P of all parts of `request`, with `field` for the velocities of nodes.
    pub(in crate::mpm) fn gather<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        field: &[Vector<D>],
        request: G2pRequest<'_, D>,
    ) {
        let Self { level, fields, .. } = self;
        pack(fields, grid, field, request.change.is_some());
        let fields = fields.each_ref().map(PackedField::view);
        par_split(0..particles.len(), request, &|range, request| {
            let basis = PhantomData;
            let pass = Gather::<D, B> { grid, particles, range, request, fields, basis };
            simd::run(*level, pass);
        });
    }
}
