//! Several solvers in one report: names, cases, gates, and duplicate names.

use super::bar;
use super::program::solver_of;
use crate::cli::{FAILED, Folder, SOUND, assert_refusals};
use crate::common::folder::assert_contains;
use rstest::{fixture, rstest};
use serde_json::Value;

/// Creates a folder with a suite and two solvers, whose errors differ by a factor.
#[fixture]
fn folder() -> Folder {
    let folder = Folder::with("bar.yaml", bar());
    folder.write("one.sh", solver_of("h * h"));
    folder.write("two.sh", solver_of("2 * h * h"));
    folder
}

const BOTH: [&str; 4] = ["--solver", "first=sh one.sh", "--solver", "second=sh two.sh"];

#[rstest]
fn solvers_and_methods_are_cases_of_one_suite(folder: Folder) {
    let run = ["run", "bar.yaml", "--with-methods", "--format", "json"];
    let document = folder.call(&[&run[..], &BOTH].concat()).ended(SOUND).json();
    let suites = document["suites"].as_array().unwrap();
    assert_eq!(suites.len(), 1);
    let cases = suites[0]["cases"].as_array().unwrap();
    let names: Vec<&str> = cases.iter().filter_map(|case| case["case"].as_str()).collect();
    assert_eq!(names, ["mpm-linear-flip-musl", "fem-linear-lumped", "first", "second"]);
    let error = |case: usize| cases[case]["levels"][0]["judged"].as_f64().unwrap();
    assert!((error(3) / error(2) - 2.0).abs() <= 1e-3, "{} {}", error(3), error(2));
    // External solvers count no transfers, so the ranking by transfers contains the methods only.
    assert_eq!(suites[0]["cost"][0]["methods"].as_array().map(Vec::len), Some(2));
}

#[rstest]
fn a_report_shows_no_transfers_of_solvers_that_count_none(folder: Folder) {
    let answer = folder
        .call(&["run", "bar.yaml", "--with-methods", "--solver", "mine=sh one.sh"])
        .ended(SOUND);
    let (_, finest) = answer.out.split_once("on the finest level").expect("a table");
    let row = |name: &str| -> Vec<&str> {
        let line = finest.lines().find(|line| line.trim_start().starts_with(name));
        line.expect("a row").split("  ").filter(|cell| !cell.is_empty()).map(str::trim).collect()
    };
    let column = row("case").iter().position(|cell| *cell == "transfers").expect("a column");
    assert_eq!(row("mine")[column], "-");
    assert!(row("fem-linear-lumped")[column].parse::<u64>().is_ok_and(|count| count > 0));
}

#[rstest]
fn one_ranking_by_seconds_has_methods_and_solvers(folder: Folder) {
    let cost = ["cost", "bar.yaml", "--with-methods", "--format", "json"];
    let document = folder.call(&[&cost[..], &BOTH].concat()).ended(SOUND).json();
    let suite = &document["suites"][0];
    let names = |list: &Value| -> Vec<String> {
        let names = list.as_array().into_iter().flatten().map(|one| one["case"].as_str());
        names.flatten().map(str::to_owned).collect()
    };
    let all = ["fem-linear-lumped", "first", "mpm-linear-flip-musl", "second"];
    let mut ranked = names(&suite["cost"][0]["methods"]);
    ranked.sort();
    assert_eq!(ranked, all);
    assert_eq!(suite["cost"][0]["work"], "seconds");
    for case in suite["cases"].as_array().unwrap() {
        let levels = case["levels"].as_array().unwrap();
        assert_eq!(levels.len(), 4, "{case}");
        for level in levels {
            assert!(level["seconds"]["median"].as_f64() > Some(0.0), "{case}");
        }
    }
}

/// The first solver passes the suite and the second one fails, so the next suite does not start.
#[rstest]
fn fail_fast_ends_the_run_if_one_of_two_solvers_fails(folder: Folder) {
    folder.write("low.sh", solver_of("h"));
    folder.write("next.yaml", bar().replace("short-bar", "next-bar"));
    let run = ["run", "bar.yaml", "next.yaml", "--gate", "--fail-fast", "--jobs", "1", "--brief"];
    let solvers = ["--solver", "first=sh one.sh", "--solver", "second=sh low.sh"];
    let found = folder.call(&[&run[..], &solvers].concat()).ended(FAILED);
    assert_contains(&found.errors, &["so 1 suite did not start (--fail-fast)"]);
}

#[rstest]
fn each_solver_has_its_own_gate(folder: Folder) {
    let gate = ["run", "bar.yaml", "--gate", "--brief", "--solver"];
    folder.write("low.sh", solver_of("h"));
    let both = |second: &'static str| {
        folder.call(&[&gate[..], &["first=sh one.sh", "--solver", second]].concat())
    };
    assert_eq!(both("second=sh two.sh").code, SOUND);
    // The name also selects cases.
    let one = ["second=sh two.sh", "--case", "second"];
    let one = folder.call(&[&gate[..], &["first=sh one.sh", "--solver"], &one].concat()).out;
    assert!(!one.contains("first") && one.contains("::second"), "{one}");
    let answer = both("low=sh low.sh");
    let lines = answer.out.lines().filter(|line| line.contains("  short-bar::"));
    let results: Vec<String> =
        lines.map(|line| line.split_whitespace().take(2).collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(results, ["pass short-bar::first", "FAIL short-bar::low"]);
}

#[rstest]
fn equal_names_are_refused(folder: Folder) {
    let of_both = "
$ run bar.yaml --solver 'a=sh one.sh' --solver 'sh two.sh'
error: --solver sh two.sh: several solvers need a name each: `NAME=COMMAND`
$ run bar.yaml --solver 'a=sh one.sh' --solver 'a=sh two.sh'
error: --solver a: another solver has this name
$ run bar.yaml --with-methods --solver 'fem-linear-lumped=sh one.sh'
error: --solver fem-linear-lumped: a case of the suite `short-bar` has this name
$ run bar.yaml --solver a=
error: invalid value 'a=' for '--solver <[NAME=]COMMAND>': expected a command after `=`
$ run bar.yaml --with-methods
error: the following required arguments were not provided:
  --solver <[NAME=]COMMAND>
Usage: mpm-verify run --solver <[NAME=]COMMAND> --with-methods <SUITE>...
";
    assert_refusals(&folder, of_both);
    assert_refusals(&folder, &of_both.replace(" run ", " cost "));
    let of_run = "
$ run bar.yaml --with-methods --shard 1/2 --solver 'a=sh one.sh'
error: --shard: shards are supported for one solver, or for the built-in methods
";
    assert_refusals(&folder, of_run);
}
