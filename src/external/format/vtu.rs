//! Points with data, for ParaView: the XML format of VTK in text, which is written here because
//! the crate for it rests on parsers that coming versions of Rust refuse.

use super::shape::{is_scalar, is_tensor};
use crate::external::problem::LevelProblem;
use std::fmt::Write;

/// One vertex for each particle, at its position. Vectors have three components and tensors nine;
/// what lies beyond the dimension is zero.
pub(super) fn written(problem: &LevelProblem) -> String {
    let (n, d) = (problem.particles.len(), problem.dimension);
    let mut xml = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\">\n<Points>\n"
    );
    array(&mut xml, "position", "Float64", 3, &padded(&problem.particles.position, d, (1, 1)));
    xml += "</Points>\n<Cells>\n";
    let numbers = |first: usize| (first..first + n).map(|k| k as f64).collect::<Vec<_>>();
    array(&mut xml, "connectivity", "Int64", 1, &numbers(0));
    array(&mut xml, "offsets", "Int64", 1, &numbers(1));
    array(&mut xml, "types", "UInt8", 1, &vec![VERTEX; n]);
    xml += "</Cells>\n<PointData>\n";
    for (name, column) in problem.particles.columns() {
        if is_scalar(name) {
            array(&mut xml, name, "Float64", 1, column);
        } else if is_tensor(name) {
            array(&mut xml, name, "Float64", 9, &padded(column, d, (d, 3)));
        } else {
            array(&mut xml, name, "Float64", 3, &padded(column, d, (1, 1)));
        }
    }
    xml + "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
}

/// VTK's number of a cell that is a point.
const VERTEX: f64 = 1.0;

fn array(xml: &mut String, name: &str, kind: &str, components: usize, numbers: &[f64]) {
    let head = format!(
        "<DataArray Name=\"{name}\" type=\"{kind}\" NumberOfComponents=\"{components}\" \
         format=\"ascii\">\n"
    );
    *xml += &head;
    for row in numbers.chunks(components) {
        let row: Vec<String> = row.iter().map(f64::to_string).collect();
        // Writing to a string does not fail.
        let _ = writeln!(xml, "{}", row.join(" "));
    }
    *xml += "</DataArray>\n";
}

/// A column whose particles have `rows` rows of `d` numbers, filled up with zeros to `deep` rows of
/// three.
fn padded(numbers: &[f64], d: usize, (rows, deep): (usize, usize)) -> Vec<f64> {
    let mut all = Vec::with_capacity(numbers.len() / (rows * d) * deep * 3);
    for particle in numbers.chunks_exact(rows * d) {
        for (i, j) in (0..deep).flat_map(|i| (0..3).map(move |j| (i, j))) {
            all.push(if i < rows && j < d { particle[i * d + j] } else { 0.0 });
        }
    }
    all
}
