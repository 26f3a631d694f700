//! Materials: the family. A member is one file.

mod contract;
mod linear_elastic;

pub use contract::Material;
pub use linear_elastic::LinearElastic;
