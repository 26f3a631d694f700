//! Names of cases contain exactly the settings that distinguish two methods.

use super::samples::{BAR, SWEPT};
use super::{load, refuse_all};

const METHODS: &str = "- mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}
  - fem: {element: linear, mass: lumped}
";

/// Returns the names of the cases of a bar with these methods.
fn names(methods: &[&str]) -> Vec<String> {
    let entries = format!("- {}\n", methods.join("\n  - "));
    let (head, _) = BAR.split_once("\nexpect:").expect("expectations");
    let expected = "\nexpect:\n  - {verdict: too_few_levels, because: two levels are no claim}\n";
    let suite = head.replace(METHODS, &entries) + expected;
    let suite = load(&suite).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    suite.case_names().into_iter().map(ToOwned::to_owned).collect()
}

#[test]
fn names_contain_what_distinguishes_two_methods() {
    let lines = NAMES.replace("\n  ", " ");
    let mut methods = Vec::new();
    for line in lines.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(wanted) = line.strip_prefix("⇒ ") {
            assert_eq!(names(&methods).join(" "), wanted);
            methods.clear();
        } else {
            methods.push(line);
        }
    }
}

const NAMES: &str = "
mpm: {basis: linear, transfer: flip, scheme: usl}
mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}
⇒ mpm-linear-flip-usl-updated-lagrangian mpm-linear-flip-usl-total-lagrangian
mpm: {basis: linear, transfer: flip, scheme: usl, mass: lumped}
mpm: {basis: linear, transfer: flip, scheme: usl, mass: consistent}
⇒ mpm-linear-flip-usl-lumped mpm-linear-flip-usl-consistent
mpm: {basis: linear, transfer: flip, scheme: usl, start: half_step_back}
mpm: {basis: linear, transfer: flip, scheme: usl}
⇒ mpm-linear-flip-usl-half-step-back mpm-linear-flip-usl-at-zero
fem: {element: linear, mass: lumped, sampling: nodes}
fem: {element: linear, mass: lumped}
⇒ fem-linear-lumped-nodes fem-linear-lumped-inside
fem: {element: linear, mass: lumped, law: hencky}
fem: {element: linear, mass: lumped}
⇒ fem-linear-lumped-hencky fem-linear-lumped-small-strain
mpm: {basis: linear, transfer: {fmpm: 2}, scheme: usl}
mpm: {basis: linear, transfer: {fmpm: 4}, scheme: usl}
⇒ mpm-linear-fmpm-2-usl mpm-linear-fmpm-4-usl
# Settings that all methods share are no part of the names.
mpm: {basis: linear, transfer: flip, scheme: usl, mass: lumped, frame: total_lagrangian}
mpm: {basis: linear, transfer: pic, scheme: usl, mass: lumped, frame: total_lagrangian}
⇒ mpm-linear-flip-usl mpm-linear-pic-usl
# Only names that would be equal become longer, until they differ.
mpm: {basis: linear, transfer: [flip, pic], scheme: usl}
mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}
⇒ mpm-linear-flip-usl-updated-lagrangian mpm-linear-pic-usl mpm-linear-flip-usl-total-lagrangian
mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian, start: half_step_back}
mpm: {basis: linear, transfer: flip, scheme: usl, start: half_step_back}
mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}
mpm: {basis: linear, transfer: flip, scheme: usl}
⇒ mpm-linear-flip-usl-half-step-back-total-lagrangian
  mpm-linear-flip-usl-half-step-back-updated-lagrangian
  mpm-linear-flip-usl-at-zero-total-lagrangian
  mpm-linear-flip-usl-at-zero-updated-lagrangian
";

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r"
@bar
- fem: → - ▸mpm: {basis: linear, transfer: flip, scheme: usl}\n  - fem:
⇒ the case `mpm-linear-flip-usl` appears twice … the second time
- fem: → - ▸mpm: {basis: linear, transfer: flip, scheme: usl, frame: updated_lagrangian}\n  - fem:
⇒ the case `mpm-linear-flip-usl` appears twice
mass: lumped} → mass: lumped}\n  - ▸fem: {element: linear, mass: lumped, law: small_strain}
⇒ the case `fem-linear-lumped` appears twice
[musl, usl] → [musl, usl], frame: [total_lagrangian, total_lagrangian]
- mpm: → - ▸mpm:
⇒ the case `mpm-linear-flip-musl-total-lagrangian` appears twice
";

#[test]
fn methods_of_a_stability_study_have_unique_names() {
    let (head, _) = SWEPT.split_once("\nmethods:").expect("methods");
    let suite = load(&format!(
        "{head}
methods:
  - mpm: {{basis: linear, transfer: flip, scheme: usl}}
  - mpm: {{basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}}
expect:
  - {{critical: {{above: 0.1}}, because: it is stable there}}
"
    ));
    let suite = suite.unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    let wanted = ["mpm-linear-flip-usl-updated-lagrangian", "mpm-linear-flip-usl-total-lagrangian"];
    assert_eq!(suite.case_names(), wanted);
}
