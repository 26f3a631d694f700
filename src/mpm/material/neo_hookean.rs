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
}

impl<const D: usize> Material<D> for NeoHookean {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn update(&self, _: f64, particles: &mut Particles<D>) {
        for p in 0..particles.len().min(particles.def_grad.len()) {
            let f = &particles.def_grad[p];
            let j = det(f);
            particles.vol[p] = j * particles.vol0[p];
            particles.sigma[p] = self.cauchy(f, j);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn simple_shear_has_its_closed_form() {
        let law = NeoHookean::new(100.0, 0.3);
        let sigma = law.cauchy(&Matrix::<2>::new(1.0, 0.4, 0.0, 1.0), 1.0);
        assert_relative_eq!(sigma[(0, 1)], law.mu * 0.4, max_relative = 1e-14);
        assert_relative_eq!(sigma[(0, 0)], law.mu * 0.16, max_relative = 1e-14);
        assert_relative_eq!(sigma[(1, 1)], 0.0, epsilon = 1e-14);
    }

    #[test]
    fn a_stretched_bar_has_its_closed_form() {
        let (young, stretch) = (1e4, 1.1);
        let sigma = NeoHookean::new(young, 0.0).cauchy(&Matrix::<1>::new(stretch), stretch);
        let exact = young / 2.0 * (stretch - 1.0 / stretch);
        assert_relative_eq!(sigma[(0, 0)], exact, max_relative = 1e-13);
    }

    #[test]
    fn at_rest_there_is_no_stress() {
        let sigma = NeoHookean::new(100.0, 0.3).cauchy(&Matrix::<3>::identity(), 1.0);
        assert_relative_eq!(sigma.norm(), 0.0, epsilon = 1e-14);
    }

    /// sigma(Q F) = Q sigma(F) Q^T.
    #[test]
    fn a_superposed_rotation_only_turns_the_stress() {
        let law = NeoHookean::new(100.0, 0.3);
        let f = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
        let (c, s) = (libm::cos(0.7), libm::sin(0.7));
        let q = Matrix::<2>::new(c, -s, s, c);
        let turned = law.cauchy(&(q * f), det(&f));
        let expected = q * law.cauchy(&f, det(&f)) * q.transpose();
        assert_relative_eq!(turned, expected, max_relative = 1e-12);
    }
}
