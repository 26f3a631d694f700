//! Bodies, planes, grids, loads, references and the observed point.

use super::refuse_all;

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar
to: [L] → to: [▸0] ⇒ the box ends at 0 and starts at 0 … above that of `from`
[0], to: [L] → [-1e308], to: [▸1e308] ⇒ the box is inf m long … expected a length from 1e-30 to 1e30
from: [0], to: [L] → from: ▸[0, 0], to: [L] ⇒ 2 components in a scene of dimension 1 … expected 1
["v0*mode(X)"] → ▸["v0*mode(X)", 0] ⇒ 2 components in a scene of dimension 1 … expected 1
linear_elastic: {young: E, poisson: 0 → j2: {young: E, poisson: 0, yield: 1
initial_velocity: → ▸initial_displacement: [0]\n  initial_velocity:
⇒ a `j2` body cannot start deformed … plastic flow depends on the whole history
initial_velocity: → initial_displacement: ▸[0, 0]\n  initial_velocity:
⇒ 2 components in a scene of dimension 1 … expected 1
to: [L + 5] → to: [▸-5] ⇒ the box ends at -5 and starts at 0
to: [L + 5] → to: [▸L - 5]
⇒ the body's right face at 25 is outside the grid, which ends at 20 … expected at least 25
grid: {from: [0] → grid: {from: [▸-1]
⇒ the left face at 0 is fixed, but the grid ends at -1 … expected exactly 0
boundary: {left: fixed} → boundary: {left: fixed}\n  loads: [{traction: {on: ▸left, value: [1]}}]
⇒ the face `left` is fixed
at: [12.5] → at: ▸[12.5, 1] ⇒ 2 components in a scene of dimension 1 … expected 1
at: [12.5] → at: ▸[] ⇒ 0 components … expected 1
at: [12.5] → at: [▸30] ⇒ 30 is outside the body … expected a number from 0 to 25
, ppc: 4 →
- mpm: → - ▸mpm:
⇒ MPM needs particles, but `refine` has no `ppc` … add `ppc: 4` to `refine`
suite: bar → ▸suite: bar
exact:\n  equation: small_strain\n  displacement: ["v0/omega*mode(X)*sin(omega*t)"]\n →
⇒ a convergence study needs `exact`, `manufactured`, `equilibrium` or `reference`
small_strain → ▸log_strain
⇒ a formula is checked against `small_strain`, `neo_hookean`, `hencky` or `corotated` only
   … give other equations a `reference`
@plate
- mpm: → - ▸fem: {element: linear, mass: lumped}\n  - mpm:
⇒ the built-in FEM is 1-D, but the scene is 2-D
run:
   → ▸reference:\n  equation: small_strain\n
    fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:
⇒ the built-in FEM is 1-D, but the scene is 2-D … give this scene an `exact` solution
omega: "5*pi" → omega: "10*pi/1.1"
to: [1, 0.5] → to: [0.5, 1.1]
{left: fixed} → {bottom: fixed, top: fixed}
["sin(pi*X/2)", 0] → [0, "sin(pi*Y/1.1)"]
["sin(pi*X/2)*sin(omega*t)/omega", 0] → [0, "sin(pi*Y/1.1)*sin(omega*t)/omega"]
[4, 8] → [5, ▸8]
⇒ with 8 cells along the first axis the top face, which is fixed, is at 1.1
   … but the nearest nodes are at 1.125 … expected a cell size that divides the length, not 0.0625 m
@bending-bar - ▸"X*(cos
surface}\n    - pressure → ▸rim}\n    - pressure ⇒ unknown name `rim` … `particles` … `surface`
on: left → on: ▸right ⇒ the face `right` already has a pressure
on: left → on: ▸bottom ⇒ the face `bottom` is fixed
"-across(stretch(-w, t))/stretch(-w, t)" → ▸[0, 0]
⇒ expected a finite number or a formula, found a list
stretch(-w, t)", at → stretch(-w, ▸s)", at ⇒ `s`
stretch(-w, t)", at → stretch(w, t)", at
⇒ boundary condition: left is under pressure, traction in X … this is not a solution
along(stretch(X, t))*cos → along(stretch(w, t))*cos
⇒ boundary condition: top is loaded, traction in Y … this is not a solution
@oedometer
- gravity: ["-g"] → - gravity: ["-g"]\n    - gravity: ▸["-g"] ⇒ gravity appears twice
@steffen-bar
right, → right, value: [p0]}\n    - traction: {on: ▸right, ⇒ the face `right` already has a traction
# Several bodies: scenes that are not possible with several bodies, methods that support only one,
# motions that violate contact, and invalid viscosities.
@bar ▸scene:
body: {box: {from: [0], to: [L]}} →
⇒ the scene has no `body` … or a list of `bodies` with one of each
material: {linear_elastic: {young: E, poisson: 0, density: rho}} →
⇒ the scene has no `material` … or a list of `bodies` with one of each
@two-bar-impact
contact: {friction: 0} → contact: {friction: 0}\n  ▸body: {box: {from: [0], to: [1]}}
⇒ `body` is for a single body, but the scene lists `bodies`
{friction: 0} → {friction: 0}\n  ▸initial_velocity: [v0] ⇒ `initial_velocity` is for a single body
contact: {friction: 0} → contact: {friction: 0}\n  loads:\n    - ▸traction: {on: right, value: [1]}
⇒ `traction` acts on a face of a single body, but the scene lists `bodies`
{friction: 0} → {friction: 0}\n  loads:\n    - ▸heat: {conductivity: 1, capacity: 1}
⇒ `heat` is supported for a single body only, but the scene lists `bodies`
contact: {friction: 0} → contact: {friction: ▸-0.5}
⇒ the coefficient of friction is -0.5 … expected zero or a positive number
- body: {box: {from: [L] → - ▸body: {box: {from: ["0.9*L"] ⇒ body 1 and body 2 overlap
mpm: {basis: linear, transfer: flip, scheme: [usl, musl]
   → ▸mpm: {basis: linear, transfer: xpic_2, scheme: usl
⇒ the transfer `xpic_2` is not supported for several bodies
mpm: {basis: linear, transfer: flip, scheme: [usl, musl]
   → ▸mpm: {basis: linear, transfer: flip, scheme: usl, mass: consistent
⇒ the mass matrix `consistent` is not supported for several bodies
mpm: {basis: linear, transfer: flip, scheme: [usl, musl]
   → ▸mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian
⇒ the frame `total_lagrangian` is not supported for several bodies
mpm: {basis: linear, transfer: flip, scheme: [usl, musl]
   → ▸mpm: {basis: linear, transfer: flip, scheme: usl, start: half_step_back
⇒ `start: half_step_back` is not supported with contact
["sign(L - X)*bar(abs(X - L), t)"] → [▸"sign(L - X)*v0*t + 0*bar(X, t)"]
⇒ where two bodies meet along X, they overlap at X = (
contact: {friction: 0} → # no contact
["sign → [▸"sign
⇒ where two bodies meet along X, their displacements u_X differ
   … add `contact: {friction: 0}` to `scene`
@bar-of-two-materials [▸"A*(left
boundary: {left: fixed} → boundary: {left: fixed}\n  ▸initial_displacement: [0]
⇒ `initial_displacement` is for a single body
linear_elastic: {young: E2, poisson: 0 → j2: {young: E2, poisson: 0, yield: 1
initial_displacement: ["A*right → ▸initial_displacement: ["A*right
⇒ a `j2` body cannot start deformed … plastic flow depends on the whole history
["A*right(X)"] → ["1.001*A*right(X)"]
⇒ initial condition u_X(X, 0) = u0(X) is violated at X = (1. … m (off by -
omega: 6.276875706767236 → omega: 6.276876
⇒ where two bodies meet along X, their tractions in X differ at X = ( … Pa (off by
- body: {box: {from: [a] → - ▸body: {box: {from: ["1.1*a"]
⇒ the exact solution of bodies with a gap and one velocity field depends on the cell size
   … add `contact: {friction: 0}` to `scene`
@two-disks
material: {linear_elastic: {young: 1000, poisson: 0.3, density: → ▸material: {rigid: {density:
⇒ a `rigid` body cannot be in a list of bodies
   … a `rigid` body does not move: remove this, or choose another material
body: {disk: {centre: [0.8, 0.8] → ▸body: {disk: {centre: [0.45, 0.45] ⇒ body 1 and body 2 overlap
contact: → boundary: {▸bottom: {friction: 0.1}}\n  contact:
⇒ friction on a wall is supported for a single body only
run: → ▸manufactured: {displacement: [X, Y]}\nrun:
⇒ `manufactured` is for a single body, but the scene lists `bodies`
- body: {disk: {centre: [0.2 → - ▸body: {disk: {centre: [0.2
run: → exact:\n  equation: small_strain\n  displacement: ["v*t", "v*t"]\nrun:
⇒ an exact solution of several bodies can be checked only for boxes
suite: two → ▸suite: two
crossings: some → crossings: some\n    error_below: 1
⇒ a convergence study needs `exact`
   … without one of them, expectations can only bound a `drift` or an `energy_rate`
methods: → ▸observe: {at: [0.2, 0.2]}\nmethods:
⇒ `observe` needs an exact solution or a reference, and the suite has neither
@artificial-viscosity-linear
linear: 1, → linear: ▸-1, ⇒ a coefficient of viscosity is -1 … expected zero or a positive number
{linear: 1, quadratic: 0} → ▸{linear: 1} ⇒ quadratic
- artificial → - artificial_viscosity: {linear: 0, quadratic: 0}\n    - artificial
viscosity: {linear: 1, → viscosity: ▸{linear: 1,
⇒ artificial viscosity appears twice
mpm: {basis: linear, transfer: flip, scheme: [musl, usl], start: half_step_back
   → ▸fem: {element: linear, mass: lumped
⇒ the built-in FEM does not support artificial viscosity
@vibrating-bar-of-two
mpm: {basis: linear, transfer: flip, scheme: [musl, usl] → ▸fem: {element: linear, mass: lumped
⇒ the built-in FEM supports a single body only, but the scene lists `bodies`
# Laws, conditions and studies that a state across the plane excludes in two dimensions.
@plane-stress-wave - ▸"v0/omega*sin(pi*X/L)
plane: stress → plane: ▸stretch ⇒ unknown name `stretch` … `strain` … `stress`
linear_elastic: {young: E, poisson: nu, → ▸j2: {young: E, poisson: nu, yield: 1,
⇒ the law `j2` is not supported in plane stress, where sigma_33 = 0 … use `linear_elastic`
sqrt(E/((1 - nu^2)*rho)) → sqrt(E*(1 - nu)/((1 + nu)*(1 - 2*nu)*rho))
⇒ equation of motion in X … this is not a solution
plane: stress → plane: strain ⇒ equation of motion in X … this is not a solution
- mpm: {basis: linear, transfer: flip → - ▸mpm: {basis: linear, transfer: tls
⇒ the transfer `tls` is not supported in `plane: stress` … integrates over cells in the plane
roller, right: roller, bottom: roller, top: roller}
   → roller}\n  loads: [▸artificial_viscosity: {linear: 1, quadratic: 1}]
⇒ `plane: stress` is not supported with `artificial_viscosity`: it is a pressure on all axes
roller, right: roller, bottom: roller, top: roller}
   → roller}\n  loads: [▸heat: {conductivity: 1, capacity: 1}]
⇒ `plane: stress` is not supported with `heat`: it is implemented in plane strain only
@axisymmetric-wave [▸"v0/omega
body: {box: {from: [0, 0] → ▸body: {box: {from: [-1, 0]
⇒ the body starts at the negative radius -1 … the first coordinate of the meridian plane
boundary: {left: roller, → ▸boundary: {
⇒ the left face lies on the axis, but is free … state `left: roller`
left: roller, right: roller → ▸left: periodic, right: periodic ⇒ the face `left` cannot be periodic
- mpm: {basis: linear → - ▸mpm: {basis: cpgimp
⇒ the basis `cpgimp` is not supported in `plane: axisymmetric` … Nairn & Guilkey 2015
transfer: [flip, apic] → transfer: tls
- mpm → - ▸mpm
⇒ the transfer `tls` is not supported in `plane: axisymmetric`
body: {box: {from: [0, 0], to: [b, → ▸bodies:\n    - body: {box: {from: [0, 0], to: [b,
material: →     material:
initial_velocity: → # initial_velocity:
⇒ `plane: axisymmetric` is not supported for several bodies
body: {box: {from: [0, 0], to: [b, b/4
   → ▸body: {quadrilateral: {corners: [[0, 0], [b, 0], [b, b/4], [0, b/4]
⇒ `plane: axisymmetric` is not supported for a quadrilateral
body: {box: {from: [0, 0], to: [b, b/4]}} → ▸body: {polygon: [[0, 0], [b, 0], [0, b]]}
boundary: → # boundary:
⇒ the free rim of the body touches the axis … move it to larger radii
initial_velocity → ▸initial_stress: {xx: "1"}\n  initial_velocity
⇒ `plane: axisymmetric` is not supported with an initial stress, which has no key for the hoop
   stress
judge: {norm: max_l2} → judge: {of: ▸kinetic_energy, norm: linf}
⇒ the exact solution does not provide the kinetic energy of a body of revolution
initial_velocity
   → sets: {tip: {box: {from: [b/2, 0], to: [b, b/4]}}}\n
    loads: [▸force: {on: tip, value: [1, 0]}]\n  initial_velocity
⇒ `plane: axisymmetric` is not supported with `force`: it is not defined
3.8317059702075123/b → pi/b
bessel_j1(k*X)*sin → sin(k*X)*sin
v0*bessel_j1 → v0*sin
⇒ equation of motion in X … this is not a solution
plane: axisymmetric → plane: strain ⇒ equation of motion in X … this is not a solution
- order: [1.9, 2.1] → - drift: {▸momentum: 1e-9}
⇒ this sum over the meridian plane is not conserved in a body of revolution
@pressurised-cylinder
# The hoop stress is part of the balance at the inner face, where the pressure acts.
Q: "(1 + nu)/E*p* → Q: "(1 + nu)/E*1e-5*
plane: axisymmetric → plane: strain
strain\n  displacement: ["u → strain\n  displacement: [▸"u
⇒ left is under pressure, traction in X … this is not a solution
Q: "(1 + nu)/E*p* → Q: "(1 + nu)/E*1e-5*
p: 1e-5 → p: 1.1e-5
strain\n  displacement: ["u → strain\n  displacement: [▸"u
⇒ left is under pressure, traction in X … this is not a solution
@load-steps-cylinder-uniform
- mpm: {basis: linear → - ▸mpm: {basis: cpgimp
⇒ the basis `cpgimp` is not supported in `plane: axisymmetric` … Nairn & Guilkey 2015
boundary: {left: roller, bottom: roller} → boundary: {left: roller}
body: → ▸body:
⇒ nothing holds the body along Y
plane: axisymmetric → ▸plane: stress ⇒ load steps are not supported in plane stress
traction: {on: right, value: ["(mu*(a^2 - 1) + L)/a", 0] → pressure: ▸{on: right, value: 1
⇒ `pressure` is not supported in load steps: it is a follower load
@bar
scene: → scene:\n  plane: ▸strain
⇒ `plane` needs a 2-D scene, but this scene is 1-D … expected in a scene of `dimension: 2`
@cube
scene: → scene:\n  plane: ▸strain
⇒ `plane` needs a 2-D scene, but this scene is 3-D … expected in a scene of `dimension: 2`
@plane-stress-pull displacement: [▸"(a
# The pressure acts on the current thickness of a face that is free across the plane.
p: "-E*ln(a)/(a*b^2)" → p: "-E*ln(a)/(a*b)" ⇒ boundary condition: right is … traction in X
plane: stress → # plane strain ⇒ boundary condition: right is … traction in X
"#;
