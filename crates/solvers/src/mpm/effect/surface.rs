//! The surface of a body, represented by the layer of particles at one of its faces.
//!
//! Each particle of the layer represents a part of the face with the area A_p. The middle of this
//! part is `X_s = X_p + s/2 N` with the spacing s along the normal N. A traction there is mapped to
//! the grid in one of two ways ([`Placement`]):
//!
//! - at the particle, `f_i += f N_i(x_p)`, half a spacing inside, as in the original MPM. The sum
//!   of the forces is exact, but their moment is not. The moment arm of forces along the face is
//!   s/2 too short. This causes a bending error of order h in the whole body;
//! - at the surface, `f_i += f N_i(x_p) + (f (x) d) grad N_i(x_p)`, `d = F s/2 N`: the weights of
//!   the surface point, extrapolated linearly from the particle. Sum and moment are exact,
//!   `sum_i f_i (x) x_i = f (x) (x_p + d)`, if the basis reproduces linear fields. The exact
//!   weights of the surface point are not used, because they could load a node without mass.
//!
//! In GIMP, a domain with a node in its interior has functions that are not linear up to the
//! surface. The extrapolated weight of the node beyond is then half the value at the end of the
//! domain, and the load is not in balance with a uniform stress. In load steps, the difference from
//! the average over the end of the domain is added; sum and moment of this difference are zero. The
//! extrapolation is exact in CPDI, whose functions are linear between the corners of the domain.
//!
//! On a face of a mapped box, the layer contains the particles whose domains end on the face. The
//! middles of these domain ends are on the face of the body ([`Particles::fill_mapped`]), even if
//! the particle rows meet the face at an angle.

use super::contract::BodyOnGrid;
use crate::mpm::boundary::Side;
use crate::mpm::foundation::algebra::{Matrix, Vector, dyad, times};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::named;
use std::ops::{Mul, Sub};

named! {
    /// Point of action of a surface force.
    #[derive(Default)]
    pub enum Placement {
        /// At the outermost particles.
        #[default]
        Particles = "particles",
        /// At the surface, half a particle spacing further out.
        Surface = "surface",
    }
}

/// The outermost layer of particles on one face.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    pub(super) layer: Vec<usize>,
    pub(super) placement: Placement,
    axis: usize,
    /// Sign of the outward normal along the axis.
    outwards: f64,
    /// Area of the face per particle (m^(D-1)). Along a straight side of a mapped body in 2-D, the
    /// areas are equal.
    pub(super) area: f64,
    /// Half a spacing along the axis (m); not used for a mapped body.
    depth: f64,
    /// Index of a column of the domain matrix, and a sign. The column times the sign is the vector
    /// from a particle to the face. `None` unless the body is mapped.
    column: Option<(usize, f64)>,
    /// Whether forces at the surface are integrated over the ends of the particle domains.
    pub(super) is_integrated: bool,
    /// Index difference between a particle of this layer and its neighbour in the next layer.
    below: usize,
}

