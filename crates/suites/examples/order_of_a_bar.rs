//! Runs a suite and prints the observed order of each case.

use mpm_suites::study::Runner;
use mpm_suites::suite::Suite;
use mpm_suites::suite::yaml::{Diagnostic, Source};

const TEXT: &str = r#"
suite: my-bar
title: A vibrating bar
source: "one mode of an elastic bar, fixed on the left"
parameters: {L: 25, E: 100, rho: 1, v0: 0.1, omega: "pi/(2*L)*sqrt(E/rho)"}
scene:
  dimension: 1
  body: {box: {from: [0], to: [L]}}
  material: {corotated: {young: E, poisson: 0, density: rho}}
  boundary: {left: fixed}
exact: {equation: corotated, displacement: ["v0/omega*sin(pi*X/(2*L))*sin(omega*t)"]}
run: {until: 0.5, dt: 0.004*h}
refine: {cells: [5, 10, 20, 40], ppc: 4}
methods: [{mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}}]
expect: [{order: [1.9, 2.1], because: "linear functions, and no particle crosses cells"}]
"#;

fn main() -> Result<(), Diagnostic> {
    let suite = Suite::load(&Source::from_text("my-bar.yaml", TEXT)?)?;
    for case in &Runner::new(&suite).run(&|| ()).cases {
        let judgement = &case.convergence().expect("each case has levels").judgement;
        let order = judgement.order.map_or(f64::NAN, |order| order.value);
        println!("{}: {}, order {order:.2}", case.case, judgement.verdict);
    }
    Ok(())
}
