//! What a solver is made of.

use super::{
    boundary::Boundary, effect::Effect, frame::FrameName, grid::Grid, kernel::Kernel,
    mass::MassMatrix, material::Material, particles::Particles, scheme::SchemeName,
    transfer::Transfer,
};
use crate::subject::Start;

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
