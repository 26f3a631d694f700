//! Build script: embeds every suite of the folders beside it, so that an installed binary needs no checkout.

use std::{
    collections::BTreeMap,
    env,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

fn main() {
    let package = path("CARGO_MANIFEST_DIR");
    let root = package.ancestors().find(|folder| folder.join("verification/embed.rs").is_file());
    let root = root.expect("the package is in the repository");
    println!("cargo:rerun-if-changed={}", root.join("verification").display());
    let mut rows = String::new();
    for (name, path) in suites(root) {
        let file = root.join(&path);
        let file = file.to_str().expect("the path of the checkout is valid UTF-8");
        writeln!(rows, "    ({name:?}, {path:?}, include_str!({file:?})),")
            .expect("a String takes any text");
    }
    fs::write(self::path("OUT_DIR").join("suites.rs"), format!("&[\n{rows}]\n"))
        .expect("the output folder is writable");
}

/// Names and paths, from the root, of the suites of every folder of `verification/`, by name.
fn suites(root: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for folder in names(&root.join("verification")).filter(|name| !name.contains('.')) {
        for file in names(&root.join("verification").join(&folder)) {
            if let Some(name) = file.strip_suffix(".yaml") {
                let path = format!("verification/{folder}/{file}");
                let other = found.insert(name.to_owned(), path);
                assert_eq!(other, None, "two suites are called {name}");
            }
        }
    }
    found
}

/// Names of what a folder holds.
fn names(folder: &Path) -> impl Iterator<Item = String> {
    let entries = fs::read_dir(folder).expect("the folder of suites is part of the crate");
    entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok())
}

/// The path that cargo gives in the environment variable `name`.
fn path(name: &str) -> PathBuf {
    PathBuf::from(env::var_os(name).expect("cargo sets it"))
}
