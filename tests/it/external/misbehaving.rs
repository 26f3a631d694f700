//! Processes that break the protocol in different ways. The other levels still run, and the verdict
//! names the violation.

use super::bar;
use super::program::HELLO;
use crate::cli::{BAD_INPUT, FAILED, Folder, SOUND};
use crate::common::folder::flat;
use rstest::rstest;

/// Creates a script that is correct until it receives `advance`, and then runs `then`.
pub(crate) fn script(then: &str) -> String {
    format!(
        "read -r m; echo '{HELLO}'\nread -r m || exit 0\ncase \"$m\" in *bye*) exit 0;; esac\n\
         echo '{{\"type\":\"ready\"}}'\nread -r m\n{then}\n"
    )
}

fn run(script: &str, more: &[&str]) -> (i32, String) {
    let folder = Folder::with("bar.yaml", bar());
    folder.write("solver.sh", script);
    let mut arguments = vec!["run", "bar.yaml", "--brief", "--solver", "sh solver.sh"];
    arguments.extend(more);
    let found = folder.call(&arguments);
    (found.code, found.out + &found.errors)
}

#[rstest]
#[case::a_crash("exit 3", "the solver ended without an answer (exit status 3)")]
#[case::a_signal("kill -9 $$", "the solver ended without an answer (killed by signal 9)")]
#[case::last_words(
    "echo 'out of cheese' >&2; echo 'first'",
    "`first`; its last output on standard error: out of cheese"
)]
#[case::a_trace(
    "printf 'Trace:\\n  File \"a.py\", line 7, in step\\n    x / y\\n    ~~^~~\\nZeroDivisionError: zero\\n' >&2; exit 1",
    "; its last output on standard error: File \"a.py\", line 7, in step | x / y | ZeroDivisionError: zero"
)]
#[case::garbage(
    "echo hello there",
    "sent an invalid message (not a JSON object; print other text on standard error): `hello"
)]
#[case::another_type("echo '{\"type\":\"ready\"}'", "answered `advance` with `ready`")]
#[case::an_unknown_type("echo '{\"type\":\"done\"}'", "unknown variant `done`")]
#[case::half_a_line("printf '{\"type\":\"sta'", "ended in the middle of an answer")]
#[case::half_a_block(
    "printf '{\"type\":\"state\",\"bytes\":100,\"columns\":{}}\\nabc'",
    "ended in the middle of a block of bytes"
)]
#[case::a_fraction_of_a_count(
    "echo '{\"type\":\"state\",\"columns\":{},\"crossings\":1.5}'",
    "expected a whole number, zero or more at line 1"
)]
#[case::a_count_in_words(
    "echo '{\"type\":\"state\",\"columns\":{},\"left_domain\":\"none\"}'",
    "expected a whole number, zero or more at line 1"
)]
#[case::a_column_that_is_a_number(
    "echo '{\"type\":\"state\",\"columns\":{\"displacement\":5}}'",
    "a column is a list of numbers, or `{\"f64\": [OFFSET, COUNT]}`"
)]
#[case::nan(
    "echo '{\"type\":\"state\",\"columns\":{\"displacement\":[NaN]}}'",
    "answered with NaN, which is not a finite number"
)]
#[case::beyond_the_block(
    "printf '{\"type\":\"state\",\"bytes\":1,\"columns\":{\"displacement\":{\"f64\":[0,16]}}}\\nx'",
    "sent the column `displacement` as 16 doubles from byte 0, but the message has 1 bytes"
)]
#[case::an_impossible_block(
    "echo '{\"type\":\"state\",\"bytes\":99999999999999,\"columns\":{}}'; sleep 9",
    "answered with more than 1048576 bytes"
)]
#[case::a_flood_of_bytes("yes | tr -d '\\n'", "answered with more than 1048576 bytes")]
#[case::a_flood_of_lines("yes", "sent an invalid message")]
#[case::endless_questions(
    "while :; do echo '{\"type\":\"body_force\",\"t\":0}'; read -r m; done",
    "requested values 1001 times, more than the limit"
)]
#[case::its_own_word("echo '{\"type\":\"failed\",\"reason\":\"all is lost\"}'", "all is lost")]
fn what_breaks_the_protocol_fails_and_says_how(#[case] then: &str, #[case] words: &str) {
    let (code, said) = run(&script(then), &[]);
    assert!(code == SOUND && said.contains("explored  short-bar::odd  failed"), "{said}");
    let flat = flat(&said);
    assert!(flat.contains(words), "no `{words}` in\n{said}");
}

