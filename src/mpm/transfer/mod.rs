//! Transfers of velocity between particles and grid: the family. A member is one file and one
//! line below.

mod contract;
mod flip;

pub use contract::Transfer;
pub use flip::Flip;

use super::family::family;

family! {
    /// Names of the transfers that suites may choose.
    pub enum TransferName; with_transfer;
    "flip" => Flip,
}
