//! Suites: YAML files ([`suite`]), the studies that run and judge their cases ([`study`]), and
//! external solvers ([`external`]).
//!
//! `mpm-verify` re-exports the modules, embeds the suites of the repository and adds reports, the
//! command line and test harnesses.

use mpm_judge::{exact, verify};
use mpm_solvers::{fem, mpm};
use mpm_subject as subject;

pub mod external;
pub mod study;
pub mod suite;
#[doc(hidden)]
pub mod vtk;
