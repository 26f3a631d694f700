//! Materials and their parameters.

use super::refuse_all;
use super::samples::BAR;
use crate::common::valid_suite;

const ELASTIC: &str = "{linear_elastic: {young: E, poisson: 0, density: rho}}";

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar
linear_elastic → ▸linear_elastik ⇒ unknown name `linear_elastik` … did you mean `linear_elastic`?
linear_elastic → ▸rubber ⇒ unknown name `rubber` … j2
linear_elastic: {young: E, poisson: 0, density: rho
   → newtonian: {bulk: E, viscosity: 0, density: rho, ▸poisson: 0
⇒ unknown key `poisson` … bulk
{linear_elastic: {young: E, poisson: 0, → {newtonian: {bulk: E, ▸viscositi: 0,
⇒ unknown key `viscositi` … did you mean `viscosity`?
{linear_elastic: {young: E, → {j2: ▸{young: E, ⇒ missing key `yield` in `j2` … add `yield: 1`
{linear_elastic: {young: E, poisson: 0, → {j2: {young: E, poisson: 0, yield: ▸0,
⇒ the yield stress is 0, but must be above zero
linear_elastic: {young: E, poisson: 0 → j2: {young: E, poisson: 0, yield: 1, hardening: ▸"-E"
⇒ the hardening modulus is -100, but must not be below zero … expected zero or a positive number
{linear_elastic: {young: E, poisson: 0, → {newtonian: {bulk: ▸0, viscosity: 1,
⇒ the bulk modulus is 0, but must be above zero
{linear_elastic: {young: E, poisson: 0, → {newtonian: {bulk: E, viscosity: ▸-1,
⇒ the viscosity is -1, but must not be below zero
linear_elastic: {young: E, poisson: 0, density: → hencky: {young: E, poisson: ▸0.5, density:
⇒ Poisson's ratio is 0.5 … expected a number above -1 and below 0.5
@path-drucker-prager
dilation: 0.1 → dilation: ▸0.4
⇒ the coefficient of dilation is above that of friction … does negative work
@path-mohr-coulomb
dilation_angle: 10 → dilation_angle: ▸40 ⇒ the dilation angle is above the friction angle
friction_angle: 30 → friction_angle: ▸90
⇒ the friction angle is 90 degrees … at least 0 and less than 90
cohesion: c → cohesion: ▸-1 ⇒ the cohesion is -1, but must not be below zero
@path-cam-clay-elastic
swelling_slope: kappa → swelling_slope: ▸0.1
⇒ the slope of swelling is not below that of compression … plastic compaction
preconsolidation: 1000 → \n    preconsolidation: ▸50
⇒ the preconsolidation pressure is below the initial pressure … outside its yield surface
initial_pressure: p0 → \n    initial_pressure: ▸0
⇒ the initial pressure is 0, but must be above zero
poisson: 0.25 → \n    poisson: ▸0.5 ⇒ Poisson's ratio is 0.5
@bar
exact:\n  equation: small_strain\n  displacement: ["v0/omega*mode(X)*sin(omega*t)"]
   → reference:\n  equation: hencky\n
    fem: {element: linear, mass: lumped, cells: 100, dt: "1e-3/omega"}
{linear_elastic: {young: E, poisson: 0, → {j2: {young: E, poisson: 0, yield: 1,
- fem: → - ▸fem:
⇒ the built-in FEM does not support the law `j2` … name the `law` of an elastic bar
exact:\n  equation: small_strain\n  displacement: ["v0/omega*mode(X)*sin(omega*t)"]
   → reference:\n  equation: hencky\n
    fem: {element: linear, mass: lumped, cells: 100, dt: "1e-3/omega"}
reference: → ▸reference:
linear_elastic: {young: E, poisson: 0, density: → newtonian: {bulk: E, viscosity: 1, density:
⇒ the built-in FEM is a solid bar, but `newtonian` has no Young's modulus
# Gases, and densities that vary over the body.
@gas-cloud [▸"(a(t)
exponent: 3 → exponent: ▸1 ⇒ the exponent is 1, but must be above one … expected a number above 1
{stiffness: K, exponent: 3, → ▸{stiffness: K, ⇒ missing key `exponent` in `polytropic`
stiffness: K → stiffness: ▸0 ⇒ the stiffness is 0, but must be above zero
exponent: 3 → exponent: "3 + ▸X"
⇒ unknown name `X` … only the density of a material can vary over a body
"sqrt(A*(1 - X^2))" → ▸0 ⇒ the density is 0, but must be above zero
"sqrt(A*(1 - X^2))" → ▸"A*(X + 0.5)"
⇒ the density is -0. … kg/m3 at (-0. … expected a positive density inside the body
"sqrt(A*(1 - X^2))" → ▸"A*abs(X)*step(X)"
⇒ the density is 0 kg/m3 at (-0. … at least zero on its rim
"sqrt(A*(1 - X^2))" → ▸"sqrt(A*(0.5 - X^2))" ⇒ the density is NaN kg/m3 at (-0.
"sqrt(A*(1 - X^2))" → "1 + ▸Y" ⇒ unknown name `Y` … the variables are `X`
"sqrt(A*(1 - X^2))" → "1 + ▸t" ⇒ unknown name `t`
"sqrt(1 + C*t^2)" → "sqrt(1 + 1.01*C*t^2)" ⇒ equation of motion in X
"sqrt(A*(1 - X^2))" → "1.01*sqrt(A*(1 - X^2))" ⇒ equation of motion in X
"sqrt(A*(1 - X^2))" → A ⇒ boundary condition … is free, traction in X
"sqrt(A*(1 - X^2))" → "sqrt(A*(1.5 - X^2))" ⇒ boundary condition … traction in X
@spinning-cloud ▸"A*(1 - X^2 - Y^2)"
polytropic: {stiffness: K, exponent: 2, density → neo_hookean: {young: K, poisson: 0, density
⇒ the density is zero on the rim, where the wave speed of `neo_hookean` is unbounded
disk: {centre: [0, 0], radius: 1} → polygon: [[0, 0], [0.5, 0], [0, 0.5]]
⇒ a density that varies over the body is not supported here … in a box or a round body only
dimension: 2 → dimension: 2\n  plane: axisymmetric
⇒ a density that varies over the body is not supported here … not integrated in a body of revolution
disk: {centre: [0, 0], radius: 1} → box: {from: [-1, -1], to: [1, 1]}
⇒ the density is -0. … kg/m3 at (-0.
@spinning-cloud-radius
radius_of_gyration} → radius_of_gyration, norm: ▸mass_l2}
⇒ the radius of gyration is one number for the whole body, so `mass_l2`, a norm over particles,
   does not apply
   … use `rms`
radius_of_gyration} → radius_of_gyration, norm: ▸max_mass_l2}
⇒ the radius of gyration is one number for the whole body, so a norm over particles does not apply
radius_of_gyration} → ▸radius_of_giration}
⇒ unknown name `radius_of_giration` … did you mean `radius_of_gyration`?
# Materials whose stress depends on more than the deformation, and the exact solutions that they
# allow.
@plastic-bar [▸"rate*t*X"]
min(2*mu*eps, Y) → 2*mu*eps ⇒ boundary condition: right is loaded, traction in X
2/3*min(2*mu*eps, Y) → 2/3*Y ⇒ boundary condition: right is loaded, traction in X
rate*t))/(1 + rate*t) → rate*t*(1 - t/2)))/(1 + rate*t*(1 - t/2))
until: 1, → until: 2,
["rate*t*X"] → [▸"rate*t*(1 - t/2)*X"]
⇒ loading reverses where the body flows plastically … expected 0.0
@plastic-wave [▸"front(e1
# Fronts of any speed satisfy the equation of motion at every point.
cp: "sqrt(K/rho)" → cp: "0.9*sqrt(K/rho)" ⇒ momentum balance across wave fronts
"sqrt((K + 4/3*mu)/rho)" → "0.9*sqrt((K + 4/3*mu)/rho)" ⇒ momentum balance across wave fronts
methods: → methods:\n  - ▸fem: {element: linear, mass: lumped, law: j2}
of: stress, →
⇒ the built-in FEM does not support the law `j2`
run:
   → reference: {equation: ▸j2, fem: {element: linear, mass: lumped, cells: 100, dt: "h/100"}}\nrun:
of: stress, →
⇒ the built-in FEM does not support the law `j2`
@fluid-column
a: "7*rho*g/K" → a: "7.1*rho*g/K"
["0*X" → [▸"0*X"
⇒ equation of motion in Y
equilibrium: → exact:
equation: tait → equation: ▸tait
rest_below: 1e-9 → # in motion
rest_below: 1e-6 → # in motion
⇒ the stress of a viscous fluid in motion depends on its velocity
@spinning-disk - ▸"(1 + s(X, Y))*(cos
# A check with a tolerance of 1 % still distinguishes plane strain from plane stress.
np: "nu/(1 - nu)" → np: nu ⇒ is violated at X … this is not a solution
Ep: "E/(1 - nu^2)" → Ep: E ⇒ is violated at X … this is not a solution
@path-cam-clay-elastic [▸"rate*t*X"]
# Clay yields in extension, or softens in compression from far inside its yield surface. Its
# stress is then unknown.
rate: -0.03 → rate: 0.2
poisson: 0.25 → poisson: 0.25
⇒ `cam_clay` has no stress for the extension du_X/dX =
rate: -0.03 → rate: -0.3
poisson: 0.25 → poisson: 0
⇒ `cam_clay` has no stress for the compression du_X/dX = -
"#;

const EXACT: &str =
    "exact:\n  equation: small_strain\n  displacement: [\"v0/omega*mode(X)*sin(omega*t)\"]\n";
const REFERENCE: &str = "reference:\n  equation: hencky\n  fem: {element: linear, mass: lumped, cells: 100, dt: \"1e-3/omega\"}\n";

/// The bar has an elastic reference that the suite names, and the FEM case names its law too.
#[test]
fn plastic_bar_with_reference_and_law_is_valid() {
    let solid = "{j2: {young: E, poisson: 0, yield: 1, hardening: 2, density: rho}}";
    let sound = BAR
        .replace(EXACT, REFERENCE)
        .replace(ELASTIC, solid)
        .replace("mass: lumped}\n\njudge", "mass: lumped, law: hencky}\n\njudge");
    valid_suite(&sound);
}
