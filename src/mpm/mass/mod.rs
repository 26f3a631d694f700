//! Mass matrices: the family. A member is one file and one line below.

mod assembly;
mod consistent;
mod contract;
mod lumped;

pub use consistent::Consistent;
pub use contract::MassMatrix;
pub use lumped::Lumped;

use super::foundation::family::objects;

objects! {
    /// Names of the mass matrices that suites may choose for MPM.
    pub enum MassName;
    /// Makes the mass matrix that a suite names.
    pub fn mass_matrix -> MassMatrix;
    "lumped" => Lumped: Lumped,
    "consistent" => Consistent: Consistent::default(),
}
