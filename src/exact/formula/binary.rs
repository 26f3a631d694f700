//! Functions of two arguments: the operators, and those called by name.

use super::number::Number;

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
    /// `min(a, b)`; of two equal arguments the first, with its derivatives.
    Min,
    /// `max(a, b)`; of two equal arguments the first, with its derivatives.
    Max,
}

impl Binary {
    /// The functions that are called by name.
    pub const NAMED: &'static [(&'static str, Self)] =
        &[("atan2", Self::Atan2), ("min", Self::Min), ("max", Self::Max)];

    /// The function called `name`.
    pub(super) fn find(name: &str) -> Option<Self> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
    }

    /// The value for the arguments `a` and `b`.
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
