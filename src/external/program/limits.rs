//! Limits of time and memory.

use std::time::Duration;

/// Limits of each process of a solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramLimits {
    /// Longest time without an answer.
    pub silence: Duration,
    /// Address space (bytes), on Unix; none: what the system gives.
    pub memory: Option<u64>,
}

impl Default for ProgramLimits {
    fn default() -> Self {
        Self { silence: Duration::from_secs(60), memory: None }
    }
}
