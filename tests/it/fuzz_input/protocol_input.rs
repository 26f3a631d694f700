//! Interprets bytes as the answers of a solver.

use mpm_verify::external::read_answers;

/// Reads answers until one violates the protocol. Panics if reading panics, or if there are more
/// answers than the bytes can contain.
pub(crate) fn answers(bytes: &[u8]) {
    let count = read_answers(bytes);
    assert!(count <= bytes.len(), "{count} answers in {} bytes", bytes.len());
}
