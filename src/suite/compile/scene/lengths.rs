//! Lengths (m) that bodies may have. Beyond them are slips of the pen, whose powers are no numbers.

pub(crate) const SHORTEST: f64 = 1e-30;
pub(crate) const LONGEST: f64 = 1e30;
