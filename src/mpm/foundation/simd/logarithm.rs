//! Natural logarithms of several numbers at a time.
//!
//! The operations of `libm::log` (FreeBSD's `e_log.c`: the error is below one unit in the last
//! place) without its branches, so that the compiler vectorises them. A test checks that the bits
//! are equal.

use super::{BATCH, F64Batch};

/// Bits of the square root of 1/2, to 32 bits: where numbers are split into `2^k` and a factor.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e << 32;
const ONE: u64 = 0x3ff0_0000 << 32;
const MANTISSA: u64 = (1 << 52) - 1;
/// 2^52, whose last bit counts ones: a whole number below it, put into its mantissa, is added.
const COUNTING: u64 = 0x4330_0000 << 32;

const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
const LG1: f64 = 6.666_666_666_666_735e-1;
const LG2: f64 = 3.999_999_999_940_942e-1;
const LG3: f64 = 2.857_142_874_366_239e-1;
const LG4: f64 = 2.222_219_843_214_978_4e-1;
const LG5: f64 = 1.818_357_216_161_805e-1;
const LG6: f64 = 1.531_383_769_920_937_3e-1;
const LG7: f64 = 1.479_819_860_511_658_6e-1;

/// `ln x` of each number, with the bits of `libm::log`.
#[inline(always)]
#[allow(
    clippy::manual_range_contains,
    clippy::needless_bitwise_bool,
    reason = "a lazy operator is a branch"
)]
pub(in crate::mpm) fn ln(x: &F64Batch) -> F64Batch {
    let mut result = F64Batch::ZERO;
    let mut all_normal = true;
    for lane in 0..BATCH {
        let x = x.0[lane];
        all_normal &= (x >= f64::MIN_POSITIVE) & (x <= f64::MAX);
        result.0[lane] = ln_of_normal(x);
    }
    if all_normal { result } else { one_by_one(x) }
}

/// `ln x` of a positive number that is neither subnormal nor infinite.
#[inline(always)]
fn ln_of_normal(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_add(ONE - ROOT_OF_HALF);
    let k = f64::from_bits(shifted >> 52 | COUNTING) - (f64::from_bits(COUNTING) + 1023.0);
    let f = f64::from_bits((shifted & MANTISSA).wrapping_add(ROOT_OF_HALF)) - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (LG2 + w * (LG4 + w * LG6));
    let odd = z * (LG1 + w * (LG3 + w * (LG5 + w * LG7)));
    s * (half_square + (odd + even)) + k * LN2_LOW - half_square + f + k * LN2_HIGH
}

/// `ln x` lane by lane, for batches with a number that is zero, negative, subnormal or not finite.
#[cold]
#[inline(never)]
fn one_by_one(x: &F64Batch) -> F64Batch {
    F64Batch(x.0.map(libm::log))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rstest::rstest;

    fn holds(numbers: [f64; BATCH]) {
        let found = ln(&F64Batch(numbers)).0.map(f64::to_bits);
        assert_eq!(found, numbers.map(|x| libm::log(x).to_bits()), "{numbers:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn logarithms_have_the_bits_of_the_library(bits in any::<[u64; BATCH]>()) {
            // All numbers of each batch are positive and normal, so that the fast path is used.
            holds(bits.map(|bits| f64::from_bits(bits % (0x7fe << 52) + (1 << 52))));
        }

        #[test]
        fn logarithms_near_one_have_them_too(x in proptest::array::uniform16(0.5_f64..2.0)) {
            holds(x);
        }
    }

    #[rstest]
    #[case::zero(0.0)]
    #[case::minus_zero(-0.0)]
    #[case::negative(-1.0)]
    #[case::subnormal(1e-310)]
    #[case::infinite(f64::INFINITY)]
    #[case::no_number(f64::NAN)]
    #[case::smallest(f64::MIN_POSITIVE)]
    #[case::largest(f64::MAX)]
    #[case::one(1.0)]
    #[case::root_of_half(f64::from_bits(ROOT_OF_HALF))]
    #[case::below_root_of_half(f64::from_bits(ROOT_OF_HALF - 1))]
    fn logarithms_of_extremes_have_the_bits_of_the_library(#[case] x: f64) {
        let mut numbers = [1.5; BATCH];
        numbers[5] = x;
        holds(numbers);
        holds([x; BATCH]);
    }
}
