//! A figure that has been drawn.

/// A figure and the name of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name, without a folder.
    pub file: String,
    /// The SVG document.
    pub svg: String,
}
