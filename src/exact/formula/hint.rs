//! Suggestions for unknown names.

use crate::nearest::nearest;

/// Names that other languages have and this one writes differently.
const ELSEWHERE: &[(&str, &str)] = &[
    ("e", "there is no constant `e`: write `exp(1)`"),
    ("log", "the natural logarithm is `ln`"),
    ("pow", "a power is written `a^b`"),
    ("heaviside", "the unit step is `step`"),
];

/// Correction of the unknown `name`, if it resembles a candidate or is known elsewhere.
pub(super) fn hint<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let elsewhere = ELSEWHERE.iter().find(|(foreign, _)| *foreign == name);
    if let Some((_, help)) = elsewhere {
        return Some((*help).to_owned());
    }
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}
