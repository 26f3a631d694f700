//! Stress and energy of laws of the deformation gradient alone, over all particles.

use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::algebra::{Matrix, det};
use crate::mpm::particles::Particles;
use crate::mpm::simd::{BATCH, F64Batch, vectorized};

/// Sum of the energies of the particles (J), from that per reference volume (J/m^D).
pub(super) fn stored_energy<const D: usize>(
    particles: &Particles<D>,
    density: impl Fn(&Matrix<D>) -> f64,
) -> f64 {
    let all = particles.def_grad.iter().zip(&particles.vol0);
    all.map(|(f, vol0)| vol0 * density(f)).sum()
}

/// Sets volumes, and Cauchy stresses from F and J.
pub(super) fn set_stress<const D: usize>(
    body: &mut StressUpdate<'_, D>,
    cauchy: impl Fn(&Matrix<D>, f64) -> Matrix<D> + Sync,
) {
    set_stress_by_batch(body, |j| [*j], |f, [j]| cauchy(f, j));
}

/// The same for a law of which `of_j` computes what it needs of J, for several particles at a time.
pub(super) fn set_stress_by_batch<const D: usize, const N: usize>(
    body: &mut StressUpdate<'_, D>,
    of_j: impl Fn(&F64Batch) -> [F64Batch; N] + Sync,
    cauchy: impl Fn(&Matrix<D>, [f64; N]) -> Matrix<D> + Sync,
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
                    let of_j = of_j(&j);
                    for (lane, (sigma, f)) in sigma.iter_mut().zip(def_grad).enumerate() {
                        let mut own = [0.0; N];
                        for k in 0..N {
                            own[k] = of_j[k].get(lane);
                        }
                        *sigma = cauchy(f, own);
                    }
                }
            },
        );
    });
}
