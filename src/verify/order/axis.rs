//! Axes of refinement: cells, time steps or particles.

use crate::named::named;

named! {
    /// An axis of refinement. Errors of the axes add up, so that refining one of them alone ends at
    /// the error of the others.
    pub enum Axis {
        /// Cells. The time step may follow as a formula of h.
        Space = "space",
        /// Time steps, on one grid.
        Time = "time",
        /// Particles per cell, on one grid. Their spacing along an axis is h/ppc^(1/D).
        Particles = "particles",
    }
}

impl Axis {
    /// The symbol of the spacing that is judged, as sentences and tables write it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Space => "h",
            Self::Time => "dt",
            Self::Particles => "particle spacing",
        }
    }

    /// The spacing in words.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Space => "cell size",
            Self::Time => "time step",
            Self::Particles => "particle spacing",
        }
    }
}
