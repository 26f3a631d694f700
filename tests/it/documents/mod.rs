//! Checks the documents with the program: it must parse the command lines and load the suites.
//! (`tests/architecture` checks paths, names and JSON.)

mod dispersion;
mod figures;
#[path = "../../architecture/markdown.rs"]
#[allow(dead_code, reason = "links and headings are checked by tests/architecture")]
mod markdown;
mod methods;
#[cfg(unix)]
mod tour;

use crate::common::valid_suite;
use markdown::Document;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Returns every document of the repository.
fn documents() -> Vec<Document> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut documents = Vec::new();
    read(root, root, &mut documents);
    documents
}

/// Adds the documents below a folder, except build output.
fn read(root: &Path, folder: &Path, documents: &mut Vec<Document>) {
    for entry in fs::read_dir(folder).expect("a folder of documents") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            read(root, &path, documents);
        } else if path.extension().is_some_and(|end| end == "md") {
            let text = fs::read_to_string(&path).expect("a readable document");
            let file = path.strip_prefix(root).unwrap_or(&path).display().to_string();
            documents.push(Document::new(&file, &text));
        }
    }
}

/// Returns the arguments of the program in a line, up to the end of the command. Single quotes
/// group text with spaces.
fn arguments(line: &str) -> Option<Vec<&str>> {
    let call = line.split(['#', '>', '|']).next().unwrap_or_default();
    let mut is_quoted = false;
    let words = call.split(|sign: char| {
        is_quoted ^= sign == '\'';
        sign == '\'' || (!is_quoted && sign.is_whitespace())
    });
    let mut words = words.filter(|word| !word.is_empty()).peekable();
    match words.next()? {
        "mpm-verify" => {}
        "cargo" if words.peek() == Some(&"run") => {
            words.find(|word| *word == "--")?;
        }
        _ => return None,
    }
    Some(words.collect())
}

/// Parses the arguments of a line, with `--help` at the end, which prints the help of the
/// subcommand. The program parses arguments in order, so it reaches `--help` only if all others are
/// valid. Nothing runs.
fn understood(arguments: &[&str]) -> Result<(), String> {
    let program = Command::new(env!("CARGO_BIN_EXE_mpm-verify"))
        .args(arguments)
        .arg("--help")
        .output()
        .expect("the program starts");
    let help = String::from_utf8_lossy(&program.stdout);
    let usage = help.lines().find_map(|line| line.strip_prefix("Usage: ")).unwrap_or_default();
    let of = usage.split(' ').nth(1).unwrap_or_default();
    let wanted = arguments.first().filter(|first| !first.starts_with('-'));
    let answered = !usage.is_empty() && wanted.is_none_or(|subcommand| of == *subcommand);
    let errors = String::from_utf8_lossy(&program.stderr);
    if program.status.success() && answered { Ok(()) } else { Err(format!("{usage}\n{errors}")) }
}

#[test]
fn every_command_line_in_documents_is_valid() {
    let mut count = 0;
    for document in documents() {
        let shell = document.blocks.iter().filter(|b| matches!(&*b.language, "console" | "sh"));
        let lines = shell.flat_map(|block| block.text.lines().map(str::to_owned));
        let spans = document.code_spans().into_iter().map(|span| span.text);
        for line in lines.chain(spans) {
            let Some(arguments) = arguments(&line) else { continue };
            let understood = understood(&arguments);
            assert!(understood.is_ok(), "{}: `{line}`\n{understood:?}", document.file);
            count += 1;
        }
    }
    assert!(count > 10, "documents show {count} command lines: are they still found?");
}

#[test]
fn quoted_arguments_are_not_split() {
    let words = arguments("mpm-verify run a.yaml --solver 'python3 b.py --flip 1'  # slow");
    assert_eq!(words, Some(vec!["run", "a.yaml", "--solver", "python3 b.py --flip 1"]));
}

#[test]
fn invalid_command_line_is_detected() {
    for line in [
        "mpm-verify rnu",
        "mpm-verify run --formta json",
        "cargo run --release -- run --format jsn   # as JSON",
        "mpm-verify compare --tolerance x old.json new.json",
    ] {
        let arguments = arguments(line).expect("a call of the program");
        assert!(understood(&arguments).is_err(), "`{line}` has a mistake");
    }
}

/// Replaces the table `name` in a page.
fn with_table(page: &str, name: &str, table: &str) -> String {
    let begin = format!("<!-- {name} -->\n");
    let (before, rest) = page.split_once(&begin).expect("a place for the table");
    let (_, after) = rest.split_once("<!-- end -->").expect("the end of the table");
    format!("{before}{begin}{table}\n<!-- end -->{after}")
}

/// Returns the suites that documents show completely, with their positions.
fn whole_suites() -> Vec<(String, String)> {
    let suites = documents().into_iter().flat_map(|document| {
        let whole = document.blocks.into_iter().filter(|block| {
            block.language == "yaml" && block.text.lines().any(|line| line.starts_with("suite:"))
        });
        whole.map(move |block| (format!("{}:{}", document.file, block.line), block.text))
    });
    suites.collect()
}

#[test]
fn complete_suites_in_documents_load() {
    for (place, text) in whole_suites() {
        let loaded = Source::from_text(&*place, &*text).and_then(|source| Suite::load(&source));
        assert!(loaded.is_ok(), "{place}\n{}", loaded.unwrap_err());
    }
}

#[test]
fn first_suites_in_documents_pass() {
    let pages =
        ["README.md", "docs/writing-a-suite.md", "docs/stability.md", "docs/grammar/truth.md"];
    for page in pages {
        let shown = whole_suites().into_iter().find(|(place, _)| place.starts_with(page));
        let (place, text) = shown.unwrap_or_else(|| panic!("{page} shows no whole suite"));
        assert!(
            Runner::new(&valid_suite(&text)).run(&|| ()).passed(),
            "{place}: not as it expects"
        );
    }
}

/// The document must show the adapter that is compiled and run, not a similar one.
#[test]
fn adapter_on_the_library_page_is_the_example() {
    let page = include_str!("../../../docs/library.md");
    let adapter = include_str!("../../../examples/own_solver/subject.rs");
    assert!(page.contains(&format!("```rust\n{adapter}```")), "examples/own_solver/subject.rs");
}

#[test]
fn the_front_page_of_the_crate_shows_the_suite_of_the_readme() {
    let suites = whole_suites();
    let (_, suite) = suites.iter().find(|(place, _)| place.starts_with("README.md")).unwrap();
    let commented: Vec<String> = suite.lines().map(|line| format!("//! {line}\n")).collect();
    let commented = commented.concat();
    assert!(include_str!("../../../src/lib.rs").contains(&commented), "src/lib.rs:\n{commented}");
}
