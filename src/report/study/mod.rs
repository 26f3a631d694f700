//! Kinds of study in reports: the list of all.

pub(crate) mod convergence;
pub(crate) mod internal_force;
pub(crate) mod kind;
pub(crate) mod stability;

use self::convergence::ConvergenceReport;
use self::internal_force::InternalForceReport;
use self::kind::StudyReport;
use self::stability::StabilityReport;

/// Every kind of study.
pub(crate) const KINDS: [&dyn StudyReport; 3] =
    [&ConvergenceReport, &InternalForceReport, &StabilityReport];
