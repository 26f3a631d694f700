//! Output of a run: its length, its colours, and write errors.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, ambitious, assert_contains};
use rstest::rstest;
use std::fs;
use std::path::PathBuf;

/// Creates six suites, which are too many for full reports. The last one has an expectation that
/// fails.
fn six() -> Folder {
    let folder = Folder::new();
    for number in 1..6 {
        let suite = BAR.replace("short-bar", &format!("bar-{number}"));
        folder.write(&format!("verification/bars/bar-{number}.yaml"), suite);
    }
    folder.write("verification/proud/ambitious-bar.yaml", ambitious());
    folder
}

#[test]
fn a_run_of_many_suites_prints_a_line_for_each_and_the_failures() {
    let folder = six();
    let found = folder.call(&["run"]);
    assert_eq!((found.code, found.errors.as_str()), (FAILED, ""));
    let results = found.out.lines().filter(|line| line.starts_with("  result  ")).count();
    assert_eq!(results, 2, "two cases of one suite\n{}", found.out);
    let parts = ["  bar-1          2.01..2.02  2 pass\n", "ambitious-bar: Short bar\n", "  FAIL "];
    assert_contains(&found.out, &parts);
    let end = "\n6 suites, 12 cases: 10 pass, 2 FAIL\nnext: mpm-verify diagnose \
               verification/proud/ambitious-bar.yaml --case mpm-linear-flip-musl\n";
    assert!(found.out.ends_with(end), "{}", found.out);
    let written = folder.call(&["--out", "results"]).out;
    assert_contains(&written, &["\nwrote results\n6 suites, "]);
    let matrix = folder.call(&["run", "--overview"]).out;
    let parts = ["\n  suite                            findings by basis\nbars\n  bar-1  "];
    assert_contains(&matrix, &parts);
}

/// The commands of the last lines are valid.
#[test]
fn without_arguments_a_plot_and_the_next_commands_are_printed() {
    let folder = Folder::new();
    let out = folder.accepted(&[]);
    assert!(out.lines().count() <= 40 && out.lines().all(|line| line.chars().count() <= 100));
    assert_contains(
        &out,
        &[
            "  vibrating-bar: rms error of displacement at the end (m)\n",
            "  a  mpm-linear-flip-{musl,usl}: 1.96 [1.91, 2.01]\n",
            "14 suites, 61 cases: 46 pass, 15 known limits, 0 FAIL\nnext: mpm-verify run ",
            " mpm-verify run vibrating-bar ",
        ],
    );
    let own = six().call(&[]);
    assert_eq!(own.code, FAILED, "the suites of the project");
    assert_contains(&own.out, &["  bar-5: rms error", "6 suites, 12 cases: "]);
}

/// Longer lines would be wrapped by terminals and code reviews. The last lines are the verdict, or
/// a command that helps now.
#[rstest]
#[case(&["--help"], "`mpm-verify run --help` lists.")]
#[case(&["run", "--help"], "or have no requirement")]
#[case(&["estimate", "--help"], "Print help (see a summary with '-h')")]
#[case(&["list"], "suites, ")]
#[case(&["list", "stability"], "suites, ")]
#[case(&["check", "vibrating-bar"], "vibrating-bar")]
#[case(&["explain", "cooks-membrane"], "next: mpm-verify run cooks-membrane")]
#[case(&["explain", "order-too-low"], "restores the order")]
#[case(&["list", "--cases"], "suites, ")]
#[case(&["steps", "the-talk"], "levels: 0 with a step that differs")]
#[case(&["steps", "vibrating-bar"], "24 levels: 0 with a step that differs")]
#[case(&["run", "vibrating-bar", "steffen-bar"], "2 suites, 7 cases: ")]
#[case(&["run", "--brief", "grid-crossing*"], ", 0 FAIL")]
#[case(&["diagnose", "vibrating-bar", "--case", "usf"], "1 case diagnosed")]
#[case(&["propose", "vibrating-bar"], "# next: copy entries into `expect`")]
#[case(&["cost", "--verbose", "vibrating-bar-crossing"], "work-precision diagrams")]
fn lines_fit_in_100_columns_and_end_with_the_verdict(#[case] words: &[&str], #[case] last: &str) {
    let out = Folder::new().call(words).out;
    let wide: Vec<&str> = out.lines().filter(|line| line.chars().count() > 100).collect();
    assert!(wide.is_empty(), "{}", wide.join("\n"));
    let lines: Vec<&str> = out.lines().filter(|line| !line.is_empty()).collect();
    let end = lines[lines.len().saturating_sub(2)..].join(" ");
    assert!(end.contains(last), "{end}");
}

