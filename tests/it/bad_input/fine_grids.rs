//! Suites in which a reference run on a fine grid is not allowed.

use super::samples::{BAR, CUBE, PLATE};
use super::{Edits, refused};
use rstest::rstest;

const HALVES: &str =
    include_str!("../../../verification/contact-and-friction/vibrating-bar-of-two.yaml");

const EXACT: (&str, &str) = (
    "exact:\n  equation: small_strain\n  displacement: [\"sin(pi*X/2)*sin(omega*t)/omega\", 0]\n",
    "",
);
const NO_PARAMETERS: (&str, &str) = ("parameters:\n  omega: \"5*pi\"\n", "");

#[rstest]
#[case::of_no_more_cells(
    BAR,
    &[("run:", "reference: {same_method: {cells: ▸47}}\nrun:")],
    &["the fine grid has 47 cells, but the finest level already has 12", "expected at least 4 times as many"]
)]
#[case::of_half_a_cell(
    BAR,
    &[("run:", "reference: {same_method: {cells: ▸48.5}}\nrun:")],
    &["the number of cells is 48.5"]
)]
#[case::and_no_levels_of_cells(
    BAR,
    &[
        ("run:", "reference: {▸same_method: {cells: 48}}\nrun:"),
        (", dt: 1e-3, instants", ", instants"),
        ("cells: [6, 12], ppc: 4", "cells: 6, ppc: 4, dt: [2e-3, 1e-3]"),
    ],
    &["`same_method` on a fine grid measures only the error of the cell size", "list `cells` in `refine`"]
)]
#[case::and_shorter_steps(
    BAR,
    &[("run:", "reference: {▸same_method: {cells: 48, dt: 1e-4}}\nrun:")],
    &["either shorter steps (`dt`) or a fine grid (`cells`)", "state one of them"]
)]
#[case::or_shorter_steps(
    BAR,
    &[("run:", "reference: {▸same_method: {}}\nrun:")],
    &["either shorter steps (`dt`) or a fine grid (`cells`)", "state one of them"]
)]
#[case::without_a_step(
    BAR,
    &[
        ("run:", "reference: {same_method: {cells: ▸48}}\nrun:"),
        (", dt: 1e-3, instants", ", instants"),
        ("cells: [6, 12], ppc: 4", "cells: [6, 12], ppc: 4, dt: [2e-3, 1e-3]"),
    ],
    &["a time step for each level, but none for the fine grid", "as a formula of h"]
)]
#[case::whose_step_divides_no_instants(
    BAR,
    &[
        ("run:", "reference: {same_method: {cells: ▸50}}\nrun:"),
        ("dt: 1e-3", "dt: \"h/1000\""),
    ],
    &["dt = 0.0006 is changed to", "so that steps end at 50 instants"]
)]
#[case::of_a_width_that_does_not_fit(
    PLATE,
    &[
        ("run:", "reference: {same_method: {cells: ▸33}}\nrun:"),
        ("{left: fixed}", "{left: fixed, top: roller}"),
    ],
    &["with 33 cells along the first axis the top face", "a cell size that divides the length"]
)]
#[case::too_fine(
    CUBE,
    &[("run:", "reference: {same_method: {cells: ▸1000}}\nrun:")],
    &["with 1000 cells along the first axis, 1.6e9 nodes", "expected at most 5e7 nodes"]
)]
#[case::too_fine_to_keep(
    BAR,
    &[("run:", "reference: {same_method: {cells: ▸1000000}}\nrun:")],
    &["3.3e6 particles at 50 instants are too many to store"]
)]
#[case::without_a_stress(
    PLATE,
    &[("run:", "▸reference: {same_method: {cells: 32}}\njudge: {of: stress}\nrun:")],
    &["a reference does not provide the stress that this suite judges", "judge the displacement or the velocity"]
)]
#[case::of_a_disk(
    PLATE,
    &[
        ("run:", "reference: {▸same_method: {cells: 32}}\nrun:"),
        ("{box: {from: [0, 0], to: [1, 0.5]}}", "{disk: {centre: [0, 0], radius: 1}}"),
        ("  boundary: {left: fixed}\n", ""),
        EXACT,
        NO_PARAMETERS,
    ],
    &["regular particles of a single box, but the scene has a body of kind `disk`"]
)]
#[case::of_moved_particles(
    BAR,
    &[("run:", "reference: {▸same_method: {cells: 48}}\nparticles: {perturb: 0.2}\nrun:")],
    &["regular particles of a single box, but the scene has moved `particles`"]
)]
#[case::of_several_bodies(
    HALVES,
    &[("run:", "reference: {▸same_method: {cells: 4000}}\nrun:")],
    &["regular particles of a single box, but the scene has several bodies"]
)]
fn a_fine_grid(#[case] sound: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(sound, edits, words);
}
