//! Weights of a particle along one axis.

/// K neighbouring functions along one axis.
#[derive(Debug, Clone, Copy)]
pub struct Weights1d<const K: usize> {
    /// Index of the first. On a periodic axis the first function follows the last one; beyond a
    /// wall indices belong to functions of weight zero.
    pub first: usize,
    /// Values.
    pub weight: [f64; K],
    /// Derivatives (1/m).
    pub slope: [f64; K],
    /// Positions from the particle (m).
    pub offset: [f64; K],
    /// `sum weight offset^2` (m^2), about the mean where the particle has no other functions along
    /// this axis.
    pub variance: f64,
}

impl<const K: usize> Weights1d<K> {
    /// No functions.
    pub const NONE: Self =
        Self { first: 0, weight: [0.0; K], slope: [0.0; K], offset: [0.0; K], variance: 0.0 };

    /// Functions with the variance as a sum. A closed form, where there is one, is faster.
    #[inline(always)]
    pub fn new(first: usize, weight: [f64; K], slope: [f64; K], offset: [f64; K]) -> Self {
        let mut variance = 0.0;
        for k in 0..K {
            variance += weight[k] * offset[k] * offset[k];
        }
        Self { first, weight, slope, offset, variance }
    }

    /// Sums over the functions of `weight offset^n` for n = 0, 1, 2.
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

/// The product over all axes of the moments of these orders.
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
