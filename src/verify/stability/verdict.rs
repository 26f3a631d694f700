//! The words for how a run ended.

use crate::named::named;

named! {
    /// How a run ended.
    pub enum Stability {
        /// The energy stayed within what exchange between its kinds allows.
        Stable = "stable",
        /// It grew beyond that, and not out of all bounds in the steps of the run.
        BoundedGrowth = "bounded_growth",
        /// It grew out of all bounds.
        Unstable = "unstable",
        /// The subject could not go on, or a figure is not finite.
        Failed = "failed",
    }
}

impl Stability {
    /// In plain words, as reports print it.
    pub fn words(self) -> &'static str {
        match self {
            Self::BoundedGrowth => "bounded growth",
            other => other.name(),
        }
    }
}
