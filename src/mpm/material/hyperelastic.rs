//! Stress and energy of laws of the deformation gradient alone, over all particles.

use crate::mpm::algebra::{Matrix, det};
use crate::mpm::particles::Particles;

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
    particles: &mut Particles<D>,
    cauchy: impl Fn(&Matrix<D>, f64) -> Matrix<D>,
) {
    for p in 0..particles.len().min(particles.def_grad.len()) {
        let f = &particles.def_grad[p];
        let j = det(f);
        particles.vol[p] = j * particles.vol0[p];
        particles.sigma[p] = cauchy(f, j);
    }
}
