//! The exercises, `docs/exercises/FAMILY.md`: pages that add one member to a family.
//!
//! Each member is a file of `tests/exercises`, which the tests of its family compile. A page shows
//! it in a block of Rust after a line `File: tests/exercises/NAME.rs`, says where a permanent
//! member `belongs in`, and shows the lines of registration after `In` and the name of a file.

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

/// Maximum number of source files that a new member of each family adds or changes.
const MOST_FILES: [(&str, usize); 6] =
    [("basis", 2), ("transfer", 2), ("material", 5), ("effect", 6), ("quantity", 2), ("figure", 1)];

/// Places in the sources that a page adds a file to, or changes.
fn places(page: &Document) -> BTreeSet<String> {
    let prose = page.prose();
    let after = |start: &'static str| prose.split(start).skip(1);
    let named =
        after("belongs in `").chain(after("In `")).filter_map(|text| text.split('`').next());
    named
        .filter(|place| place.starts_with("src/") || place.starts_with("crates/"))
        .map(str::to_owned)
        .collect()
}

/// Reports families without a page, places that do not exist, and pages whose member touches more
/// files than its family allows.
pub(crate) fn touching_too_much(pages: &[Document]) -> Vec<String> {
    let mut wrong = Vec::new();
    for (family, most) in MOST_FILES {
        let file = format!("docs/exercises/{family}.md");
        let Some(page) = pages.iter().find(|page| page.file == file) else {
            wrong.push(format!("{file} is missing"));
            continue;
        };
        let places = places(page);
        let missing = places.iter().filter(|place| !source::root().join(place).exists());
        wrong.extend(missing.map(|place| format!("{file}: there is no {place}")));
        if !(1..=most).contains(&places.len()) {
            let list: Vec<&str> = places.iter().map(String::as_str).collect();
            let count = places.len();
            wrong.push(format!("{file}: {count} files, not 1 to {most}: {}", list.join(", ")));
        }
    }
    wrong
}
