//! Heat, bodies at rest, and thermal expansion.

use super::refuse_all;
use crate::common::valid_suite;

/// A bar at rest that cools through one end.
const COOLED: &str = include_str!("../../../verification/heat/heat-convection.yaml");

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@heat-convection temperature: ▸"Ta
mu: 0.860333589019380 → mu: 0.860334 ⇒ right is cooled by convection … this is not a solution
{right: {convection: {coefficient: b, ambient: Ta}}} → {right: {temperature: Ta}}
⇒ right has a given temperature … K (off by
boundary: {right: {convection: {coefficient: b, ambient: Ta}}} → boundary: {right: insulated}
⇒ right is insulated, but the heat inflow is another one … W/m2 (off by
boundary: {right: {convection: {coefficient: b, ambient: Ta}}} → boundary: {}
material → boundary: {left: periodic, right: periodic}\n  material
⇒ left is periodic, but the temperature differs … K (off by
c: 4 → c: 5
kappa: "k/(rho*c)" → kappa: "k/(rho*4)"
⇒ heat equation, rho0 c T_t = Div(k Grad T) + rho0 s … W/kg
initial: "Ta + 5* → initial: "Ta + 6* ⇒ initial condition T(X, 0) = T0(X)
loads: → ▸loads:
temperature: "Ta + 5*cos(mu*X/L)*exp(-kappa*(mu/L)^2*t)" → tolerance: 1e-8
⇒ the scene has `heat`, but no temperature is stated
conductivity: k → conductivity: ▸-1 ⇒ the conductivity is -1
capacity: c → capacity: ▸0 ⇒ the heat capacity is 0
coefficient: b, → coefficient: ▸-2, ⇒ the coefficient of convection is -2
boundary: {right: {convection: {coefficient: b, ambient: Ta}}} → boundary: {▸top: insulated}
⇒ a body of dimension 1 has no face `top`
boundary: {right: {convection: {coefficient: b, ambient: Ta}}} → boundary: {right: {▸heated: 3}}
⇒ heated … insulated … temperature … flux … convection
- heat: → - heat: {conductivity: 1, capacity: 1}\n    - ▸heat: ⇒ heat appears twice
loads: → boundary: {▸left: fixed}\n  loads:
⇒ the left face is fixed, but a `rigid` body does not move … choose another material
loads: → ▸initial_velocity: [1]\n  loads: ⇒ `initial_velocity` is not supported for a `rigid` body
loads: → loads:\n    - ▸gravity: [1] ⇒ this load is not supported for a `rigid` body
heat: {basis: [linear, cpgimp, quadratic_bspline, cubic_bspline]
   → ▸mpm: {basis: linear, transfer: flip, scheme: musl
⇒ a `rigid` body does not move … `heat: {basis: linear}`
judge: {of: temperature}\n →
material: {rigid → material: ▸{rigid
⇒ the judged quantity needs a motion, but the body is `rigid` … judge: {of: temperature}
methods: → ▸observe: {at: [0]}\nmethods: ⇒ this key needs a motion, but the body is `rigid`
temperature: "Ta + 5*cos → ▸displacement: [X*t]\n  temperature: "Ta + 5*cos
⇒ this key needs a motion, but the body is `rigid`
order: [1.95, 2.05] → order: [1.95, 2.05]\n    ▸drift: {mass: 1e-9}
⇒ a body at rest has no motion whose sums could drift
@thermal-fin
source: "-b*(T - Ta)/rho" → source: "-2*b*(T - Ta)/rho"
exact:\n  temperature: "Ta → exact:\n  temperature: ▸"Ta
⇒ heat equation, rho0 c T_t = Div(k Grad T) + rho0 s … this is not a solution
source: "-b*(T - Ta)/rho" → source: "-b*(▸warmth - Ta)/rho"
⇒ unknown name `warmth` … the variables are `X`, `t`, `T`
Ta: 20 → ▸T: 20\n  Ta: T
⇒ `T` is a variable of formulas and cannot be declared … the variables are X, t, T
exact: → manufactured:
manufactured:\n  temperature: "Ta → manufactured:\n  ▸temperature: "Ta
⇒ the manufactured temperature defines the source: remove `source`
# Only heat sources may use the temperature `T`.
source: "-b*(T - Ta)/rho" → initial: ▸T ⇒ unknown name `T`
conductivity: k → conductivity: k*▸T ⇒ unknown name `T`
{left: {temperature: "Ta + base"}} → {left: {flux: ▸T}} ⇒ unknown name `T`
cosh(m*L) + → cosh(m*L) + 0*▸T + ⇒ unknown name `T`
@heat-2d
capacity: c → capacity: c\n        source: 1
temperature: "T0 → ▸temperature: "T0
⇒ the manufactured temperature defines the source: remove `source`
bottom: {flux: "-k* → bottom: {flux: "k*
temperature: "T0 → temperature: ▸"T0
⇒ bottom has a given flux
body: {box: {from: [0, 0], to: [1, 1]}} → body: {disk: {centre: [0, 0], radius: 1}}
- heat: → - ▸heat:
⇒ heat is supported in a `box` only, but the body is of kind `disk`
to: [1, 1]}} → to: [1, 0.9]}}
cells: [4, → cells: [▸4,
+ w(X, t)*sin(Y + 1/2) → + 0*w(X, t)*Y
bottom: {flux: "-k*w(X, t)*cos(1/2)"} → bottom: insulated
b, ambient: "T0 + w(X, t)*(sin(3/2) + k/b*cos(3/2))"}} → b, ambient: T0}}
⇒ the top face, which is at rest … expected a cell size that divides the length
@thermal-expansion-mms - ▸thermal_expansion: {coefficient: alpha, reference: T0}
right: fixed} → top: fixed}
boundary: {left: fixed, top: fixed} → boundary: {left: fixed}
right: {conv → ▸right: {conv
⇒ the right face is free, but heat can enter only at a face of the grid … leave it insulated
scheme: musl} → scheme: musl, frame: ▸total_lagrangian} ⇒ `total_lagrangian` does not support heat
transfer: flip → transfer: ▸tls ⇒ a transfer that integrates over cells does not support heat
mpm: {basis: [linear, cpgimp, quadratic_bspline], transfer: flip, scheme: musl
   → ▸fem: {element: linear, mass: lumped
⇒ the built-in FEM does not support heat
mpm: {basis: [linear, cpgimp, quadratic_bspline], transfer: flip, scheme: musl
   → ▸heat: {basis: linear
⇒ a `neo_hookean` body moves … use `mpm`
displacement: ["A*sin(pi*X)*sin(w*t)"] → # no displacement
\nmanufactured: → \n▸manufactured:
⇒ a body that moves needs a `displacement`
reference: T0} → reference: T0}\n    - ▸thermal_expansion: {coefficient: 1, reference: 0}
⇒ thermal expansion appears twice
poisson: 0, density → poisson: 0.3, density
⇒ in 1-D `thermal_expansion` of a `neo_hookean` body needs a Poisson's ratio of 0
neo_hookean: {young: E, poisson: 0, density: → newtonian: {bulk: E, viscosity: 1, density:
⇒ `thermal_expansion` does not support the law `newtonian`
- heat:\n        conductivity: k\n        capacity: c\n        boundary:\n
            left: {temperature: "T0 + dT*exp(-t)"}\n
            right: {convection: {coefficient: 2, ambient: "T0 - dT*exp(-t)"}}\n    - thermal_e
   → - ▸thermal_e
⇒ `thermal_expansion` needs `heat`, which is not listed
@thermal-expansion-clamped
# A free edge has no traction. A heated plate that does not move would have one.
bottom: fixed, top: fixed} → bottom: fixed}
displacement: [0, 0] → displacement: [▸0, 0]
⇒ top is free, traction in Y
"#;

/// If the source does not use `T`, a suite may declare its own `T`.
#[test]
fn source_without_temperature_may_use_the_name() {
    let own = COOLED.replace("  Ta: 20", "  T: 20\n  Ta: T");
    let sourced = own.replace("capacity: c\n", "capacity: c\n        source: 0*X\n");
    assert!(own != COOLED && sourced != own);
    valid_suite(&sourced);
}
