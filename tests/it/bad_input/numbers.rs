//! Numbers that are invalid for their key.

use super::samples::{BAR, COLUMN, PLATE};
use super::{Edits, refused};
use rstest::rstest;

#[rstest]
#[case::a_negative_density(
    &[("density: rho", "density: ▸-1")],
    &["the density is -1, but must be above zero", "expected a positive number"]
)]
#[case::a_negative_density_deep_in_a_formula(
    &[("rho: 1\n", "rho: -1\n"), ("\"pi/(2*L)", "▸\"pi/(2*L)")],
    &["`omega` is NaN because `rho` is -1", "expected a finite number", "`rho` is -1 (line 8)"]
)]
#[case::a_negative_stiffness_deep_in_a_formula(
    &[("E: 100", "E: -100"), ("\"pi/(2*L)", "▸\"pi/(2*L)")],
    &["`omega` is NaN because `E` is -100", "`E` is -100 (line 7)"]
)]
#[case::a_length_of_zero_deep_in_a_formula(
    &[("L: 25 ", "L: 0 "), ("\"pi/(2*L)", "▸\"pi/(2*L)")],
    &["`omega` is inf because `L` is 0", "`L` is 0 (line 6)"]
)]
#[case::two_that_are_to_blame_together(
    &[("E: 100", "E: 25"), ("rho: 1\n", "rho: 1\n  k: ▸\"1/(E - L)\"\n")],
    &["`k` is inf because `E` is 25 and `L` is 25", "`E` is 25 (line 7), `L` is 25 (line 6)"]
)]
#[case::one_beyond_a_branch_through_a_function(
    &[("sin(pi*s/(2*L))", "asin(s*v0)"), ("v0: 0.1", "v0: 3"), ("until: 0.5", "until: ▸\"mode(1)\"")],
    &["`mode(1)` is NaN because `v0` is 3", "`v0` is 3 (line 9)"]
)]
#[case::none_that_stands_out(
    &[("rho: 1\n", "rho: 1\n  k: ▸\"0*E/0\"\n")],
    &["`0*E/0` is NaN, which is not finite", "`E` is 100 (line 7)"]
)]
#[case::a_negative_stiffness(
    &[("E: 100", "E: -100"), ("sqrt(E/rho)", "sqrt(-E/rho)"), ("young: E", "young: ▸E")],
    &["Young's modulus is -100, but must be above zero", "`E` is -100 (line 7)"]
)]
#[case::a_fraction_of_a_cell_by_a_formula(
    &[("[6, 12]", "[6, ▸\"E/40\"]")],
    &["the number of cells is 2.5", "`E` is 100 (line 7)"]
)]
#[case::zero_cells(&[("[6, 12]", "[▸0, 12]")], &["the number of cells is 0", "expected a whole number from 1"])]
#[case::zero_cells_without_a_list(&[("[6, 12]", "▸0")], &["the number of cells is 0", "expected a whole number from 1"])]
#[case::a_fraction_of_a_cell(&[("[6, 12]", "[6, ▸2.5]")], &["the number of cells is 2.5"])]
#[case::cells_beyond_counting(&[("[6, 12]", "[6, ▸1e300]")], &["the number of cells is 1e300", "from 1 to 1e7"])]
#[case::a_level_twice(&[("[6, 12]", "[6, 12, ▸6]")], &["a level with 6 cells appears twice", "the second time"])]
#[case::no_particle_per_cell(
    &[("ppc: 4", "ppc: ▸0")],
    &["the number of particles per cell is 0", "expected a whole number from 1"]
)]
#[case::a_division_by_zero(&[("v0: 0.1", "v0: ▸\"1/0\"")], &["`1/0` is inf, which is not finite"])]
#[case::nothing_by_nothing(&[("poisson: 0", "poisson: ▸\"0/0\"")], &["`0/0` is NaN, which is not finite"])]
#[case::a_number_too_large(&[("E: 100", "E: ▸1e999")], &["the number `1e999` is too large"])]
#[case::an_incompressible_solid(
    &[("poisson: 0", "poisson: ▸0.5")],
    &["Poisson's ratio is 0.5", "expected a number above -1 and below 0.5"]
)]
#[case::no_time_step(&[("dt: 1e-3", "dt: ▸0")], &["with 6 cells the time step is 0", "expected a positive step"])]
#[case::a_negative_time_step(&[("dt: 1e-3", "dt: ▸-1e-3")], &["the time step is -0.001", "expected a positive step"])]
#[case::a_time_step_for_years(
    &[("dt: 1e-3", "dt: ▸1e-300")],
    &["with 6 cells the time step is 1e-300", "at most 1e9 of them"]
)]
#[case::a_time_step_that_is_none(&[("dt: 1e-3", "dt: ▸\"0/0\"")], &["the time step is NaN"])]
#[case::an_infinite_time_step(
    &[("dt: 1e-3", "dt: ▸\"0.5*h/(E - E)\"")],
    &["with 6 cells the time step is inf", "expected a positive step"]
)]
#[case::an_infinite_gravity(
    &[("  boundary: {left: fixed}", "  boundary: {left: fixed}\n  loads: [gravity: [▸\"1/0\"]]")],
    &["`1/0` is inf, which is not finite", "expected a finite number"]
)]
#[case::an_infinite_traction(
    &[
        ("  boundary: {left: fixed}", "  boundary: {left: fixed}\n  loads: [traction: {on: right, value: [\"1/(t - t)\"]}]"),
        ("[\"v0/omega", "[▸\"v0/omega"),
    ],
    &["right is loaded, traction in X", "expected inf", "off by -inf"]
)]
#[case::grouped_digits(&[("E: 100", "E: ▸1_000")], &["digits are not grouped: write `1000`"])]
#[case::grouped_digits_in_a_formula(
    &[("E: 100", "E: \"2*▸1_000_000\"")],
    &["digits are not grouped: write `1000000`"]
)]
#[case::a_decimal_comma(&[("E: 100", "E: \"1▸,5\"")], &["a decimal point is written `.`: `1.5`"])]
#[case::a_decimal_comma_in_brackets(
    &[("E: 100", "E: \"2*(1▸,5 + 3)\"")],
    &["a decimal point is written `.`: `1.5`"]
)]
#[case::a_time_step_below_zero_on_coarse_grids(
    &[("dt: 1e-3", "dt: ▸\"1e-3*(4 - h)\"")],
    &["with 6 cells the time step is -0.001"]
)]
#[case::an_end_before_the_start(&[("until: 0.5", "until: ▸-0.5")], &["the end of the run is -0.5, but must be above zero"])]
#[case::one_end_of_several_at_the_start(&[("until: 0.5", "until: [0.5, ▸0]")], &["the end of the run is 0"])]
#[case::an_end_twice(&[("until: 0.5", "until: [0.5, ▸\"1/2\"]")], &["the end 0.5 s appears twice"])]
#[case::an_end_after_the_universe(
    &[("until: 0.5, dt: 1e-3", "until: 1e300, dt: 1e297"), ("[\"v0/omega", "[▸\"v0/omega")],
    &["t = ", "e29"]
)]
#[case::no_instants(&[("instants: 50", "instants: ▸0")], &["the number of instants is 0", "expected a whole number from 1"])]
#[case::instants_beyond_counting(&[("instants: 50", "instants: ▸1e300")], &["the number of instants is 1e300"])]
#[case::a_fourth_dimension(&[("dimension: 1", "dimension: ▸4")], &["a scene of dimension 4", "expected 1, 2 or 3"])]
#[case::half_a_dimension(&[("dimension: 1", "dimension: ▸1.5")], &["a scene of dimension 1.5", "expected 1, 2 or 3"])]
#[case::a_tolerance_that_tolerates_anything(
    &[("small_strain\n", "small_strain\n  tolerance: ▸1\n")],
    &["a tolerance of 1 would let a wrong solution pass", "expected at most 1e-2"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[test]
fn three_particles_per_cell_cannot_be_spaced_equally_in_2d() {
    let words = ["3 particles per cell cannot be equally spaced", "expected n^2 in 2-D"];
    refused(PLATE, &[("ppc: 4", "ppc: ▸3")], &words);
}

#[rstest]
#[case::no_elements(&[("cells: 640", "cells: ▸0")], &["the number of elements is 0"])]
#[case::no_time_step(
    &[("cells: 640, dt: \"0.3*h/c\"", "cells: 640, dt: ▸0")],
    &["with 640 cells the time step is 0", "expected a positive step"]
)]
#[case::more_states_than_fit(
    &[("cells: 640", "cells: ▸1e7")],
    &["10000000 elements at 167 instants are too many to store", "expected at most 5e7"]
)]
fn a_reference_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(COLUMN, edits, words);
}
