//! Verification of Material Point Method solvers: does a solver converge to the right answer, how
//! fast, and did a change break it?
//!
//! A solver runs on problems with a known exact solution, on a series of refined grids. The errors
//! give the observed order of accuracy with a confidence interval, and a verdict. Users of the
//! program start with the README; `bash ci/book` builds a book of all pages.
//!
//! # From a suite to a report
//!
//! A suite is a YAML file: a problem with its solution, methods, and expectations.
//!
//! ```
//! use mpm_verify::prelude::*;
//!
//! let text = r#"
//! suite: my-bar
//! title: A vibrating bar
//! source: "one mode of an elastic bar, fixed on the left"
//! parameters: {L: 25, E: 100, rho: 1, v0: 0.1, omega: "pi/(2*L)*sqrt(E/rho)"}
//! scene:
//!   dimension: 1
//!   body: {box: {from: [0], to: [L]}}
//!   material: {corotated: {young: E, poisson: 0, density: rho}}
//!   boundary: {left: fixed}
//! exact: {equation: corotated, displacement: ["v0/omega*sin(pi*X/(2*L))*sin(omega*t)"]}
//! run: {until: 0.5, dt: 0.004*h}
//! refine: {cells: [5, 10, 20, 40], ppc: 4}
//! methods: [{mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}}]
//! expect: [{order: [1.9, 2.1], because: "linear functions, and no particle crosses cells"}]
//! "#;
//! let suite = Suite::load(&Source::from_text("my-bar.yaml", text)?)?;
//! let outcome = Runner::new(&suite).run(&|| ());
//! assert!(outcome.passed());
//! # Ok::<(), Diagnostic>(())
//! ```
//!
//! The modules, in the order of the data flow:
//!
//! ```text
//! suite    checks the file, and reports each error with its line; inserts the given solution
//!          into the equation of motion
//! study    makes one case per combination of listed values; sets up and runs the solvers
//! verify   computes errors on every level, compares observed and formal order, gives a verdict
//! report   writes text (the snapshot), JSON, drawings and an HTML page; compares two runs
//! ```
//!
//! Dependencies: the solvers [`mpm`] and [`fem`] import only [`subject`], the interface of solvers.
//! So does [`external`], which passes problems to external solvers. [`exact`] contains the exact
//! solutions and imports no solver. [`verify`] judges results of any solver. [`suite`] describes
//! what [`study`] runs, and [`report`] uses results only.
//!
//! # Judging a solver of your own
//!
//! A program in any language is connected through the protocol of `docs/protocol.md`. A solver in
//! Rust runs on every suite through a [`external::SolverFactory`], which initialises each level. To
//! judge a solver without suites, implement [`subject::Subject`], run it at several levels, and
//! call [`verify::judge`]. In this example the subject is an oscillator `u_tt = -w^2 u` with
//! leapfrog steps, and the time step is refined:
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
//!         Level::new(clock.dt(), found.errors.at_end.rms)
//!     })
//!     .into();
//! let found = judge(&levels, &OrderHypothesis::formal(2.0));
//! assert_eq!(found.verdict, Verdict::Converging, "{}", found.reason);
//! ```

pub use mpm_judge::{exact, verify};
pub use mpm_solvers::{fem, mpm};
pub use mpm_subject as subject;
pub use mpm_subject::nearest;
pub use mpm_suites::{external, study, suite};

pub mod embedded;
pub mod prelude;
pub mod report;
pub mod testing;
