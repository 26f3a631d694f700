//! The exercises, `docs/exercises/FAMILY.md`: pages that add one member to a family.
//!
//! A page holds every change, so that it can be applied: a line `File: path` and below it a fenced
//! block, either the whole text of a new file or a diff of a present one. A line `@@` parts hunks; the
//! context and the removed lines of a hunk stand in the file exactly once.

use crate::markdown::{Block, Document};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A page, and most files of `src/` that an addition to its family may touch.
pub(crate) const PAGES: &[(&str, usize)] =
    &[("basis", 2), ("transfer", 2), ("material", 3), ("effect", 3), ("quantity", 3)];

/// One block of a page.
#[derive(Debug)]
pub(crate) struct Change {
    pub(crate) file: String,
    /// Where the block stands on the page.
    line: usize,
    edit: Edit,
}

#[derive(Debug)]
enum Edit {
    New(String),
    Hunks(Vec<Hunk>),
}

/// Lines as they are and as they shall be.
#[derive(Debug, Default)]
struct Hunk {
    old: String,
    new: String,
    added: usize,
}

/// The changes of a page; an error is a block that says neither.
pub(crate) fn changes(page: &Document) -> Result<Vec<Change>, String> {
    let named = page.blocks.iter().filter_map(|block| {
        let file = block.before.strip_prefix("File: ")?.trim().trim_matches('`');
        Some(change(file, block).map_err(|what| format!("{}:{}: {what}", page.file, block.line)))
    });
    named.collect()
}

fn change(file: &str, block: &Block) -> Result<Change, String> {
    let edit = match block.language.as_str() {
        "rust" | "yaml" => Edit::New(block.text.clone()),
        "diff" => Edit::Hunks(hunks(&block.text)?),
        other => return Err(format!("`{other}` is no block of an exercise")),
    };
    Ok(Change { file: file.to_owned(), line: block.line, edit })
}

fn hunks(text: &str) -> Result<Vec<Hunk>, String> {
    let mut hunks = vec![Hunk::default()];
    for line in text.lines() {
        if line.starts_with("@@") {
            hunks.push(Hunk::default());
            continue;
        }
        let hunk = hunks.last_mut().expect("at least one hunk");
        let (mark, rest) = line.split_at(line.len().min(1));
        let rest = format!("{rest}\n");
        match mark {
            "+" => {
                hunk.new += &rest;
                hunk.added += 1;
            }
            "-" => hunk.old += &rest,
            " " | "" => {
                hunk.old += &rest;
                hunk.new += &rest;
            }
            _ => return Err(format!("`{line}` is no line of a diff")),
        }
    }
    hunks.retain(|hunk| !hunk.old.is_empty());
    Ok(hunks)
}

impl Change {
    fn is_in_src(&self) -> bool {
        self.file.starts_with("src/")
    }

    /// Lines that the diff of a present file adds: those of registration.
    fn registered(&self) -> usize {
        match &self.edit {
            Edit::New(_) => 0,
            Edit::Hunks(hunks) => hunks.iter().map(|hunk| hunk.added).sum(),
        }
    }

    /// The text of the file when the change is made; `present` is none if there is no such file.
    /// Whoever has made it already may make it again.
    fn applied(&self, present: Option<String>) -> Result<String, String> {
        let wrong = |what: &str| Err(format!("line {}: {} {what}", self.line, self.file));
        match (&self.edit, present) {
            (Edit::New(text), None) => Ok(text.clone()),
            (Edit::New(text), Some(present)) if *text == present => Ok(present),
            (Edit::New(_), Some(_)) => wrong("is to be new and is there already"),
            (Edit::Hunks(_), None) => wrong("is to be changed and is not there"),
            (Edit::Hunks(hunks), Some(present)) => {
                let mut text = format!("\n{present}");
                for hunk in hunks {
                    let [old, new] = [format!("\n{}", hunk.old), format!("\n{}", hunk.new)];
                    let done = text.matches(&new).count();
                    match text.matches(&old).count() {
                        1 => text = text.replacen(&old, &new, 1),
                        0 if done == 1 => {}
                        0 => return wrong(&format!("does not have these lines:{old}")),
                        n => return wrong(&format!("has these lines {n} times:{old}")),
                    }
                }
                Ok(text.split_off(1))
            }
        }
    }
}

/// Files of `src/` that the changes touch, and lines that they add to those that are there.
pub(crate) fn counted(changes: &[Change]) -> (usize, usize) {
    let ours = changes.iter().filter(|change| change.is_in_src());
    let files: BTreeSet<&str> = ours.clone().map(|change| change.file.as_str()).collect();
    (files.len(), ours.map(Change::registered).sum())
}

/// Names of the suites that the page adds.
pub(crate) fn suites(changes: &[Change]) -> Vec<&str> {
    let files = changes.iter().filter(|change| change.file.starts_with("verification/"));
    let names = files.filter_map(|change| change.file.strip_suffix(".yaml")?.rsplit('/').next());
    names.collect()
}

/// Makes the changes in the copy of the repository at `root`, in their order.
pub(crate) fn apply(changes: &[Change], root: &Path) -> Result<(), String> {
    for change in changes {
        let path = root.join(&change.file);
        let text = change.applied(fs::read_to_string(&path).ok())?;
        fs::write(&path, text).map_err(|error| format!("{}: {error}", change.file))?;
    }
    Ok(())
}

/// Whether what `tests/exercises` compiles is what the page adds: a file there has the name of the
/// file that the page puts into `src/`.
pub(crate) fn compiled(changes: &[Change], root: &Path) -> Result<(), String> {
    for change in changes.iter().filter(|change| change.is_in_src()) {
        let name = change.file.rsplit('/').next().unwrap_or_default();
        let Edit::New(text) = &change.edit else { continue };
        let compiled = fs::read_to_string(root.join("tests/exercises").join(name));
        if compiled.is_ok_and(|compiled| compiled != *text) {
            return Err(format!("line {}: tests/exercises/{name} differs", change.line));
        }
    }
    Ok(())
}

/// Whether the changes can be made in the present sources.
pub(crate) fn check(changes: &[Change], root: &Path) -> Result<(), String> {
    let mut texts = BTreeMap::new();
    for change in changes {
        let read = || fs::read_to_string(root.join(&change.file)).ok();
        let present = texts.remove(&change.file).or_else(read);
        texts.insert(change.file.clone(), change.applied(present)?);
    }
    Ok(())
}
