//! `diff`: snapshots of two folders, or of a commit.

use super::{BAD_INPUT, FAILED, Folder, SOUND};

const OVERVIEW: &str = "---\nsource: a\n---\nOverview of all suites\n\n  result        1 case as expected\n\n\
    == bars ==\n\n  bar: A bar\n\
    \x20 case           verdict     order  95 %          finest error  floor  result\n\
    \x20 mpm-flip-musl  converging   1.99  [1.95, 2.03]     1.000e-04  -      pass\n";

const REPORT: &str = "---\nsource: a\n---\nbar: A bar\n\n  source        a book\n\
    \x20 parameters    E = 100\n\
    \x20 problem       body (0) to (1) m; left fixed; dt\n\
    \x20               0.1*h/c\n\
    \x20 methods       until: t = 1 s\n";

/// A folder with the snapshots of an old and a new run.
fn folder(overview: &str, report: &str) -> Folder {
    let folder = Folder::new();
    for (name, overview, report) in [("old", OVERVIEW, REPORT), ("new", overview, report)] {
        folder.write(&format!("{name}/OVERVIEW.snap"), overview);
        folder.write(&format!("{name}/bars/bar.snap"), report);
    }
    folder
}

#[test]
fn what_moved_is_said_in_words() {
    let found = folder(OVERVIEW, REPORT).call(&["diff", "old", "new"]);
    assert_eq!((found.code, found.errors.as_str()), (SOUND, ""));
    assert!(found.out.starts_with("nothing worse: 1 unchanged"), "{}", found.out);
    let worse = OVERVIEW.replace("1.000e-04", "2.000e-04");
    let found = folder(&worse, REPORT).call(&["diff", "old", "new"]);
    assert_eq!(found.code, FAILED);
    for words in ["bar::mpm-flip-musl", "1.000e-4 -> 2.000e-4", "2.00 x", "the finest level"] {
        assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    }
    let failing = OVERVIEW.replace("  pass", "  NOT AS EXPECTED");
    let found = folder(&failing, REPORT).call(&["diff", "old", "new"]);
    assert!(found.out.contains("1 no longer as expected"), "{}", found.out);
}

#[test]
fn another_problem_is_no_worse_solver() {
    let worse = OVERVIEW.replace("1.000e-04", "2.000e-04");
    let stiffer = REPORT.replace("E = 100", "E = 101").replace("left fixed", "left roller");
    let found = folder(&worse, &stiffer).call(&["diff", "old", "new"]);
    assert_eq!(found.code, SOUND);
    for words in ["bar: parameters E = 100 -> E = 101", "bar: left fixed -> roller"] {
        assert!(found.out.contains(words), "no `{words}` in\n{}", found.out);
    }
    let finer = REPORT.replace("0.1*h/c", "0.05*h/c");
    let found = folder(&worse, &finer).call(&["diff", "old", "new"]);
    assert_eq!(found.code, FAILED, "steps are no problem of their own\n{}", found.out);
}

#[test]
fn a_side_without_an_overview_is_an_error() {
    let found = folder(OVERVIEW, REPORT).call(&["diff", "older", "new"]);
    assert_eq!(found.code, BAD_INPUT);
    assert!(found.errors.contains("`older` has no OVERVIEW.snap"), "{}", found.errors);
}
