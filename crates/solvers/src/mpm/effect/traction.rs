//! A surface traction on the layer of particles at the surface.
//!
//! `f_ext_i += sum_p p0 A_p N_i(x_p)` over this layer, where A_p is the surface area of a particle
//! in the reference configuration. The traction is a dead load, `P N = p0(X, t)`. The surface of
//! the body need not coincide with nodes, because the force follows the particles, even on faces
//! that rotate and bend (Wobbes & Tielen 2015, Steffen's bar). By default the force acts half a
//! particle spacing inside the surface ([`Placement`]).

use super::contract::{BodyOnGrid, Effect};
use super::surface::{Placement, Surface};
use crate::mpm::boundary::Side;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;

/// A traction (Pa, per reference area) as a function of the reference position and time.
pub type TractionField<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> Vector<D> + Send>;

/// Traction p0(X, t) (Pa, per reference area) on one face of the body.
pub struct Traction<const D: usize> {
    value: TractionField<D>,
    surface: Surface,
}

impl<const D: usize> Traction<D> {
    /// Creates a traction p0(X, t), with X on the surface, on the outermost layer of `particles` at
    /// the face `side` of `axis`. The force acts at `placement`.
    pub fn at(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        placement: Placement,
        value: TractionField<D>,
    ) -> Self {
        Self { value, surface: Surface::new(particles, axis, side, placement) }
    }
}

impl<const D: usize> Effect<D> for Traction<D> {
    fn name(&self) -> &'static str {
        "traction"
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("surface layer", &self.surface.layer)]
    }

    fn reads_deformation(&self) -> bool {
        self.surface.placement == Placement::Surface
    }

    fn integrate_over_domain_ends(&mut self) {
        self.surface.is_integrated = true;
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let (Self { value, surface }, particles) = (self, body.particles);
        surface.pull(body, |p| value(&surface.label(particles, p), t))
    }
}
