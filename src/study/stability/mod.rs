//! The stability study: every row of every case, run and judged.

mod handed;
pub(crate) mod run;
pub(crate) mod runner;
