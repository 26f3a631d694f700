//! Figures as standalone SVG documents.
//!
//! There are three kinds: the [`LogLogPlot`] (error against cell size, time step or work), the
//! [`HistoryPlot`] (curves with linear axes) and the [`Map`] (a table of numbers on coloured
//! fields). All are pure functions of their input and can be compared byte by byte: coordinates
//! have two decimals, and transcendental functions come from `libm`.
//!
//! Figures accept any input. A value that cannot be placed on its axis is drawn as failed,
//! interrupts its curve, or is counted in a note below the figure.
//!
//! ```
//! use mpm_verify::report::figure::{Curve, HistoryPlot};
//!
//! let svg = HistoryPlot {
//!     title: "Vibrating bar".into(),
//!     x_label: "time (s)".into(),
//!     y_label: "velocity (m/s)".into(),
//!     curves: vec![Curve {
//!         name: "exact".into(),
//!         look: 0,
//!         points: vec![(0.0, 1.0), (0.5, -1.0), (1.0, 1.0)],
//!         exact: true,
//!         markers: false,
//!     }],
//! }
//! .to_svg();
//! assert!(svg.starts_with("<svg xmlns="));
//! ```

pub(crate) mod cost;
pub(crate) mod map;
pub(crate) mod plot;
pub(crate) mod study;
pub(crate) mod sweep;

mod history;
mod log_log;
mod pgfplots;
mod series;

pub use history::{Curve, HistoryPlot};
pub use log_log::LogLogPlot;
pub use map::{Map, MapField};
pub use series::{Mark, PlotPoint, PlotSeries};

/// A figure with the name of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name, without a folder.
    pub file: String,
    /// The SVG document.
    pub svg: String,
    /// The figure as a LaTeX document that uses the package PGFPlots.
    pub pgfplots: String,
}

impl Figure {
    /// Returns the file name of the LaTeX document, without a folder.
    pub fn pgfplots_file(&self) -> String {
        format!("{}.tex", self.file.strip_suffix(".svg").unwrap_or(&self.file))
    }
}
