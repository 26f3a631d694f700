//! Arrays of NumPy: a zip file of `npy` files (NumPy Enhancement Proposal 1, version 1.0 of the
//! format).

use crate::external::problem::LevelProblem;
use std::io::{Cursor, Write};
use zip::ZipWriter;
use zip::result::ZipResult;
use zip::write::SimpleFileOptions;

/// Length (bytes) of which the head of an array is a multiple.
const ALIGNED: usize = 64;

/// One array for each column: n rows, and as many columns as it has components. `grid_origin`,
/// `h`, `dt` and `until` stand beside them.
pub(super) fn written(problem: &LevelProblem) -> ZipResult<Vec<u8>> {
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

/// An array of doubles as a `npy` file.
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
