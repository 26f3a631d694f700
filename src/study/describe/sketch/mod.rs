//! A sketch of a scene: bodies, grid, faces and loads, as text and as SVG.
//!
//! Symbols are the customary ones (hatching for a fixed face, rollers, arrows for loads). What a
//! picture cannot say stands below it in the words of reports.

mod shape;
mod svg;
mod symbols;
mod text;
mod view;

pub use svg::sketch_svg;
pub use text::sketch_text;
