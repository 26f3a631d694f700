//! Verdicts: their names, the rules that determine them from levels, and the reasons.

pub(crate) mod diagnosis;
pub(crate) mod error_trend;
pub(crate) mod floor;
pub(crate) mod judge;
pub(crate) mod name;
pub(crate) mod reason;
