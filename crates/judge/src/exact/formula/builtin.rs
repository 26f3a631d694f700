//! Functions of two arguments (operators and named functions), and builtin names of formulas.

use super::number::Number;
use super::unary::Unary;

/// A function of two arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binary {
    /// `a + b`.
    Add,
    /// `a - b`.
    Subtract,
    /// `a * b`.
    Multiply,
    /// `a / b`.
    Divide,
    /// `a ^ b`.
    Power,
    /// `atan2(y, x)`, the angle of the point (x, y).
    Atan2,
    /// `min(a, b)`, with the derivatives of the smaller argument, or of `a` if both are equal.
    Min,
    /// `max(a, b)`, with the derivatives of the larger argument, or of `a` if both are equal.
    Max,
}

impl Binary {
    /// Functions that formulas call by name, with their names.
    pub const NAMED: &'static [(&'static str, Self)] =
        &[("atan2", Self::Atan2), ("min", Self::Min), ("max", Self::Max)];

    pub(super) fn find(name: &str) -> Option<Self> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
    }

    /// Returns the value for the arguments `a` and `b`.
    #[inline]
    pub fn apply<T: Number>(self, a: T, b: T) -> T {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => a.pow(b),
            Self::Atan2 => a.atan2(b),
            Self::Min => a.min(b),
            Self::Max => a.max(b),
        }
    }
}

pub(super) const PI: &str = "pi";
const SUM: &str = "sum";

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Builtin {
    Unary(Unary),
    Binary(Binary),
    Sum,
}

impl Builtin {
    pub(super) fn find(name: &str) -> Option<Self> {
        Unary::find(name)
            .map(Self::Unary)
            .or_else(|| Binary::find(name).map(Self::Binary))
            .or_else(|| (name == SUM).then_some(Self::Sum))
    }
}

pub(super) fn is_reserved(name: &str) -> bool {
    name == PI || Builtin::find(name).is_some()
}

pub(super) fn names<'a>() -> impl Iterator<Item = &'a str> {
    let unary = Unary::ALL.iter().map(|(name, _)| *name);
    let binary = Binary::NAMED.iter().map(|(name, _)| *name);
    unary.chain(binary).chain([SUM, PI])
}

pub(super) fn arguments(count: usize) -> String {
    format!("{count} argument{}", if count == 1 { "" } else { "s" })
}
