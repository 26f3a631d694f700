//! Loads that depend on the displacement: their effect in this solver and on the stable time step.

use crate::common::{cases, levels};
use rstest::rstest;

/// A free bar on springs that act on its whole displacement, in six steps of 1/w. The leapfrog of
/// an oscillator advances the phase by 2 asin(w dt/2) per step, here by 60 degrees. After six steps
/// the bar is at its start again, while the exact phase has advanced by 6 radians.
const FREE: &str = r#"suite: free
title: Free bar
source: a test
parameters: {a: 1e-3, w: 100}
scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  grid: {from: [-0.5], to: [1.5]}
  material: {linear_elastic: {young: 1, poisson: 0, density: 1}}
  loads: [{body_force: ["-w^2*ux"]}]
  initial_displacement: [a]
exact: {equation: small_strain, displacement: ["a*cos(w*t) + 0*X"]}
run: {until: "6/w", dt: "1/w", instants: 6}
refine: {cells: [4, 6, 8, 12], ppc: 2}
methods:
  - mpm:
      basis: [linear, cpgimp, cubic_bspline]
      transfer: [flip, apic]
      scheme: [usl, musl]
      start: half_step_back
  - mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian, start: half_step_back}
  - fem: {element: linear, mass: consistent, start: half_step_back}
"#;

/// A plate with forces towards a point. Formulas of x give the point for each particle.
const PLATE: &str = r#"suite: plate
title: Free plate
source: a test
parameters: {a: 1e-3, w: 100}
scene:
  dimension: 2
  body: {box: {from: [0, 0], to: [1, 1]}}
  grid: {from: [-0.5, -0.5], to: [1.5, 1.5]}
  material: {neo_hookean: {young: 1, poisson: 0.3, density: 1}}
  loads: [{body_force: ["w^2*(X - (X + ux))", "w^2*(Y - (Y + uy))"]}]
exact: {equation: neo_hookean, displacement: ["a*cos(w*t) + 0*X", "-2*a*cos(w*t) + 0*Y"]}
run: {until: "6/w", dt: "1/w", instants: 6}
refine: {cells: [4, 6], ppc: 4}
methods:
  - mpm: {basis: [linear, cpdi, quadratic_bspline], transfer: flip, scheme: musl, start: half_step_back}
"#;

/// A bar between walls on springs that are much stiffer than the bar.
const STIFF: &str = r#"suite: stiff
title: Stiff foundation
source: a test
parameters: {v0: 1e-6, k: "pi", w: 200, omega: "sqrt(k^2 + w^2)"}
scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  material: {linear_elastic: {young: 1, poisson: 0, density: 1}}
  boundary: {left: fixed, right: fixed}
  loads: [{body_force: ["-w^2*ux"]}]
  initial_velocity: ["v0*sin(k*X)"]
exact: {equation: small_strain, displacement: ["v0/omega*sin(k*X)*sin(omega*t)"]}
run: {until: "100/omega", dt: {courant: 1}, instants: 4}
refine: {cells: [8, 16], ppc: 2}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: [usl, musl], start: half_step_back}
"#;

#[rstest]
#[case::bar(FREE, 1.0, 14)]
#[case::plate(PLATE, 5.0, 3)]
fn load_uses_the_displacement_of_each_particle(
    #[case] text: &str,
    #[case] square: f64,
    #[case] count: usize,
) {
    let expected = 1e-3 * f64::sqrt(square) * (1.0 - libm::cos(6.0));
    let found = cases(text);
    assert_eq!(found.len(), count);
    for case in &found {
        for level in levels(case) {
            let error = level.run.errors.at_end.rms;
            assert!((error - expected).abs() < 1e-9 * expected, "{}: {error}", case.case);
        }
    }
}

/// The stable step is sqrt(2/(l + w^2)), with l = 4/h^2 at most for the bar. Without springs, a
/// wave crosses a cell of 1/8 in 25 times this step.
#[test]
fn the_stable_step_knows_the_stiffness_of_a_load() {
    for case in &cases(STIFF) {
        for level in levels(case) {
            let cells = 4.0 / (level.h * level.h);
            let [least, most] = [cells, 0.0].map(|l| (2.0 / (l + 4e4_f64)).sqrt());
            let is_near = (0.95 * least..1.02 * most).contains(&level.dt);
            assert!(is_near, "{}: {}", case.case, level.dt);
            let error = level.run.errors.at_end.rms * 200.0;
            assert!(error < 3e-6, "{}: it stays bounded: {error}", case.case);
        }
    }
}
