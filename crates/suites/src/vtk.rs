//! Writes VTK files in XML format for ParaView: points and grids with data, and time series of such
//! files (VTK File Formats, "XML File Formats"). Numbers are appended in base64, because text
//! readers stop at the first NaN, and a file with raw bytes is not XML. The existing VTK crate is
//! not used, because it depends on parsers that future Rust versions will reject.

use crate::subject::StateField;
use std::fmt::Write;

/// VTK number of the cell type "vertex": a cell that is a point.
const VERTEX: u8 = 1;

/// Tensor rank of an entry of a field. In one dimension the number of components does not determine
/// the rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TensorRank {
    Scalar,
    Vector,
    Tensor,
}

impl TensorRank {
    /// Returns the tensor rank of a field in `d` dimensions; a single number is a scalar.
    fn of(field: &StateField, d: usize) -> Self {
        match field.components {
            1 => Self::Scalar,
            n if n == d => Self::Vector,
            _ => Self::Tensor,
        }
    }
}

/// Creates a file of points, each with a vertex cell. A position (m) has `d` numbers.
pub(crate) fn points(d: usize, positions: &[f64], fields: &[(TensorRank, StateField)]) -> Vec<u8> {
    let n = positions.len() / d.max(1);
    let mut file = VtkFile::default();
    file.xml += &format!("<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\">\n<Points>\n");
    file.numbers("position", TensorRank::Vector, d, positions);
    file.xml += "</Points>\n<Cells>\n";
    let count = |first: usize| (first..first + n).flat_map(|k| (k as u64).to_le_bytes());
    file.array("connectivity", "Int64", 1, &count(0).collect::<Vec<_>>());
    file.array("offsets", "Int64", 1, &count(1).collect::<Vec<_>>());
    file.array("types", "UInt8", 1, &vec![VERTEX; n]);
    file.xml += "</Cells>\n";
    file.point_data(d, fields);
    file.written("UnstructuredGrid", "")
}

/// Pairs each field of a body with its tensor rank, which the number of components determines.
pub(crate) fn ranked(d: usize, fields: Vec<StateField>) -> Vec<(TensorRank, StateField)> {
    fields.into_iter().map(|field| (TensorRank::of(&field, d), field)).collect()
}

/// Creates a file of grid nodes with spacing `h` (m). `counts` has the number of nodes along each
/// axis, `origin` is the lowest node (m), and the first axis varies fastest.
pub(crate) fn grid(
    origin: &[f64],
    h: f64,
    counts: &[usize],
    fields: &[(TensorRank, StateField)],
) -> Vec<u8> {
    let last = |axis: usize| counts.get(axis).map_or(0, |count| count.saturating_sub(1));
    let extent = format!("0 {} 0 {} 0 {}", last(0), last(1), last(2));
    let start = |axis: usize| origin.get(axis).copied().unwrap_or(0.0);
    let (x, y, z) = (start(0), start(1), start(2));
    let place = format!(" WholeExtent=\"{extent}\" Origin=\"{x} {y} {z}\" Spacing=\"{h} {h} {h}\"");
    let mut file = VtkFile::default();
    file.xml += &format!("<Piece Extent=\"{extent}\">\n");
    file.point_data(counts.len(), fields);
    file.written("ImageData", &place)
}

/// Creates a time series. Each entry has a time (s), a part (one for each body and one for its
/// grid), and the path of a file relative to the series file.
pub(crate) fn series(files: &[(f64, usize, String)]) -> String {
    let mut xml = head("Collection", "");
    for (t, part, file) in files {
        // Writing to a string does not fail.
        let _ = writeln!(xml, "<DataSet timestep=\"{t}\" part=\"{part}\" file=\"{file}\"/>");
    }
    xml + "</Collection>\n</VTKFile>\n"
}

fn head(kind: &str, attributes: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<{kind}{attributes}>\n"
    )
}

/// The XML text of a file, and the numbers that are appended to it.
#[derive(Default)]
struct VtkFile {
    xml: String,
    appended: String,
}

impl VtkFile {
    fn point_data(&mut self, d: usize, fields: &[(TensorRank, StateField)]) {
        self.xml += "<PointData>\n";
        for (rank, field) in fields {
            self.numbers(&field.name, *rank, d, &field.numbers);
        }
        self.xml += "</PointData>\n</Piece>\n";
    }

    /// Appends numbers. Vectors are extended to three components and tensors to nine; the
    /// additional components are zero.
    fn numbers(&mut self, name: &str, rank: TensorRank, d: usize, numbers: &[f64]) {
        let (rows, deep, wide) = match rank {
            TensorRank::Scalar => (1, 1, 1),
            TensorRank::Vector => (1, 1, 3),
            TensorRank::Tensor => (d, 3, 3),
        };
        let columns = if rank == TensorRank::Scalar { 1 } else { d };
        let mut bytes = Vec::with_capacity(numbers.len() * 8);
        for entry in numbers.chunks_exact((rows * columns).max(1)) {
            for (i, j) in (0..deep).flat_map(|i| (0..wide).map(move |j| (i, j))) {
                let number = if i < rows && j < columns { entry[i * columns + j] } else { 0.0 };
                bytes.extend(number.to_le_bytes());
            }
        }
        self.array(name, "Float64", deep * wide, &bytes);
    }

    fn array(&mut self, name: &str, kind: &str, components: usize, bytes: &[u8]) {
        let offset = self.appended.len();
        let _ = writeln!(
            self.xml,
            "<DataArray Name=\"{name}\" type=\"{kind}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>"
        );
        let length = (bytes.len() as u64).to_le_bytes();
        self.appended += &base64(&[&length[..], bytes].concat());
    }

    fn written(self, kind: &str, attributes: &str) -> Vec<u8> {
        let xml = head(kind, attributes) + &self.xml;
        let tail = format!("</{kind}>\n<AppendedData encoding=\"base64\">\n_");
        let end = "\n</AppendedData>\n</VTKFile>\n";
        [xml, tail, self.appended, end.to_owned()].concat().into_bytes()
    }
}

/// Encodes bytes in base64 with padding (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let byte = |k: usize| u32::from(group.get(k).copied().unwrap_or(0));
        let number = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let digit = char::from(DIGITS[(number >> (18 - 6 * k)) as usize & 63]);
            text.push(if k <= group.len() { digit } else { '=' });
        }
    }
    text
}
