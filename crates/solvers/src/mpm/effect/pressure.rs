//! A follower pressure on a face or a round rim of the body: `t = -p n` per current area.
//!
//! The force per reference area is `P N = -p J F^-T N = -p cof(F) N` (Nanson's formula). The force
//! depends on F of the particles in the layer, and changes if the face stretches or rotates. If the
//! force acts at the surface ([`Placement`]), F is extrapolated to the surface.

use super::contract::{BodyOnGrid, Effect};
use super::rim::{Facet, RimCircle, facets, press};
use super::surface::{Placement, Surface};
use crate::mpm::boundary::Side;
use crate::mpm::foundation::algebra::{Vector, cofactor};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;

/// A pressure (Pa) as a function of the reference position and time.
pub type PressureField<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> f64 + Send>;

/// Pressure p(X, t) on one face or rim of the body. A negative pressure is a suction.
pub struct Pressure<const D: usize> {
    value: PressureField<D>,
    site: PressedSurface<D>,
}

enum PressedSurface<const D: usize> {
    Face(Surface),
    Rim(Vec<Facet<D>>),
}

impl<const D: usize> Pressure<D> {
    /// Creates a pressure on the outermost layer of `particles` on the face `side` of `axis`.
    pub fn at(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        placement: Placement,
        value: PressureField<D>,
    ) -> Self {
        Self { value, site: PressedSurface::Face(Surface::new(particles, axis, side, placement)) }
    }

    /// Creates a pressure on a circular rim of a two-dimensional body filled with `particles`.
    pub fn on_rim(particles: &Particles<D>, circle: &RimCircle, value: PressureField<D>) -> Self {
        Self { value, site: PressedSurface::Rim(facets(particles, circle)) }
    }
}

impl<const D: usize> Effect<D> for Pressure<D> {
    fn name(&self) -> &'static str {
        "pressure"
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![match &self.site {
            PressedSurface::Face(surface) => Column::of_particles("surface layer", &surface.layer),
            PressedSurface::Rim(facets) => Column::of_particles("facets of the rim", facets),
        }]
    }

    fn reads_deformation(&self) -> bool {
        true
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let (Self { value, site }, particles) = (self, body.particles);
        let surface = match site {
            PressedSurface::Face(surface) => surface,
            PressedSurface::Rim(facets) => {
                return press(facets, body, |label| value(label, t));
            }
        };
        let normal = surface.normal();
        surface.pull(body, |p| {
            let pressure = value(&surface.label(particles, p), t);
            let across = surface.across(particles, p);
            cofactor(&surface.def_grad(particles, p)) * normal * (-pressure * across)
        })
    }
}
