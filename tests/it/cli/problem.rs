//! `mpm-verify problem`: writes a level of a suite to a file.

use super::{BAR, Folder, assert_refusals};
use crate::common::valid_suite;
use mpm_verify::external::ProblemFormat;
use mpm_verify::study::{exact_state, level_problem};
use rstest::rstest;

/// The finest level that `run` uses is the default.
#[rstest]
#[case::finest(&[], 3, None, ProblemFormat::Csv)]
#[case::coarsest(&["--level", "1", "--format", "json"], 0, None, ProblemFormat::Json)]
#[case::arrays(&["--level", "3", "--format", "npz"], 2, None, ProblemFormat::Npz)]
#[case::later(&["--level", "2", "--at", "0.03", "--out", "vtu"], 1, Some(0.03), ProblemFormat::Vtu)]
fn level_is_written_at_its_time_and_in_its_format(
    #[case] arguments: &[&str],
    #[case] level: usize,
    #[case] t: Option<f64>,
    #[case] format: ProblemFormat,
) {
    let text = BAR.replace("ppc: 4}", "ppc: 4, full: 16}");
    let suite = valid_suite(&text);
    let plan = suite.convergence().expect("a study of an order");
    let level = plan.refine.levels[level];
    let mut problem = level_problem(&suite.name, plan, &plan.cases[0], level).expect("a problem");
    if let Some(t) = t {
        problem.particles = exact_state(plan, &problem.particles, t).expect("a state");
    }
    let folder = Folder::with("bar.yaml", text);
    let mut command = folder.command(&[&["problem", "bar.yaml"], arguments].concat());
    let bytes = command.output().expect("the program starts").stdout;
    assert!(bytes == problem.written(format).expect("a file"));
}

#[test]
fn unwritable_problem_is_refused() {
    let folder = Folder::with("bar.yaml", BAR);
    let expected = "
$ problem bar.yaml --level 9
error: short-bar: there is no level 9: expected 1 to 4
$ problem bar.yaml --level 0
error: short-bar: there is no level 0: expected 1 to 4
$ problem bar.yaml --format xls
error: invalid value 'xls' for '--format <FORMAT>': expected one of csv, json, npz, vtu
$ problem courant-limit
error: courant-limit: it is not a convergence study
$ problem heat-step --at 0.1
error: heat-step: the suite states no exact motion
$ problem bar.yaml --at 0.0501
error: short-bar: `--at 0.0501` is not a time of the run: expected 0 to 0.05 s
";
    assert_refusals(&folder, expected);
}
