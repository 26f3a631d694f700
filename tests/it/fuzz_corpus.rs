//! Runs the corpora of the fuzzer in `tests/fuzz/corpus`, except that of steps. They contain
//! inputs that reach new code or failed in the past.

#[path = "fuzz_input/compare_input.rs"]
mod compare_input;
#[path = "fuzz_input/formula_input.rs"]
mod formula_input;
#[path = "fuzz_input/protocol_input.rs"]
mod protocol_input;
#[path = "fuzz_input/suite_input.rs"]
mod suite_input;

use rstest::rstest;

#[rstest]
#[case::formulas("formula", formula_input::evaluate)]
#[case::documents("compare", compare_input::differences)]
#[case::suites("suite", suite_input::load)]
#[case::answers("protocol", protocol_input::answers)]
fn fuzzer_corpus_is_parsed_or_refused(#[case] name: &str, #[case] read: fn(&[u8])) {
    let folder = format!("{}/tests/fuzz/corpus/{name}", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).expect("a corpus").map(|entry| entry.expect("an entry"));
    let count = files.map(|file| read(&std::fs::read(file.path()).expect("a file"))).count();
    assert!(count >= 5, "{count} files");
}
