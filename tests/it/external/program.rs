//! A correct solver in a shell script.

use super::bar;
use crate::cli::{FAILED, Folder, SOUND};
use crate::common::folder::{assert_contains, flat};

/// First message of a solver of one-dimensional elasticity.
pub(crate) const HELLO: &str = r#"{"type":"hello","protocol":1,"name":"odd","version":"1","capabilities":{"dimensions":[1],"laws":["linear_elastic"],"conditions":["free","fixed"]}}"#;

/// A solver whose result is the exact solution of the bar with a relative error of h^2: it has
/// order 2 and runs no steps. The error is a formula in `h` (m) and the time step `d` (s).
pub(super) const SECOND_ORDER: &str = r#"
read -r m; echo 'HELLO'
read -r problem || exit 0
case "$problem" in *'"bye"'*) exit 0;; esac
echo '{"type":"ready"}'
while read -r m; do
    case "$m" in *'"bye"'*) exit 0;; esac
    printf '%s\n%s\n' "$problem" "$m" | awk '
        function number(name, rest) {
            rest = substr($0, index($0, "\"" name "\":") + length(name) + 3)
            return rest + 0
        }
        NR == 1 {
            x = substr($0, index($0, "\"reference_position\":[") + 22)
            n = split(substr(x, 1, index(x, "]") - 1), X, ",")
            h = number("h")
        }
        NR == 2 {
            pi = atan2(0, -1)
            d = number("dt")
            t = number("from") + number("steps") * d
            for (p = 1; p <= n; p++) {
                s = 1e-3 * sin(pi * X[p] / 2) * (1 + h * h)
                u = u (p > 1 ? "," : "") sprintf("%.17g", s * sin(5 * pi * t) / (5 * pi))
                v = v (p > 1 ? "," : "") sprintf("%.17g", s * cos(5 * pi * t))
            }
            printf "{\"type\":\"state\",\"columns\":{\"displacement\":[%s],\"velocity\":[%s]}}\n", u, v
        }'
done
"#;

pub(super) fn solver_of(error: &str) -> String {
    SECOND_ORDER.replace("HELLO", HELLO).replace("(1 + h * h)", &format!("(1 + {error})"))
}

/// Creates a folder with `bar.yaml`, and with a solver in `solver.sh` whose relative error is
/// `error`.
pub(super) fn folder_of(error: &str) -> Folder {
    let folder = Folder::with("bar.yaml", bar());
    folder.write("solver.sh", solver_of(error));
    folder
}

fn folder() -> Folder {
    folder_of("h * h")
}

const SOLVER: &str = "sh solver.sh";

#[test]
fn a_program_is_judged_like_any_method() {
    let found = folder().call(&["run", "bar.yaml", "--solver", SOLVER]).ended(SOUND);
    let flat = flat(&found.out);
    for words in [
        "solver odd version 1 precision double formal order 2, as stated by the solver",
        "odd explored a converging 2.00 [2.00, 2.00]",
    ] {
        assert!(flat.contains(words), "no `{words}` in\n{}", found.out);
    }
}

