//! Expectations: exactly one for each case.

pub(crate) mod any_method;
pub(crate) mod because;
pub(crate) mod cases;
pub(crate) mod limits;
