//! Boxes that judged errors are restricted to: their place, and the waves that reach them.

use super::refuse_all;
use super::samples::BAR;
use crate::common::{edited, valid_suite};

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar
# The bar `BAR` has waves of 10 m/s, and ends at 0.5 s.
{norm: rms} → {norm: rms, within: {from: [10], to: [▸10]}} ⇒ the box ends at 10 and starts at 10
rms → rms, within: {from: [10], to: [▸26]} ⇒ 26 is outside the body … expected a number from 0 to 25
{norm: rms} → {norm: rms, within: {from: ▸[10, 1], to: [20]}} ⇒ 2 … 1
{norm: rms} → {norm: rms, within: {▸form: [10], to: [20]}} ⇒ form … from
{norm: rms} → {norm: rms, ▸within: {from: [10], to: [20]}}
exact:\n  equation: small_strain\n  displacement: ["v0/omega*mode(X)*sin(omega*t)"]
   → reference:\n  equation: small_strain\n
    fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}
⇒ `within` needs a motion that is stated under `exact` … state the solution under `exact`
{norm: rms} → {norm: rms, within: {from: [15], to: [20]}}
at: [12.5] → at: ▸[12.5]
⇒ the observed point is outside `judge.within` … expected a point in 15 to 20 m
boundary: {left: fixed} → # free ends
{norm: rms} → {norm: rms, within: {from: [▸4.9], to: [20]}}
⇒ the box is 4.9 m from the left face, whose condition the solution violates
   … an elastic wave from this face travels 5 m in 0.5 s at 10 m/s
   … expected a distance of at least 5 m … shorten the run, or move the box away from the face
{left: fixed} → {left: fixed, right: fixed}
[L + 5] → [L]
{norm: rms} → {norm: rms, within: {from: [1], to: [▸21]}}
⇒ the box is 4 m from the right face … travels 5 m
{norm: rms} → {norm: rms, within: {from: [10], to: [15]}}
["v0/omega*mode(X)*sin(omega*t)"] → [▸"v0/omega/1.1*mode(X)*sin(1.1*omega*t)"]
⇒ equation of motion in X … is violated
{norm: rms} → {norm: rms, within: {from: [10], to: [15]}}
["v0*mode(X)"] → ["2*v0*mode(X)"]
["v0/omega* → [▸"v0/omega*
⇒ initial condition on the velocity in X
@mpm-bar
{norm: rms} → {of: kinetic_energy, ▸within: {from: [10], to: [20]}}
⇒ `within` is not supported for the kinetic energy, a sum over the whole body … judge a field
{norm: rms} → {norm: rms, ▸within: {from: [10], to: [20]}}
exact:\n  equation: small_strain → manufactured:
linear_elastic → neo_hookean
initial_velocity: ["v0*mode(X)"] → # at rest
⇒ `within` needs a motion that is stated under `exact`
@plate
boundary: {left: fixed} → boundary: {left: fixed, top: fixed}
methods: → judge: {within: {from: [0, 0], to: [1, ▸0.4]}}\nmethods:
⇒ from the top face, whose condition the solution violates
"#;

/// A box at a distance of exactly one travel of a wave, and a box next to a face whose condition
/// holds.
#[test]
fn box_that_no_wave_reaches_is_valid() {
    let whole = ("{norm: rms}", "{norm: rms, within: {from: [0], to: [25]}}");
    valid_suite(&edited(BAR, &[whole]));
    let distant = ("from: [0], to: [25]", "from: [5], to: [25]");
    valid_suite(&edited(BAR, &[whole, distant, ("  boundary: {left: fixed}\n", "")]));
}
