//! A sketch of a scene: bodies, grid, faces and loads, as text and as SVG.
//!
//! Symbols follow the usual conventions (hatching for a fixed face, rollers, arrows for loads).
//! Text below the picture states the rest, as in reports.

mod shape;
mod svg;
mod symbols;
mod text;
mod view;

pub use svg::sketch_svg;
pub use text::sketch_text;
