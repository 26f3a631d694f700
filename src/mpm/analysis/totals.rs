//! Sums over the body that a motion without external forces conserves.

use crate::mpm::foundation::algebra::{Matrix, dyad};
use crate::mpm::foundation::particles::Particles;
use crate::subject::Totals;

impl<const D: usize> Particles<D> {
    /// Mass, momenta and kinetic energy now; the strain energy is left to the material. `own` is
    /// the first moment of the velocity field that a particle has about itself, if the transfer
    /// gives it one (Jiang et al. 2015).
    pub fn totals(&self, own: impl Fn(usize) -> Option<Matrix<D>>) -> Totals {
        let mut totals = Totals::default();
        for (p, (m, v)) in self.mass.iter().zip(&self.v).enumerate() {
            let spin = axial(&self.moment(p, own(p))).map(|component| m * component);
            let v = std::array::from_fn(|i| if i < D { v[i] } else { 0.0 });
            totals.add(*m, v, spin);
        }
        totals
    }

    /// Angular momentum of particle p per unit of its mass, as the matrix with that axial vector:
    /// `v x^T` for the motion of its centre, and the moment `own` about the centre.
    fn moment(&self, p: usize, own: Option<Matrix<D>>) -> Matrix<D> {
        dyad(&self.v[p], self.position(p)) + own.unwrap_or_else(Matrix::zeros)
    }
}

/// `(M_zy - M_yz, M_xz - M_zx, M_yx - M_xy)`: x cross v for `M = v x^T`, of as many dimensions as
/// there are.
fn axial<const D: usize>(m: &Matrix<D>) -> [f64; 3] {
    let part = |i: usize, j: usize| if i.max(j) < D { m[(i, j)] - m[(j, i)] } else { 0.0 };
    [part(2, 1), part(0, 2), part(1, 0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::foundation::algebra::Vector;
    use crate::mpm::foundation::particles::Block;
    use approx::assert_relative_eq;

    fn two_particles<const D: usize>() -> Particles<D> {
        let mut to = Vector::from_element(1.0);
        to[0] = 2.0;
        let block = Block { from: Vector::<D>::zeros(), to, density: 3.0 };
        Particles::fill(&block, 1.0, 1)
    }

    #[test]
    fn angular_momentum_is_x_cross_m_v() {
        let mut body = two_particles::<3>();
        (body.x[0], body.v[0]) =
            (Vector::<3>::new(1.0, 2.0, 3.0), Vector::<3>::new(-4.0, 5.0, 0.5));
        let totals = body.totals(|_| None);
        let expected = body.x[0].cross(&body.v[0]) * body.mass[0];
        for i in 0..3 {
            assert_relative_eq!(totals.angular_momentum[i], expected[i], max_relative = 1e-14);
        }
        assert_relative_eq!(totals.angular_momentum_size, expected.norm(), max_relative = 1e-14);
    }

    #[test]
    fn two_particles_that_fly_apart_have_a_size_and_no_sum() {
        let mut body = two_particles::<2>();
        (body.v[0], body.v[1]) = (Vector::<2>::new(0.0, 2.0), Vector::<2>::new(0.0, -2.0));
        let totals = body.totals(|_| None);
        assert_eq!((totals.mass, totals.momentum, totals.momentum_size), (6.0, [0.0; 3], 12.0));
        assert_eq!(totals.kinetic_energy, 12.0);
        assert_eq!(totals.angular_momentum, [0.0, 0.0, -6.0]);
        assert_eq!(totals.angular_momentum_size, 12.0);
    }

    #[test]
    fn a_bar_does_not_spin() {
        let mut bar = two_particles::<1>();
        bar.v[0][0] = 1.0;
        let totals = bar.totals(|_| None);
        assert_eq!(totals.momentum, [3.0, 0.0, 0.0]);
        assert_eq!((totals.angular_momentum, totals.angular_momentum_size), ([0.0; 3], 0.0));
    }
}