impl Surface {
    pub(super) fn new<const D: usize>(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        placement: Placement,
    ) -> Self {
        let outwards = side.sign();
        if let Some(mapped) = Self::mapped(particles, axis, outwards, placement) {
            return mapped;
        }
        let (x0, spacing) = (&particles.x0, particles.spacing[axis]);
        let height = |p: usize| outwards * x0[p][axis];
        let top = (0..x0.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
        let reach = top - 0.5 * spacing;
        let layer: Vec<usize> = (0..x0.len()).filter(|&p| height(p) > reach).collect();
        let second = (0..x0.len()).find(|&p| (reach - spacing..reach).contains(&height(p)));
        let below = match (layer.first(), second) {
            (Some(first), Some(second)) => first.abs_diff(second),
            _ => 0,
        };
        let area = (0..D).filter(|&a| a != axis).map(|a| particles.spacing[a]).product();
        let (column, depth, is_integrated) = (None, 0.5 * spacing, false);
        Self { layer, placement, axis, outwards, area, depth, column, is_integrated, below }
    }

    /// Creates the outermost plane face of a mapped body along `axis` in the direction `outwards`
    /// (1 or -1). `None` for a body that is not a mapped box.
    fn mapped<const D: usize>(
        particles: &Particles<D>,
        axis: usize,
        outwards: f64,
        placement: Placement,
    ) -> Option<Self> {
        let Particles { x0, domain0, spacing, .. } = particles;
        let end = |p: usize, column: usize, sign: f64| {
            outwards * (x0[p][axis] + sign * domain0[p][(axis, column)])
        };
        let furthest = |(column, sign)| {
            (0..domain0.len()).map(|p| end(p, column, sign)).fold(f64::NEG_INFINITY, f64::max)
        };
        let columns = (0..D).flat_map(|a| [(a, 1.0), (a, -1.0)]);
        let column = columns.max_by(|a, b| furthest(*a).total_cmp(&furthest(*b)))?;
        let reach = furthest(column) - ROUNDING * spacing[axis];
        let layer: Vec<usize> =
            (0..domain0.len()).filter(|&p| end(p, column.0, column.1) > reach).collect();
        let (&first, &last) = (layer.first()?, layer.last()?);
        let middle = |p: usize| x0[p] + domain0[p].column(column.0) * column.1;
        let area = if D == 2 && first != last {
            (middle(last) - middle(first)).norm() / (layer.len() - 1) as f64
        } else {
            let others = (0..D).filter(|&a| a != column.0);
            others.map(|a| 2.0 * domain0[first].column(a).norm()).product()
        };
        let below = if column.0 == 0 { 1 } else { layer.len() };
        let (column, depth, is_integrated) = (Some(column), 0.0, false);
        Some(Self { layer, placement, axis, outwards, area, depth, column, is_integrated, below })
    }

    pub(super) fn normal<const D: usize>(&self) -> Vector<D> {
        Vector::from_fn(|i, _| if i == self.axis { self.outwards } else { 0.0 })
    }

    /// Returns the reference vector (m) from particle `p` to the middle of its part of the face.
    fn to_face<const D: usize>(&self, particles: &Particles<D>, p: usize) -> Vector<D> {
        match self.column {
            Some((column, sign)) => particles.domain0[p].column(column) * sign,
            None => self.normal() * self.depth,
        }
    }

    /// Returns the middle X_s of the face part of particle `p` (m).
    pub(super) fn label<const D: usize>(&self, particles: &Particles<D>, p: usize) -> Vector<D> {
        particles.x0[p] + self.to_face(particles, p)
    }

    pub(super) fn def_grad<const D: usize>(&self, particles: &Particles<D>, p: usize) -> Matrix<D> {
        self.continued(&particles.def_grad, p)
    }

    pub(super) fn across<const D: usize>(&self, particles: &Particles<D>, p: usize) -> f64 {
        if particles.across.is_empty() { 1.0 } else { self.continued(&particles.across, p) }
    }

    /// Returns the value of a column at the surface above particle `p`: extrapolated linearly from
    /// this particle and the particle below, or the value of particle `p` for
    /// [`Placement::Particles`].
    fn continued<T>(&self, column: &[T], p: usize) -> T
    where
        T: Copy + Mul<f64, Output = T> + Sub<Output = T>,
    {
        let here = column[p];
        if self.placement == Placement::Particles {
            return here;
        }
        let high = self.column.map_or(self.outwards, |(_, sign)| sign) > 0.0;
        let below = if high { p.checked_sub(self.below) } else { Some(p + self.below) };
        let below = below.and_then(|q| column.get(q)).copied().unwrap_or(here);
        here * 1.5 - below * 0.5
    }

    /// Returns the face area of particle `p` in the reference configuration (m^(D-1)). For a body
    /// of revolution the area is per radian, at the radius of the face (m^2/rad).
    fn area<const D: usize>(&self, particles: &Particles<D>, p: usize) -> f64 {
        let is_revolved = !particles.stress_across.is_empty();
        if is_revolved { self.area * self.label(particles, p)[0] } else { self.area }
    }

    /// Adds the forces of a traction (Pa, per reference area) on every particle of the layer.
    /// Returns the number of visited particle-node pairs.
    pub(super) fn pull<const D: usize>(
        &self,
        body: &mut BodyOnGrid<'_, D>,
        traction: impl Fn(usize) -> Vector<D>,
    ) -> u64 {
        let particles = body.particles;
        // The domain of a particle ends on the face if the face is normal to an axis of the domain.
        let end = match self.column {
            Some((column, sign)) => (column == self.axis).then_some((column, sign)),
            None => Some((self.axis, self.outwards)),
        };
        let end = end.filter(|_| self.is_integrated);
        let mut visits = 0;
        for &p in &self.layer {
            let force = traction(p) * self.area(particles, p);
            if self.placement == Placement::Particles {
                body.add_point_force(p, &force);
                visits += 1;
                continue;
            }
            put_at_surface(body, p, &force, self.to_face(particles, p));
            let BodyOnGrid { kernel, grid, .. } = body;
            let is_corrected =
                end.is_some_and(|end| kernel.p2g_domain_end(particles, p, end, &force, grid));
            visits += if is_corrected { 3 } else { 2 };
        }
        body.pairs(visits)
    }
}

/// Adds `force` at particle `p`, and a moment that shifts the point of action to the end of `arm`.
/// The arm is the vector from the particle to the surface in the reference configuration (m).
pub(super) fn put_at_surface<const D: usize>(
    body: &mut BodyOnGrid<'_, D>,
    p: usize,
    force: &Vector<D>,
    arm: Vector<D>,
) {
    body.add_point_force(p, force);
    let particles = body.particles;
    let arm = match particles.def_grad.get(p) {
        Some(f) if particles.current_position.is_empty() => times(f, &arm),
        _ => arm,
    };
    body.kernel.p2g_point_moment(particles, p, &dyad(force, &arm), body.grid);
}

/// Maximum distance from the face that counts as rounding error (spacings).
const ROUNDING: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Quadrilateral;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Axis, direction, length and position of each side of a panel.
    type Sides<'a> = &'a [(usize, f64, f64, f64)];

