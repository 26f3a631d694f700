//! A problem as a file, for those who compare by hand or look at it.

mod csv;
mod npz;
mod shape;
mod vtu;

use super::problem::LevelProblem;
use crate::named::named;
use serde_json::json;

named! {
    /// Formats of a problem.
    pub enum ProblemFormat {
        /// A table, one particle a line.
        Csv = "csv",
        /// One document with the keys of the protocol.
        Json = "json",
        /// Arrays of NumPy, one for each column and for the grid.
        Npz = "npz",
        /// Points with data, for ParaView.
        Vtu = "vtu",
    }
}

impl ProblemFormat {
    /// Whether the file is no text.
    pub fn is_binary(self) -> bool {
        matches!(self, Self::Npz | Self::Vtu)
    }
}

impl LevelProblem {
    /// The bytes of a file that holds the problem.
    ///
    /// # Errors
    /// One line that says why a writer failed.
    pub fn written(&self, format: ProblemFormat) -> Result<Vec<u8>, String> {
        match format {
            ProblemFormat::Csv => Ok(csv::written(self).into_bytes()),
            ProblemFormat::Json => Ok(self.document().into_bytes()),
            ProblemFormat::Npz => npz::written(self).map_err(|error| error.to_string()),
            ProblemFormat::Vtu => Ok(vtu::written(self)),
        }
    }

    /// The message of the protocol, in lines.
    fn document(&self) -> String {
        let mut document = json!(self);
        let columns = self.particles.columns();
        document["particles"] =
            columns.iter().map(|(name, all)| ((*name).to_owned(), json!(all))).collect();
        format!("{document:#}\n")
    }
}
