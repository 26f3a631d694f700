//! Bodies that come to rest, and the damping that they need.

use super::refuse_all;

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@column-hencky-small-load [▸"E/(rho0*g)
"-g*s(min(t/ramp, 1))" → "-1.01*g*s(min(t/ramp, 1))"
⇒ equation of motion in X … t = 8.000000 … this is not a solution
ramp: 2 → ramp: 10 ⇒ equation of motion in X … t = 8.000000
equation: hencky → equation: ▸neo_hookean
⇒ equation `neo_hookean` does not belong to the material `hencky`
- X"] → - X + ▸t"] ⇒ `t`
equilibrium: → ▸exact:\n  equation: hencky\n  displacement: ["X*t"]\n\nequilibrium:
⇒ the suite states both `exact` and `equilibrium`: keep one
until: 8 → until: [8, ▸9] ⇒ a suite with `equilibrium` has a single end time … expected one end
norm: l1 → norm: ▸max_l1
⇒ a `max_` norm needs a motion: with `equilibrium` the error exists only at the end
   … expected a norm at the end
of: stress → of: ▸kinetic_energy ⇒ the exact kinetic energy of the body is zero at all times
- damping: "pi*c/l0" → # no damping
methods: → methods:\n  - ▸fem: {element: linear, mass: lumped}
of: stress, →
⇒ the built-in FEM has no damping, so it does not reach an equilibrium
boundary: {left: fixed} → boundary: {left: fixed, ▸right: {velocity: [0]}}
dimension: 1 → dimension: 1\n  grid: {from: [0], to: [l0]}
⇒ the face `right` has a given velocity, but `equilibrium` needs a body at rest
loads:
   → sets:\n    ▸tip: {box: {from: [49], to: [50]}}\n  loads:\n    - velocity: {on: tip, value: [0]}