#[test]
fn lines_of_snapshots_fit_in_100_columns() {
    let groups = fs::read_dir("verification").expect("the suites").flatten();
    let in_group = |path: PathBuf| fs::read_dir(path).into_iter().flatten().flatten();
    let files = groups.flat_map(|group| in_group(group.path())).map(|file| file.path());
    let snapshots: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|end| end == "snap")).collect();
    assert!(snapshots.len() > 200, "{} snapshots", snapshots.len());
    for path in snapshots {
        let text = fs::read_to_string(&path).expect("text");
        let wide = text.lines().find(|line| line.chars().count() > 100);
        assert_eq!(wide, None, "{}", path.display());
    }
}

#[test]
fn reports_are_printed_for_few_named_suites_or_on_request() {
    let folder = six();
    let reports = |words: &[&str]| {
        let out = folder.call(words).out;
        out.lines().filter(|line| line.starts_with("  source  ")).count()
    };
    assert_eq!(reports(&["--reports"]), 6);
    assert_eq!(reports(&["bar-1", "bar-2"]), 2);
    assert_eq!(reports(&["bars"]), 5);
    assert_eq!(reports(&["bars", "ambitious-bar"]), 0);
    assert_eq!(reports(&["--brief"]), 0);
}

#[test]
fn quiet_run_prints_only_unexpected_results() {
    let folder = six();
    let found = folder.call(&["run", "--quiet", "bars"]);
    assert_eq!((found.code, found.out.as_str(), found.errors.as_str()), (SOUND, "", ""));
    let found = folder.call(&["-q"]).ended(FAILED);
    assert!(found.out.starts_with("ambitious-bar: Short bar\n\n  result "), "{}", found.out);
    assert!(!found.out.contains("bar-1"), "{}", found.out);
    let checked = folder.call(&["check", "-q"]);
    assert_eq!((checked.code, checked.out.as_str(), checked.errors.as_str()), (SOUND, "", ""));
}

#[rstest]
#[case::pattern("bar-*", 5)]
#[case::pattern_of_the_end("*-bar", 1)]
#[case::group("bars", 5)]
#[case::pattern_in_a_group("proud/*", 1)]
#[case::name("bar-3", 1)]
fn suites_are_selected_by_pattern_and_group(#[case] target: &str, #[case] count: usize) {
    let found = six().call(&["check", target]);
    assert_eq!((found.code, found.out.lines().count()), (SOUND, count), "{}", found.out);
}

