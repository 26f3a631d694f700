//! Invalid values of options: not finite, out of range, or of another type.

use super::{BAD_INPUT, BAR, Folder, refusals};

#[test]
fn invalid_option_values_are_refused_with_the_expected_form() {
    let folder = Folder::with("bar.yaml", BAR);
    let text = refusals(
        &folder,
        &[
            "problem bar.yaml --at nan",
            "problem bar.yaml --at inf",
            "problem bar.yaml --at 99",
            "problem bar.yaml --at -1",
            "problem bar.yaml --level -1",
            "problem bar.yaml --level 1.5",
            "problem bar.yaml --level two",
            "run bar.yaml --jobs 0",
            "run bar.yaml --jobs -2",
            "run bar.yaml --solver x --solver-memory -1",
            "run bar.yaml --solver x --solver-timeout -5s",
            "run bar.yaml --solver x --solver-timeout infs",
            "run bar.yaml --shard -1/2",
            "compare a.json b.json --tolerance nan",
            "compare a.json b.json --tolerance -0.1",
            r#"check bar.yaml --solver 'python3 "solver.py'"#,
            "check bar.yaml --solver ''",
        ],
    );
    insta::assert_snapshot!(text, @r#"
    problem bar.yaml --at nan
    error: invalid value 'nan' for '--at <T>': expected a finite number
    problem bar.yaml --at inf
    error: invalid value 'inf' for '--at <T>': expected a finite number
    problem bar.yaml --at 99
    error: short-bar: `--at 99` is not a time of the run: expected 0 to 0.05 s
    problem bar.yaml --at -1
    error: short-bar: `--at -1` is not a time of the run: expected 0 to 0.05 s
    problem bar.yaml --level -1
    error: invalid value '-1' for '--level <N>': expected a whole number
    problem bar.yaml --level 1.5
    error: invalid value '1.5' for '--level <N>': expected a whole number
    problem bar.yaml --level two
    error: invalid value 'two' for '--level <N>': expected a whole number
    run bar.yaml --jobs 0
    error: invalid value '0' for '--jobs <N>': expected a whole number, 1 or more
    run bar.yaml --jobs -2
    error: invalid value '-2' for '--jobs <N>': expected a whole number, 1 or more
    run bar.yaml --solver x --solver-memory -1
    error: invalid value '-1' for '--solver-memory <MB>': expected a whole number, 1 or more
    run bar.yaml --solver x --solver-timeout -5s
    error: invalid value '-5s' for '--solver-timeout <TIME>': expected a time with its unit, such as `10s` or `500ms`
    run bar.yaml --solver x --solver-timeout infs
    error: invalid value 'infs' for '--solver-timeout <TIME>': expected a time with its unit, such as `10s` or `500ms`
    run bar.yaml --shard -1/2
    error: invalid value '-1/2' for '--shard <K/N>': expected a number and a count, such as `2/5`, up to 10000
    compare a.json b.json --tolerance nan
    error: invalid value 'nan' for '--tolerance <SHARE>': expected a finite number, zero or more
    compare a.json b.json --tolerance -0.1
    error: invalid value '-0.1' for '--tolerance <SHARE>': expected a finite number, zero or more
    check bar.yaml --solver 'python3 "solver.py'
    error: --solver python3 "solver.py: the solver command has an unclosed quote, or ends with a backslash
    check bar.yaml --solver ''
    error: --solver : the solver command is empty: expected a program with its arguments
    "#);
}

/// The suggestion of `clap`, `-- -1`, would pass the number as a suite.
#[test]
fn advice_for_a_stray_negative_number_works() {
    let folder = Folder::with("bar.yaml", BAR);
    let answer = folder.call(&["run", "bar.yaml", "-1"]).ended(BAD_INPUT);
    insta::assert_snapshot!(answer.errors, @"
    error: unexpected argument '-1' found

    Usage: mpm-verify run [OPTIONS] [SUITE]...

    For more information, try '--help'.
    ");
}
