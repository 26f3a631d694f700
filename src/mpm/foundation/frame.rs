//! The configuration in which basis functions live.

use super::algebra::Matrix;
use super::particles::Particles;
use crate::named::named;

named! {
    /// Names of the frames that suites may choose.
    pub enum FrameName {
        /// Updated Lagrangian: the basis sees particles where they are, and meets the Cauchy
        /// stress. The original MPM.
        Updated = "updated_lagrangian",
        /// Total Lagrangian: the basis sees particles where they were, and meets the first
        /// Piola-Kirchhoff stress, `f_int_i = - sum_p V0_p P_p grad0 N_i(X_p)`; no particle ever
        /// changes its cell (de Vaucorbeil, Nguyen & Hutchinson 2020, CMAME 360).
        Total = "total_lagrangian",
    }
}

impl<const D: usize> Particles<D> {
    /// Enters the total-Lagrangian frame: from now on the basis is evaluated at reference
    /// positions.
    pub(in crate::mpm) fn stay_in_reference(&mut self) {
        self.track_deformation();
        self.current_position.clone_from(&self.x);
        self.x.clone_from(&self.x0);
    }

    /// Stress times volume (N m) of particle `p`, the factor of basis gradients in the internal
    /// force: V sigma, in the total-Lagrangian frame V0 P = V sigma F^-T.
    #[inline(always)]
    pub fn flux(&self, p: usize) -> Matrix<D> {
        let flux = self.sigma[p] * self.vol[p];
        if self.current_position.is_empty() { flux } else { self.in_reference(p, &flux) }
    }

    #[inline(never)]
    fn in_reference(&self, p: usize, flux: &Matrix<D>) -> Matrix<D> {
        // No inverse: the particle is inverted, and the next stage says so.
        flux * self.def_grad[p].try_inverse().unwrap_or_else(Matrix::zeros).transpose()
    }

    /// Turns gradients with respect to X into those with respect to x, `grad0 v F^-1`.
    pub(in crate::mpm) fn push_gradients_forward(&mut self) {
        for (grad_v, f) in self.grad_v.iter_mut().zip(&self.def_grad) {
            *grad_v *= f.try_inverse().unwrap_or_else(Matrix::zeros);
        }
    }
}
