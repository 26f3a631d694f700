//! Violation: the condition that a wrong exact solution breaks.

use std::fmt;

/// A condition that the declared solution does not satisfy: which, where, when, by how much.
#[derive(Debug, Clone, PartialEq)]
pub struct Violation {
    /// The condition, in words and symbols.
    pub condition: String,
    /// Reference position (m).
    pub label: Vec<f64>,
    /// Time (s).
    pub t: f64,
    /// Value that the condition asks for, where that is one number.
    pub expected: Option<f64>,
    /// Value of the solution.
    pub found: f64,
    /// Unit of both.
    pub unit: &'static str,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place: Vec<String> = self.label.iter().map(|c| coordinate(*c)).collect();
        let (place, t) = (place.join(", "), coordinate(self.t));
        write!(f, "{} is violated at X = ({place}), t = {t}: ", self.condition)?;
        if let Some(expected) = self.expected {
            write!(f, "expected {expected:.6e}, ")?;
        }
        write!(f, "found {:.6e}", self.found)?;
        if !self.unit.is_empty() {
            write!(f, " {}", self.unit)?;
        }
        self.expected
            .map_or(Ok(()), |expected| write!(f, " (off by {:.3e})", self.found - expected))
    }
}

/// Six decimals where they show something.
fn coordinate(value: f64) -> String {
    let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if plain { format!("{value:.6}") } else { format!("{value:.6e}") }
}

impl std::error::Error for Violation {}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(0.0, "0.000000")]
    #[case(-0.25, "-0.250000")]
    #[case(1e-3, "0.001000")]
    #[case(-2.5e-4, "-2.500000e-4")]
    #[case(1e6, "1.000000e6")]
    fn coordinates_have_digits(#[case] value: f64, #[case] text: &str) {
        assert_eq!(coordinate(value), text);
    }
}
