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
    &["the fine grid has 47 cells, the finest level 12", "expected at least 4 times as many"]
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
    &["on a fine grid knows the error of a grid", "list `cells` in `refine`"]
)]
#[case::and_shorter_steps(
    BAR,
    &[("run:", "reference: {▸same_method: {cells: 48, dt: 1e-4}}\nrun:")],
    &["by shorter steps (`dt`) or by a fine grid (`cells`)", "state one of them"]
)]
#[case::or_shorter_steps(
    BAR,
    &[("run:", "reference: {▸same_method: {}}\nrun:")],
    &["by shorter steps (`dt`) or by a fine grid (`cells`)", "state one of them"]
)]
#[case::without_a_step(
    BAR,
    &[
        ("run:", "reference: {same_method: {cells: ▸48}}\nrun:"),
        (", dt: 1e-3, instants", ", instants"),
        ("cells: [6, 12], ppc: 4", "cells: [6, 12], ppc: 4, dt: [2e-3, 1e-3]"),
    ],
    &["a time step for each level, and none for the fine grid", "as a formula of h"]
)]
#[case::whose_step_divides_no_instants(
    BAR,
    &[
        ("run:", "reference: {same_method: {cells: ▸50}}\nrun:"),
        ("dt: 1e-3", "dt: \"h/1000\""),
    ],
    &["dt = 0.0006 becomes", "to end at 50 instants"]
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
    &["3.3e6 particles at 50 instants are too many to keep"]
)]
#[case::without_a_stress(
    PLATE,
    &[("run:", "▸reference: {same_method: {cells: 32}}\njudge: {of: stress}\nrun:")],
    &["a reference has no stress to compare with", "judge the displacement or the velocity"]
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
    &["between the particles of a box, and this is one of kind `disk`"]
)]
#[case::of_moved_particles(
    BAR,
    &[("run:", "reference: {▸same_method: {cells: 48}}\nparticles: {perturb: 0.2}\nrun:")],
    &["between the particles of a box, and this is one whose `particles` are moved"]
)]
#[case::of_several_bodies(
    HALVES,
    &[("run:", "reference: {▸same_method: {cells: 4000}}\nrun:")],
    &["between the particles of a box, and this is several bodies"]
)]
fn a_fine_grid(#[case] sound: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(sound, edits, words);
}
