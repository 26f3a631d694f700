//! Hencky elasticity: the law of small strains, with logarithmic strain and Kirchhoff stress.
//!
//! `sigma = (lambda tr(eps) I + 2 mu eps)/J`, `eps = ln(F F^T)/2` (Hencky 1928; de Souza Neto,
//! Peric & Owen 2008, chapter 13; Charlton et al. 2017 in MPM). Derived from the energy
//! `W = lambda/2 tr(eps)^2 + mu eps : eps`. Fewer than three dimensions mean plane or uniaxial
//! strain.

use super::{
    contract::Material,
    linear_elastic::LinearElastic,
    spectral::{assembled, half_log, spectral},
};
use crate::mpm::{
    algebra::{Matrix, det},
    particles::Particles,
};

/// Hencky elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hencky {
    lambda: f64,
    mu: f64,
}

impl Hencky {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        let (squares, axes) = spectral(&(f * f.transpose()));
        let strain = half_log(&squares);
        let pressure = self.lambda * strain.sum();
        assembled(&strain.map(|eps| (pressure + 2.0 * self.mu * eps) / j), &axes)
    }
}

impl<const D: usize> Material<D> for Hencky {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |f: &Matrix<D>| {
            let strain = half_log(&spectral(&(f * f.transpose())).0);
            0.5 * self.lambda * strain.sum() * strain.sum() + self.mu * strain.norm_squared()
        };
        let all = particles.def_grad.iter().zip(&particles.vol0);
        Some(all.map(|(f, vol0)| vol0 * density(f)).sum())
    }

    fn update(&mut self, _: f64, particles: &mut Particles<D>) {
        for p in 0..particles.len().min(particles.def_grad.len()) {
            let f = &particles.def_grad[p];
            let j = det(f);
            particles.vol[p] = j * particles.vol0[p];
            particles.sigma[p] = self.cauchy(f, j);
        }
    }
}
