//! Violated conditions of an exact solution.

use std::fmt;

/// A condition that an exact solution violates, with position, time and difference.
#[derive(Debug, Clone, PartialEq)]
pub struct Violation {
    /// The violation, as a clause such as "boundary condition u_X = 0 is violated".
    pub condition: String,
    /// Reference position (m).
    pub label: Vec<f64>,
    /// Time (s).
    pub t: f64,
    /// Value that the condition requires, if it is a single number.
    pub expected: Option<f64>,
    /// Value of the solution.
    pub found: f64,
    /// Difference that the tolerance allows; `None` for a condition without tolerance.
    pub allowed: Option<f64>,
    /// Unit of the values.
    pub unit: &'static str,
}

/// Stores the largest relative violation, with a preference for the condition already stored.
#[derive(Debug, Default)]
pub(super) struct LargestViolation(Option<Violation>);

impl LargestViolation {
    pub(super) fn add(&mut self, found: Result<(), Violation>) {
        let Err(found) = found else { return };
        // An infinite or NaN excess counts as the largest.
        let exceeds = |largest: &Violation| {
            let factor = if found.condition == largest.condition { 1.01 } else { 10.0 };
            !(found.excess() <= factor * largest.excess())
        };
        if self.0.as_ref().is_none_or(exceeds) {
            self.0 = Some(found);
        }
    }

    pub(super) fn into_result(self) -> Result<(), Violation> {
        self.0.map_or(Ok(()), Err)
    }
}

impl Violation {
    fn excess(&self) -> f64 {
        self.accepted_by(1.0).unwrap_or(0.0)
    }

    /// Returns the smallest tolerance with which the solution would be accepted, if its problem has
    /// the given `tolerance`. `None` for a condition without tolerance.
    pub fn accepted_by(&self, tolerance: f64) -> Option<f64> {
        Some(tolerance * ((self.found - self.expected?).abs() / self.allowed?))
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place: Vec<String> = self.label.iter().map(|c| coordinate(*c)).collect();
        let (place, t) = (place.join(", "), coordinate(self.t));
        write!(f, "{} at X = ({place}), t = {t}: ", self.condition)?;
        let (found, gap) = (self.found, if self.unit.is_empty() { "" } else { " " });
        let Some(expected) = self.expected else {
            return write!(f, "found {found:.6e}{gap}{}", self.unit);
        };
        // Writes six digits, or more if the values agree to six digits.
        let differs = |n: &usize| format!("{expected:.n$e}") != format!("{found:.n$e}");
        let digits = match (6..17).find(differs) {
            Some(6) | None => 6,
            Some(digits) => (digits + 1).min(16),
        };
        write!(f, "expected {expected:.digits$e}, found {found:.digits$e}{gap}{} ", self.unit)?;
        let off = found - expected;
        match self.allowed {
            Some(allowed) if off.is_finite() => {
                write!(f, "(off by {off:.3e}, at most {allowed:.1e} allowed)")
            }
            _ => write!(f, "(off by {off:.3e})"),
        }
    }
}

/// Formats a coordinate with six decimals for ordinary magnitudes, otherwise with an exponent.
fn coordinate(value: f64) -> String {
    let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if plain { format!("{value:.6}") } else { format!("{value:.6e}") }
}

impl std::error::Error for Violation {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_digits() {
        let texts = ["0.000000", "-0.250000", "0.001000", "-2.500000e-4", "1.000000e6"];
        assert_eq!([0.0, -0.25, 1e-3, -2.5e-4, 1e6].map(coordinate), texts);
    }
}
