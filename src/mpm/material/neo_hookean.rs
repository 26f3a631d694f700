//! Neo-Hookean elasticity, a law of the whole deformation.
//!
//! `sigma = (lambda ln(J)/J) I + (mu/J) (F F^T - I)` (Wallstedt & Guilkey 2008; Kamojjala et al.
//! 2015). Nothing is integrated in time but F. Fewer than three dimensions mean plane or uniaxial
//! strain.

use super::{contract::Material, linear_elastic::LinearElastic};
use crate::mpm::{
    algebra::{Matrix, det},
    particles::Particles,
};

/// Compressible neo-Hookean elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    lambda: f64,
    mu: f64,
}

impl NeoHookean {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        let pressure = (self.lambda * libm::log(j) - self.mu) / j;
        Matrix::identity() * pressure + f * f.transpose() * (self.mu / j)
    }

    /// `W = lambda/2 ln(J)^2 + mu/2 (F : F - D - 2 ln J)` (J/m^D), of `H = F - I`: where strains are
    /// small, F : F - D and 2 ln J are nearly the same.
    fn density<const D: usize>(&self, f: &Matrix<D>) -> f64 {
        let h = f - Matrix::identity();
        let trace = h.trace();
        let minors = 0.5 * (trace * trace - (h * h).trace());
        let log = libm::log1p(trace + minors + if D == 3 { det(&h) } else { 0.0 });
        0.5 * self.lambda * log * log + self.mu * (trace - log + 0.5 * h.norm_squared())
    }
}

impl<const D: usize> Material<D> for NeoHookean {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let all = particles.def_grad.iter().zip(&particles.vol0);
        Some(all.map(|(f, vol0)| vol0 * self.density(f)).sum())
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
