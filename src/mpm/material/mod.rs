//! Materials: the family. A member is one file.

mod contract;
mod linear_elastic;
mod neo_hookean;

pub use contract::Material;
pub use linear_elastic::LinearElastic;
pub use neo_hookean::NeoHookean;
