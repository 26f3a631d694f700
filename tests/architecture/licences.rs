//! Licences of the crates that a build takes in.

use serde_json::Value;
use std::process::Command;

/// Licences that only require attribution.
const KNOWN: [&str; 13] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "0BSD",
];

/// Name and licence of every crate for the platform that this runs on.
pub(crate) fn of_dependencies() -> Vec<(String, String)> {
    let text = |command: &mut Command| {
        let output = command.output().expect("the tool that builds this is here");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let version = text(Command::new("rustc").arg("-vV"));
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).expect("a platform");
    let words = ["metadata", "--format-version", "1", "--locked", "--offline"];
    let metadata = text(
        Command::new(env!("CARGO"))
            .args(words)
            .args(["--filter-platform", host])
            .current_dir(env!("CARGO_MANIFEST_DIR")),
    );
    let metadata: Value = serde_json::from_str(&metadata).expect("JSON");
    let word = |package: &Value, key: &str| package[key].as_str().unwrap_or_default().to_owned();
    let packages = metadata["packages"].as_array().expect("packages").iter();
    packages.map(|package| (word(package, "name"), word(package, "license"))).collect()
}

/// Whether one of the alternatives of a licence expression is made of known ones only.
pub(crate) fn is_known(expression: &str) -> bool {
    let plain = |part: &str| {
        let part = part.trim().trim_matches(['(', ')']);
        KNOWN.contains(&part)
    };
    let every = |text: &str| text.split(" AND ").flat_map(|part| part.split(" OR ")).all(plain);
    let expression = expression.replace('/', " OR ");
    every(&expression) || (!expression.contains('(') && expression.split(" OR ").any(every))
}
