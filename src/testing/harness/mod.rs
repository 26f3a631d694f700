//! A test for each case of each suite of a folder.
//!
//! Two gates that never mix. Theory is asserted in plain Rust: no environment variable and no
//! snapshot command can accept it away. Drift is the snapshot of a report: `cargo insta review`
//! shows and accepts it.

mod drift;
mod gate;
mod slowest;
mod suite_folder;

pub use suite_folder::SuiteFolder;
