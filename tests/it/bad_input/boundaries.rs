//! Boundary conditions and loads on sets: unknown keys, and motions that violate them.

use super::samples::{BAR, PLATE};
use super::{Edits, NO_FEM, refuse_all, refuse_in, refused};
use crate::common::{edited, valid_suite};

/// Changes the plate to a periodic bar.
const RING: Edits<'_> = &[
    ("omega: \"5*pi\"", "A: 0.01"),
    ("dimension: 2", "dimension: 1"),
    ("[0, 0], to: [1, 0.5]", "[0], to: [1]"),
    ("linear_elastic", "neo_hookean"),
    ("{left: fixed}", "{left: periodic, right: periodic}"),
    ("  initial_velocity: [\"sin(pi*X/2)\", 0]\n", ""),
    ("exact:\n  equation: small_strain", "manufactured:"),
    ("\"sin(pi*X/2)*sin(omega*t)/omega\", 0", "\"A*sin(2*pi*X)*sin(pi*t)\""),
    ("until: 0.1", "until: 0.5"),
    ("[4, 8], ppc: 4", "[5, 10], ppc: 2"),
];

/// Changes the plate to a square between rollers, with a set of particles whose velocity is
/// prescribed.
const SQUARE: Edits<'_> = &[
    ("omega: \"5*pi\"", "A: 0.01"),
    ("[1, 0.5]", "[1, 1]"),
    ("linear_elastic: {young: 100, poisson: 0", "neo_hookean: {young: 100, poisson: 0.3"),
    ("{left: fixed}", "{left: roller, right: roller, bottom: roller, top: roller}"),
    (
        "initial_velocity: [\"sin(pi*X/2)\", 0]",
        r#"sets: {middle: {box: {from: [0.4, 0.4], to: [0.6, 0.6]}}}
  loads:
    - velocity: {on: middle, value: ["A*pi*sin(pi*X)*cos(pi*t)", "A*pi*sin(pi*Y)*cos(pi*t)"]}"#,
    ),
    ("exact:\n  equation: small_strain", "manufactured:"),
    (
        "\"sin(pi*X/2)*sin(omega*t)/omega\", 0",
        "\"A*sin(pi*X)*sin(pi*t)\", \"A*sin(pi*Y)*sin(pi*t)\"",
    ),
    ("until: 0.1", "until: 0.5"),
];

/// Changes the ring: it is stretched to the length of a longer grid.
const STRETCHED: Edits<'_> = &[
    ("A: 0.01", "V: 2"),
    ("  material", "  grid: {from: [0], to: [1.2]}\n  material"),
    ("manufactured:", "exact:\n  equation: neo_hookean"),
    ("A*sin(2*pi*X)*sin(pi*t)", "0.2*X + V*t"),
];

/// Changes the vibrating bar without finite elements: the motion of its far end is prescribed.
const DRIVEN: Edits<'_> = &[
    ("grid: {from: [0], to: [L + 5]}", "grid: {from: [0], to: [L]}"),
    ("{left: fixed}", "{left: roller, right: {velocity: [\"v0*mode(X)*cos(omega*t)\"]}}"),
];

/// Changes a column under gravity: its weight becomes a force on a set of all particles.
const PUSHED: Edits<'_> = &[
    ("gravity: [\"-g\"]", "force: {on: all, value: [\"-rho*g*H\"]}"),
    ("  loads:", "  sets: {all: {box: {from: [-1], to: [2]}}}\n  loads:"),
];

#[test]
fn conditions_that_fit_the_motion_are_valid() {
    let (ring, square) = (edited(PLATE, RING), edited(PLATE, SQUARE));
    let held = "{left: fixed}";
    let sound: [(&str, Edits<'_>); 7] = [
        (&ring, &[]),
        (&ring, STRETCHED),
        (&square, &[]),
        (&edited(BAR, NO_FEM), DRIVEN),
        (BAR, &[("left: fixed", "left: roller")]),
        (PLATE, &[(held, "{left: roller, bottom: roller, top: roller}")]),
        (PLATE, &[(held, "{left: fixed, bottom: periodic, top: periodic}")]),
    ];
    for (text, edits) in sound {
        valid_suite(&edited(text, edits));
    }
}

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
    let ring = edited(PLATE, RING);
    refuse_in(&ring, IN_A_RING);
    refuse_in(&edited(PLATE, SQUARE), IN_A_SQUARE);
    refuse_in(&edited(&ring, STRETCHED), IN_A_STRETCHED_RING);
}

const MISTAKES: &str = r#"
@sliding-block
bottom: {friction: mu} → bottom: {friction: ▸-mu}
⇒ the coefficient of friction is -0.267949 … expected zero or a positive number
bottom: {friction: mu} → bottom: {▸rub: mu} ⇒ unknown … `friction`
start: at_zero} → start: at_zero, mass: ▸consistent} ⇒ `friction` needs a lumped mass matrix
{friction: mu} → {friction: 0.99*mu}
- "slide*t → - ▸"slide*t
⇒ the traction in X on the friction wall `bottom` does not have the value that opposes the velocity
@bar
{left: fixed} → {left: ▸{friction: 0.1}}
⇒ the left face has friction, but the built-in FEM supports only fixed and free ends
{left: fixed} → {left: ▸{velocity: ["v0*t"]}}
⇒ the left face has a given velocity, but the built-in FEM supports only fixed and free ends
boundary
   → sets: {▸tip: {box: {from: [0], to: [L]}}}\n  loads: [{velocity: {on: tip, value: [v0]}}]\n
    boundary
