//! Solvers in other programs, as shell scripts: correct ones, and violations of every rule.

#[cfg(unix)]
mod differentiate;
mod doctor;
#[cfg(unix)]
mod gate;
mod gradient;
mod handover;
mod library;
#[cfg(unix)]
pub(crate) mod misbehaving;
#[cfg(unix)]
mod program;
mod repeat;
#[cfg(unix)]
mod results;
#[cfg(unix)]
mod several;
mod single_precision;
mod spectrum;
#[cfg(unix)]
mod values;

/// Creates a suite of four levels in one dimension, with steps proportional to the cells.
fn bar() -> String {
    crate::cli::BAR.replace("until: 0.05, dt: 1e-3", "until: 0.004, dt: \"h/250\"")
}
