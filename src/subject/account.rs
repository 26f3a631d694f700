//! A solver's account of itself: its name, and the order that it claims.

use crate::named::named;

/// Longest name of a solver, in bytes.
pub(crate) const LONGEST_NAME: usize = 64;

/// Largest order that a solver may claim.
pub(crate) const HIGHEST_ORDER: f64 = 20.0;

/// Whether `name` may be that of a solver: it becomes part of the names of cases and files.
pub(crate) fn is_solver_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    !name.is_empty() && name.len() <= LONGEST_NAME && name.chars().all(plain)
}

named! {
    /// Precision of a solver's numbers.
    #[derive(Default)]
    pub enum Precision {
        /// 53 bits.
        #[default]
        Double = "double",
        /// 24 bits.
        Single = "single",
    }
}
