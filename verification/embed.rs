//! Build script: embeds every suite beside it, so that an installed binary needs no checkout.

use std::{
    env,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

fn main() {
    let folder = path("CARGO_MANIFEST_DIR").join("verification");
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut rows = String::new();
    for name in suites(&folder) {
        let file = folder.join(&name);
        let file = file.to_str().expect("the path of the checkout is valid UTF-8");
        writeln!(rows, "    ({name:?}, include_str!({file:?})),").expect("a String takes any text");
    }
    fs::write(path("OUT_DIR").join("suites.rs"), format!("&[\n{rows}]\n"))
        .expect("the output folder is writable");
}

/// File names of the suites in `folder`, sorted.
fn suites(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder of suites is part of the crate")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| Path::new(name).extension().is_some_and(|end| end == "yaml"))
        .collect();
    names.sort();
    names
}

/// The path that cargo gives in the environment variable `name`.
fn path(name: &str) -> PathBuf {
    PathBuf::from(env::var_os(name).expect("cargo sets it"))
}
