//! Verification of Material Point Method solvers: which order does a solver have, where does it
//! stop having it, and did a change break it?
//!
//! The way of the data, in the order of the modules below:
//!
//! ```text
//! verification/*.yaml
//!   -> suite::Suite       what the file says, checked, with file:line:column for every complaint
//!   -> suite::Runner      one case for each member of the product of its lists; names -> types
//!   -> verify::run        the subject on every level of the refinement plan, against the truth
//!   -> verify::judge      observed against formal order: a verdict, with the figures behind it
//!   -> report             the text kept as a snapshot; JSON; figures
//! ```
//!
//! The walls: [`mpm`] and [`fem`] are subjects and know nothing but [`subject`]; [`exact`] is the
//! truth and knows no solver; [`verify`] is the judge and knows no particular subject; [`suite`]
//! is the only one that knows all; [`report`] knows results only.

pub mod subject;

pub mod fem;
pub mod mpm;

pub mod exact;
pub mod verify;

pub mod report;
pub mod suite;

mod named;
