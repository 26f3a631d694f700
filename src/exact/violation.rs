//! What a wrong exact solution is told.

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
    /// What the condition asks for.
    pub expected: f64,
    /// What the solution gives.
    pub found: f64,
    /// Unit of both.
    pub unit: &'static str,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place: Vec<String> = self.label.iter().map(|c| format!("{c:.6}")).collect();
        write!(
            f,
            "{} is violated at X = ({}), t = {:.6}: expected {:.6e}, found {:.6e} {} \
             (off by {:.3e})",
            self.condition,
            place.join(", "),
            self.t,
            self.expected,
            self.found,
            self.unit,
            self.found - self.expected,
        )
    }
}

impl std::error::Error for Violation {}
