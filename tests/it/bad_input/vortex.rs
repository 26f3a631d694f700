//! A published force with a wrong sign, and bodies that are not boxes.
//!
//! The generalized vortex of Kamojjala, Brannon, Sadeghirad & Guilkey (2015) is an annulus whose
//! circles rotate by `alpha = sin(pi t) h(R)`. Several public codes contain its force in the basis
//! of the reference position, with one tangential term of the wrong sign.

use super::{load, refuse_in, refused};
use crate::common::valid_suite;
use rstest::rstest;

const VORTEX: &str = r#"suite: vortex
title: Generalized vortex
source: Kamojjala et al. (2015), with a force that the suite states

parameters:
  E: 1000
  nu: 0.3
  rho: 1000
  m: "E/(2*(1 + nu))/rho"          # mu/rho0 (m2/s2)

functions:
  radius(x, y): "sqrt(x^2 + y^2)"
  profile(r): "1 - 32*(r - 1)^2 + 256*(r - 1)^4"
  slope(r): "-64*(r - 1) + 1024*(r - 1)^3"
  curve(r): "-64 + 3072*(r - 1)^2"
  g(s): "sin(pi*s)"
  alpha(x, y, s): "g(s)*profile(radius(x, y))"    # the angle alpha
  centripetal(r, s): "r*(pi*cos(pi*s)*profile(r))^2"
  stretch(r, s): "m*r*(g(s)*slope(r))^2"
  tangential(r, s): "-r*pi^2*g(s)*profile(r) - m*g(s)*(3*slope(r) + r*curve(r))"
FORCE

scene:
  dimension: 2
  body: {annulus: {centre: [0, 0], inner: 0.75, outer: 1.25}}
  grid: {from: [-2, -2], to: [2, 2]}
  material: {neo_hookean: {young: E, poisson: nu, density: rho}}
  loads:
    - body_force:
        - "(radial(radius(X, Y), alpha(X, Y, t), t)*cX(X, Y, t) - angular(radius(X, Y), alpha(X, Y, t), t)*sX(X, Y, t))/radius(X, Y)"
        - "(radial(radius(X, Y), alpha(X, Y, t), t)*sX(X, Y, t) + angular(radius(X, Y), alpha(X, Y, t), t)*cX(X, Y, t))/radius(X, Y)"

exact:
  equation: neo_hookean
  displacement:
    - "cos(alpha(X, Y, t))*X - sin(alpha(X, Y, t))*Y - X"
    - "sin(alpha(X, Y, t))*X + cos(alpha(X, Y, t))*Y - Y"

run: {until: 1, dt: "0.1*h"}
refine: {cells: [16, 32], ppc: 4}

methods:
  - mpm: {basis: cpgimp, transfer: flip, scheme: musl}

expect:
  - verdict: too_few_levels
    because: two levels support no claim
"#;

/// Force in the basis that rotates with the material, as in published benchmarks.
const CURRENT: &str = r#"  radial(r, a, s): "-centripetal(r, s) + stretch(r, s) + 0*a"
  angular(r, a, s): "tangential(r, s) + 0*a"
  cX(x, y, s): "cos(alpha(x, y, s))*x - sin(alpha(x, y, s))*y"
  sX(x, y, s): "sin(alpha(x, y, s))*x + cos(alpha(x, y, s))*y""#;

/// Force in the basis of the reference position, as published, with one sign corrected.
const PUBLISHED: &str = r#"  radial(r, a, s): "(stretch(r, s) - centripetal(r, s))*cos(a) - tangential(r, s)*sin(a)"
  angular(r, a, s): "stretch(r, s)*sin(a) - centripetal(r, s)*sin(a) + tangential(r, s)*cos(a)"
  cX(x, y, s): "x + 0*y + 0*s"
  sX(x, y, s): "y + 0*x + 0*s""#;

#[rstest]
#[case::in_the_current_basis(CURRENT)]
#[case::in_the_reference_basis(PUBLISHED)]
fn correct_force_is_accepted(#[case] force: &str) {
    valid_suite(&VORTEX.replace("FORCE", force));
}

/// docs/wrong-force.md quotes this error.
#[test]
fn the_published_force_is_refused() {
    let wrong = PUBLISHED.replace("- centripetal(r, s)*sin", "+ centripetal(r, s)*sin");
    let text = VORTEX.replace("FORCE", &wrong);
    let edit = ("    - \"cos(alpha(X", "    - ▸\"cos(alpha(X");
    let words = [
        "equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b, is violated at X = (",
        "expected ",
        ", found ",
        " m/s2 (off by ",
    ];
    refused(&text, &[edit], &words);
    let shown = load(&text).expect_err("a wrong sign").to_string();
    let message = shown.lines().next().expect("a message");
    assert!(
        include_str!("../../../docs/wrong-force.md").contains(message),
        "docs/wrong-force.md quotes another message than\n{message}"
    );
}

#[test]
fn mistakes_are_refused() {
    refuse_in(&VORTEX.replace("FORCE", CURRENT), IN_A_VORTEX);
}

const IN_A_VORTEX: &str = r#"
@ - ▸"cos(alpha(X
outer: 1.25 → outer: ▸0.5 ⇒ the outer radius is 0.5, the inner 0.75 … above `inner`
inner: 0.75 → inner: ▸0 ⇒ the radius is 0, but must be above zero
{annulus: {centre: [0, 0], inner: 0.75, outer: 1.25}} → {▸ball: {centre: [0, 0, 0], radius: 1}}
⇒ the scene is 2-D, but `ball` is a body in 3-D
   … `box`, `annulus`, `disk`, `polygon` or `quadrilateral`
loads: → boundary: {▸left: fixed}\n  loads:
⇒ `left` cannot be held: a body of kind `annulus` has free rims only
loads: → loads:\n    - pressure: {on: ▸iner, value: 1}
⇒ the body has no rim `iner` … did you mean `inner`?
loads: → loads:\n    - pressure: {on: inner, value: 1}\n    - pressure: {on: ▸inner, value: 2}
⇒ the rim `inner` already has a pressure
loads: → loads:\n    - pressure: {on: inner, value: 1, at: ▸particles}
⇒ a pressure on a rim acts at the surface … remove `at`
loads: → loads:\n    - pressure: {on: outer, value: 1}
⇒ boundary condition: the outer rim is under pressure, traction in X … expected … Pa (off by
loads: → loads:\n    - traction: {on: ▸inner, value: [1, 0]}
⇒ `inner` cannot be loaded: a body of kind `annulus` has free rims only
from: [-2, -2] → from: [-2, ▸-1]
⇒ the annulus extends to -1.25, but the grid ends at -1 … at most -1.25
outer: 1.25 → outer: 1.2 ⇒ boundary condition: the outer rim is free, traction in X … Pa (off by
expect: → observe: {at: ▸[0.1, 0.2]}\n\nexpect:
⇒ this point is outside the body … expected a point in the annulus
"#;