    /// Vertical and horizontal sides of a panel are recognised, even if the particle rows are
    /// oblique.
    #[rstest]
    #[case::slanting(
        [[0.0, 0.0], [3.0, 0.0], [2.0, 2.0], [0.0, 2.0]],
        &[(0, -1.0, 2.0, 0.0), (1, -1.0, 3.0, 0.0), (1, 1.0, 2.0, 2.0)]
    )]
    #[case::steep(
        [[0.0, 0.0], [1.0, 2.0], [1.0, 4.0], [0.0, 2.0]],
        &[(0, -1.0, 2.0, 0.0), (0, 1.0, 2.0, 1.0)]
    )]
    fn each_side_is_found(#[case] corners: [[f64; 2]; 4], #[case] sides: Sides<'_>) {
        let panel = Quadrilateral::new(corners.map(Vector::from)).unwrap();
        let particles = panel.fill::<2>(1.0, 0.5, 2);
        for &(axis, outwards, length, place) in sides {
            let face = Surface::mapped(&particles, axis, outwards, Placement::Surface).unwrap();
            assert_relative_eq!(face.area * face.layer.len() as f64, length, max_relative = 1e-12);
            let (column, sign) = face.column.unwrap();
            for &p in &face.layer {
                let middle = particles.x0[p] + particles.domain0[p].column(column) * sign;
                assert_relative_eq!(middle[axis], place, epsilon = 1e-12);
            }
        }
    }
}
