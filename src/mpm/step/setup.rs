//! Parts of a solver.

use crate::mpm::boundary::Boundary;
use crate::mpm::effect::Effect;
use crate::mpm::foundation::frame::FrameName;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::kernel::request::G2pRequest;
use crate::mpm::mass::MassMatrix;
use crate::mpm::material::Material;
use crate::mpm::scheme::SchemeName;
use crate::mpm::stage::Stage;
use crate::mpm::transfer::Transfer;
use crate::subject::{Column, Start};

/// Parts of a solver of one body.
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
    /// Effects that the scene lists.
    pub effects: Vec<Box<dyn Effect<D>>>,
    /// Boundary conditions on faces of the grid; where faces meet, the last one wins.
    pub boundary: Vec<Box<dyn Boundary<D>>>,
    /// Order of the stages.
    pub scheme: SchemeName,
    /// Treatment of the initial velocity.
    pub start: Start,
}

impl<const D: usize> Setup<D> {
    /// Whether an effect or a condition reads the velocities of the grid before they advance.
    pub(in crate::mpm) fn reads_velocity(&self) -> bool {
        self.effects.iter().any(|effect| effect.reads_grid_velocity())
            || self.boundary.iter().any(|condition| condition.reads_velocity())
    }

    /// The stages of a step; `is_read`: something else reads nodal velocities before they advance.
    pub(in crate::mpm) fn stages(&mut self, is_read: bool) -> &'static [Stage] {
        let G2pRequest { mix, moment, gradient, .. } = self.transfer.g2p_request(0.0);
        let is_taken = mix.is_some() || moment.is_some() || gradient.is_some();
        self.scheme.stages(is_taken || is_read || self.reads_velocity())
    }

    /// Passes of the effects' own state.
    pub(in crate::mpm) fn state_passes(&self) -> Vec<&'static str> {
        self.effects.iter().flat_map(|effect| effect.state_passes()).copied().collect()
    }

    /// All columns for particles and nodes, with those `of_solver`; the factors of a consistent
    /// mass matrix, computed anew in each step, are left out.
    pub(in crate::mpm) fn columns<'a>(&'a self, of_solver: [Column<'a>; 2]) -> Vec<Column<'a>> {
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
