//! Figures as standalone SVG documents.
//!
//! There are two kinds: the [`LogLogPlot`] (error against cell size, time step or work) and the
//! [`Map`] (a table of numbers on coloured fields). Both are pure functions of their input and can
//! be compared byte by byte: coordinates have two decimals, and transcendental functions come from
//! `libm`.
//!
//! A value that cannot be placed on its axis is drawn as failed or is counted in a note below.
//!
//! ```
//! use mpm_verify::report::figure::{LogLogPlot, Mark, PlotPoint, PlotSeries};
//!
//! let point = |x: f64| PlotPoint { x, error: x * x, mark: Mark::Measured };
//! let series = PlotSeries {
//!     name: "linear".into(),
//!     look: 0,
//!     points: vec![point(0.25), point(0.5), point(1.0)],
//! };
//! let svg = LogLogPlot {
//!     title: "Vibrating bar".into(),
//!     x_label: "cell size h (m)".into(),
//!     y_label: "error (m)".into(),
//!     series: vec![series],
//!     reference_orders: vec![2.0],
//!     ..LogLogPlot::default()
//! }
//! .to_svg();
//! assert!(svg.starts_with("<svg xmlns="));
//! ```

pub(crate) mod cost;
pub(crate) mod map;
pub(crate) mod plot;
pub(crate) mod study;
pub(crate) mod sweep;

mod log_log;
mod pgfplots;
mod series;

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
