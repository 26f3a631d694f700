//! Registry of the transfers of velocity between particles and grid. A new transfer requires one
//! file and one line below. A transfer with a parameter is also a member of [`WithParameter`].

/// The transfer added by `docs/exercises/transfer.md`.
#[cfg(test)]
#[path = "../../../../../tests/exercises/aflip.rs"]
mod aflip;
mod apic;
mod blend;
mod contract;
mod flip;
mod fmpm;
mod pic;
mod tls;
mod tpic;
mod xpic;

use super::foundation::family::objects;
pub use apic::{AffineTransfer, Apic, Mls};
pub use blend::Blend;
pub(in crate::mpm) use contract::kick;
pub use contract::{Transfer, TransferKind, TransferParameter, g2p};
pub use flip::Flip;
pub use fmpm::Fmpm;
use mpm_subject::named;
pub use pic::Pic;
pub use tls::Tls;
pub use tpic::Tpic;
pub use xpic::Xpic;

objects! {
    /// Names of the transfers that suites may choose.
    pub enum TransferName;
    /// Creates the transfer with this name.
    pub fn transfer -> Transfer;
    "flip" => Flip: Flip,
    "flip_99" => Flip99: Blend::new(0.99),
    "flip_95" => Flip95: Blend::new(0.95),
    "pic" => Pic: Pic,
    "apic" => Apic: Apic::default(),
    "mls" => Mls: Mls::default(),
    "tpic" => Tpic: Tpic::default(),
    "tls" => Tls: Tls::default(),
    "xpic_2" => Xpic2: Xpic::new(2),
    "xpic_5" => Xpic5: Xpic::new(5),
    "fmpm_2" => Fmpm2: Fmpm::new(2),
    "fmpm_4" => Fmpm4: Fmpm::new(4),
}

named! {
    /// Names of the transfers that have a parameter.
    pub enum WithParameter {
        /// [`Xpic`] with its order.
        Xpic = "xpic",
        /// [`Fmpm`] with its order.
        Fmpm = "fmpm",
    }
}

impl WithParameter {
    /// Returns the range and description of the parameter.
    pub fn parameter(self) -> TransferParameter {
        match self {
            Self::Xpic | Self::Fmpm => TransferParameter::TERMS,
        }
    }
}

impl TransferName {
    /// Returns the kind of the transfer.
    pub fn kind(self) -> TransferKind {
        transfer::<1>(self).kind()
    }
}

/// A transfer and its parameter, if any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferChoice {
    /// A registered transfer without a parameter.
    Named(TransferName),
    /// A transfer with the value of its parameter, which must be within
    /// [`TransferParameter::range`].
    With(WithParameter, u32),
}

impl From<TransferName> for TransferChoice {
    fn from(name: TransferName) -> Self {
        Self::Named(name)
    }
}

impl TransferChoice {
    /// Returns the name in reports, such as `apic` or `fmpm_8`.
    pub fn name(self) -> String {
        match self {
            Self::Named(name) => name.name().to_owned(),
            Self::With(name, value) => format!("{}_{value}", name.name()),
        }
    }

    /// Returns the kind of the transfer, which is the same in every dimension.
    pub fn kind(self) -> TransferKind {
        self.build::<1>().kind()
    }

    /// Creates the transfer.
    pub fn build<const D: usize>(self) -> Box<dyn Transfer<D>> {
        match self {
            Self::Named(name) => transfer(name),
            Self::With(WithParameter::Xpic, order) => Box::new(Xpic::new(order)),
            Self::With(WithParameter::Fmpm, order) => Box::new(Fmpm::new(order)),
        }
    }
}
