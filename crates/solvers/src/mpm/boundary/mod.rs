//! Registry of the boundary conditions on the grid. A new condition requires one file and one
//! registration line below.
//!
//! A face without a condition is free. A periodic axis needs no condition. With the bases of this
//! crate, only the first and last functions on an axis are non-zero on its walls (open knots,
//! Steffen, Kirby & Berzins 2008). Prescribing their coefficients therefore prescribes the values
//! on the wall. Where faces meet, a later condition of the list overrides an earlier one.

mod contract;
mod fixed;
mod friction;
mod prescribed;
mod roller;

pub(super) use contract::nodes;
pub use contract::{Advance, Boundary, Side};
pub use fixed::Fixed;
pub(super) use friction::ContactState;
pub use friction::Friction;
pub(super) use prescribed::continued;
pub use prescribed::{Prescribed, VelocityField};
pub use roller::Roller;
