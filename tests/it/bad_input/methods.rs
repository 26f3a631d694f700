//! Methods whose parts cannot be combined: averaged volume ratios and precisions in places where
//! they have no effect, and automatic time steps.

use super::refuse_all;
use mpm_verify::mpm::{FrameName, MaterialPlan, VolumeName, combine_volume};
use mpm_verify::subject::PlaneState;

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@two-shears-nearly-incompressible
volume: [particle, averaged] → volume: ▸average ⇒ unknown name `average` … did you mean `averaged`?
volume: [particle, averaged] → volume: ▸cells ⇒ unknown name `cells` … `particle` … `averaged`
volume: [particle, averaged] → volume: ▸2 ⇒ expected
- mpm: {basis: linear → - ▸mpm: {basis: linear, frame: total_lagrangian
⇒ `volume: averaged` … the frame `total_lagrangian`
order: → ▸drift: {energy: 1e-3}\n    order:
⇒ the force of `volume: averaged` does not derive from a stored energy
order: → ▸energy_rate: [0.9, 1.1]\n    order:
⇒ the force of `volume: averaged` does not derive from a stored energy
methods: → judge: {of: strain_energy}\n\nmethods:
volume: [particle, averaged] → volume: ▸[particle, averaged]
⇒ the force of `volume: averaged` does not derive from a stored energy
@cooks-membrane-averaged - ▸mpm: {
neo_hookean: {young → linear_elastic: {young
⇒ `volume: averaged` is not supported with the law `linear_elastic`
   … a law in rate form does not compute its stress from F or J
neo_hookean: {young → jaumann: {young
⇒ `volume: averaged` is not supported with the law `jaumann`
   … a law in rate form does not compute its stress from F or J
neo_hookean: {young → green_naghdi: {young
⇒ `volume: averaged` is not supported with the law `green_naghdi`
   … a law in rate form does not compute its stress from F or J
@bar
- mpm: {basis: linear, → - ▸mpm: {volume: averaged, basis: linear,
⇒ `volume: averaged` … in 1-D … volumetric locking does not occur
@acoustic-column-finite
- mpm: { → - ▸mpm: {volume: averaged,
⇒ `volume: averaged` is not supported in 1-D: it would average the whole strain
@plane-stress-wave
- mpm: {basis: linear, → - ▸mpm: {volume: averaged, basis: linear,
⇒ `volume: averaged` … `plane: stress` … volumetric locking does not occur
# Parts of a method that cannot be combined.
@bar - ▸mpm:
flip, scheme: [musl, usl] → [flip, mls], scheme: musl ⇒ the transfer `mls` … the basis `linear`
linear, transfer: flip, scheme: [musl, usl]
   → cpgimp, transfer: fmpm_2, scheme: musl, mass: consistent
⇒ the transfer `fmpm_2` … is not supported with the mass matrix `consistent`
linear, transfer: flip, scheme: [musl, usl]
   → cubic_bspline, transfer: apic, scheme: musl, mass: consistent
⇒ the transfer `apic` … is not supported with the mass matrix `consistent`
linear, transfer: flip, scheme: [musl, usl]
   → cpdi, transfer: flip, scheme: musl, frame: total_lagrangian
⇒ the basis `cpdi` … the frame `total_lagrangian`
linear, transfer: flip → ugimp, transfer: tls ⇒ the transfer `tls` … the basis `ugimp`
flip, scheme: [musl, usl] → tls, scheme: musl, frame: total_lagrangian
⇒ the transfer `tls` … the frame `total_lagrangian`
transfer: flip → transfer: ▸apci ⇒ unknown name `apci` … did you mean `apic`?
[musl, usl] → musl, frame: ▸total ⇒ unknown name `total` … total_lagrangian
# Invalid automatic time steps.
dt: 1e-3 → dt: auto
- fem: { → - ▸fem: {
⇒ an automatic time step is available for MPM only
@mpm-bar
dt: 1e-3 → dt: {courant: ▸0} ⇒ must be above zero
dt: 1e-3 → dt: {▸currant: 0.5} ⇒ currant … courant
dt: 1e-3, →
cells: [6, 12] → cells: 6, dt: [▸auto, 1e-3]
⇒ auto
@tiny-nodal-mass
"C*h/c" → {courant: C}, ▸alternate: 0.1 ⇒ `alternate` is not supported with an automatic time step
# Precisions of a method in places where they have no effect.
@single-precision-bar
precision: [double, single] → precision: ▸singel ⇒ unknown name `singel` … did you mean `single`?
precision: [double, single] → precision: ▸32 ⇒ expected
@two-bar-impact - ▸mpm:
transfer: → precision: single, transfer: ⇒ `precision: single` is supported for a single body only
@cold-flow
transfer: → precision: ▸single, transfer: ⇒ a stability study needs double precision
"#;

/// In a plane, every law is tried. Laws of F or of J alone can be combined with an average.
#[test]
fn a_law_that_reads_neither_f_nor_j_is_refused_by_name() {
    let (averaged, updated) = (VolumeName::Averaged, FrameName::Updated);
    let mut refused = Vec::new();
    for plan in MaterialPlan::every(|_| 0.25) {
        let known = combine_volume(averaged, updated, &plan, 2, PlaneState::Strain);
        if let Err(reason) = known {
            let name = format!("the law `{}`", plan.name());
            assert!(reason.to_string().contains(&name), "{reason}");
            refused.push(plan.name());
        }
        assert!(
            combine_volume(VolumeName::Particle, updated, &plan, 1, PlaneState::Strain).is_ok()
        );
    }
    refused.sort_unstable();
    assert_eq!(refused, ["cam_clay", "green_naghdi", "jaumann", "linear_elastic", "rigid"]);
}
