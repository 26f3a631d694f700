//! Moments of the weights of a particle, for affine transfers.

use super::algebra::{self, Matrix, Vector, array, dyad, product, zeros};
use mpm_subject::Column;

/// Minimum valid second moment, as a fraction of h^2. A smaller value is a rounding error: all
/// weight is on one node along that axis, for example if a particle is on a node of the linear
/// basis.
pub(in crate::mpm) const SMALLEST: f64 = 1e-13;

/// Moments of the weights of each particle.
#[derive(Debug, Clone, Default)]
pub struct Moments<const D: usize> {
    /// Weighted mean of the node positions, relative to the particle: `sum_i (x_i - x_p) N_i` (m).
    pub mean: Vec<Vector<D>>,
    /// `D_p = sum_i (x_i - x_p) (x) (x_i - x_p) N_i`, about the mean (m^2): the inertia tensor of
    /// APIC (Jiang et al. 2015, eq. 8).
    pub second: Vec<Matrix<D>>,
}

impl<const D: usize> Moments<D> {
    /// Resizes the columns to this number of particles.
    pub fn resize(&mut self, particles: usize) {
        self.mean.resize(particles, zeros());
        self.second.resize(particles, zeros());
    }

    pub(in crate::mpm) fn columns(&self) -> [Column<'_>; 2] {
        [Column::of_particles("mean", &self.mean), Column::of_particles("D", &self.second)]
    }
}

/// Moments of the weights of one particle or patch.
#[derive(Debug, Clone, Copy)]
pub struct WeightMoments<const D: usize> {
    /// Weighted mean of the node positions relative to the particle, `sum_i (x_i - x_p) N_i` (m).
    pub mean: Vector<D>,
    /// Second moment (m^2), about the mean (the inertia tensor D_p) or about the particle.
    pub second: Matrix<D>,
}

impl<const D: usize> WeightMoments<D> {
    #[inline(always)]
    pub(in crate::mpm) fn zero() -> Self {
        Self { mean: zeros(), second: zeros() }
    }

    /// Computes the moments of products of one-dimensional functions from mean and variance along
    /// each axis.
    #[inline(always)]
    pub(in crate::mpm) fn diagonal(mean: [f64; D], variance: [f64; D]) -> Self {
        let mut inertia = Self::zero();
        for axis in 0..D {
            inertia.mean[axis] = mean[axis];
            inertia.second[(axis, axis)] = variance[axis];
        }
        inertia
    }

    /// Converts the second moment about the particle to the one about the mean.
    #[inline(always)]
    pub(in crate::mpm) fn about_mean(self) -> Self {
        Self { second: self.second - dyad(&self.mean, &self.mean), ..self }
    }

    /// Computes `matrix D_p^-1`.
    #[inline]
    pub(in crate::mpm) fn divide(&self, matrix: &Matrix<D>, h: f64) -> Matrix<D> {
        product(matrix, &inverse(self.second, SMALLEST * h * h))
    }
}

/// Inverts the tensor on the axes whose second moment exceeds `smallest`. The inverse is zero on
/// other axes.
fn inverse<const D: usize>(mut second: Matrix<D>, smallest: f64) -> Matrix<D> {
    let lost: [bool; D] = array(false, |axis| !(second[(axis, axis)] > smallest));
    let drop = |matrix: &mut Matrix<D>, diagonal: f64| {
        for axis in (0..D).filter(|&axis| lost[axis]) {
            for k in 0..D {
                (matrix[(axis, k)], matrix[(k, axis)]) = (0.0, 0.0);
            }
            matrix[(axis, axis)] = diagonal;
        }
    };
    drop(&mut second, 1.0);
    let Some(mut inverse) = algebra::inverse(&second) else { return zeros() };
    drop(&mut inverse, 0.0);
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn inverse_is_zero_without_a_second_moment() {
        let found = inverse(Matrix::<2>::new(0.25, 0.0, 0.0, 1e-20), 1e-13);
        assert_relative_eq!(found, Matrix::<2>::new(4.0, 0.0, 0.0, 0.0));
    }
}