#[test]
fn more_than_10_000_requests_before_ready_fail() {
    let flood = "yes '{\"type\":\"body_force\",\"t\":0}' | head -n 10001 & cat >/dev/null; wait";
    let (_, said) = run(&script("").replacen("echo '{\"type\":\"ready\"}'", flood, 1), &[]);
    assert!(flat(&said).contains("requested values 10001 times"), "{said}");
}

#[test]
fn a_gate_fails_with_its_solver() {
    assert_eq!(run(&script("exit 1"), &["--gate"]).0, FAILED);
}

#[test]
fn child_processes_of_a_solver_are_killed() {
    let folder = Folder::with("bar.yaml", bar());
    folder.write("solver.sh", script("sleep 999 & echo $! >> pids; exit 1"));
    folder.call(&["run", "bar.yaml", "--solver", "sh solver.sh"]);
    let pids = std::fs::read_to_string(folder.path().join("pids")).expect("pids");
    assert_eq!(pids.lines().count(), 4, "one for each level");
    for pid in pids.lines() {
        let alive = || {
            let status = std::fs::read_to_string(format!("/proc/{pid}/stat"));
            status.is_ok_and(|status| !status.contains(") Z "))
        };
        // The system may end a killed process late.
        let patient = (0..6000).any(|_| {
            let is_dead = !alive();
            if !is_dead {
                std::thread::sleep(std::time::Duration::from_millis(10));
            }
            is_dead
        });
        assert!(patient, "process {pid} goes on");
    }
}

#[rstest]
#[case::no_command("", "expected a program with its arguments")]
#[case::no_program(
    "/no/such/program -x",
    "program `/no/such/program` does not start: No such file"
)]
#[case::no_hello("true", "ended without an answer (exit status 0)")]
#[case::silence("sleep 99", "did not answer within 0.05 s")]
#[case::an_older_version(
    "sh -c 'read m; echo \"{\\\"type\\\":\\\"hello\\\",\\\"protocol\\\":7,\\\"name\\\":\\\"x\\\"}\"'",
    "uses version 7 of the protocol; expected version 1 or 2"
)]
#[case::a_name_that_is_a_path(
    "sh -c 'read m; echo \"{\\\"type\\\":\\\"hello\\\",\\\"protocol\\\":1,\\\"name\\\":\\\"../x\\\"}\"'",
    "has the invalid name `../x`: expected up to 64 letters"
)]
fn a_command_that_cannot_be_greeted_is_bad_input(#[case] command: &str, #[case] words: &str) {
    let folder = Folder::with("bar.yaml", bar());
    // Only the silent program waits for the timeout, because nothing else happens within it.
    let timeout = if command == "sleep 99" { "50ms" } else { "60s" };
    let arguments = ["run", "bar.yaml", "--solver", command, "--solver-timeout", timeout];
    let found = folder.call(&arguments).ended(BAD_INPUT);
    assert!(found.errors.contains(words), "no `{words}` in\n{}", found.errors);
}

#[test]
fn memory_has_a_limit() {
    let hungry = script("awk 'BEGIN { s = \"x\"; while (1) s = s s }'; exit 7");
    let (_, said) = run(&hungry, &["--solver-memory", "200"]);
    assert!(said.contains("exit status 7"), "{said}");
}
