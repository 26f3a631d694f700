//! Judged quantities, and bounds on measured values.

use super::refuse_all;
use super::samples::BAR;
use crate::common::valid_suite;

const EXPECTED: &str = "    verdict: too_few_levels\n    finest_pair: [1.5, 2.5]\n";

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@bar - ▸fem:
{norm: rms} → {of: ▸strain} ⇒ unknown name `strain` … displacement … deformation_gradient
{norm: rms} → {norm: ▸max_rsm} ⇒ max_rsm … max_rms
{norm: rms} → {scale: ▸"E - 100"}
⇒ the scale of the error is 0, but must be above zero … expected a positive number
{norm: rms} → {scale: ▸"1/(E - 100)"} ⇒ is inf because `E` is 100
{norm: rms} → {of: stress} ⇒ the built-in FEM does not provide the stress that this suite judges
{norm: rms} → {of: deformation_gradient}
⇒ the built-in FEM does not provide the deformation gradient
   … judge the displacement or the velocity
norm: rms → of: stress_xx ⇒ the built-in FEM does not provide the stress xx that this suite judges
{norm: rms} → {of: kinetic_energy}
⇒ the built-in FEM does not provide the kinetic energy that this suite judges
{norm: rms} → {of: velocity, ▸face: left} ⇒ the velocity is not a quantity of a face
finest_pair: [1.5, 2.5] → error_below: ▸-1e-9 ⇒ a bound is -1e-9, but must be above zero
finest_pair: [1.5, 2.5] → error_below: ▸.nan ⇒ finite
finest_pair: [1.5, 2.5] → error_above: ▸0 ⇒ a bound is 0, but must be above zero
finest_pair: [1.5, 2.5] → error_below: 1e-9\n    error_above: ▸1e-6
⇒ no error is below 1e-9 and above 1e-6
finest_pair: [1.5, 2.5] → drift: ▸{} ⇒ `drift` is empty … mass, momentum, angular_momentum
finest_pair: [1.5, 2.5] → drift: {▸momentun: 1e-12} ⇒ not a known key … did you mean `momentum`?
finest_pair: [1.5, 2.5] → drift: {momentum: ▸-1} ⇒ a bound is -1, but must be above zero
finest_pair: [1.5, 2.5] → drift: {▸angular_momentum: 1e-12} ⇒ there is no angular momentum in 1-D
finest_pair: [1.5, 2.5] → energy_rate: ▸[1e-9] ⇒ an interval has two ends
finest_pair: [1.5, 2.5] → energy_rate: ▸[1e-9, -1e-9] ⇒ expected [low, high]
- case: "fem-*"\n    verdict: too_few_levels → - case: "fem-*"\n    ▸drift: {momentum: 1e-12}
⇒ the built-in FEM does not compute the sums whose drift is bounded here
- case: "fem-*"\n    verdict: too_few_levels → - case: "fem-*"\n    ▸energy_rate: [-1, 1]
⇒ the built-in FEM does not compute the sums whose drift is bounded here
observe: {at: [12.5]}\n →
finest_pair: [1.5, 2.5] → ▸observed_within: 1e-3
⇒ `observed_within` needs an observed point, but the suite has no `observe`
   … add `observe: {at: [...]}` to the suite
@mpm-bar
{norm: rms} → {of: stress}
run:
   → ▸reference:\n  equation: small_strain\n
    fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:
⇒ a reference does not provide the stress that this suite judges
{norm: rms} → {of: ▸mean_stress} ⇒ there is no mean stress in 1-D … use a scene with more dimensions
{norm: rms} → {of: ▸stress_xy} ⇒ there is no stress xy in 1-D
{norm: rms} → {of: kinetic_energy, norm: ▸max_rms}
⇒ the kinetic energy is one number for the whole body
   … `linf` for the largest value over the instants
{norm: rms} → {of: momentum, ▸face: left}
⇒ the momentum is not a quantity of a face … judge the `reaction`
{norm: rms} → {of: ▸angular_momentum} ⇒ there is no angular momentum in 1-D
{norm: rms} → {of: reaction, face: ▸lefft}
⇒ a body of dimension 1 has no face `lefft` … did you mean `left`?
{norm: rms} → {of: reaction, face: ▸right}
⇒ the right face is free: only a fixed face or a roller has a reaction
{norm: rms} → {of: ▸reaction}
boundary: {left: fixed} → boundary: {}
v0*mode(X) → v0*cos(pi*X/L)
v0/omega*mode(X)*sin(omega*t) → v0/(2*omega)*cos(pi*X/L)*sin(2*omega*t)
functions:\n  mode(s): "sin(pi*s/(2*L))"\n →
⇒ there is no reaction, because no face is held … `fixed` or `roller`
{norm: rms} → {of: reaction}
scheme: [musl, usl]} → scheme: [musl, usl], mass: ▸consistent}
⇒ a reaction contains the inertia of other nodes … use `lumped`
@oedometer-mohr-coulomb-mean-stress [▸0, "rate*t*Y"]
# Stresses that a body in plane strain does not have, and motions whose stress is unknown.
{of: mean_stress → {of: ▸stress_yz ⇒ there is no stress yz in 2-D
{of: mean_stress → {of: ▸mean_stress
mohr_coulomb: {young: E, poisson: nu, friction_angle: 30, dilation_angle: 10, cohesion: c
   → linear_elastic: {young: E, poisson: nu
equation: mohr_coulomb → equation: small_strain
initial_stress: → # no initial_stress:
s0: 40 → # s0: 40
k0: 0.5 → # k0: 0.5
frame: total_lagrangian → frame: updated_lagrangian
rate: -0.02 → rate: -1e-9
c: 10 → # c: 10
⇒ the out-of-plane stress of `linear_elastic` in plane strain is not computed
{of: mean_stress → {of: ▸mean_stress
frame: total_lagrangian → volume: averaged
⇒ the out-of-plane stress of averaged volume ratios is not computed
[0, "rate*t*Y"] → [▸"1e-9*t*X", "rate*t*Y"]
⇒ the stress of `mohr_coulomb` is known in uniaxial strain only, but du_Y/dY is not zero
zz: "-k0*s0" → zz: "-0.9*k0*s0" ⇒ the lateral initial stresses xx and zz differ
yy: "-s0" → yy: "-s0", xy: 1 ⇒ a body in uniaxial strain has an initial shear stress
@plate
# In a plane: the energy of a law in rate form, and a corner between two fixed walls.
{left: fixed} → {left: fixed, bottom: roller}
methods: → judge: {▸of: strain_energy}\nmethods:
⇒ `linear_elastic` is integrated in rate form
{left: fixed} → {left: fixed, bottom: roller}
methods: → judge: {of: reaction, face: ▸left}\nmethods:
⇒ the reactions of `left` and … leave `face` out to judge all walls together
# In a plane, the stress of a law in rate form has no energy.
verdict: too_few_levels → drift: {▸energy: 1e-3}
⇒ `linear_elastic` is integrated in rate form … use `neo_hookean` or `hencky`
verdict: too_few_levels → ▸energy_rate: [-1e-9, 1e-9]
⇒ `linear_elastic` is integrated in rate form … use `neo_hookean` or `hencky`
@prestressed-bar
{norm: max_rms} → {of: ▸energy}
⇒ the exact solution does not provide the stored energy of a body with an initial stress
# Cases and their expectations: each case has exactly one expectation.
@bar
case: "fem-*" → case: ▸"fme-*"
⇒ `fme-*` matches no case … cases: mpm-linear-flip-musl, mpm-linear-flip-usl, fem-linear-lumped
case: "mpm-*" → case: ["mpm-*", ▸"mmp-*"] ⇒ `mmp-*` matches no case
- case: "fem-*" → - ▸case: "*" ⇒ a second expectation for the case `mpm-linear-flip-musl`
expect: → ▸expect:
case: "mpm-*" → case: "mpm-*-musl"
⇒ the case `mpm-linear-flip-usl` has no expectation
[1.5, 2.5] → ▸[2.5, 1.5] ⇒ the interval ends at 1.5 and starts at 2.5 … expected [low, high]
[1.5, 2.5] → ▸[2.5] ⇒ an interval has two ends … expected [low, high]
because: two → because: ▸"" # two
⇒ `because` is empty: state the reason for this expectation … expected a text
because: two → because: ▸"  " # two ⇒ `because` is empty: state the reason for this expectation
- case: "mpm-*"\n    verdict: too_few_levels → - ▸case: "mpm-*"
⇒ this expectation has no order, no verdict and no bound
   … add `order: [1.9, 2.1]`, `verdict: divergent` or `error_below: 1e-12`
methods: → methods: ▸[]
- mpm: → # mpm:
- fem: → # fem:
⇒ the suite has no cases: `methods` is empty
"#;

#[test]
fn suite_with_bounds_and_one_level_is_valid() {
    let bounds = "    error_below: \"v0\"\n    error_above: 1e-9\n    drift: {mass: 1e-14}\n    observed_within: 1\n";
    let text = BAR.replace(EXPECTED, bounds).replace("cells: [6, 12]", "cells: 12");
    let text = text.replace("{norm: rms}", "{of: velocity, norm: max_linf, scale: v0}");
    valid_suite(&text);
}
