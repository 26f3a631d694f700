//! Invalid keys, names and types.

use super::refuse_all;
use crate::common::{built_in_source, valid_suite};

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar
until: → ▸untill: ⇒ unknown key `untill` … did you mean `until`?
judge: → ▸judges: ⇒ unknown key `judges` … did you mean `judge`?
{young: E, poisson: 0, density: rho} → ▸{young: E, poisson: 0}
⇒ missing key `density` in `linear_elastic` … add `density: 1` in `linear_elastic`
suite: bar → ▸suite: bar
refine: {cells: [6, 12], ppc: 4}\n →
⇒ missing key `refine` … add `refine: {cells: [8, 16, 32, 64], ppc: 4}`
{until: 0.5, → ▸{ ⇒ a run needs an end … add `until`
[6, 12] → ▸[] ⇒ an empty list selects nothing … at least one value
basis: linear → basis: ▸liner ⇒ unknown name `liner` … did you mean `linear`?
- fem: → - ▸fme: ⇒ unknown name `fme` … did you mean `fem`?
suite: bar → suite: bar\nstudy: ▸convergance
⇒ unknown name `convergance` … did you mean `convergence`?
too_few_levels → ▸too_few_level ⇒ `too_few_level` is not a verdict … did you mean `too_few_levels`?
too_few_levels → ▸wonderful ⇒ `wonderful` is not a verdict … known verdicts: converging, too_good,
left: fixed → ▸lefft: fixed ⇒ a body of dimension 1 has no face `lefft` … did you mean `left`?
left: fixed → ▸top: fixed ⇒ a body of dimension 1 has no face `top` … known faces: left, right
boundary: {left: fixed} → boundary: {left: fixed}\n  loads: [{traction: {on: ▸rigth, value: [1]}}]
⇒ no face `rigth` … did you mean `right`?
suite: bar → suite: ▸vibrating bar
⇒ this is not a name for a suite … expected lower-case letters, digits and hyphens
suite: bar → suite: ▸../bar ⇒ this is not a name for a suite
@grid-crossing
study: internal_force\n →
internal_force: → ▸internal_force:
⇒ unknown key `internal_force`
volume: Omega → volume: ▸"-Omega" ⇒ a particle's volume is -0.125, but must be above zero
because: > → because: ▸"" #
the gradients of → # the gradients of
force jumps when → # force jumps when
⇒ `because` is empty: state the reason for this expectation
- mpm: {basis: [linear, ugimp, cpgimp, cpdi, quadratic_bspline, cubic_bspline
   → ▸- mpm: {basis: [linear, linear
⇒ the case `mpm-linear` appears twice
\n  - mpm: {basis: [linear, ugimp, cpgimp, cpdi, quadratic_bspline, cubic_bspline]} →  ▸[]
⇒ the suite has no cases: `methods` is empty
case: mpm-linear\n    agrees_within: 1e-14
   → ▸case: mpm-linear\n    agrees_within: 1e-14\n    steps_below: 1
⇒ expected either `agrees_within` or `steps_below`
positions: 16 → positions: ▸1e7
⇒ 10000000 positions with 4 particles per cell each … expected at most 1000000
parameters: → parameters:\n  ▸n_left: 4 ⇒ `n_left` is a variable of formulas and cannot be declared
# Formulas, parameters and functions.
@bar
*sin(omega*t)" → *sin(omega*t▸" ⇒ expected `,` or `)`, found the end of the formula
L: 25 → L: 25▸,5 ⇒ expected an operator or the end of the formula, found `,`
v0/omega* → v0/▸omgea* ⇒ unknown name `omgea` … did you mean `omega`? declared: `omega`,
v0*mode(X) → v0*▸mod(X) ⇒ unknown function `mod` … did you mean `mode`?
mode(X)* → mode(▸x)* ⇒ unknown name `x` … did you mean `X`?
mode(X)* → mode(▸Y)* ⇒ unknown name `Y` … the variables are `X`, `t`
dt: 1e-3 → dt: ▸t ⇒ unknown name `t` … the variables are `h`
L: 25 → L: "▸E/4" ⇒ unknown name `E` … `E` is declared further down (line 7): move it up
E: 100 → E: "▸M*4" ⇒ unknown name `M` … there are no variables here; declared: `L`
young: E → young: "E*▸X"
⇒ unknown name `X` … for several materials, list several `bodies` in `scene`
sin(pi*s/(2*L)) → sin(pi*s/(2*▸v0))
L: 25 → L: "25*mode(1)"
⇒ unknown name `v0` … `v0` is declared further down (line 9): move it up
rho: 1 → rho: 1\n  ▸nu: 0.3 ⇒ the parameter `nu` is never used … remove it, or use it
functions: → functions:\n  ▸spare(s): "s^2"
⇒ the function `spare` is never used … remove it, or use it
functions: → functions:\n  spare(s): "s^▸" ⇒ expected a value, found the end of the formula
sin(pi*s/(2*L)) → sin(pi*▸mode(s)/(2*L)) ⇒ functions may not be recursive: `mode` calls `mode`
"sin(pi*s/(2*L))" → "other(s)"\n  other(s): "▸mode(s)"
⇒ functions may not be recursive: `mode` calls `other` calls `mode`
sin(pi*s/(2*L)) → sin(pi*▸S/(2*L)) ⇒ unknown name `S` … did you mean `s`?
v0*mode(X) → v0*▸mode(X, t) ⇒ `mode` takes 1 argument, not 2
rho: 1 → rho: 1\n  ▸sin: 1 ⇒ `sin` is already a builtin name
rho: 1 → rho: 1\n  ▸pi: 3 ⇒ `pi` is already a builtin name
rho: 1 → rho: 1\n  ▸t: 3
⇒ `t` is a variable of formulas and cannot be declared … rename it; the variables are X, t
rho: 1 → rho: 1\n  ▸h: 3 ⇒ `h` is a variable of formulas and cannot be declared
functions: → functions:\n  ▸X(s): "s^2" ⇒ `X` is a variable of formulas and cannot be declared
mode(s): → ▸mode s:
⇒ `mode s` is not a function declaration … write the name and its arguments: `s(tau)`
mode(s): → ▸mode(): ⇒ `mode()` lacks a name or an argument … `s(tau)`
mode(s): → ▸(s): ⇒ `(s)` lacks a name or an argument
mode(s): → ▸"mode(s,)": ⇒ `mode(s,)` lacks a name or an argument
mode(s): → ▸mode(2s): ⇒ `2s` is not a name … a name is made of ASCII letters, digits and `_`
functions: → functions:\n  mode(x): "x"
mode(s) → ▸mode(s)
⇒ `mode` is already a function
["v0/omega*mode(X)* → [▸"sum(k, 1, 99999, sin(k*X))*
⇒ this formula takes … expected at most 5000: shorten its sums
# Numbers that are invalid for their key.
@bar ▸"pi/(2*L)
density: rho → density: ▸-1 ⇒ the density is -1, but must be above zero … expected a positive number
rho: 1 → rho: -1
⇒ `omega` is NaN because `rho` is -1 … expected a finite number … `rho` is -1 (line 8)
E: 100 → E: -100 ⇒ `omega` is NaN because `E` is -100 … `E` is -100 (line 7)
L: 25 → L: 0 ⇒ `omega` is inf because `L` is 0 … `L` is 0 (line 6)
E: 100 → E: 25
rho: 1 → rho: 1\n  k: ▸"1/(E - L)"
⇒ `k` is inf because `E` is 25 and `L` is 25 … `E` is 25 (line 7), `L` is 25 (line 6)
sin(pi*s/(2*L)) → asin(s*v0)
v0: 0.1 → v0: 3
until: 0.5 → until: ▸"mode(1)"
⇒ `mode(1)` is NaN because `v0` is 3 … `v0` is 3 (line 9)
rho: 1 → rho: 1\n  k: ▸"0*E/0" ⇒ `0*E/0` is NaN, which is not finite … `E` is 100 (line 7)
E: 100 → E: -100
sqrt(E/rho) → sqrt(-E/rho)
young: E → young: ▸E
⇒ Young's modulus is -100, but must be above zero … `E` is -100 (line 7)
[6, 12] → [6, ▸"E/40"] ⇒ the number of cells is 2.5 … `E` is 100 (line 7)
[6, 12] → [▸0, 12] ⇒ the number of cells is 0 … expected a whole number from 1
[6, 12] → [6, ▸2.5] ⇒ the number of cells is 2.5
[6, 12] → [6, ▸1e300] ⇒ the number of cells is 1e300 … from 1 to 1e7
[6, 12] → [6, 12, ▸6] ⇒ a level with 6 cells appears twice … the second time
ppc: 4 → ppc: ▸0 ⇒ the number of particles per cell is 0 … expected a whole number from 1
v0: 0.1 → v0: ▸"1/0" ⇒ `1/0` is inf, which is not finite
poisson: 0 → poisson: ▸"0/0" ⇒ `0/0` is NaN, which is not finite
E: 100 → E: ▸1e999 ⇒ the number `1e999` is too large
poisson: 0 → poisson: ▸0.5 ⇒ Poisson's ratio is 0.5 … expected a number above -1 and below 0.5
dt: 1e-3 → dt: ▸0 ⇒ with 6 cells the time step is 0 … expected a positive step
dt: 1e-3 → dt: ▸1e-300 ⇒ with 6 cells the time step is 1e-300 … at most 1e9 of them
dt: 1e-3 → dt: ▸"0/0" ⇒ the time step is NaN
dt: 1e-3 → dt: ▸"0.5*h/(E - E)" ⇒ with 6 cells the time step is inf … expected a positive step
boundary: {left: fixed} → boundary: {left: fixed}\n  loads: [gravity: [▸"1/0"]]
⇒ `1/0` is inf, which is not finite … expected a finite number
{left: fixed} → {left: fixed}\n  loads: [traction: {on: right, value: ["1/(t - t)"]}]
["v0/omega → [▸"v0/omega
⇒ right is loaded, traction in X … expected inf … off by -inf
E: 100 → E: ▸1_000 ⇒ digits are not grouped: write `1000`
E: 100 → E: "2*▸1_000_000" ⇒ digits are not grouped: write `1000000`
E: 100 → E: "1▸,5" ⇒ a decimal point is written `.`: `1.5`
E: 100 → E: "2*(1▸,5 + 3)" ⇒ a decimal point is written `.`: `1.5`
dt: 1e-3 → dt: ▸"1e-3*(4 - h)" ⇒ with 6 cells the time step is -0.001
until: 0.5 → until: ▸-0.5 ⇒ the end of the run is -0.5, but must be above zero
until: 0.5 → until: [0.5, ▸0] ⇒ the end of the run is 0
until: 0.5 → until: [0.5, ▸"1/2"] ⇒ the end 0.5 s appears twice
until: 0.5, dt: 1e-3 → until: 1e300, dt: 1e297
["v0/omega → [▸"v0/omega
⇒ t = … e29
instants: 50 → instants: ▸0 ⇒ the number of instants is 0 … expected a whole number from 1
instants: 50 → instants: ▸1e300 ⇒ the number of instants is 1e300
dimension: 1 → dimension: ▸4 ⇒ a scene of dimension 4 … expected 1, 2 or 3
dimension: 1 → dimension: ▸1.5 ⇒ a scene of dimension 1.5 … expected 1, 2 or 3
small_strain → small_strain\n  tolerance: ▸1
⇒ a tolerance of 1 would let a wrong solution pass … expected at most 1e-2
@oedometer
cells: 640 → cells: ▸0 ⇒ the number of elements is 0
640, dt: "0.3*h/c" → 640, dt: ▸0 ⇒ with 640 cells the time step is 0 … expected a positive step
640 → ▸1e7 ⇒ 10000000 elements at 167 instants are too many to store … expected at most 5e7
@plate
ppc: 4 → ppc: ▸3 ⇒ 3 particles per cell cannot be equally spaced … expected n^2 in 2-D
# Convergence and stability studies both have a key `run`, with different sub-keys.
@tiny-nodal-mass
suite: → ▸suite:
run: {dt: "C*h/c", steps: 500, full_steps: 10000, frozen: true}\n →
⇒ missing key `run` … add `run: {dt: 1e-3, steps: 1000}`
# Loads that depend on the displacement: invalid names, and exact solutions for another load.
@elastic-foundation [▸"v0/omega
"3*E*k^2" → "2*E*k^2"
-kf*ux/rho → -1.01*kf*ux/rho
⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b, … m/s2 (off by
-kf*ux/rho → kf*ux/rho ⇒ equation of motion in X … solved for b,
["-kf*ux/rho"] → ["-kf*▸uy/rho"] ⇒ unknown name `uy`
body_force: ["-kf*ux/rho"] → gravity: ["-kf*▸ux/rho"] ⇒ unknown name `ux`
{left: fixed, right: fixed} → {left: fixed}
body_force: ["-kf*ux/rho"] → traction: {on: right, value: ["-kf*▸ux"]}
⇒ unknown name `ux`
v0: 1e-4 → ▸ux: 2\n  v0: 1e-4
⇒ `ux` is a variable of formulas and cannot be declared … rename it; the variables are X, t, ux
"#;

/// If no load uses the name, the suite may declare it like any other name.
#[test]
fn a_suite_without_such_a_load_may_declare_the_name() {
    let text = built_in_source("elastic-foundation")
        .text()
        .replace("-kf*ux/rho", "-kf*v0/omega*sin(k*X)*sin(omega*t)/rho");
    let text = text.replace("  v0: 1e-4", "  ux: 2\n  v0: 1e-4");
    let text = text.replace("until: \"pi/omega\"", "until: \"ux/2*pi/omega\"");
    valid_suite(&text);
}
