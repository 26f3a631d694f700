//! Peak rates of one core of this machine.

use crate::clock::shortest;
use fearless_simd::{Level, Simd, SimdBase, SimdFloat, SimdInto, dispatch, f64x4};
use std::hint::black_box;

#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Floating-point operations per second, in fused multiply-adds of four numbers.
    pub(crate) flops: f64,
    /// Bytes per second between memory and a loop that reads two columns and writes one.
    pub(crate) memory: f64,
    /// Bytes per second of this loop if the columns fit the second-level cache.
    pub(crate) cache: f64,
    /// Updates per second (read, add, write) of four numbers in the first-level cache.
    pub(crate) updates: f64,
}

/// Number of independent chains: enough to hide the latency of a fused multiply-add.
const CHAINS: usize = 10;

#[inline(always)]
fn chains<S: Simd>(simd: S, times: usize) -> f64 {
    let (factor, term) =
        (f64x4::splat(simd, black_box(0.999)), f64x4::splat(simd, black_box(1e-3)));
    let mut sums: [f64x4<S>; CHAINS] =
        std::array::from_fn(|k| [k as f64, 1.0, 2.0, 3.0].simd_into(simd));
    for _ in 0..times {
        for sum in &mut sums {
            *sum = sum.mul_add_precise(factor, term);
        }
    }
    sums.iter().map(|sum| <[f64; 4]>::from(*sum)[0]).sum()
}

#[inline(always)]
fn add_to<S: Simd>(simd: S, nodes: &mut [[f64; 4]], value: [f64; 4]) {
    let value: f64x4<S> = value.simd_into(simd);
    for node in nodes {
        let sum: f64x4<S> = (*node).simd_into(simd);
        *node = (sum + value).into();
    }
}

fn triad(megabytes: f64) -> f64 {
    let count = (megabytes * 1e6 / 24.0) as usize;
    let (b, c, mut a) = (vec![1.0; count], vec![2.0; count], vec![0.0; count]);
    let time = shortest(|| {
        let factor = black_box(3.0);
        for ((a, b), c) in a.iter_mut().zip(black_box(&b)).zip(&c) {
            *a = b + factor * c;
        }
        black_box(&mut a);
    });
    24.0 * count as f64 / time
}

impl Limits {
    pub(crate) fn measured() -> Self {
        let times = 100_000;
        let time = shortest(|| {
            black_box(dispatch!(Level::new(), simd => chains(simd, black_box(times))));
        });
        let flops = 2.0 * 4.0 * (CHAINS * times) as f64 / time;
        let mut nodes = vec![[0.0; 4]; 512];
        let time = shortest(|| {
            for _ in 0..1000 {
                dispatch!(Level::new(), simd => add_to(simd, black_box(&mut nodes), [1e-9; 4]));
            }
        });
        let updates = (1000 * nodes.len()) as f64 / time;
        Self { flops, memory: triad(600.0), cache: triad(0.6), updates }
    }
}
