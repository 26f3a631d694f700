//! What a solver is made of.

use super::{
    boundary::Boundary, effect::Effect, frame::FrameName, grid::Grid, kernel::contract::Kernel,
    mass::MassMatrix, material::Material, particles::Particles, scheme::SchemeName, stage::Stage,
    transfer::Transfer,
};
use crate::subject::{Column, Profile, Start};

/// Everything that a solver is made of.
pub struct Setup<const D: usize> {
    /// The background grid.
    pub grid: Grid<D>,
    /// The body, in its initial state.
    pub particles: Particles<D>,
    /// Basis.
    pub kernel: Box<dyn Kernel<D>>,
    /// Velocities between particles and grid.
    pub transfer: Box<dyn Transfer<D>>,
    /// From momenta to velocities, from forces to accelerations.
    pub mass: Box<dyn MassMatrix<D>>,
    /// Configuration in which the basis lives.
    pub frame: FrameName,
    /// The constitutive law.
    pub material: Box<dyn Material<D>>,
    /// What the scene lists, and nothing else.
    pub effects: Vec<Box<dyn Effect<D>>>,
    /// What holds on faces of the grid; where faces meet, the last one wins.
    pub boundary: Vec<Box<dyn Boundary<D>>>,
    /// Order of the stages.
    pub scheme: SchemeName,
    /// Treatment of the initial velocity.
    pub start: Start,
}

impl<const D: usize> Setup<D> {
    /// Whether an effect or a condition reads the velocities of the grid before they advance.
    pub(super) fn reads_velocity(&self) -> bool {
        self.effects.iter().any(|effect| effect.reads_grid_velocity())
            || self.boundary.iter().any(|condition| condition.reads_velocity())
    }

    /// The stages of a step; `coupled`: what couples bodies reads velocities too.
    pub(super) fn stages(&self, coupled: bool) -> &'static [Stage] {
        let reads_velocity = self.reads_velocity() || coupled;
        self.scheme.stages(self.transfer.reads_grid_velocity() || reads_velocity)
    }

    /// The effects, and all that is kept for particles and nodes, with the columns `of_solver` of the
    /// solver. The factors of a consistent mass matrix, made anew in each step, are not among them.
    pub(super) fn profile(&self, of_solver: [Column; 2]) -> Profile {
        let Self { grid, particles, transfer, material, effects, boundary, .. } = self;
        let mut columns = particles.columns();
        columns.extend(of_solver);
        columns.extend(transfer.columns());
        columns.extend(material.columns());
        columns.extend(effects.iter().flat_map(|effect| effect.columns()));
        columns.extend(grid.columns());
        columns.extend(boundary.iter().flat_map(|condition| condition.columns()));
        columns.retain(|column| column.entries > 0);
        Profile {
            effects: effects.iter().map(|effect| effect.name().name()).collect(),
            particles: particles.len(),
            nodes: grid.nodes(),
            columns,
            passes: Vec::new(),
        }
    }
}
