//! Stability studies: invalid sweeps, limits and expectations.

use super::{Edits, SWEPT, edited, refuse_all, refuse_in};

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
    refuse_in(&edited(SWEPT, HALVES), IN_HALVES);
}

const MISTAKES: &str = r#"
@tiny-nodal-mass ▸frozen: true
sweep: {d: [ → sweep: {e: ▸[ ⇒ `e` is not a parameter … did you mean
sweep: {d: [0.5 → sweep: ▸{C: [1], d: [0.5 ⇒ `sweep` must vary exactly one parameter
sweep: {d: [0.5, 0.1, 0.02, 0.01, 0.002, 0.001]} → sweep: ▸{} ⇒ exactly one parameter
{parameter: C → {parameter: ▸d ⇒ `d` cannot be the parameter of both
from: 0.01, to: 4 → from: 4, to: ▸4 ⇒ the range ends at 4 and starts at 4
dt: "C*h/c" → dt: ▸"(C - 0.01)*h/c" ⇒ the time step is 0
{d: [0.5, 0.1, → {d: [0.5, 7,
extra: [["4 + d"]] → extra: [▸["4 + d"]]
⇒ at 11 … outside the grid
cells: 10 → cells: 20
extra: [["4 + d"]] → extra: [▸[9]]
⇒ a particle at 9 is outside the grid … expected a position from -2 to 8
\nparticles: →   loads:\n    - gravity: [-1]\n\nparticles: ⇒ a frozen run must start at rest
\nparticles: →   initial_velocity: [1]\n\nparticles: ⇒ a frozen run must start at rest
linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl] → linear, scheme: ▸quasi_static
⇒ a stability study needs time steps
critical: {parameter: C, from: 0.01, to: 4}\n →
critical: {is → ▸critical: {is
⇒ a limit is expected, but the suite has no `critical`
critical: {is: "sqrt(2*d*(1 - d))", within: "0.6*d"} → ▸verdict: stable ⇒ no row is a single run
critical: {is: "sqrt(2*d*(1 - d))", within: "0.6*d"} → critical: ▸{within: 0.1} ⇒ expected both
critical: {above: 1.7, below: 1.8} → critical: ▸{} ⇒ this figure has no bound
critical: {parameter: C, from: 0.01, to: 4}\n →
critical: {is: "sqrt(2*d*(1 - d))", within: "0.6*d"} → figures: {▸energie: {above: 1}}
⇒ unknown figure `energie` … did you mean `energy`?
methods: → show: [▸energie]\nmethods: ⇒ did you mean `energy`?
mpm: {basis: linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl]
   → ▸fem: {element: linear, mass: lumped
⇒ a stability study supports MPM only
dimension: 1 → dimension: 2
from: [0], to: [4] → from: [0, 0], to: [4, 4]
from: [-2], to: [8] → from: [-2, -2], to: [8, 8]
ppc: 2 → ppc: ▸2
⇒ not equally spaced
[flip, pic, apic] → [flip, ▸{fmpm: 0}] ⇒ a series of 0 terms … expected a whole number from 1 to 64
transfer: [flip, pic, apic] → transfer: [flip, {▸fmpn: 2}] ⇒ fmpn
frozen: true → frozen: true, ▸every: 2 ⇒ `every` needs a second step length
frozen: true → frozen: true, alternate: 1, every: ▸1e4 ⇒ expected at most 1000
case: "mpm-linear-apic-*" → ▸any_method: true ⇒ only the last entry can have `any_method`
- case: ["mpm-*gimp-apic-*", → - any_method: true\n    ▸case: ["mpm-*gimp-apic-*",
⇒ an entry with `any_method` applies to no case of the suite
frozen: true → ▸frosen: true ⇒ unknown key `frosen` … did you mean `frozen`?
"#;

const IN_HALVES: &str = r"
ppc: 2 → ppc: 2, ▸extra: [[1]] ⇒ `extra` is supported for a single body only
methods: → show: [▸null_share]\nmethods: ⇒ `null_share` is supported for a single body only
critical: {above: 1.7, below: 1.8} → figures: {null_share: ▸{below: 1}}
⇒ `null_share` is supported for a single body only
frozen: true → ▸frozen: true ⇒ `frozen` is not supported with contact
";

/// Replaces the bar by two halves in contact.
const HALVES: Edits<'_> = &[
    (
        "body: {box: {from: [0], to: [4]}}",
        "contact: {friction: 0}
  bodies:
    - body: {box: {from: [0], to: [2]}}
      material: {linear_elastic: {young: E, poisson: 0, density: rho}}
    - body: {box: {from: [2], to: [4]}}
      material: {linear_elastic: {young: E, poisson: 0, density: rho}}",
    ),
    (
        "  material: {linear_elastic: {young: E, poisson: 0, density: rho}}\n\nparticles",
        "\nparticles",
    ),
    (", extra: [[\"4 + d\"]]", ""),
    ("C*h/c", "C*h/c*d/d"),
];
