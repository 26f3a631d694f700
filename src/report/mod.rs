//! The page: what a person or a program reads of a [`SuiteOutcome`](crate::verify::SuiteOutcome).
//!
//! - [`text()`]: the aligned text that is kept as a snapshot. No time, host, date or path.
//! - [`json()`]: one document, an interface.
//! - [`svg()`]: figures, drawn by the layer in [`figure`].
//! - [`mod@page`]: one HTML page with all of it.
//! - [`drift`]: comparison of two texts, number by number.
//! - [`mod@compare`]: two JSON documents side by side, what moved first.

pub mod compare;
#[cfg(test)]
mod contrast;
mod cost;
mod cost_figure;
mod drawing;
pub mod drift;
pub mod figure;
mod json;
mod json_cost;
mod json_number;
mod json_priced;
mod json_stability;
mod levels;
pub mod page;
mod priced;
mod profile;
mod stability;
mod svg;
mod sweep;
mod table;
mod text;

pub use cost::cost;
pub use cost_figure::cost_figures;
pub use drawing::Figure;
pub use json::json;
pub use json_priced::priced_json;
pub use priced::{bid, priced};
pub use profile::{difference, profile};
pub use svg::svg;
pub use text::{case, summary, text};
