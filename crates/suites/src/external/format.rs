//! Converts a problem to a file, for manual inspection or a viewer.

use super::problem::LevelProblem;
use crate::subject::StateField;
use crate::vtk::{TensorRank, points};
use mpm_subject::named;
use serde_json::json;
use std::io::{self, Cursor, Write};
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

named! {
    /// File formats for a problem.
    pub enum ProblemFormat {
        /// A table with one particle per line.
        Csv = "csv",
        /// One document with the keys of the protocol.
        Json = "json",
        /// NumPy arrays: one for each column, and arrays with grid and time step.
        Npz = "npz",
        /// Points with data, for ParaView.
        Vtu = "vtu",
    }
}

impl ProblemFormat {
    /// Whether the file is binary.
    pub fn is_binary(self) -> bool {
        matches!(self, Self::Npz | Self::Vtu)
    }
}

impl LevelProblem {
    /// Converts the problem to the bytes of a file.
    ///
    /// # Errors
    /// If the zip library fails.
    pub fn written(&self, format: ProblemFormat) -> io::Result<Vec<u8>> {
        match format {
            ProblemFormat::Csv => Ok(csv_table(self).into_bytes()),
            ProblemFormat::Json => Ok(self.document().into_bytes()),
            ProblemFormat::Npz => Ok(npz_file(self)?),
            ProblemFormat::Vtu => Ok(vtu_file(self)),
        }
    }

    fn document(&self) -> String {
        let mut document = json!(self);
        let columns = self.particles.columns();
        document["particles"] =
            columns.iter().map(|(name, all)| ((*name).to_owned(), json!(all))).collect();
        format!("{document:#}\n")
    }

    fn width(&self, column: &[f64]) -> usize {
        column.len() / self.particles.len().max(1)
    }
}

fn is_scalar(column: &str) -> bool {
    ["mass", "reference_volume", "volume", "body", "hoop_stress"].contains(&column)
}

fn is_tensor(column: &str) -> bool {
    ["deformation_gradient", "stress", "initial_stress"].contains(&column)
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Formats a table with one particle per line, and column names such as `stress_xy`.
fn csv_table(problem: &LevelProblem) -> String {
    let (d, columns) = (problem.dimension, problem.particles.columns());
    let mut head = Vec::new();
    for (name, column) in &columns {
        let width = problem.width(column);
        let component = |k: usize| {
            if is_tensor(name) {
                format!("{name}_{}{}", AXES[k / d], AXES[k % d])
            } else {
                let is_across = *name == "initial_stress_across";
                format!("{name}_{}", AXES[if is_across { d + k } else { k }])
            }
        };
        if is_scalar(name) {
            head.push((*name).to_owned());
        } else {
            head.extend((0..width).map(component));
        }
    }
    let mut lines = vec![head.join(",")];
    lines.extend((0..problem.particles.len()).map(|p| {
        let numbers = columns.iter().flat_map(|(_, column)| {
            let width = problem.width(column);
            &column[p * width..(p + 1) * width]
        });
        numbers.map(f64::to_string).collect::<Vec<_>>().join(",")
    }));
    lines.join("\n") + "\n"
}

/// Alignment of the header of an npy file (bytes).
const ALIGNED: usize = 64;

/// Creates a zip file with `npy` arrays (NumPy Enhancement Proposal 1, version 1.0 of the format).
/// Each column becomes an array with n rows and one array column for each component. The other
/// arrays are `grid_origin`, `h`, `dt` and `until`.
fn npz_file(problem: &LevelProblem) -> ZipResult<Vec<u8>> {
    let mut file = ZipWriter::new(Cursor::new(Vec::new()));
    let mut add = |name: &str, shape: &str, numbers: &[f64]| -> ZipResult<()> {
        file.start_file(format!("{name}.npy"), SimpleFileOptions::default())?;
        Ok(file.write_all(&array(shape, numbers))?)
    };
    let n = problem.particles.len();
    for (name, column) in problem.particles.columns() {
        let shape = match problem.width(column) {
            1 => format!("({n},)"),
            width => format!("({n}, {width})"),
        };
        add(name, &shape, column)?;
    }
    add("grid_origin", &format!("({},)", problem.dimension), &problem.grid.origin)?;
    for (name, value) in [("h", problem.grid.h), ("dt", problem.dt), ("until", problem.until)] {
        add(name, "()", &[value])?;
    }
    Ok(file.finish()?.into_inner())
}

fn array(shape: &str, numbers: &[f64]) -> Vec<u8> {
    let mut head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    let magic = b"\x93NUMPY\x01\x00";
    let size = (magic.len() + 2 + head.len() + 1).next_multiple_of(ALIGNED);
    let padding = size - magic.len() - 2 - head.len() - 1;
    head.extend(std::iter::repeat_n(' ', padding));
    head.push('\n');
    let mut bytes = magic.to_vec();
    bytes.extend((head.len() as u16).to_le_bytes());
    bytes.extend(head.as_bytes());
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

fn vtu_file(problem: &LevelProblem) -> Vec<u8> {
    let rank = |name: &str| match name {
        name if is_scalar(name) => TensorRank::Scalar,
        name if is_tensor(name) => TensorRank::Tensor,
        _ => TensorRank::Vector,
    };
    let field = |(name, column): (&str, &[f64])| {
        let (name, components) = (name.to_owned(), problem.width(column));
        (rank(&name), StateField { name, components, numbers: column.to_vec() })
    };
    let fields: Vec<(TensorRank, StateField)> =
        problem.particles.columns().into_iter().map(field).collect();
    points(problem.dimension, &problem.particles.position, &fields)
}
