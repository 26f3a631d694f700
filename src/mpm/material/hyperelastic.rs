//! Stress and energy of all particles, for laws that depend only on the deformation gradient.

use super::spectral::{MatrixBatch, assembled_batch, spectral_batch};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, Vector, det, product};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, F64Batch, vectorized};

/// Sums the particle energies (J), from the energy per reference volume (J/m^D).
pub(super) fn stored_energy<const D: usize>(
    particles: &Particles<D>,
    density: impl Fn(&Matrix<D>) -> f64,
) -> f64 {
    let all = particles.def_grad.iter().zip(&particles.vol0);
    all.map(|(f, vol0)| vol0 * density(f)).sum()
}

/// Sets volumes, and computes Cauchy stresses from F for several particles at a time. `cauchy`
/// receives F of a particle and the result of `of_j`, a function of J.
pub(super) fn set_stress_by_batch<const D: usize, const N: usize>(
    body: &mut StressUpdate<'_, D>,
    of_j: impl Fn(&F64Batch) -> [F64Batch; N] + Sync,
    cauchy: impl Fn(&Matrix<D>, [f64; N]) -> Matrix<D> + Sync,
) {
    by_batch(
        body,
        #[inline(always)]
        |def_grad, j, sigma| {
            let of_j = of_j(j);
            for (lane, (sigma, f)) in sigma.iter_mut().zip(def_grad).enumerate() {
                let mut own = [0.0; N];
                for k in 0..N {
                    own[k] = of_j[k].get(lane);
                }
                *sigma = cauchy(f, own);
            }
        },
    );
}

/// Sets volumes and Cauchy stresses, for laws whose stress has the axes of `F F^T`. `of_squares` is
/// applied to the squared principal stretches, for several particles at a time. `principal`
/// computes the principal stresses (Pa) from the results of `of_squares` and from J.
pub(super) fn set_stress_along_axes<const D: usize>(
    body: &mut StressUpdate<'_, D>,
    of_squares: impl Fn(&F64Batch) -> F64Batch + Sync,
    principal: impl Fn(&Vector<D>, f64) -> Vector<D> + Sync,
) {
    by_batch(
        body,
        #[inline(always)]
        |def_grad, j, sigma| {
            let mut squared = MatrixBatch::identity();
            for (lane, f) in def_grad.iter().enumerate() {
                squared.set(lane, &product(f, &f.transpose()));
            }
            let (squares, axes) = spectral_batch(squared);
            let mut stresses = squares.map(&of_squares);
            for lane in 0..BATCH {
                stresses.set(lane, &principal(&stresses.get(lane), j.get(lane)));
            }
            let assembled = assembled_batch(&stresses, &axes);
            for (lane, sigma) in sigma.iter_mut().enumerate() {
                *sigma = assembled.get(lane);
            }
        },
    );
}

/// Sets volumes, and calls `set_stress` with F, J and the stresses of each batch.
fn by_batch<const D: usize>(
    body: &mut StressUpdate<'_, D>,
    set_stress: impl Fn(&[Matrix<D>], &F64Batch, &mut [Matrix<D>]) + Sync,
) {
    body.by_block(|StressBlock { def_grad, vol0, vol, sigma, .. }| {
        vectorized(
            #[inline(always)]
            || {
                let columns = def_grad.chunks(BATCH).zip(vol0.chunks(BATCH));
                let results = vol.chunks_mut(BATCH).zip(sigma.chunks_mut(BATCH));
                for ((def_grad, vol0), (vol, sigma)) in columns.zip(results) {
                    let mut j = F64Batch([1.0; BATCH]);
                    for (j, f) in j.0.iter_mut().zip(def_grad) {
                        *j = det(f);
                    }
                    for ((vol, vol0), j) in vol.iter_mut().zip(vol0).zip(&j.0) {
                        *vol = j * vol0;
                    }
                    set_stress(def_grad, &j, sigma);
                }
            },
        );
    });
}
