//! P2G and G2P on threads, with reusable memory.

use super::colouring::{Blocks, ParticleBlock};
use super::contract::{G2pRequest, LoopSettings, P2gRequest};
use super::g2p::{Gather, are_beside};
use super::p2g::{Scatter, wants_wide_nodes};
use super::parallel::{Target, par_split, two_colour_schedule};
use super::source::Static;
use crate::mpm::basis::Basis;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::packed_grid::{
    Columns, FieldViewMut, Node4, Node8, PackedField, PackedNode,
};
use crate::mpm::foundation::particles::Particles;
use fearless_simd::Level;

/// Memory of a pass, in addition to the particles and the grid.
#[derive(Debug)]
pub(in crate::mpm) struct Workspace {
    level: Level,
    fields: [PackedField<Node4>; 2],
    wide: PackedField<Node8>,
    blocks: Blocks,
}

fn pack<const D: usize>(
    [first, second]: &mut [PackedField<Node4>; 2],
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

struct P2g<'a, const D: usize> {
    level: Level,
    particles: &'a Particles<D>,
    request: &'a P2gRequest<'a, D>,
    grid: &'a Grid<D>,
    blocks: &'a Blocks,
}

impl<const D: usize> P2g<'_, D> {
    fn run<B: Basis, N: PackedNode>(self, field: &mut PackedField<N>, columns: Columns<'_, D>) {
        let Self { level, particles, request, grid, blocks } = self;
        let add = |block: &ParticleBlock, field: FieldViewMut<'_, N>| {
            let range = block.particles.clone();
            let source = Static::<B>::BASIS;
            let pass = Scatter { grid, particles, range, request, field, source };
            B::run(level, pass);
        };
        // On a periodic axis, the sums in the margins must be added to the nodes that the margins
        // repeat, before nodal values are copied to the grid.
        let (at_once, after) = if grid.periodic.contains(&true) {
            (None, Some(columns))
        } else {
            (Some(columns), None)
        };
        let target = Target { field: field.shaped(grid), columns: at_once.unwrap_or_default() };
        let [one, other] = &blocks.colours;
        two_colour_schedule(grid, [one, other], target, &add);
        let Some(columns) = after else { return };
        field.fold(grid);
        columns.unpack_all(grid, &field.shaped(grid));
    }
}

impl Workspace {
    pub(in crate::mpm) fn new(settings: LoopSettings) -> Self {
        Self {
            level: settings.level,
            fields: Default::default(),
            wide: PackedField::default(),
            blocks: Blocks::new(settings),
        }
    }

    pub(in crate::mpm) fn scatter<B: Basis, const D: usize>(
        &mut self,
        particles: &Particles<D>,
        request: &P2gRequest<'_, D>,
        grid: &Grid<D>,
        columns: Columns<'_, D>,
    ) {
        let Self { level, fields: [four, _], wide, blocks } = self;
        blocks.cut::<B, D>(grid, particles);
        let pass = P2g { level: *level, particles, request, grid, blocks };
        if const { D > 1 } && wants_wide_nodes(request) {
            pass.run::<B, _>(wide, columns);
        } else {
            pass.run::<B, _>(four, columns);
        }
    }

    /// Computes all quantities of `request`, with `field` as the nodal velocities.
    pub(in crate::mpm) fn gather<B: Basis, const D: usize>(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        field: &[Vector<D>],
        request: G2pRequest<'_, D>,
    ) {
        let Self { level, fields, .. } = self;
        pack(fields, grid, field, request.change.is_some());
        let fields = [fields[0].view(), fields[1].view()];
        par_split(0..particles.len(), request, &|range, request| {
            let source = Static::<B>::BASIS;
            let pass = Gather { grid, particles, range, request, fields, source };
            B::run(*level, pass);
        });
    }
}
