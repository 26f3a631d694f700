//! Averaged volume ratios in places where they have no effect.

use super::samples::BAR;
use super::{Edits, load, refused};
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

#[test]
fn sound() {
    for text in [SHEARS, PANEL] {
        if let Err(diagnostic) = load(text) {
            panic!("{diagnostic}");
        }
    }
}

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

#[test]
fn in_one_dimension() {
    let edits: Edits<'_> = &[(
        "- mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}",
        "- ▸mpm: {basis: linear, transfer: flip, scheme: musl, volume: averaged}",
    )];
    refused(BAR, edits, &["`volume: averaged`", "in 1-D", "volumetric locking does not occur"]);
}

#[test]
fn a_linear_fluid_in_one_dimension() {
    assert!(COLUMN.contains("linear_fluid") && COLUMN.contains("dimension: 1"));
    let text = COLUMN.replacen("scheme:", "volume: averaged, scheme:", 1);
    let refused = load(&text).expect_err("a column").one_line();
    assert!(
        refused.contains(
            "`volume: averaged` is not supported in 1-D: it would average the whole strain"
        )
    );
}

#[test]
fn in_plane_stress() {
    let edits: Edits<'_> =
        &[("- mpm: {basis: linear,", "- ▸mpm: {volume: averaged, basis: linear,")];
    refused(
        WAVE,
        edits,
        &["`volume: averaged`", "`plane: stress`", "volumetric locking does not occur"],
    );
}

#[test]
fn around_an_axis() {
    let text = PANEL.replacen("dimension: 2", "dimension: 2\n  plane: axisymmetric", 1);
    let refused = load(&text).expect_err("a body of revolution").to_string();
    assert!(refused.contains("`volume: averaged`") || refused.contains("axisymmetric"));
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

#[rstest]
#[case::drift("drift: {energy: 1e-3}")]
#[case::energy_rate("energy_rate: [0.9, 1.1]")]
fn an_energy_to_be_bounded(#[case] bound: &str) {
    let text = SHEARS.replacen("    order: ", &format!("    {bound}\n    order: "), 1);
    let refused = load(&text).expect_err("an energy").to_string();
    let reason = "the force of `volume: averaged` does not derive from a stored energy";
    assert!(refused.contains(reason), "{refused}");
}

#[test]
fn an_energy_to_be_judged() {
    let text = SHEARS.replacen("methods:", "judge: {of: strain_energy}\n\nmethods:", 1);
    let refused = load(&text).expect_err("an energy").to_string();
    let reason = "the force of `volume: averaged` does not derive from a stored energy";
    assert!(refused.contains(reason), "{refused}");
}
