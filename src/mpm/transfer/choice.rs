//! A transfer in a suite: a registered name, or a name with a parameter (`{fmpm: 8}`).

use super::{Transfer, TransferKind, TransferName, WithParameter, transfer, with_parameter};

/// A transfer, ready to be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransferChoice {
    /// A registered one.
    Named(TransferName),
    /// One with a parameter, in its range.
    With(WithParameter, u32),
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
            Self::With(name, value) => format!("{}_{value}", name.name()),
        }
    }

    /// Kind of the transfer, the same in every dimension.
    pub fn kind(self) -> TransferKind {
        self.build::<1>().kind()
    }

    /// Makes the transfer.
    pub fn build<const D: usize>(self) -> Box<dyn Transfer<D>> {
        match self {
            Self::Named(name) => transfer(name),
            Self::With(name, value) => with_parameter(name, value),
        }
    }
}
