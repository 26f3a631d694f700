//! Valid suites, into which tests insert mistakes.

use super::Edits;

/// A valid bar; tests in 1-D insert one mistake each.
pub(super) const BAR: &str = r#"suite: bar
title: Vibrating bar
source: a textbook

parameters:
  L: 25        # length (m)
  E: 100
  rho: 1
  v0: 0.1
  omega: "pi/(2*L)*sqrt(E/rho)"

functions:
  mode(s): "sin(pi*s/(2*L))"

scene:
  dimension: 1
  body: {box: {from: [0], to: [L]}}
  grid: {from: [0], to: [L + 5]}
  material: {linear_elastic: {young: E, poisson: 0, density: rho}}
  boundary: {left: fixed}
  initial_velocity: ["v0*mode(X)"]

exact:
  equation: small_strain
  displacement: ["v0/omega*mode(X)*sin(omega*t)"]

run: {until: 0.5, dt: 1e-3, instants: 50}
refine: {cells: [6, 12], ppc: 4}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}
  - fem: {element: linear, mass: lumped}

judge: {norm: rms}
observe: {at: [12.5]}

expect:
  - case: "mpm-*"
    verdict: too_few_levels
    finest_pair: [1.5, 2.5]
    because: two levels support no claim
  - case: "fem-*"
    verdict: too_few_levels
    because: two levels support no claim
"#;

/// A valid plate, for mistakes that require a second axis.
pub(super) const PLATE: &str = r#"suite: plate
title: Vibrating plate
source: a textbook

parameters:
  omega: "5*pi"

scene:
  dimension: 2
  body: {box: {from: [0, 0], to: [1, 0.5]}}
  material: {linear_elastic: {young: 100, poisson: 0, density: 1}}
  boundary: {left: fixed}
  initial_velocity: ["sin(pi*X/2)", 0]

exact:
  equation: small_strain
  displacement: ["sin(pi*X/2)*sin(omega*t)/omega", 0]

run: {until: 0.1, dt: 1e-3}
refine: {cells: [4, 8], ppc: 4}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}

expect:
  - verdict: too_few_levels
    because: two levels support no claim
"#;

/// Changes the plate to a cube that fills a 3-D grid.
pub(super) const CUBE: Edits<'_> = &[
    ("dimension: 2", "dimension: 3"),
    ("[0, 0], to: [1, 0.5]", "[0, 0, 0], to: [1, 1, 1]"),
    ("\", 0]", "\", 0, 0]"),
    ("omega\", 0]", "omega\", 0, 0]"),
    ("ppc: 4", "ppc: 8"),
];

/// A suite with a particle that moves through a node.
pub(super) const FORCE: &str = include_str!("../../../verification/the-talk/grid-crossing.yaml");

/// A bar whose Courant limit is determined.
pub(super) const SWEPT: &str = include_str!("../../../verification/stability/tiny-nodal-mass.yaml");
