//! The start of a run of a stability study.

use crate::exact::Random;
use crate::study::setup::body::Body;
use crate::study::setup::initial_state::Initial;
use crate::subject::Perturbable;
use crate::suite::compile::stability::setup::RunSetup;
use crate::suite::model::Scene;

/// Seed of the perturbations at the start.
const SEED: u64 = 8;

/// The bodies that a run starts from, each in a scene of its own.
pub(super) fn bodies<'a>(setup: &'a RunSetup, each: &'a [Scene]) -> Vec<Body<'a>> {
    let body = |own| Body {
        scene: &setup.scene,
        own,
        initial: Initial::stated(own),
        manufactured: None,
        heat: None,
        keeps_deformation: false,
        lattice: setup.lattice.clone(),
    };
    each.iter().map(body).collect()
}

/// Adds a random number to each number of the state, so that no mode is left out, if the run starts
/// so.
pub(super) fn perturb(subject: &mut dyn Perturbable, setup: &RunSetup) {
    if !(setup.perturb > 0.0) {
        return;
    }
    let (mut state, mut sizes, mut random) = (Vec::new(), Vec::new(), Random::new(SEED));
    subject.state(&mut state);
    subject.sizes(setup.scales.speed, setup.scales.modulus, &mut sizes);
    for (number, size) in state.iter_mut().zip(&sizes) {
        *number += setup.perturb * size * random.between(-1.0, 1.0);
    }
    subject.set_state(&state);
}
