//! Force of walls on a body.

/// Force of walls on the body, at the beginning of the last step: those of its end are not known
/// before another step computes them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reaction {
    /// Time of the force (s).
    pub time: f64,
    /// The force (N); components beyond the dimension are zero.
    pub force: [f64; 3],
}
