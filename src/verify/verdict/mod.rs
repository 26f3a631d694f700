//! The verdict: from levels and their orders to a name, with the reason.

pub(crate) mod diagnosis;
pub(crate) mod error_trend;
pub(crate) mod floor;
pub(crate) mod judge;
pub(crate) mod name;
pub(crate) mod reason;
