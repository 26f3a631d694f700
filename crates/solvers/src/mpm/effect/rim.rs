//! The rim of a round two-dimensional body, divided into facets that carry a surface force.
//!
//! The particles at a rim form a staircase. Unlike on a face of a box, these particles represent
//! unequal parts of the surface. The circle is therefore divided into arcs about half a spacing
//! long. The force on an arc and the moment of this force act on the nearest particle. If the basis
//! reproduces linear fields, the sum of `f_i (x) x_i` is then `f (x) x_s`, as for a force at the
//! middle x_s of the arc. The area vectors are exact, so a uniform pressure has no resultant.

use super::contract::BodyOnGrid;
use super::surface::put_at_surface;
use crate::mpm::foundation::algebra::{Vector, cofactor};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Entry;
use std::f64::consts::TAU;

/// A circular rim in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RimCircle {
    /// Centre (m).
    pub centre: [f64; 2],
    /// Radius (m).
    pub radius: f64,
    /// Direction of the outward normal: 1 away from the centre, -1 towards the centre.
    pub outwards: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Facet<const D: usize> {
    /// Particle nearest to the middle of the arc.
    pub(super) particle: usize,
    /// Middle of the arc in the reference configuration (m).
    pub(super) label: Vector<D>,
    /// Integral of the outward normal over the arc, in the reference configuration (m^(D-1)).
    area: Vector<D>,
}

impl<const D: usize> Entry for Facet<D> {}

/// Number of arcs per particle spacing along the rim.
const PER_SPACING: f64 = 2.0;

/// Maximum distance between the rim and a particle that can carry a facet (spacings). Each point of
/// the rim is at most half a diagonal of the particle lattice from a particle.
const REACH: f64 = 2.0;

/// Divides `circle` into facets, starting at the positive first axis. The result is empty if no
/// particle is near the rim.
pub(super) fn facets<const D: usize>(
    particles: &Particles<D>,
    circle: &RimCircle,
) -> Vec<Facet<D>> {
    let RimCircle { centre, radius, outwards } = *circle;
    let spacing = particles.spacing.iter().copied().fold(f64::INFINITY, f64::min);
    let distance_from_rim = |x: &Vector<D>| {
        let square: f64 = x.iter().zip(centre).map(|(x, c)| (x - c) * (x - c)).sum();
        (square.sqrt() - radius).abs()
    };
    let near: Vec<usize> = (0..particles.x0.len())
        .filter(|&p| distance_from_rim(&particles.x0[p]) <= REACH * spacing)
        .collect();
    let count = (TAU * radius * PER_SPACING / spacing).ceil();
    let half = 0.5 * TAU / count;
    let length = 2.0 * radius * libm::sin(half);
    let facet = |k: usize| {
        let angle = half * (2 * k + 1) as f64;
        let radial = [libm::cos(angle), libm::sin(angle)];
        let along = |origin: [f64; 2], by: f64| {
            Vector::from_fn(|i, _| if i < 2 { origin[i] + by * radial[i] } else { 0.0 })
        };
        let label: Vector<D> = along(centre, radius);
        let distance = |p: &usize| (particles.x0[*p] - label).norm_squared();
        let nearest = near.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(Facet { particle: nearest, label, area: along([0.0; 2], outwards * length) })
    };
    (0..count as usize).filter_map(facet).collect()
}

/// Adds the forces of a pressure (Pa, per current area) on every facet. `pressure` is a function of
/// the reference position. F at the rim is approximated by F of the nearest particle, half a
/// spacing away. Returns the number of visited particle-node pairs.
pub(super) fn press<const D: usize>(
    facets: &[Facet<D>],
    body: &mut BodyOnGrid<'_, D>,
    pressure: impl Fn(&Vector<D>) -> f64,
) -> u64 {
    let particles = body.particles;
    for Facet { particle, label, area } in facets {
        let (p, f) = (*particle, &particles.def_grad[*particle]);
        let across = particles.across.get(p).copied().unwrap_or(1.0);
        let force = cofactor(f) * area * (-pressure(label) * across);
        put_at_surface(body, p, &force, label - particles.x0[p]);
    }
    body.pairs(2 * facets.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Block;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// The facets of a circle in a square of particles form a closed curve, and each facet is near
    /// its particle.
    #[rstest]
    #[case::outer(1.0)]
    #[case::inner(-1.0)]
    fn facets_form_a_closed_curve_with_the_length_of_the_rim(#[case] outwards: f64) {
        let block =
            Block { from: Vector::zeros(), to: Vector::<2>::from([4.0, 4.0]), density: 1.0 };
        let particles = Particles::fill(&block, 0.5, 2);
        let circle = RimCircle { centre: [2.0, 1.9], radius: 1.3, outwards };
        let facets = facets(&particles, &circle);
        let sum = facets.iter().fold(Vector::<2>::zeros(), |sum, facet| sum + facet.area);
        assert!(sum.norm() <= 1e-14, "{sum}");
        let length: f64 = facets.iter().map(|facet| facet.area.norm()).sum();
        assert_relative_eq!(length, TAU * 1.3, max_relative = 1e-3);
        // Twice the area of the polygon, by the divergence theorem; negative around a hole.
        let doubled: f64 = facets
            .iter()
            .map(|facet| facet.area.dot(&(facet.label - Vector::from([2.0, 1.9]))))
            .sum();
        assert_relative_eq!(doubled, outwards * 2.0 * 0.5 * TAU * 1.69, max_relative = 1e-3);
        let half_diagonal = 0.125 * 2.0_f64.sqrt();
        for facet in &facets {
            let distance = (particles.x0[facet.particle] - facet.label).norm();
            assert!(distance <= half_diagonal + 1e-12, "{facet:?}");
        }
    }
}
