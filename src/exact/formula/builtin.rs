//! The names that every formula knows.

use super::binary::Binary;
use super::unary::Unary;

/// The only named constant of the language.
pub(super) const PI: &str = "pi";
const SUM: &str = "sum";

/// Meaning of a builtin name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Builtin {
    Unary(Unary),
    Binary(Binary),
    Sum,
}

impl Builtin {
    /// The builtin function called `name`.
    pub(super) fn find(name: &str) -> Option<Self> {
        Unary::find(name)
            .map(Self::Unary)
            .or_else(|| Binary::find(name).map(Self::Binary))
            .or_else(|| (name == SUM).then_some(Self::Sum))
    }
}

/// Whether `name` belongs to the language, so that nothing else may be called so.
pub(super) fn is_reserved(name: &str) -> bool {
    name == PI || Builtin::find(name).is_some()
}

/// Every name of the language.
pub(super) fn names<'a>() -> impl Iterator<Item = &'a str> {
    let unary = Unary::ALL.iter().map(|(name, _)| *name);
    let binary = Binary::NAMED.iter().map(|(name, _)| *name);
    unary.chain(binary).chain([SUM, PI])
}

/// `1 argument`, `2 arguments`.
pub(super) fn arguments(count: usize) -> String {
    format!("{count} argument{}", if count == 1 { "" } else { "s" })
}
