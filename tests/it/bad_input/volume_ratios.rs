//! Averaged volume ratios in places where they have no effect.

use super::samples::BAR;
use super::{Edits, refused};
use mpm_verify::mpm::{FrameName, MaterialPlan, VolumeName, combine_volume};
use mpm_verify::subject::PlaneState;
use rstest::rstest;

const SHEARS: &str =
    include_str!("../../../verification/equilibrium/two-shears-nearly-incompressible.yaml");
const COLUMN: &str =
    include_str!("../../../verification/plasticity-and-fluids/acoustic-column-finite.yaml");
const WAVE: &str =
    include_str!("../../../verification/axisymmetry-and-plane-stress/plane-stress-wave.yaml");
const PANEL: &str = include_str!("../../../verification/equilibrium/cooks-membrane-averaged.yaml");

const BASES: &str = "- mpm: {basis: linear";

#[rstest]
#[case::of_no_known_name(
    &[("volume: [particle, averaged]", "volume: ▸average")],
    &["unknown name `average`", "did you mean `averaged`?"]
)]
#[case::of_a_name_unlike_any(
    &[("volume: [particle, averaged]", "volume: ▸cells")],
    &["unknown name `cells`", "`particle`", "`averaged`"]
)]
#[case::that_are_a_number(
    &[("volume: [particle, averaged]", "volume: ▸2")],
    &["expected"]
)]
#[case::in_the_reference_configuration(
    &[(BASES, "- ▸mpm: {basis: linear, frame: total_lagrangian")],
    &["`volume: averaged`", "the frame `total_lagrangian`"]
)]
fn volume_ratios(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SHEARS, edits, words);
}

#[rstest]
#[case::linear_elastic("linear_elastic")]
#[case::jaumann("jaumann")]
#[case::green_naghdi("green_naghdi")]
fn a_law_in_rate_form(#[case] law: &str) {
    let name = format!("{law}: {{young");
    let edits: Edits<'_> = &[("neo_hookean: {young", &name), ("- mpm: {", "- ▸mpm: {")];
    let words = &[
        &format!("`volume: averaged` is not supported with the law `{law}`")[..],
        "a law in rate form does not compute its stress from F or J",
    ];
    refused(PANEL, edits, words);
}

const ENERGY: &str = "the force of `volume: averaged` does not derive from a stored energy";

#[rstest]
#[case::in_one_dimension(
    BAR,
    &[("- mpm: {basis: linear,", "- ▸mpm: {volume: averaged, basis: linear,")],
    &["`volume: averaged`", "in 1-D", "volumetric locking does not occur"]
)]
#[case::for_a_linear_fluid_in_one_dimension(
    COLUMN,
    &[("- mpm: {", "- ▸mpm: {volume: averaged, ")],
    &["`volume: averaged` is not supported in 1-D: it would average the whole strain"]
)]
#[case::in_plane_stress(
    WAVE,
    &[("- mpm: {basis: linear,", "- ▸mpm: {volume: averaged, basis: linear,")],
    &["`volume: averaged`", "`plane: stress`", "volumetric locking does not occur"]
)]
#[case::with_a_drift(SHEARS, &[("    order: ", "    ▸drift: {energy: 1e-3}\n    order: ")], &[ENERGY])]
#[case::with_an_energy_rate(SHEARS, &[("    order: ", "    ▸energy_rate: [0.9, 1.1]\n    order: ")], &[ENERGY])]
#[case::with_a_judged_energy(
    SHEARS,
    &[
        ("methods:", "judge: {of: strain_energy}\n\nmethods:"),
        ("volume: [particle, averaged]", "volume: ▸[particle, averaged]"),
    ],
    &[ENERGY]
)]
fn averaged_ratios(#[case] suite: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(suite, edits, words);
}

/// In a plane, every law is tried. Laws of F or of J alone can be combined with an average.
#[test]
fn a_law_that_reads_neither_f_nor_j_is_refused_by_name() {
    let (averaged, updated) = (VolumeName::Averaged, FrameName::Updated);
    let mut refused = Vec::new();
    for plan in MaterialPlan::every(|_| 0.25) {
        let known = combine_volume(averaged, updated, &plan, 2, PlaneState::Strain);
        if let Err(reason) = known {
            let name = format!("the law `{}`", plan.name());
            assert!(reason.to_string().contains(&name), "{reason}");
            refused.push(plan.name());
        }
        assert!(
            combine_volume(VolumeName::Particle, updated, &plan, 1, PlaneState::Strain).is_ok()
        );
    }
    refused.sort_unstable();
    assert_eq!(refused, ["cam_clay", "green_naghdi", "jaumann", "linear_elastic", "rigid"]);
}
