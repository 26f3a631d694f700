//! The stability study: runs and judges every row of every case.

mod handed;
pub(crate) mod run;
pub(crate) mod runner;
