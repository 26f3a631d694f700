//! Precisions of a method in places where they have no effect.

use super::{Edits, refused};
use rstest::rstest;

const BAR: &str = include_str!("../../../verification/first-checks/single-precision-bar.yaml");
const IMPACT: &str = include_str!("../../../verification/contact-and-friction/two-bar-impact.yaml");
const COLD_FLOW: &str = include_str!("../../../verification/stability/cold-flow.yaml");

#[rstest]
#[case::of_no_known_name(
    &[("precision: [double, single]", "precision: ▸singel")],
    &["unknown name `singel`", "did you mean `single`?"]
)]
#[case::that_are_a_number(
    &[("precision: [double, single]", "precision: ▸32")],
    &["expected"]
)]
fn precisions(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[test]
fn of_several_bodies() {
    let text = IMPACT.replacen("transfer:", "precision: single, transfer:", 1);
    let refused = super::load(&text).expect_err("two bodies").to_string();
    assert!(
        refused.contains("`precision: single` is supported for a single body only"),
        "{refused}"
    );
}

#[test]
fn of_a_stability_study() {
    let text = COLD_FLOW.replacen("transfer:", "precision: single, transfer:", 1);
    let refused = super::load(&text).expect_err("a stability study").to_string();
    assert!(refused.contains("a stability study needs double precision"), "{refused}");
}
