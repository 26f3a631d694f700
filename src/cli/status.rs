//! What the exit status says.

/// Everything came as expected.
pub(super) const PASSED: u8 = 0;

/// Some expectation was not met.
pub(super) const FAILED: u8 = 1;

/// Something that was given could not be used.
pub(super) const BAD_INPUT: u8 = 2;
