//! Checks the drawings in documents that can be created quickly; `ci/check` compares the other.

use super::whole_suites;
use crate::common::folder::Folder;
use std::path::{Path, PathBuf};

/// A drawing, and the suite whose run creates it: a suite of the repository, or the suite on a
/// page.
const FIGURES: [(&str, &str); 2] =
    [("vibrating-bar.svg", "vibrating-bar"), ("courant-limit-of-one.svg", "docs/stability.md")];

/// Returns the drawings of runs, with their paths.
fn drawn() -> Vec<(PathBuf, String)> {
    let (folder, root) = (Folder::new(), Path::new(env!("CARGO_MANIFEST_DIR")));
    let shown = whole_suites();
    let draw = |(figure, suite): (&str, &str)| {
        let on_page = shown.iter().find(|(place, _)| place.starts_with(suite));
        let file = on_page.map(|(_, text)| folder.write("shown.yaml", text).display().to_string());
        let suite = file.as_deref().unwrap_or(suite);
        folder.call(&["run", suite, "--brief", "--out", "results"]).ended(0);
        (root.join("docs/figures").join(figure), folder.read(&format!("results/{figure}")))
    };
    FIGURES.map(draw).into()
}

#[test]
fn figures_are_up_to_date() {
    for (path, drawn) in drawn() {
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(kept == drawn, "{} is stale: run ci/pages", path.display());
    }
}

#[test]
#[ignore = "ci/pages runs it"]
fn figures_are_written() {
    for (path, drawn) in drawn() {
        std::fs::write(path, drawn).expect("a figure is written");
    }
}
