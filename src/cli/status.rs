//! Exit statuses.

/// Everything came as expected; in a comparison, nothing got worse.
pub(super) const PASSED: u8 = 0;

/// Some expectation was not met; in a comparison, something got worse.
pub(super) const FAILED: u8 = 1;

/// Something that was given could not be used.
pub(super) const BAD_INPUT: u8 = 2;
