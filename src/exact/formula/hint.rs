//! Suggestions for unknown names.

use crate::nearest::nearest;

/// Names that other languages have and this one writes differently.
const ELSEWHERE: &[(&str, &str)] = &[
    ("e", "there is no constant `e`: write `exp(1)`"),
    ("log", "the natural logarithm is `ln`"),
    ("pow", "a power is written `a^b`"),
    ("heaviside", "the unit step is `step`"),
];

/// Spelling here of a name that other languages have.
pub(super) fn elsewhere(name: &str) -> Option<String> {
    let known = ELSEWHERE.iter().find(|(foreign, _)| *foreign == name);
    known.map(|(_, help)| (*help).to_owned())
}

/// The question whether the nearest candidate is meant, if one is near.
pub(super) fn meant<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}
