//! Invalid refinement plans.

use super::samples::BAR;
use super::{Edits, refused};
use rstest::rstest;

const PLAN: &str = "refine: {cells: [6, 12], ppc: 4}";
const STEP: &str = ", dt: 1e-3, instants";
const NO_STEP: &str = ", instants";

#[rstest]
#[case::levels_from_fine_to_coarse(
    &[("[6, 12]", "[12, ▸6]")],
    &["a level with 6 cells after one with 12", "expected levels from coarse to fine"]
)]
#[case::no_time_step(
    &[(STEP, NO_STEP), ("run:", "▸run:")],
    &["a run needs a time step", "add `dt`, or a list of them to `refine`"]
)]
#[case::two_places_for_the_time_step(
    &[(PLAN, "refine: {cells: 6, ppc: 4, ▸dt: [1e-3, 5e-4]}")],
    &["the time step is already stated in `run`"]
)]
#[case::one_time_step(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: 6, ppc: 4, ▸dt: 1e-3}")],
    &["a single time step refines nothing", "move it to `run`"]
)]
#[case::growing_time_steps(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: 6, ppc: 4, dt: [1e-3, ▸2e-3]}")],
    &["a level with dt = 0.002 after one with 0.001", "expected levels from coarse to fine"]
)]
#[case::time_steps_that_become_the_same(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: 6, ppc: 4, dt: [1, ▸0.9]}")],
    &["dt = 0.9 and 1 both become 0.5 s", "both runs take 1 steps"]
)]
#[case::instants_of_a_computed_truth_that_cut_the_step(
    &[("dt: 1e-3", "dt: ▸3e-3"), ("\nrun:", "\nreference:\n  equation: small_strain\n  fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:")],
    &["dt = 0.003 is changed to 0.0025 s, so that steps end at 50 instants", "to 1 %", "`instants: 42` keeps this step"]
)]
#[case::a_time_step_that_is_none(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: 6, ppc: 4, dt: [1e-3, ▸\"0/0\"]}")],
    &["with 6 cells the time step is NaN"]
)]
#[case::cells_and_particles(
    &[(PLAN, "refine: {cells: [6, 12], ppc: ▸[1, 2]}")],
    &["`ppc` is refined together with `cells` or `dt`", "to refine `ppc`, state one number of cells"]
)]
#[case::lists_of_unequal_length(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: [6, 12], ppc: 4, dt: ▸[3e-3, 2e-3, 1e-3]}")],
    &["3 time steps for 2 levels of cells", "as a formula of h"]
)]
#[case::full_of_two_lists(
    &[(STEP, NO_STEP), (PLAN, "refine: {cells: [6, 12], ppc: 4, dt: [2e-3, 1e-3], ▸full: 24}")],
    &["`full` is one list, so it cannot refine both"]
)]
#[case::full_that_is_not_finer(
    &[("ppc: 4}", "ppc: 4, full: [24, ▸10]}")],
    &["a level with 10 cells after one with 24"]
)]
#[case::full_that_repeats(
    &[("ppc: 4}", "ppc: 4, full: ▸12}")],
    &["a level with 12 cells appears twice"]
)]
#[case::full_too_large_to_run(
    &[("ppc: 4}", "ppc: 8, full: ▸1e7}")],
    &["with 10000000 cells along the first axis, 6.7e7 particles"]
)]
#[case::an_fem_with_refined_particles(
    &[(PLAN, "refine: {cells: 6, ppc: [1, 2]}"), ("  - fem:", "  - ▸fem:")],
    &["but an FEM has none"]
)]
#[case::full_expected_and_not_run(
    &[("    verdict: too_few_levels\n    finest_pair", "    verdict: too_few_levels\n    ▸full: {verdict: divergent, because: none}\n    finest_pair")],
    &["this expectation needs a full run, but `refine` has no `full`"]
)]
#[case::full_with_cases_of_its_own(
    &[
        ("ppc: 4}", "ppc: 4, full: 24}"),
        ("    verdict: too_few_levels\n    finest_pair", "    verdict: too_few_levels\n    full: {▸case: x, verdict: divergent, because: none}\n    finest_pair"),
    ],
    &["cannot have its own `case`"]
)]
#[case::a_floor_of_no_axis(
    &[("finest_pair: [1.5, 2.5]", "floor: ▸tiem")],
    &["tiem", "time"]
)]
#[case::the_same_method_and_no_time_steps(
    &[("run:", "reference: {▸same_method: {dt: 1e-5}}\nrun:")],
    &["measures only the error of the time step"]
)]
#[case::the_same_method_with_steps_as_long(
    &[
        ("run:", "reference: {same_method: {dt: ▸2e-4}}\nrun:"),
        (STEP, NO_STEP),
        (PLAN, "refine: {cells: 6, ppc: 4, dt: [2e-3, 1e-3]}"),
    ],
    &["the time step is 0.0002, but the finest level already has 0.001", "expected at most 1/8"]
)]
#[case::a_reference_of_nothing(
    &[("run:", "▸reference: {}\nrun:")],
    &["a reference needs `equation` and `fem`, or `same_method`"]
)]
fn a_plan_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::beyond_the_middle(
    &[("refine:", "particles: ▸{shift: [0.4], perturb: 0.2}\nrefine:")],
    &["particles are moved by up to 0.6", "expected at most 0.5"]
)]
#[case::so_far_that_the_layer_of_a_load_is_lost(
    &[
        ("  initial_velocity", "  loads:\n    - traction: {on: right, value: [0]}\n  initial_velocity"),
        ("refine:", "particles: {perturb: ▸0.3}\nrefine:")
    ],
    &["particles are moved by up to 0.3", "expected at most 0.25 at a face or rim with a load"]
)]
#[case::a_seed_of_nothing(
    &[("refine:", "particles: {shift: [0.1], ▸seed: 3}\nrefine:")],
    &["`seed` has no effect without `perturb`", "add `perturb: 0.2`"]
)]
#[case::nothing_moved(
    &[("refine:", "▸particles: {shift: [0]}\nrefine:")],
    &["`particles` moves no particle"]
)]
#[case::a_shift_in_the_plane(
    &[("refine:", "particles: {shift: ▸[0.1, 0.1]}\nrefine:")],
    &["2 components in a scene of dimension 1"]
)]
#[case::not_a_number(
    &[("refine:", "particles: {perturb: ▸-0.1}\nrefine:")],
    &["the share of the spacing"]
)]
fn particles_off_their_lattice(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}