/// The expectation of each case is the order that the solver claims.
#[test]
fn gate_requires_the_claimed_order() {
    let folder = folder();
    let gate = ["run", "bar.yaml", "--solver", SOLVER, "--gate", "--brief"];
    folder.call(&gate).ended(SOUND);
    let boastful = HELLO.replace(r#""version""#, r#""formal_order":3,"version""#);
    folder.write("solver.sh", SECOND_ORDER.replace("HELLO", &boastful));
    folder.call(&gate).ended(FAILED);
}

/// If a capability is missing, the case must have neither a verdict nor a pass.
#[test]
fn case_with_a_missing_capability_is_not_applicable() {
    let folder = folder();
    let poor = HELLO.replace(r#""laws":["linear_elastic"]"#, r#""laws":[]"#);
    folder.write("poor.sh", SECOND_ORDER.replace("HELLO", &poor));
    let found = folder.call(&["run", "bar.yaml", "--solver", "sh poor.sh"]).ended(FAILED);
    let words = "remark odd: the solver lacks laws: linear_elastic";
    assert!(flat(&found.out).contains(words), "{}", found.out);
    assert!(found.errors.contains("no case is applicable to the solver"), "{}", found.errors);
}

/// An external solver does not report the force on a node while a particle crosses it.
#[test]
fn studies_of_method_internals_are_skipped() {
    let found = folder()
        .call(&["run", "bar.yaml", "grid-crossing", "--solver", SOLVER, "--brief"])
        .ended(SOUND);
    assert!(found.errors.contains("grid-crossing: skipped"), "{}", found.errors);
}

/// Creates a solver that writes the number of its process into `log` for each accepted problem.
fn logged() -> Folder {
    let folder = folder();
    let logging = "echo $$ >>log\necho '{\"type\":\"ready\"}'";
    let script = folder.read("solver.sh").replace("echo '{\"type\":\"ready\"}'", logging);
    folder.write("solver.sh", script);
    folder
}

fn problems(folder: &Folder) -> usize {
    folder.read("log").lines().count()
}

const KEPT: [&str; 6] = ["run", "bar.yaml", "--solver", SOLVER, "--resume", "kept"];

#[test]
fn finished_levels_are_reused_only_for_the_same_solver() {
    let folder = logged();
    let first = folder.call(&KEPT).ended(SOUND);
    let levels = problems(&folder);
    assert!(levels >= 4, "{levels}");
    let again = folder.call(&KEPT);
    assert_eq!((again.code, &again.out), (SOUND, &first.out));
    assert_eq!(problems(&folder), levels, "nothing ran again");
    // The other program has the same length.
    folder.write("solver.sh", folder.read("solver.sh").replace("rest", "tail"));
    let other = folder.call(&KEPT);
    assert_eq!((other.code, &other.out), (SOUND, &first.out));
    assert_eq!(problems(&folder), 2 * levels, "another program ran");
}

#[test]
fn failed_level_runs_again() {
    let folder = logged();
    let ready = "echo $$ >>log";
    let broken = folder.read("solver.sh").replace(ready, "[ -e well ] || exit 3\necho $$ >>log");
    folder.write("solver.sh", broken);
    let first = folder.call(&KEPT);
    assert!(first.out.contains("exit status 3"), "{}{}", first.out, first.errors);
    folder.write("well", String::new());
    let again = folder.call(&KEPT);
    assert_contains(&again.out, &["converging       2.00  [2.00, 2.00]"]);
}

#[test]
fn unknown_columns_of_a_state_are_ignored() {
    let folder = folder();
    let more = folder
        .read("solver.sh")
        .replace("\\\"velocity\\\":[%s]", "\\\"velocity\\\":[%s],\\\"spin\\\":[1]");
    assert!(more.contains("spin"));
    folder.write("solver.sh", more);
    let found = folder.call(&["run", "bar.yaml", "--solver", SOLVER, "--brief"]).ended(SOUND);
    assert!(found.out.contains("converging      2.00 [2.00, 2.00]"), "{}", found.out);
}

#[test]
fn a_program_is_diagnosed_without_changes_of_its_method() {
    let found = folder_of("h").call(&["diagnose", "bar.yaml", "--solver", SOLVER]);
    assert_eq!(found.code, SOUND, "{}{}", found.out, found.errors);
    let flat = flat(&found.out);
    assert_contains(
        &flat,
        &[
            "the verdict is too low",
            "Settings of the method (start, scheme, basis, transfer, mass matrix, frame) are not changed",
            "cells of half the size",
        ],
    );
    assert!(!flat.contains("NaN") && !flat.contains("half_step_back"), "{}", found.out);
}

#[test]
fn expectations_are_proposed_for_a_program() {
    let found = folder().call(&["propose", "bar.yaml", "--solver", SOLVER]).ended(SOUND);
    for words in ["- external: {name: odd}", "- case: [odd]", "order: [1.9, 2.1]  # from theory"] {
        assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    }
}

#[test]
fn case_that_a_program_refuses_is_not_diagnosed() {
    let folder = folder();
    folder.write("bar.yaml", bar().replace("left: fixed", "left: roller"));
    let found = folder.call(&["diagnose", "bar.yaml", "--solver", SOLVER]);
    assert_eq!(found.code, crate::cli::BAD_INPUT, "{}{}", found.out, found.errors);
    assert!(found.errors.contains("is not applicable: the solver lacks"), "{}", found.errors);
}

/// Each run of each of the four levels must have its own process.
#[test]
fn each_run_has_a_new_process() {
    let folder = logged();
    let found = folder.call(&["run", "bar.yaml", "--solver", SOLVER, "--repeat", "3"]).ended(SOUND);
    assert!(found.out.contains("spread between runs"), "{}", found.out);
    let log = folder.read("log");
    let mut processes: Vec<&str> = log.lines().collect();
    processes.sort_unstable();
    processes.dedup();
    assert_eq!(processes.len(), 12, "{log}");
}

#[test]
fn a_repetition_without_a_spread_is_refused() {
    let folder = Folder::with("bar.yaml", bar());
    for (arguments, reason) in [
        (&["--repeat", "1"][..], "--repeat 1: a spread needs two runs or more"),
        (&["--repeat", "0"], "--repeat 0: a spread needs two runs or more"),
        (&["--repeat", "101"], "--repeat 101: expected a number from 2 to 100"),
        (&["--repeat", "-3"], "expected a whole number"),
        (&["--repeat", "two"], "expected a whole number"),
        (&["--repeat", "3", "--resume", "kept"], "stored levels have one run each"),
    ] {
        let errors = folder.refused(&[&["run", "bar.yaml"], arguments].concat());
        assert!(errors.contains(reason), "no `{reason}` in {errors}");
    }
}
