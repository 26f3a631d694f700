//! Solvers of other programs, as shell scripts: sound ones, and every way to misbehave.

mod library;
#[cfg(unix)]
mod misbehaving;
#[cfg(unix)]
mod program;

/// A suite of four levels in one dimension.
pub(crate) const BAR: &str = r#"suite: short-bar
title: Short bar
source: a textbook
parameters: {omega: "5*pi"}
scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  material: {linear_elastic: {young: 100, poisson: 0, density: 1}}
  boundary: {left: fixed}
  initial_velocity: ["1e-3*sin(pi*X/2)"]
exact:
  equation: small_strain
  displacement: ["1e-3*sin(pi*X/2)*sin(omega*t)/omega"]
run: {until: 0.05, dt: "h/250"}
refine: {cells: [4, 6, 8, 12], ppc: 4}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}
"#;
