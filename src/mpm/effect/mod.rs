//! Effects: the family. A member is one file and one line below; a scene lists the effects it
//! wants, and what it does not list costs nothing.

mod body_force;
mod contract;
mod gravity;
mod traction;

pub use body_force::{BodyForce, Field};
pub use contract::Effect;
pub use gravity::Gravity;
pub use traction::Traction;
