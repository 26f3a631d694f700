//! A transfer as a suite chooses it: by its name, or a series with any number of terms.

use super::{Fmpm, Transfer, TransferKind, TransferName, Xpic, transfer};

/// A transfer, ready to be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferChoice {
    /// A registered one.
    Named(TransferName),
    /// XPIC(m); m is at least 1.
    Xpic(u32),
    /// FMPM(k); k is at least 1.
    Fmpm(u32),
}

impl From<TransferName> for TransferChoice {
    fn from(name: TransferName) -> Self {
        Self::Named(name)
    }
}

impl TransferChoice {
    /// The name as reports spell it: `apic`, `fmpm_8`.
    pub fn name(self) -> String {
        match self {
            Self::Named(name) => name.name().to_owned(),
            Self::Xpic(order) => format!("xpic_{order}"),
            Self::Fmpm(order) => format!("fmpm_{order}"),
        }
    }

    /// Kind of the transfer.
    pub fn kind(self) -> TransferKind {
        match self {
            Self::Named(name) => name.kind(),
            Self::Xpic(_) | Self::Fmpm(_) => TransferKind::Series,
        }
    }

    /// Makes the transfer.
    pub fn build<const D: usize>(self) -> Box<dyn Transfer<D>> {
        match self {
            Self::Named(name) => transfer(name),
            Self::Xpic(order) => Box::new(Xpic::new(order)),
            Self::Fmpm(order) => Box::new(Fmpm::new(order)),
        }
    }
}
