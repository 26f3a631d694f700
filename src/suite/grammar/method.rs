//! Keys of a method.

use super::EquationName;
use crate::fem::{Element, Mass, Sampling};
use crate::mpm::{BasisName, FrameName, MassName, SchemeName, TransferChoice};
use crate::subject::{Precision, Start};
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

/// One method, or several: the lists in it multiply to cases.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MethodSpec {
    /// Material Point Method.
    Mpm {
        /// Basis functions.
        basis: OneOrMany<BasisName>,
        /// Transfer of velocity between particles and grid.
        transfer: OneOrMany<TransferChoice>,
        /// Time scheme: when stresses are updated.
        scheme: OneOrMany<SchemeName>,
        /// Time for which the velocity at t = 0 stands; `at_zero` unless stated.
        start: Option<OneOrMany<Start>>,
        /// Mass matrix; `lumped` unless stated.
        mass: Option<OneOrMany<MassName>>,
        /// Frame; `updated_lagrangian` unless stated.
        frame: Option<OneOrMany<FrameName>>,
    },
    /// Finite elements in one dimension.
    Fem {
        /// Element.
        element: OneOrMany<Element>,
        /// Mass matrix.
        mass: OneOrMany<Mass>,
        /// Equation of motion; that of the truth unless stated.
        law: Option<OneOrMany<EquationName>>,
        /// Time for which the velocity at t = 0 stands; `at_zero` unless stated.
        start: Option<OneOrMany<Start>>,
        /// Points at which the error is taken.
        sampling: Option<OneOrMany<Sampling>>,
    },
    /// MPM of a body at rest, in which heat flows.
    Heat {
        /// Basis functions.
        basis: OneOrMany<BasisName>,
    },
    /// A solver that is not of this crate, which the command line starts.
    External {
        /// Its name, a part of the case's.
        name: String,
        /// Order that theory gives its displacements; 2 unless stated.
        formal_order: Option<NumberText>,
        /// Precision of its numbers.
        precision: Option<Precision>,
    },
}