⇒ the set `tip` has a given velocity, but `equilibrium` needs a body at rest
- damping: "pi*c/l0" → - damping: 1\n    - damping: ▸"pi*c/l0" ⇒ damping appears twice
"pi*c/l0" → ▸"pi*c/l0*(1 - t/4)"
⇒ the rate of damping is - … expected zero or a positive number (1/s)
"pi*c/l0" → "pi*c/▸X" ⇒ `X`
equilibrium:\n  equation: hencky → manufactured:
methods: → methods:\n  - ▸fem: {element: linear, mass: lumped}
of: stress, →
⇒ the built-in FEM does not support damping
- damping: "pi*c/l0" → - local_damping: ▸1
⇒ the share of local damping is 1 … expected zero or a number below 1
- damping: "pi*c/l0" → - local_damping: ▸"-c" ⇒ expected zero or a number below 1
- damping: "pi*c/l0" → - local_damping: "1/(1 + ▸t)" ⇒ `t`
- damping: "pi*c/l0" → - local_damping: 0.5\n    - local_damping: ▸0.5 ⇒ local damping appears twice
- damping: "pi*c/l0" → - local_damping: 0.5
equilibrium:\n  equation: hencky → ▸manufactured:
of: stress, →
⇒ a part of it is manufactured … use `damping`
# The exact solution of the oedometer is a motion, not a state of rest.
@oedometer
[1.5, 1.8] → [1.5, 1.8]\n    ▸rest_below: 1e-6 ⇒ `rest_below` needs an `equilibrium` … `equilibrium`
@local-damping-bar
methods: → methods:\n  - ▸fem: {element: linear, mass: lumped}
⇒ the built-in FEM does not support damping
# Initial stresses: invalid laws, scenes and studies, and exact solutions that do not balance the
# stresses.
@geostatic-mohr-coulomb ▸initial_stress
cohesion: coh → cohesion: 0.5*coh
⇒ violates the yield condition of `mohr_coulomb`: f = … at (0, 0) m … f must not be positive
, zz: "-K0*G*(H - Y)"} → } ⇒ `initial_stress` does not state `zz` … all three normal stresses
zz: → ▸yz: 1, zz: ⇒ `yz` is not a stress component in 2-D … components: `xx`, `yy`, `zz`, `xy`
displacement: [0, 0] → displacement: [▸"1e-3*X*t^2", "1e-3*Y*t^2"]
⇒ is known in uniaxial strain only, but du_Y/dY is not zero
@prestressed-bar
{xx: S0} → {xx: S0, ▸zz: 1} ⇒ `zz` is not a stress component in 1-D … components: `xx`
hencky: {young: E, poisson: 0 → newtonian: {bulk: E, viscosity: 0
initial_stress → ▸initial_stress
⇒ a `newtonian` body does not support an initial stress … state an `initial_displacement`
{xx: S0} → ▸{} ⇒ `initial_stress` states no component … components: `xx`
{xx: S0} → {xx: "S0*▸t"} ⇒ `t`
c: "sqrt((E + S0)/rho)" → c: "sqrt(E/rho) + 0*S0"
["A*sin → [▸"A*sin
⇒ equation of motion in X
@clay-at-rest
loads: → ▸initial_stress: {xx: 1}\n  loads:
⇒ a `cam_clay` body does not support an initial stress … starts under its `initial_pressure`
@heat-2d
loads: → ▸initial_stress: {xx: 1}\n  loads: ⇒ a `rigid` body does not support an initial stress
@geostatic-slope displacement: [▸0
xy: "along*top(Y)" → ▸yx: "along*top(Y)" ⇒ unknown key `yx` … possible keys: `xx`, `yy`, `zz`, `xy`
boundary: → ▸initial_stress: {xx: 1}\n  boundary: ⇒ `initial_stress` is for a single body
yy: "-across*top(Y)" → yy: "-0.99*across*top(Y)" ⇒ equation of motion in Y
top(Y): "upper*(2*H - Y) → top(Y): "upper*(2.1*H - Y) ⇒ boundary condition: top is free, traction in
base(Y): "upper*H → base(Y): "0.9*upper*H ⇒ their tractions in
@thermal-expansion-clamped
loads: → initial_stress: {xx: 1}\n  loads:
- thermal_expansion → - ▸thermal_expansion
⇒ `thermal_expansion` is not supported with an initial stress
@released-bar
initial_displacement → ▸initial_stress: {xx: 0}\n  initial_displacement
⇒ the built-in FEM does not support an initial stress
@vibrating-bar-long
initial_velocity → initial_stress: {xx: 0}\n  initial_velocity
energy_rate → ▸energy_rate
⇒ the law `linear_elastic` is integrated in rate form and has no stored energy with an initial
   stress
@courant-limit
scene: → scene:\n  initial_stress: {xx: 1}
frozen: true → ▸frozen: true
⇒ a frozen run must start at rest, without loads and without initial stress
@path-mohr-coulomb-stressed
zz: "-l0" → zz: "-0.9*l0"
["rate*t*X → [▸"rate*t*X
⇒ the lateral initial stresses yy and zz differ
# Load steps: keys that require a motion in time, and loads, walls and laws that load steps exclude.
@load-steps-hencky
{load_steps: [1, 20]} → {load_steps: 20, ▸until: 1} ⇒ load steps have no time … keep one of them
run: {load_steps: [1, 20]} → run: ▸{dt: 1}
- mpm: {basis: [linear, ugimp, cpgimp], scheme: quasi_static} → - external: {name: mine}
⇒ a run needs an end … load_steps
[1, 20] → 20, ▸dt: 0.1 ⇒ `dt` is not supported with load steps: they have no duration
ppc: 2} → ppc: 2, ▸dt: [4, 3, 2, 1]} ⇒ `dt` is not supported with load steps: they have no duration
run: {load_steps: [1, 20]} → run: {load_steps: 20, ▸instants: 3}
⇒ `instants` is not supported with load steps: errors are computed after the last step only
displacement, → ▸velocity, ⇒ `velocity` is not supported with load steps: they have no velocity
displacement, norm: rms → ▸kinetic_energy ⇒ `kinetic_energy` is not supported with load steps
{of: displacement, norm: rms} → {of: ▸momentum} ⇒ `momentum` is not supported with load steps
[1, 20] → ▸0 ⇒ the number of load steps
[1, 20] → [1, ▸2.5] ⇒ the number of load steps
[1, 20] → ▸1000000 ⇒ expected a whole number from 1 to 1e5
[1, 20] → [20, ▸20] ⇒ 20 load steps appear twice
equilibrium: → ▸exact:
⇒ `exact` is not supported with load steps: it is a motion in time … `equilibrium`
equilibrium:\n  equation: hencky → ▸manufactured: ⇒ `manufactured` is not supported with load steps
run:
   → reference: {equation: hencky, ▸fem: {element: linear, mass: lumped, cells: 320, dt: 1e-3}}\n
  run:
⇒ `reference.fem` is not supported with load steps
K(lambert_w(q(X)))) - X → K(lambert_w(q(X)))) - X + 0*▸t ⇒ t
mpm: {basis: [linear, ugimp, cpgimp], scheme: quasi_static
   → ▸mpm: {basis: linear, transfer: flip, scheme: musl
⇒ this method needs time steps, and the suite has load steps
mpm: {basis: [linear, ugimp, cpgimp], scheme: quasi_static → ▸fem: {element: linear, mass: lumped
⇒ this method needs time steps, and the suite has load steps
run: {load_steps: [1, 20]} → run: {until: 1, dt: 0.1}
scheme: quasi_static → scheme: ▸quasi_static
⇒ `quasi_static` needs a number of load steps … run: {load_steps: 20}
scheme: → ▸transfer: flip, scheme: ⇒ `quasi_static` does not support `transfer` … no velocities
scheme: quasi_static → scheme: quasi_static, ▸mass: lumped ⇒ no inertia
scheme: quasi_static → scheme: quasi_static, ▸start: at_zero ⇒ no initial velocity
scheme: quasi_static → scheme: quasi_static, ▸frame: total_lagrangian ⇒ updated-Lagrangian
scheme: quasi_static → scheme: quasi_static, ▸volume: averaged ⇒ not implemented
scheme: quasi_static → scheme: quasi_static, ▸precision: single ⇒ double precision
scheme: quasi_static → ▸scheme: [quasi_static, musl] ⇒ a separate entry of `methods`
scheme: quasi_static → scheme: ▸quasistatic ⇒ `quasi_static`
run: {load_steps: [1, 20]} → run: {until: 1, dt: 0.1}
mpm: {basis: [linear, ugimp, cpgimp], scheme: quasi_static → ▸mpm: {basis: linear, scheme: musl
⇒ a scheme with time steps needs a `transfer` … add `transfer: flip`
- gravity: ["-g"] → - gravity: ▸["-g*t"] ⇒ `gravity` is not supported in load steps: it depends on t
- gravity: ["-g"] → - gravity: ["-g"]\n    - body_force: ▸["-ux"] ⇒ it depends on the displacement
- gravity: ["-g"] → - gravity: ["-g"]\n    - damping: ▸0.1 ⇒ there is no velocity to damp
- gravity: ["-g"] → - gravity: ["-g"]\n    - local_damping: ▸0.1 ⇒ there is no velocity to damp
gravity: ["-g"] → gravity: ["-g"]\n    - pressure: ▸{on: right, value: 1} ⇒ it is a follower load
loads:
   → sets: {tip: {box: {from: [40], to: [50]}}}\n  loads:\n    - velocity: ▸{on: tip, value: [1]}
⇒ a velocity belongs to a motion in time
left: fixed → ▸left: {velocity: [1]} ⇒ the left face … which load steps do not support
boundary: {left: fixed} → boundary: {}
body: → ▸body:
⇒ nothing holds the body along X
loads:\n    - gravity: ["-g"] → # no loads
material: → ▸material:
⇒ the scene has none
loads: → ▸initial_velocity: [1]\n  loads:
⇒ `initial_velocity` is not supported with load steps: they have no velocity
loads: → ▸initial_displacement: [1]\n  loads: ⇒ they start from the reference configuration
hencky: {young: E, poisson: 0, density: → linear_elastic: {young: E, poisson: 0, density:
equation: hencky → equation: small_strain
["E/(rho0*g)*(K(lambert_w(q(0))) - K(lambert_w(q(X)))) - X"] → ["-rho0*g/E*(l0*X - X^2/2)"]
functions:\n  q(Y): "rho0*g*(l0 - Y)/E"\n  K(w): "w + w^2/2"\n →
material: { → material: ▸{
⇒ `quasi_static` does not support `linear_elastic` … hencky
"#;