⇒ the set `tip` has a given velocity, which the built-in FEM does not support
@plate
{left: fixed} → {left: fixed, bottom: periodic, top: periodic}
material → grid: {from: [0, 0], to: [1, ▸1]}\n  material
⇒ the top face at 0.5 is periodic, but the grid ends at 1 … expected exactly 0.5
to: [1, 0.5] → to: [1, 0.45]
{left: fixed} → {left: fixed, bottom: periodic, top: periodic}
[4, 8] → [▸4, 8]
⇒ the top face, which is periodic, is at 0.45, but the nearest nodes are at 0.5
"#;

const IN_A_RING: &str = r#"
left: periodic, right: periodic → left: ▸periodic
⇒ the left face is periodic, but the right face is free … expected `right: periodic` as well
left: periodic, right: periodic → left: fixed, right: ▸periodic
⇒ the right face is periodic, but the left face is fixed
left: periodic → left: ▸periodical ⇒ unknown name `periodical` … did you mean `periodic`?
left: periodic → left: {velocity: ▸[0, 0]} ⇒ 2 components in a scene of dimension 1
left: periodic → left: ▸velocity ⇒ velocity
boundary → loads: [{force: {on: ▸tip, value: [1]}}]\n  boundary
⇒ there is no set `tip` … declare it: `sets: {tip: {box: {from: [...], to: [...]}}}`
left: periodic → left: ▸periodic
- mpm: → - fem: {element: linear, mass: lumped}\n  - mpm:
⇒ the left face is periodic, but the built-in FEM supports only fixed and free ends
["A*sin(2*pi*X) → [▸"A*sin(1.5*pi*X)
⇒ boundary condition: left is periodic, but x_X does not differ by one period from that on the
   opposite face at X = (
["A*sin(2*pi*X) → [▸"A*sin(pi*X)
⇒ boundary condition: left is periodic, but du_X/dX differs from that on the opposite face at X = (
"#;

const IN_A_SQUARE: &str = r#"
loads: → loads:\n    - traction: {on: ▸top, value: [1, 0]} ⇒ the face `top` is a roller
loads: → loads:\n    - pressure: {on: ▸middle, value: 1}
⇒ `middle` is a set, but a pressure acts on a face
loads: → loads:\n    - traction: {on: ▸middle, value: [1, 0]}
⇒ `middle` is a set, but a traction acts on a face
   … give the total force: `force: {on: middle, value: [...]}`
loads: → loads:\n    - force: {on: ▸midle, value: [1, 0]}
⇒ there is no set `midle` … did you mean `middle`?
loads: → loads:\n    - force: {on: middle, value: [1, 0]}
{on: middle, value: [" → {on: ▸middle, value: ["
⇒ the set `middle` already has a force
{middle: → {▸other: {box: {from: [0, 0], to: [1, 1]}}, middle: ⇒ the set `other` is never used
{middle: → {▸top: ⇒ `top` is the name of a face
from: [0.4, 0.4], to: [0.6, 0.6] → from: [0.4, ▸1.4], to: [0.6, 1.6]
⇒ the set `middle` from 1.4 to 1.6 is outside the body … the body is from 0 to 1
from: [0.4, 0.4], to: [0.6, 0.6] → from: [0.45, 0.45], to: [0.55, 0.55]
[4, 8] → [▸4, 8]
⇒ with 4 cells along the first axis the set `middle` contains no particle … expected more cells
["A*sin(pi*X)*sin(pi*t) → [▸"A*sin(2*X)*sin(pi*t)
["A*pi*sin(pi*X)*cos → ["A*pi*sin(2*X)*cos
⇒ boundary condition: right is a roller, u_X = 0
["A*sin(pi*X)*sin(pi*t) → [▸"A*sin(pi*X)*(1 + Y)*sin(pi*t)
["A*pi*sin(pi*X)*cos → ["A*pi*sin(pi*X)*(1 + Y)*cos
⇒ boundary condition: bottom is a roller, traction in X
value: ["A*pi* → value: ["2*A*pi*
["A*sin(pi*X)*sin(pi*t) → [▸"A*sin(pi*X)*sin(pi*t)
⇒ given velocity of the set middle in X
"#;

const IN_A_STRETCHED_RING: &str = r#"
scheme: musl → scheme: musl, frame: ▸total_lagrangian
⇒ `total_lagrangian` needs a periodic grid as long as the body
["0.2*X → [▸"0.19*X ⇒ left is periodic, but x_X does not differ by one period
["0.2*X + V*t → [▸"V*t ⇒ expected 1.2
"#;

#[test]
fn prescribed_velocity_must_agree_with_the_motion() {
    let wrong = edited(&edited(BAR, NO_FEM), DRIVEN)
        .replace("{velocity: [\"v0*", "{velocity: [\"1.01*v0*")
        .replace("[\"v0/omega*", "[▸\"v0/omega*");
    refused(&wrong, &[], &["boundary condition: velocity of right in X", "m/s (off by "]);
}

/// A force on the whole body is equivalent to gravity, for the solution and for both solvers. A
/// force on half of the body is another problem.
#[test]
fn a_force_on_a_set_enters_the_equation_of_motion() {
    let column = include_str!("../../../verification/the-talk/fem-oedometer.yaml");
    let right = edited(column, PUSHED);
    valid_suite(&right);
    let half = right
        .replace("to: [2]}}}", "to: [0.5]}}}")
        .replace("    - \"fall(t) -", "    - ▸\"fall(t) -");
    refused(&half, &[], &["equation of motion in X, rho0 u_tt = Div P + rho0 b"]);
}
