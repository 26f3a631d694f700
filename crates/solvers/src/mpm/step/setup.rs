//! The parts of a solver, and lists of their columns for memory profiles and fields.

use super::volume_average::VolumeName;
use crate::mpm::boundary::Boundary;
use crate::mpm::effect::Effect;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::{FrameName, Particles};
use crate::mpm::kernel::contract::{G2pRequest, Kernel};
use crate::mpm::mass::MassMatrix;
use crate::mpm::material::Material;
use crate::mpm::scheme::{SchemeName, Stage};
use crate::mpm::transfer::Transfer;
use mpm_subject::{BodyFields, Column, ColumnSize, Holder, Profile, Start, StateField};

/// Parts of a solver for one body.
pub struct Setup<const D: usize> {
    /// The background grid.
    pub grid: Grid<D>,
    /// The body in its initial state.
    pub particles: Particles<D>,
    /// Basis functions, compiled for the loops over particles and nodes.
    pub kernel: Box<dyn Kernel<D>>,
    /// Transfer of velocities between particles and grid.
    pub transfer: Box<dyn Transfer<D>>,
    /// Mass matrix: converts momenta to velocities, and forces to accelerations.
    pub mass: Box<dyn MassMatrix<D>>,
    /// Configuration in which the basis is evaluated.
    pub frame: FrameName,
    /// Kind of volume ratio for which the law computes the stress.
    pub volume: VolumeName,
    /// The constitutive law.
    pub material: Box<dyn Material<D>>,
    /// Effects that act on the body.
    pub effects: Vec<Box<dyn Effect<D>>>,
    /// Boundary conditions on faces of the grid. Where faces meet, the last condition applies.
    pub boundary: Vec<Box<dyn Boundary<D>>>,
    /// Time scheme, which defines the order of the stages.
    pub scheme: SchemeName,
    /// Meaning of the initial velocity in the first step.
    pub start: Start,
}

impl<const D: usize> Setup<D> {
    /// Whether an effect or a condition reads the grid velocities before they advance.
    pub(in crate::mpm) fn reads_velocity(&self) -> bool {
        self.effects.iter().any(|effect| effect.reads_grid_velocity())
            || self.boundary.iter().any(|condition| condition.reads_velocity())
    }

    /// Returns the stages of a step. `is_read` is true if another part reads nodal velocities
    /// before they advance.
    pub(in crate::mpm) fn stages(&mut self, is_read: bool) -> &'static [Stage] {
        let G2pRequest { mix, moment, gradient, .. } = self.transfer.g2p_request(0.0);
        let is_taken = mix.is_some() || moment.is_some() || gradient.is_some();
        self.scheme.stages(is_taken || is_read || self.reads_velocity())
    }

    pub(in crate::mpm) fn state_passes(&self) -> Vec<&'static str> {
        self.effects.iter().flat_map(|effect| effect.state_passes()).copied().collect()
    }

    /// Returns all columns for particles and nodes, including the columns `of_solver`. The factors
    /// of a consistent mass matrix, which are recomputed in each step, are excluded.
    pub(in crate::mpm) fn columns<'a>(
        &'a self,
        of_solver: impl IntoIterator<Item = Column<'a>>,
    ) -> Vec<Column<'a>> {
        let Self { grid, particles, transfer, material, effects, boundary, .. } = self;
        let mut columns = particles.columns();
        columns.extend(of_solver);
        columns.extend(transfer.columns());
        columns.extend(material.columns());
        columns.extend(effects.iter().flat_map(|effect| effect.columns()));
        columns.extend(grid.columns());
        columns.extend(boundary.iter().flat_map(|condition| condition.columns()));
        columns
    }
}

/// Creates the step profile of a body with these effects and columns. The lists of passes and of
/// visited particles are empty.
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

/// Returns the columns that have numbers for every particle or every node. If two columns have the
/// same name, only the first is included.
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
