//! Bytes as the answers of a solver.

use mpm_verify::external::read_answers;

/// Reads answers until one breaks the protocol; panics where that does, and where more are found
/// than the bytes can hold.
pub(crate) fn answers(bytes: &[u8]) {
    let count = read_answers(bytes);
    assert!(count <= bytes.len(), "{count} answers in {} bytes", bytes.len());
}
