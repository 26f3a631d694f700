//! Compares the solver in `examples/own_solver` with the built-in solver. Both use the same
//! algorithm.

#[path = "../../../examples/own_solver/solver.rs"]
pub(crate) mod solver;
#[path = "../../../examples/own_solver/subject.rs"]
mod subject;

use crate::common::{errors, valid_suite};
use mpm_verify::prelude::*;
use rstest::rstest;
pub(crate) use subject::OwnSolver;

/// Maximum difference of an error, relative to the largest error of the levels.
const TOLERANCE: f64 = 1e-8;

pub(crate) const SWINGING_BAR: &str =
    include_str!("../../../examples/own_solver/suites/swinging-bar.yaml");

#[rstest]
#[case::as_it_is(SWINGING_BAR.to_owned())]
#[case::between_walls(
    SWINGING_BAR.replace("left: fixed", "left: fixed, right: fixed").replace("2*L", "L")
)]
#[case::through_cells(SWINGING_BAR.replace("v0: 0.01", "v0: 1").replace("until: 0.5", "until: 2"))]
#[case::with_a_poisson_ratio(
    SWINGING_BAR.replace("poisson: 0", "poisson: 0.3").replace("sqrt(E)", "sqrt(E*0.7/(1.3*0.4))")
)]
fn example_solver_has_the_errors_of_the_built_in_solver(#[case] text: String) {
    let ours = valid_suite(&text);
    let theirs = under(&ours, &OwnSolver, false).expect("a convergence study");
    let ours = errors(&Runner::new(&ours).case(0, &|| ()));
    let outcome = Runner::new(&theirs).judging(&OwnSolver).case(0, &|| ());
    let theirs = errors(&outcome);
    let largest = ours.iter().copied().fold(0.0, f64::max);
    assert_eq!((ours.len(), theirs.len()), (4, 4), "{}", outcome.reason);
    for (a, b) in ours.iter().zip(&theirs) {
        assert!((a - b).abs() <= TOLERANCE * largest, "{b:e} and not {a:e}");
    }
}
