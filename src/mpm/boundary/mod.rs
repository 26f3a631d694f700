//! Boundary conditions on the grid: the family. A member is one file and one line below.
//!
//! A face without a condition is free. A periodic axis needs no condition. With the bases of this
//! crate the functions of index 0 and of the last index on an axis are the only ones that do not
//! vanish on its walls (open knots, Steffen, Kirby & Berzins 2008), so prescribing their
//! coefficients prescribes the values on the wall. If faces meet, a later condition of the list
//! overrides an earlier one.

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
