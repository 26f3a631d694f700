//! Spectrum studies: invalid scenes, waves and expectations.

use super::refuse_in;
use crate::common::valid_suite;

/// A valid spectrum study.
pub(super) const WAVE: &str = "\
suite: wave
study: spectrum
title: A wave
source: a textbook
scene:
  dimension: 1
  body: {box: {from: [0], to: [16]}}
  material: {linear_elastic: {young: 1, poisson: 0, density: 1}}
  boundary: {left: periodic, right: periodic}
particles: {cells: 16, ppc: 2}
spectrum: {cells_per_wavelength: [8, 16], courant: [0.4]}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: usl}
expect:
  - phase_within: 0.02
    damping_within: 0.02
    because: theory says so
";

#[test]
fn mistakes_are_refused() {
    refuse_in(WAVE, IN_A_WAVE);
}

const IN_A_WAVE: &str = r"
ppc: 2} → ppc: 2, ▸perturb: 0.1} ⇒ a spectrum study needs regular particles
ppc: 2} → ppc: 2, ▸extra: [[1]]} ⇒ a spectrum study needs regular particles
ppc: 2} → ppc: 2, shift: ▸[0.25]}
⇒ 0.5 m apart are shifted by 0.25 m … less than half of their distance
[8, 16] → [8, ▸2]
⇒ the nodes of `mpm-linear-flip-usl` are on cell faces, where a sine of 2 cells is 0
[8, 16] → [8, ▸2]
basis: linear → basis: cubic_bspline
⇒ where a sine of 2 cells is 0
[0.4] → [0.4, ▸1e-9] ⇒ a wave of 8 cells needs 1.6e11 steps … at most 1e6 steps
[0.4] → [▸1.5e-4] ⇒ a wave of 8 cells needs 1.1e6 steps
body: {box: {from: [0], to: [16]}} → # two bodies
material: {linear_elastic: {young: 1, poisson: 0, density: 1}}\n
    boundary: {left: periodic, right: periodic
   → bodies:\n    ▸- {body: {box: {from: [0], to: [8]}}, material: {linear_elastic: {young: 1,
   poisson: 0, density: 1}}}\n
      - {body: {box: {from: [8], to: [16]}}, material: {linear_elastic: {young: 1, poisson: 0,
   density: 1}}}\n  grid: {from: [0], to: [16]
⇒ a spectrum study needs one body
{linear_elastic: → ▸{neo_hookean: ⇒ a spectrum study needs a linear law: `linear_elastic`
{left: periodic, right: periodic} → ▸{left: fixed, right: fixed}
⇒ a spectrum study needs periodic faces
boundary: {left: periodic, right: periodic} → # free faces
dimension: → ▸dimension:
⇒ a spectrum study needs periodic faces
dimension: 1 → dimension: ▸2
from: [0], to: [16] → from: [0, 0], to: [16, 16]
⇒ a spectrum study needs one dimension
courant: [0.4] → courant: [0.4, ▸0.8]
⇒ a spectrum study needs a Courant number below the stability limit
   … of `mpm-linear-flip-usl` is 0.7559
wavelength: [8, 16] → wavelength: [8, ▸1.6] ⇒ a spectrum study needs at least 2 cells per wavelength
wavelength: [8, 16] → wavelength: [▸5, 16]
⇒ a spectrum study needs a whole number of wavelengths in the row of cells … 3.2 wavelengths
wavelength: [8, 16] → wavelength: ▸32 ⇒ a spectrum study needs a whole number of wavelengths
ppc: 2 → ppc: 1
wavelength: [8, 16] → wavelength: ▸2
⇒ a spectrum study needs a wave that the grid represents
   … the symbol s of the mass of `mpm-linear-flip-usl` is 0
particles: →   loads:\n    ▸- gravity: [-1]\nparticles:
⇒ a spectrum study needs a body without loads
dimension: → ▸dimension:
particles: →   initial_velocity: [1]\nparticles:
⇒ a spectrum study needs a body at rest
basis: linear, transfer: flip → basis: quadratic_bspline, transfer: ▸tls
⇒ a spectrum study needs a transfer with a closed form … `tls` with a lumped mass matrix has none
basis: linear, transfer: flip → basis: quadratic_bspline, transfer: tpic
ppc: 2 → ppc: 2, shift: ▸[0.01]
⇒ a spectrum study needs particles that are symmetric in their cells for `tpic`
scheme: usl → scheme: usl, precision: ▸single ⇒ a spectrum study needs double precision
- mpm: {basis: linear, transfer: flip, scheme: usl} → - ▸fem: {element: linear, mass: lumped}
⇒ a spectrum study needs methods of MPM in time … --solver COMMAND
- phase_within: 0.02\n    damping_within: 0.02\n    because → - ▸because
⇒ this expectation is empty … `phase_within` or `damping_within`
phase_within: 0.02 → phase_within: ▸-0.02 ⇒ the deviation is -0.02
courant: [0.4] → courant: [0.4], solvers: {mine: ▸mpm-linear-flip-musl}
⇒ there is no case `mpm-linear-flip-musl` … did you mean `mpm-linear-flip-usl`?
";

/// The unchanged suite has waves of eight and sixteen cells. The other one has waves of four cells,
/// and particles away from the lattice, on any grid.
#[test]
fn unchanged_suite_is_valid() {
    let shifted = WAVE.replace("ppc: 2}", "ppc: 2, shift: [-0.2]}").replace("[8, 16]", "4");
    for text in [WAVE, &shifted] {
        valid_suite(text);
    }
}
