//! The exercises, `docs/exercises/FAMILY.md`: pages that add one member to a family.
//!
//! Each member is a file of `tests/exercises`, which the tests of its family compile. A page shows
//! it in a block of Rust after a line `File: tests/exercises/NAME.rs`.

use crate::markdown::Document;
use crate::source;
use std::collections::BTreeSet;
use std::fs;

/// Folder of the compiled members.
const FOLDER: &str = "tests/exercises";

/// Reports members whose page differs from the file, and members without a page.
pub(crate) fn stale(pages: &[Document]) -> Vec<String> {
    let mut shown = BTreeSet::new();
    let mut stale = Vec::new();
    for page in pages {
        for block in page.blocks.iter().filter(|block| block.language == "rust") {
            let Some(file) = block.before.strip_prefix("File: ") else { continue };
            let compiled = fs::read_to_string(source::root().join(file)).unwrap_or_default();
            if compiled != block.text {
                stale.push(format!("{}:{}: {file} differs", page.file, block.line));
            }
            shown.insert(file.to_owned());
        }
    }
    let members = source::paths(FOLDER).into_iter().filter(|file| !shown.contains(file));
    stale.extend(members.map(|file| format!("no page shows {file}")));
    stale
}