#[test]
fn pattern_without_a_match_is_an_error() {
    let errors = six().refused(&["check", "bear-*"]);
    insta::assert_snapshot!(errors, @"
    error: no suite matches `bear-*`
    --> bear-*
     = help: `*` stands for any text: `mms-*`, `heat/*`
    1 error
    ");
}

#[test]
fn groups_and_patterns_select_built_in_suites_without_a_folder() {
    let folder = Folder::new();
    let group = folder.call(&["list", "the-talk"]);
    assert!(group.code == SOUND && group.out.contains("\nvibrating-bar: "), "{}", group.out);
    let fitting = folder.call(&["list", "heat-m*"]);
    assert!(fitting.code == SOUND && fitting.out.starts_with("heat-mms: "), "{}", fitting.out);
}

#[rstest]
#[case(&["run", "-"], "  fem-linear-lumped  ")]
#[case(&["-"], "  fem-linear-lumped  ")]
#[case(&["check", "-"], "short-bar: sound, 2 cases")]
#[case(&["explain", "-"], "short-bar: Short bar")]
#[case(&["propose", "-"], "# short-bar")]
#[case(&["problem", "-"], "\n")]
fn suite_is_read_from_standard_input(#[case] arguments: &[&str], #[case] words: &str) {
    let found = Folder::new().call_with_input(arguments, BAR).ended(SOUND);
    assert_contains(&found.out, &[words]);
}

#[test]
fn standard_input_has_a_name_and_a_limit() {
    let check =
        |input: &str| Folder::new().call_with_input(&["check", "-"], input).ended(BAD_INPUT).errors;
    let errors = check(&super::mistaken());
    assert!(errors.starts_with("error: unknown key `dimensions`\n --> <stdin>:9:3\n"), "{errors}");
    // The input is short enough for a pipe whose reader stops early.
    insta::assert_snapshot!(check(&"a".repeat(65 * 1024)), @"
    error: the file is too large: at most 64 KiB
    --> <stdin>
    1 error
    ");
}

#[test]
fn colours_are_for_terminals_or_on_request() {
    let folder = Folder::with("bar.yaml", ambitious());
    let escape = |answer: &crate::common::folder::Answer| {
        (answer.out.contains('\u{1b}'), answer.errors.contains('\u{1b}'))
    };
    let words = ["run", "bar.yaml", "odometer"];
    assert_eq!(escape(&folder.call(&words)), (false, false));
    let painted = folder.call(&[&words[..], &["--color", "always", "--out", "results"]].concat());
    assert_eq!(escape(&painted), (true, true));
    assert_contains(&painted.out, &["\u{1b}[31mFAIL"]);
    for file in folder.files("results") {
        assert!(!folder.read(&format!("results/{file}")).contains('\u{1b}'), "{file}");
    }
    assert_eq!(escape(&folder.call(&["--color=never", "run", "bar.yaml"])), (false, false));
    assert_eq!(folder.call(&["--color", "blue"]).code, BAD_INPUT);
}

/// `/dev/full` refuses every byte.
#[cfg(target_os = "linux")]
#[test]
fn unwritable_output_is_an_error() {
    let calls = "--help|--version|run bar.yaml|run --format json bar.yaml|man|completions fish|\
                 merge --from . bar.yaml|new another|list bar.yaml|check bar.yaml|steps bar.yaml|\
                 explain bar.yaml|propose bar.yaml|diagnose bar.yaml --case mpm --budget 1s|\
                 schema protocol|problem bar.yaml|cost bar.yaml|compare report.json report.json";
    let folder = Folder::with("bar.yaml", BAR);
    folder.write("report.json", r#"{"suites": []}"#);
    for call in calls.split('|') {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("a device");
        let mut command = folder.command(&call.split(' ').collect::<Vec<_>>());
        let output = command.stdout(full).output().expect("the program starts");
        let errors = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(BAD_INPUT), "{call}: {errors}");
        let message = "error: standard output cannot be written: No space left on device";
        assert_contains(&errors, &[message]);
    }
}

#[rstest]
#[case("completions bash", &["complete -F _mpm", "diagnose", "propose", "completions"])]
#[case("completions zsh", &["#compdef mpm-verify", "diagnose", "propose", "completions"])]
#[case("completions fish", &["complete -c mpm-verify", "diagnose", "propose", "completions"])]
#[case("man", &[".TH mpm-verify 1", "mpm\\-verify\\-diagnose(1)"])]
#[case("man run", &[".TH mpm-verify-run 1", "resume"])]
fn completions_and_manual_pages_have_the_commands(#[case] call: &str, #[case] words: &[&str]) {
    let folder = Folder::new();
    assert_contains(&folder.accepted(&call.split(' ').collect::<Vec<_>>()), words);
    assert_eq!(folder.call(&["man", "rnu"]).code, BAD_INPUT);
}
