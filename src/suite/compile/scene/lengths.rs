//! Lengths (m) that bodies may have: beyond these are slips of the pen, and their powers are no numbers.

pub(crate) const SHORTEST: f64 = 1e-30;
pub(crate) const LONGEST: f64 = 1e30;
