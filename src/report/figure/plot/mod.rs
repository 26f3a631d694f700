//! The plotting layer: axes, ticks, legends, markers, and the SVG writer.

pub(crate) mod canvas;
pub(crate) mod frame;
pub(crate) mod marker;
pub(crate) mod scale;
pub(crate) mod style;
pub(crate) mod svg;
pub(crate) mod ticks;
