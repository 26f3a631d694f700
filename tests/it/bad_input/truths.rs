//! Exact solutions of another problem: the violated condition, its position, and the difference.

use super::samples::{BAR, PLATE};
use super::{Edits, for_each_row, refuse_all, refuse_in, refused};
use crate::common::{edited, valid_suite};

/// Asserts an error with a position, a time and both values, in addition to `words`.
fn violated(sound: &str, edits: Edits<'_>, words: &[&str]) {
    let figures = [" is violated at X = (", "), t = ", "expected ", ", found ", " (off by "];
    let label = ["this is not a solution of the problem that the scene states"];
    refused(sound, edits, &[words, &figures, &label].concat());
}

#[test]
fn mistakes_are_refused() {
    for_each_row("", VIOLATIONS, violated);
    refuse_all(MISTAKES);
    for_each_row(&with_its_force(FORCE), VIOLATIONS_UNDER_A_FORCE, violated);
    refuse_in(&with_its_force(FORCE), UNDER_A_FORCE);
}

const VIOLATIONS: &str = r#"
@bar [▸"v0/omega*
["v0/omega*mode(X)*sin(omega*t)"] → [▸"v0/omega/1.1*mode(X)*sin(1.1*omega*t)"]
⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b … N/m3 (off by
young: E → young: "1.1*E" ⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b
boundary: {left: fixed} → # free ends
⇒ boundary condition: left is free, traction in X … X = (0.000000) … expected 0.000000e0
   … Pa (off by
{left: fixed} → {left: fixed, right: fixed}
[L + 5] → [L]
⇒ boundary condition: right is fixed, u_X = 0 … X = (25.000000) … expected 0.000000e0 … m (off by
["v0/omega*mode(X)*sin(omega*t)"] → [▸"v0/omega*mode(X)*cos(omega*t)"]
⇒ initial condition u_X(X, 0) = 0 … t = 0.000000 … expected 0.000000e0 … m (off by
initial_velocity: → initial_displacement: ["1e-3*X"]\n  initial_velocity:
⇒ initial condition u_X(X, 0) = u0(X) … t = 0.000000 … found 0.000000e0 … m (off by -
"v0*mode(X)" → "2*v0*mode(X)" ⇒ initial condition on the velocity in X … t = 0.000000 … m/s (off by
["v0/omega*mode(X)*sin(omega*t)"] → [▸"sin(X)/t*v0/omega*mode(X)"]
⇒ initial condition u_X(X, 0) = 0 … t = 0.000000 … found inf m (off by inf)
@oedometer - ▸"fall(t) -
["-g"] → ["g"] ⇒ equation of motion in X … expected 1.962000e4, found 0.000000e0 N/m3
max(tau, 0)^2" → max(tau, 0)^2 - max(tau - 0.2, 0)"
⇒ momentum balance across wave fronts (the equation of motion in weak form
@steffen-bar - ▸"sum(k, 0, 2
"sqrt(E/rho)" → "1.05*sqrt(E/rho)"
⇒ momentum balance across wave fronts (the equation of motion in weak form
"p0*c/E → "1.1*p0*c/E
⇒ boundary condition: right is loaded, traction in X … expected 7.000000e-1, found 7.700000e-1 Pa
[p0] → ["-p0"] ⇒ boundary condition: right is loaded, traction in X … expected -7.000000e-1
@mms-fixed-bar-small
"G*sin(pi*X)*sin(c*pi*t)" → ▸"G*cos(pi*X)*sin(c*pi*t)" ⇒ boundary condition: left is fixed, u_X = 0
["G*sin(pi*X)*sin(c*pi*t)"] → [▸"G*sin(pi*X)/t"] ⇒ initial condition u_X(X, 0) = 0 … t = 0.000000
"#;

const MISTAKES: &str = r#"
@bar
["v0/omega*mode(X)*sin(omega*t)"] → [▸0]
initial_velocity: ["v0*mode(X)"] → # at rest
⇒ the displacement is zero everywhere, for example at X = ( … found 0.000000e0 m
["v0/omega*mode(X)*sin(omega*t)"] → [▸"v0/omega*mode(X)*sin(omega*t)*sqrt(0.4 - t)"]
⇒ the displacement is not finite at X = ( … t = 0.4 … found NaN m
@mms-fixed-bar-small ▸manufactured:  #
neo_hookean: {young → linear_elastic: {young
⇒ a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only
   … a law in rate form has no stress
neo_hookean: {young: E, poisson: 0 → j2: {young: E, poisson: 0, yield: 1
⇒ a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only
   … plastic flow depends on the whole history
neo_hookean: {young: E, poisson: 0 → newtonian: {bulk: E, viscosity: 1
⇒ a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only
   … viscous stress depends on the rate
\nmanufactured: →   ▸initial_velocity: [0]\n\nmanufactured:
⇒ the manufactured motion defines the initial velocity
\nmanufactured: →   ▸initial_displacement: [0]\n\nmanufactured:
⇒ the manufactured motion defines the initial displacement
\nmanufactured: →   loads: [{body_force: [0]}]\n\n▸manufactured:
⇒ the manufactured motion defines the body force: remove `body_force`
   … to have a stated force checked
manufactured: → exact: {equation: small_strain, displacement: [0]}\n▸manufactured:
⇒ the suite states both `exact` and `manufactured`: keep one
# Linearised solutions: the residual that the law may have, and the conditions that still need the
# default tolerance.
# The relative residual of this column of water is 2e-6, and its tolerance is 5e-6.
@acoustic-column [▸"mode(X)*cos(
5e-6 → 1e-6
⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b
   … the residual is 2.00e-6 of the terms of the equations, above the stated `tolerance` of 1.00e-6
eps: 1e-6 → eps: 1e-3
⇒ the residual is 2.00e-3 of the terms of the equations, above the stated `tolerance` of 5.00e-6
cos(k*c*t)"] → cos(1.001*k*c*t)"]
⇒ equation of motion in X … of the terms of the equations, above the stated `tolerance` of 5.00e-6
linearised:\n    tolerance: 5e-6\n    because: >\n      strains → # strains
⇒ this is not a solution of the problem that the scene states
   … if the solution is linearised (its residual is 2.00e-6 of the terms of the equations)
   … add `linearised: {tolerance: ..., because: ...}`
5e-6 → ▸0.1 ⇒ a tolerance of 0.1 would let a wrong solution pass
5e-6 → ▸some ⇒ unknown name `some`
5e-6 → ▸-5e-6 ⇒ the tolerance is -5e-6, but must be above zero
linearised:\n    tolerance: 5e-6\n    because: >\n      strains
   → linearised: ▸{tolerance: 5e-6}\n      # strains
⇒ missing key `because` in `linearised`
linearised:\n    tolerance: 5e-6\n    because: >\n      strains
   → linearised: {tolerance: 5e-6, because: ▸""}\n      # strains
⇒ `because` is empty: state the reason for this linearised solution … expected a text
linearised:\n    tolerance: 5e-6\n    because: >\n      strains
   → linearised: ▸{because: strains are small}\n      # strains
⇒ missing key `tolerance` in `linearised` … tolerance: 1e-6
5e-6\n    because: → 5e-6\n    ▸reason: ⇒ unknown key `reason`
# Conditions that are linear in u need the default tolerance, because only the law is linearised.
["mode(X)"] → ["mode(X)*(1 + 1e-6)"] ⇒ initial condition u_X(X, 0) = u0(X)
["mode(X)"] → ["mode(X) + 1e-6*A"]
["mode(X)*cos(k*c*t)"] → [▸"(mode(X) + 1e-6*A)*cos(k*c*t)"]
⇒ boundary condition: left is fixed, u_X = 0
"#;

const VIOLATIONS_UNDER_A_FORCE: &str = r#"
@ [▸"u(X, t)"]
["pi^2 → ["-pi^2 ⇒ equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b, … m/s2 (off by
loads: → initial_displacement: ["1e-3*G*X"]\n  loads: ⇒ initial condition u_X(X, 0) = u0(X)
loads: → initial_velocity: [0]\n  loads: ⇒ initial condition on the velocity in X
"#;

const UNDER_A_FORCE: &str = r#"
equation: neo_hookean → equation: ▸small_strain
⇒ equation `small_strain` does not belong to the material `neo_hookean`
loads: [{ → loads: [{body_force: [0]}, {
{body_force: ["pi → {body_force: ▸["pi
⇒ a body force appears twice
"#;

#[test]
fn bar_with_a_hundred_oscillations_is_valid() {
    let long = BAR.replace("until: 0.5, dt: 1e-3", "until: 1000, dt: 1e-2");
    valid_suite(&long);
}

const FORCED: &str =
    include_str!("../../../verification/bars-at-large-strain/mms-fixed-bar-small.yaml");

/// With shear, and with principal stretches that coincide at times, two methods of differentiating
/// the stress must agree, and the weak form must be balanced.
#[test]
fn force_can_be_manufactured_for_hencky() {
    let plate: Edits<'_> = &[
        ("left: fixed", "left: fixed, right: fixed, bottom: fixed, top: fixed"),
        ("  initial_velocity: [\"sin(pi*X/2)\", 0]\n", ""),
        ("exact:\n  equation: small_strain", "manufactured:"),
        ("\"sin(pi*X/2)*sin(omega*t)/omega\"", "\"0.05*sin(pi*X)*sin(2*pi*Y)*sin(omega*t)\""),
        ("*t)\", 0]", "*t)\", \"0.1*sin(2*pi*X)*sin(2*pi*Y)*sin(omega*t)\"]"),
    ];
    for (sound, edits) in [(FORCED, &[][..]), (PLATE, plate)] {
        let text = edited(sound, edits).replace("neo_hookean", "hencky");
        valid_suite(&text.replace("linear_elastic", "hencky"));
    }
}

/// Creates the suite `FORCED` with a stated force (for nu = 0) instead of a manufactured one.
fn with_its_force(force: &str) -> String {
    let load =
        format!("  loads: [{{body_force: [\"{force}\"]}}]\n\nexact:\n  equation: neo_hookean\n");
    let motion = "u(x, s): \"G*sin(pi*x)*sin(c*pi*s)\"\n  f(x, s): \"1 + pi*G*cos(pi*x)*sin(c*pi*s)\"\n\nscene:";
    let (head, tail) = FORCED.split_once("\nmanufactured:").expect("a motion");
    let tail = tail.split_once('\n').expect("a comment").1;
    format!("{head}{load}{tail}")
        .replacen("scene:", &format!("functions:\n  {motion}"), 1)
        .replace("[\"G*sin(pi*X)*sin(c*pi*t)\"]", "[\"u(X, t)\"]")
}

const FORCE: &str = "pi^2*u(X, t)/rho*E*(0.5*(1 + 1/f(X, t)^2) - 1)";

#[test]
fn correct_stated_force_is_accepted() {
    valid_suite(&with_its_force(FORCE));
}
