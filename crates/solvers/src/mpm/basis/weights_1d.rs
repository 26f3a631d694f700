//! Weights along one axis, for one particle and for a batch of particles.

use super::cell_locator::WeightNeeds;
use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::moments::SMALLEST;
use crate::mpm::foundation::packed_grid::MARGIN;
use crate::mpm::foundation::simd::{F64Batch, F64x4, Simd};

/// K neighbouring functions along one axis.
#[derive(Debug, Clone, Copy)]
pub struct Weights1d<const K: usize> {
    /// Index of the first function. On a periodic axis the index wraps around. Indices outside the
    /// walls belong to functions with weight zero.
    pub first: usize,
    /// Values of the functions.
    pub weight: [f64; K],
    /// Derivatives of the functions (1/m).
    pub slope: [f64; K],
    /// Positions of the functions relative to the particle (m).
    pub offset: [f64; K],
    /// Variance, `sum weight offset^2` (m^2). If the particle has no other functions along this
    /// axis, offsets are measured from their mean.
    pub variance: f64,
}

impl<const K: usize> Weights1d<K> {
    /// Functions with weight zero.
    pub const NONE: Self =
        Self { first: 0, weight: [0.0; K], slope: [0.0; K], offset: [0.0; K], variance: 0.0 };

    /// Creates functions with the variance computed as a sum. A closed form, if available, is
    /// faster.
    #[inline(always)]
    pub fn new(first: usize, weight: [f64; K], slope: [f64; K], offset: [f64; K]) -> Self {
        let mut variance = 0.0;
        for k in 0..K {
            variance += weight[k] * offset[k] * offset[k];
        }
        Self { first, weight, slope, offset, variance }
    }

    /// Returns the sums over the functions of `weight offset^n` for n = 0, 1, 2.
    #[inline(always)]
    pub(in crate::mpm) fn moments(&self) -> [f64; 3] {
        let mut moments = [0.0; 3];
        for k in 0..K {
            let mut term = self.weight[k];
            for moment in &mut moments {
                *moment += term;
                term *= self.offset[k];
            }
        }
        moments
    }
}

/// Returns the product over all axes of the moment of order `order(axis)`.
#[inline(always)]
pub(in crate::mpm) fn product<const D: usize>(
    moments: &[[f64; 3]; D],
    order: impl Fn(usize) -> usize,
) -> f64 {
    let mut product = 1.0;
    for axis in 0..D {
        product *= moments[axis][order(axis)];
    }
    product
}

/// K neighbouring functions of four particles in registers, with the quantities of [`Weights1d`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct WeightsSimd<S: Simd, const K: usize> {
    pub(in crate::mpm) weight: [S::F64x4; K],
    pub(in crate::mpm) slope: [S::F64x4; K],
    pub(in crate::mpm) offset: [S::F64x4; K],
    /// Variance, `sum weight offset^2` (m^2), about the mean.
    pub(in crate::mpm) variance: S::F64x4,
}

impl<S: Simd, const K: usize> WeightsSimd<S, K> {
    #[inline(always)]
    pub(in crate::mpm) fn put(
        self,
        register: usize,
        needs: WeightNeeds,
        weights: &mut Weights1dBatch,
    ) {
        for k in 0..K {
            weights.weight[k].store(register, self.weight[k]);
        }
        if needs.slopes {
            for k in 0..K {
                weights.slope[k].store(register, self.slope[k]);
            }
        }
        if needs.offsets {
            for k in 0..K {
                weights.offset[k].store(register, self.offset[k]);
            }
            weights.variance.store(register, self.variance);
        }
    }

    #[inline(always)]
    pub(in crate::mpm) fn take(&self, lane: usize, first: usize) -> Weights1d<K> {
        let of = |functions: &[S::F64x4; K]| array(0.0, |k| functions[k].into()[lane]);
        Weights1d {
            first,
            weight: of(&self.weight),
            slope: of(&self.slope),
            offset: of(&self.offset),
            variance: self.variance.into()[lane],
        }
    }
}

