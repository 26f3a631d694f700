//! Stress and energy of all particles, for laws that depend only on the deformation gradient.

use super::spectral::MatrixBatch;
use super::stress_update::{StressBlock, StressUpdate};
use super::stretch::SquaredStretch;
use crate::mpm::foundation::algebra::{Matrix, det, pairs, zeros};
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

/// Sets volumes and Cauchy stresses, for laws whose stress is linear in an isotropic function of
/// `F F^T`. `of_stretch` computes this function for several particles at a time, and `cauchy` the
/// stress (Pa) from its value and from J.
pub(super) fn set_stress_of_stretch<const D: usize>(
    body: &mut StressUpdate<'_, D>,
    of_stretch: impl Fn(&SquaredStretch<D>) -> MatrixBatch<D> + Sync,
    cauchy: impl Fn(&Matrix<D>, f64) -> Matrix<D> + Sync,
) {
    by_batch(
        body,
        #[inline(always)]
        |def_grad, j, sigma| {
            let mut f = MatrixBatch::identity();
            for (lane, def_grad) in def_grad.iter().enumerate() {
                f.set(lane, def_grad);
            }
            let mut values = of_stretch(&SquaredStretch::new(&f, &f.minus_identity()));
            for lane in 0..BATCH {
                values.set(lane, &cauchy(&values.get(lane), j.get(lane)));
            }
            for (lane, sigma) in sigma.iter_mut().enumerate() {
                *sigma = values.get(lane);
            }
        },
    );
}

/// Returns `pressure I + factor m`.
#[inline(always)]
pub(super) fn linear<const D: usize>(pressure: f64, factor: f64, m: &Matrix<D>) -> Matrix<D> {
    let mut sum = zeros();
    for j in 0..D {
        for i in 0..D {
            sum[(i, j)] = if i == j { pressure } else { 0.0 } + factor * m[(i, j)];
        }
    }
    sum
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
                    pairs(&mut j.0, def_grad, |j, f| *j = det(f));
                    pairs(vol, vol0, |vol, vol0| *vol = *vol0);
                    pairs(vol, &j.0, |vol, j| *vol *= j);
                    set_stress(def_grad, &j, sigma);
                }
            },
        );
    });
}
