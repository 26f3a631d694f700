//! The configuration in which basis functions live.

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
