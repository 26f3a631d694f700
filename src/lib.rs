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
//! The walls: [`mpm`] and [`fem`] are subjects and know nothing but [`subject`], and so does
//! [`external`], which hands problems to solvers of others; [`exact`] is the truth and knows no
//! solver; [`verify`] is the judge and knows no particular subject; [`suite`] says what is to be
//! run and [`study`] runs it; [`report`] knows results only.
//!
//! # Judging a solver of your own
//!
//! A program in any language takes part by the protocol of `docs/protocol.md`. A solver in Rust
//! is put under every suite by a [`external::SolverFactory`], which gets each level ready to be
//! stepped. Without suites: implement [`subject::Subject`], put it on a series of grids, and ask
//! the judge. Here the subject is an oscillator `u_tt = -w^2 u` stepped by leapfrog, and time is
//! what is refined:
//!
//! ```
//! use mpm_verify::exact::Truth;
//! use mpm_verify::prelude::*;
//! use mpm_verify::verify::{Clock, Comparison, Level, OrderHypothesis, judge, run};
//!
//! const W: f64 = 3.0;
//!
//! struct Leapfrog { u: f64, v: f64, steps: u64 }
//!
//! impl Subject for Leapfrog {
//!     fn step(&mut self, dt: f64) -> Result<(), Failure> {
//!         self.u += 0.5 * dt * self.v;
//!         self.v -= dt * W * W * self.u;
//!         self.u += 0.5 * dt * self.v;
//!         self.steps += 1;
//!         Ok(())
//!     }
//!
//!     fn sample(&self, samples: &mut Samples) {
//!         samples.restart(1);
//!         samples.push(&[0.0], &[self.u], &[self.v], 1.0);
//!     }
//!
//!     fn counters(&self) -> RunCounters {
//!         RunCounters::new(self.steps)
//!     }
//! }
//!
//! struct Sine;
//!
//! impl Truth for Sine {
//!     fn displacement(&self, _: &[f64], t: f64, u: &mut [f64]) { u[0] = libm::sin(W * t) / W; }
//!     fn velocity(&self, _: &[f64], t: f64, v: &mut [f64]) { v[0] = libm::cos(W * t); }
//! }
//!
//! let levels: Vec<Level> = [0.1, 0.05, 0.025, 0.0125]
//!     .map(|dt| {
//!         let mut subject = Leapfrog { u: 0.0, v: 1.0, steps: 0 };
//!         let clock = Clock::new(1.0, dt, 10).expect("a usable step");
//!         let found = run(&mut subject, &Sine, &clock, &Comparison::default());
//!         Level::new(clock.dt(), found.errors.rms)
//!     })
//!     .into();
//! let found = judge(&levels, &OrderHypothesis::formal(2.0));
//! assert_eq!(found.verdict, Verdict::Converging, "{}", found.reason);
//! ```

pub mod study;
pub mod subject;

pub mod external;
pub mod fem;
pub mod mpm;

pub mod exact;
pub mod verify;

pub mod report;
pub mod suite;

pub mod prelude;
pub mod testing;

mod dimension;
mod members;
mod named;
mod nearest;

pub use nearest::nearest;
