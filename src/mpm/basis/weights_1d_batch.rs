//! Functions along one axis, for several particles at once.

use super::{lattice::Needs, weights_1d::Weights1d};
use crate::mpm::{
    algebra::array,
    kernel::moments::SMALLEST,
    simd::{Four, Lanes, Width},
};

/// K neighbouring functions for each of four particles, in registers.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct WeightsSimd<W: Width, const K: usize> {
    /// Their values.
    pub(in crate::mpm) weight: [W::Four; K],
    /// Their derivatives (1/m).
    pub(in crate::mpm) slope: [W::Four; K],
    /// Where they sit, from the particle (m).
    pub(in crate::mpm) offset: [W::Four; K],
    /// `sum weight offset^2` (m^2), about their mean.
    pub(in crate::mpm) variance: W::Four,
}

impl<W: Width, const K: usize> WeightsSimd<W, K> {
    /// To memory, what a pass needs.
    #[inline(always)]
    pub(in crate::mpm) fn put(self, part: usize, needs: Needs, alongs: &mut Weights1dBatch<K>) {
        for k in 0..K {
            alongs.weight[k].put(part, self.weight[k]);
        }
        if needs.slopes {
            for k in 0..K {
                alongs.slope[k].put(part, self.slope[k]);
            }
        }
        if needs.places {
            for k in 0..K {
                alongs.offset[k].put(part, self.offset[k]);
            }
            alongs.variance.put(part, self.variance);
        }
    }

    /// One of the four.
    #[inline(always)]
    pub(in crate::mpm) fn take(&self, lane: usize, first: usize) -> Weights1d<K> {
        let of = |functions: &[W::Four; K]| array(0.0, |k| functions[k].into()[lane]);
        Weights1d {
            first,
            weight: of(&self.weight),
            slope: of(&self.slope),
            offset: of(&self.offset),
            variance: self.variance.into()[lane],
        }
    }
}

/// The same in memory, for several particles, with what affine fields need.
#[derive(Debug, Clone, Copy)]
pub struct Weights1dBatch<const K: usize> {
    /// Their values.
    pub(in crate::mpm) weight: [Lanes; K],
    /// Their derivatives (1/m).
    pub(in crate::mpm) slope: [Lanes; K],
    /// Where they sit, from the particle (m).
    pub(in crate::mpm) offset: [Lanes; K],
    /// `sum weight offset^2` (m^2), about their mean where they are all that a particle sees.
    pub(in crate::mpm) variance: Lanes,
    /// Offsets from a mean (m).
    pub(in crate::mpm) lever: [Lanes; K],
    /// The same, times weight.
    pub(in crate::mpm) arm: [Lanes; K],
    /// The inverse of the variance (1/m^2), zero where there is none.
    pub(in crate::mpm) inverse: Lanes,
}

impl<const K: usize> Weights1dBatch<K> {
    /// No functions.
    pub(in crate::mpm) const NONE: Self = Self {
        weight: [Lanes::ZERO; K],
        slope: [Lanes::ZERO; K],
        offset: [Lanes::ZERO; K],
        variance: Lanes::ZERO,
        lever: [Lanes::ZERO; K],
        arm: [Lanes::ZERO; K],
        inverse: Lanes::ZERO,
    };

    /// Puts functions into a lane.
    #[inline(always)]
    pub(in crate::mpm) fn put(&mut self, lane: usize, along: &Weights1d<K>) {
        for k in 0..K {
            self.weight[k].0[lane] = along.weight[k];
            self.slope[k].0[lane] = along.slope[k];
            self.offset[k].0[lane] = along.offset[k];
        }
        self.variance.0[lane] = along.variance;
    }

    /// Levers and arms about `mean` (m), or about the mean of the functions of each particle, and
    /// the inverse of the variance. Arms are taken before any sum: near a wall the offset is small
    /// where the weight is not, and what an inertia tensor divides must not be lost in rounding.
    #[inline(always)]
    pub(in crate::mpm) fn about<W: Width>(
        &mut self,
        width: W,
        part: usize,
        h: f64,
        mean: Option<f64>,
    ) {
        let zero = width.all(0.0);
        let four = |functions: &[Lanes; K]| -> [W::Four; K] {
            array(zero, |k| functions[k].four(width, part))
        };
        let (weight, offset) = (four(&self.weight), four(&self.offset));
        let mean = mean.map_or_else(
            || {
                let mut mean = weight[0] * offset[0];
                for k in 1..K {
                    mean += weight[k] * offset[k];
                }
                mean
            },
            |mean| width.all(mean),
        );
        for k in 0..K {
            let lever = offset[k] - mean;
            self.lever[k].put(part, lever);
            self.arm[k].put(part, lever * weight[k]);
        }
        let inverse = self.variance.four(width, part).inverse_above(SMALLEST * h * h);
        self.inverse.put(part, inverse);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::simd::{FOUR, Plain};

    #[test]
    fn an_axis_without_a_moment_has_no_inverse() {
        let mut alongs = Weights1dBatch::<2>::NONE;
        for (lane, variance) in [0.25, 1e-20, 0.0, f64::NAN].into_iter().enumerate() {
            alongs.variance.0[FOUR + lane] = variance;
        }
        alongs.about(Plain, 1, 1.0, None);
        assert_eq!(alongs.inverse.0[FOUR..2 * FOUR], [4.0, 0.0, 0.0, 0.0]);
    }
}
