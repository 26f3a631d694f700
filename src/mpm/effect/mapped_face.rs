//! A face of a body that is a mapped box: the particles whose domains end on it.
//!
//! Middles of outer faces of domains lie on the face of the body ([`Particles::fill_mapped`]),
//! however slanting the rows of particles are that end there.

use crate::mpm::foundation::particles::Particles;

/// Distance from the face that is no more than rounding, in spacings.
const ROUNDING: f64 = 1e-6;

/// The layer of particles at a plane face.
pub(super) struct MappedFace {
    /// Particles, in their order.
    pub(super) layer: Vec<usize>,
    /// The column of their domains that ends on the face, and its sign.
    pub(super) column: (usize, f64),
    /// Share of the face of each particle (m^(D-1)): along a straight side in 2-D, all are
    /// equal.
    pub(super) area: f64,
}

impl MappedFace {
    /// The face that lies furthest out along `axis`, in the direction `outwards` (1 or -1). None of
    /// a body that is no mapped box.
    pub(super) fn of<const D: usize>(
        particles: &Particles<D>,
        axis: usize,
        outwards: f64,
    ) -> Option<Self> {
        let Particles { x0, domain0, spacing, .. } = particles;
        let end = |p: usize, (column, sign): (usize, f64)| {
            outwards * (x0[p][axis] + sign * domain0[p][(axis, column)])
        };
        let furthest = |column: (usize, f64)| {
            (0..domain0.len()).map(|p| end(p, column)).fold(f64::NEG_INFINITY, f64::max)
        };
        let columns = (0..D).flat_map(|a| [(a, 1.0), (a, -1.0)]);
        let column = columns.max_by(|a, b| furthest(*a).total_cmp(&furthest(*b)))?;
        let reach = furthest(column) - ROUNDING * spacing[axis];
        let layer: Vec<usize> = (0..domain0.len()).filter(|&p| end(p, column) > reach).collect();
        let (&first, &last) = (layer.first()?, layer.last()?);
        let middle = |p: usize| x0[p] + domain0[p].column(column.0) * column.1;
        let area = if D == 2 && first != last {
            (middle(last) - middle(first)).norm() / (layer.len() - 1) as f64
        } else {
            let others = (0..D).filter(|&a| a != column.0);
            others.map(|a| 2.0 * domain0[first].column(a).norm()).product()
        };
        Some(Self { layer, column, area })
    }
}

#[cfg(test)]
mod tests {
    use crate::mpm::{Quadrilateral, Vector};
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Sides by axis and direction, with their length and place.
    type Sides<'a> = &'a [(usize, f64, f64, f64)];

    /// The sides of a panel that are upright or level, however steeply its rows rise.
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
            let face = super::MappedFace::of(&particles, axis, outwards).unwrap();
            assert_relative_eq!(face.area * face.layer.len() as f64, length, max_relative = 1e-12);
            let (column, sign) = face.column;
            for &p in &face.layer {
                let middle = particles.x0[p] + particles.domain0[p].column(column) * sign;
                assert_relative_eq!(middle[axis], place, epsilon = 1e-12);
            }
        }
    }
}
