//! Invalid values of options: not finite, out of range, or of another type.

use super::{BAR, Folder, SOUND, assert_refusals};

#[test]
fn invalid_option_values_are_refused_with_the_expected_form() {
    let folder = Folder::with("bar.yaml", BAR);
    let expected = r#"
$ problem bar.yaml --at nan
error: invalid value 'nan' for '--at <T>': expected a finite number
$ problem bar.yaml --at inf
error: invalid value 'inf' for '--at <T>': expected a finite number
$ problem bar.yaml --at 99
error: short-bar: `--at 99` is not a time of the run: expected 0 to 0.05 s
$ problem bar.yaml --at -1
error: short-bar: `--at -1` is not a time of the run: expected 0 to 0.05 s
$ problem bar.yaml --level -1
error: invalid value '-1' for '--level <N>': expected a whole number
$ problem bar.yaml --level 1.5
error: invalid value '1.5' for '--level <N>': expected a whole number
$ problem bar.yaml --level two
error: invalid value 'two' for '--level <N>': expected a whole number
$ run bar.yaml --jobs 0
error: invalid value '0' for '--jobs <N>': expected a whole number, 1 or more
$ run bar.yaml --jobs -2
error: invalid value '-2' for '--jobs <N>': expected a whole number, 1 or more
$ run bar.yaml --jobs 1000000
error: --jobs 1000000: expected a number from 1 to 1024
$ run bar.yaml --solver x --solver-memory -1
error: invalid value '-1' for '--solver-memory <MB>': expected a whole number, 1 or more
$ run bar.yaml --solver x --solver-timeout -5s
error: invalid value '-5s' for '--solver-timeout <TIME>': expected a time with its unit, such as `10s` or `500ms`
$ run bar.yaml --solver x --solver-timeout infs
error: invalid value 'infs' for '--solver-timeout <TIME>': expected a time with its unit, such as `10s` or `500ms`
$ run bar.yaml --shard -1/2
error: invalid value '-1/2' for '--shard <K/N>': expected a number and a count, such as `2/5`, up to 10000
$ compare a.json b.json --tolerance nan
error: invalid value 'nan' for '--tolerance <SHARE>': expected a finite number, zero or more
$ compare a.json b.json --tolerance -0.1
error: invalid value '-0.1' for '--tolerance <SHARE>': expected a finite number, zero or more
$ check bar.yaml --solver 'python3 "solver.py'
error: --solver python3 "solver.py: the solver command has an unclosed quote, or ends with a backslash
$ check bar.yaml --solver ''
error: --solver : the solver command is empty: expected a program with its arguments
"#;
    assert_refusals(&folder, expected);
}

/// The suggestion of `clap`, `-- -1`, would pass the number as a suite.
#[test]
fn advice_for_unknown_arguments_works() {
    let expected = "
$ run bar.yaml -1
error: unexpected argument '-1' found
Usage: mpm-verify run [OPTIONS] [SUITE]...
$ run --colour
error: unexpected argument '--colour' found
  tip: a similar argument exists: '--color'
Usage: mpm-verify run --color <WHEN> [SUITE]...
";
    assert_refusals(&Folder::with("bar.yaml", BAR), expected);
}

#[test]
fn unwritable_files_are_refused_before_the_run() {
    let folder = Folder::with("file", "in the way");
    folder.write("a.yaml", BAR);
    folder.write("b.yaml", BAR);
    let (same, of_out) = ("two suites have the name `short-bar` and would", "write the same files");
    for (arguments, error) in [
        ("cost a.yaml --figures file/x", "--figures file/x: "),
        ("run a.yaml --out file/x", "--out file/x: "),
        ("run a.yaml --vtu file", "--vtu "),
        ("run a.yaml --junit .", "--junit .: this is a folder\n"),
        ("run a.yaml --html file/page.html", "--html file/page.html: "),
        ("run a.yaml --html .", "--html .: "),
        ("run a.yaml b.yaml --out new", &format!("--out: {same} {of_out}\n")),
        ("run a.yaml b.yaml --html page.html", &format!("--html: {same} share one section\n")),
    ] {
        let errors = folder.refused(&arguments.split(' ').collect::<Vec<_>>());
        assert!(errors.starts_with(&format!("error: {error}")), "{errors}");
    }
    assert_eq!(folder.call(&["run", "a.yaml", "b.yaml"]).code, SOUND);
}
