//! Results and checkpoints kept on disk, so that an interrupted run goes on.

pub(crate) mod checkpoints;
pub(crate) mod log;
pub(crate) mod results;

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Writes a file whole or not at all, also if the machine stops: under the name `unfinished` first,
/// which becomes `path` once the bytes are on the disk.
fn write_whole(path: &Path, unfinished: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(unfinished)?;
    file.write_all(bytes)?;
    file.sync_data()?;
    fs::rename(unfinished, path)
}