/// Maximum number of functions of a patch along an axis.
pub(in crate::mpm) const MOST: usize = MARGIN + 1;

/// Neighbouring functions of a batch of particles, with the quantities of [`Weights1d`]. All
/// patches have the size of the largest one, so that loops need not be compiled for each size.
#[derive(Debug, Clone, Copy)]
pub struct Weights1dBatch {
    pub(in crate::mpm) weight: [F64Batch; MOST],
    pub(in crate::mpm) slope: [F64Batch; MOST],
    pub(in crate::mpm) offset: [F64Batch; MOST],
    /// Variance (m^2), as in [`Weights1d`].
    pub(in crate::mpm) variance: F64Batch,
    /// Offset of each function from the mean (m).
    pub(in crate::mpm) offset_from_mean: [F64Batch; MOST],
    /// Offset of each function from the mean, times the weight (m).
    pub(in crate::mpm) weighted_offset: [F64Batch; MOST],
    /// Inverse of the variance (1/m^2); zero if the variance is zero.
    pub(in crate::mpm) inverse: F64Batch,
}

impl Weights1dBatch {
    pub(in crate::mpm) const NONE: Self = Self {
        weight: [F64Batch::ZERO; MOST],
        slope: [F64Batch::ZERO; MOST],
        offset: [F64Batch::ZERO; MOST],
        variance: F64Batch::ZERO,
        offset_from_mean: [F64Batch::ZERO; MOST],
        weighted_offset: [F64Batch::ZERO; MOST],
        inverse: F64Batch::ZERO,
    };

    #[inline(always)]
    pub(in crate::mpm) fn put<const K: usize>(&mut self, lane: usize, along: &Weights1d<K>) {
        for k in 0..K {
            self.weight[k].0[lane] = along.weight[k];
            self.slope[k].0[lane] = along.slope[k];
            self.offset[k].0[lane] = along.offset[k];
        }
        self.variance.0[lane] = along.variance;
    }

    /// Computes offsets from `mean` (m), or from the mean of the functions of each particle, and
    /// the inverse of the variance, for the first `functions` functions. Offsets are multiplied by
    /// weights before any sum, so that rounding does not affect the inertia tensor near a wall.
    #[inline(always)]
    pub(in crate::mpm) fn center_offsets<S: Simd>(
        &mut self,
        simd: S,
        register: usize,
        functions: usize,
        h: f64,
        mean: Option<f64>,
    ) {
        let zero = simd.splat(0.0);
        let load = |functions: &[F64Batch; MOST]| -> [S::F64x4; MOST] {
            array(zero, |k| functions[k].load(simd, register))
        };
        let (weight, offset) = (load(&self.weight), load(&self.offset));
        let mean = mean.map_or_else(
            || {
                let mut mean = weight[0] * offset[0];
                for k in 1..functions {
                    mean += weight[k] * offset[k];
                }
                mean
            },
            |mean| simd.splat(mean),
        );
        for k in 0..functions {
            let from_mean = offset[k] - mean;
            self.offset_from_mean[k].store(register, from_mean);
            self.weighted_offset[k].store(register, from_mean * weight[k]);
        }
        let inverse = self.variance.load(simd, register).inverse_above(SMALLEST * h * h);
        self.inverse.store(register, inverse);
    }
}

#[inline(always)]
pub(super) fn lane_functions(functions: &[F64Batch; MOST], lane: usize) -> [f64; MOST] {
    array(0.0, |k| functions[k].get(lane))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::foundation::simd::{LANES, Plain};

    #[test]
    fn inverse_is_zero_without_a_second_moment() {
        let mut weights = Weights1dBatch::NONE;
        for (lane, variance) in [0.25, 1e-20, 0.0, f64::NAN].into_iter().enumerate() {
            weights.variance.0[LANES + lane] = variance;
        }
        weights.center_offsets(Plain, 1, 2, 1.0, None);
        assert_eq!(weights.inverse.0[LANES..2 * LANES], [4.0, 0.0, 0.0, 0.0]);
    }
}
