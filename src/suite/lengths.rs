//! Lengths (m) that bodies may have: beyond these are slips of the pen, and their powers are no numbers.

pub(super) const SHORTEST: f64 = 1e-30;
pub(super) const LONGEST: f64 = 1e30;
