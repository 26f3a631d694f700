//! A figure that has been drawn.

/// A figure and the name of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name, without a folder.
    pub file: String,
    /// The SVG document.
    pub svg: String,
    /// This figure as a LaTeX document that uses the package PGFPlots.
    pub pgfplots: String,
}

impl Figure {
    /// Name of the file of the LaTeX document, without a folder.
    pub fn pgfplots_file(&self) -> String {
        format!("{}.tex", self.file.strip_suffix(".svg").unwrap_or(&self.file))
    }
}
