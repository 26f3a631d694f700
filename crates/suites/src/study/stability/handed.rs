//! The initial state of a run in a stability study, also as a problem for external solvers.

use crate::exact::Random;
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::study::handover::{HandedRun, is_deformed, of_scene, problem, start, unloaded};
use crate::study::setup::body::Body;
use crate::study::setup::initial_state::Initial;
use crate::subject::{Perturbable, Samples, Subject, SubjectError};
use crate::suite::model::Scene;
use crate::suite::model::stability::RunSetup;
use crate::verify::is_looked_at;

pub(super) fn needs(setup: &RunSetup) -> ProblemNeeds {
    let start = handed("", setup).map(|problem| problem.particles);
    let mut needs = ProblemNeeds {
        // A trial observes the stored energy, which requires stresses.
        columns: vec!["stress"],
        // If the problem cannot be created, the run reports the reason later.
        initial_deformation: start.is_ok_and(|start| is_deformed(&start, setup.scene.dimension())),
        ..of_scene(&setup.scene)
    };
    for (is_needed, what) in [
        (setup.frozen, "a configuration that no step changes"),
        (setup.dt.len() > 1, "steps of two lengths"),
        (setup.scales.null_space, "the energy in the null space"),
    ] {
        if is_needed {
            needs.beyond.push(what);
        }
    }
    needs
}

pub(super) fn subject(
    solver: &dyn SolverFactory,
    suite: &str,
    setup: &RunSetup,
) -> Result<Box<dyn Subject>, SubjectError> {
    let subject = solver.subject(handed(suite, setup)?)?;
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    // Without totals or stresses, growth of the energy could not be detected.
    match (subject.totals(), samples.stress.is_empty()) {
        (None, _) => Err("it sends no totals, which contain the kinetic energy".into()),
        (_, true) => Err("it sends no initial stress, from which the energy is computed".into()),
        _ => Ok(subject),
    }
}

/// Creates the problem of a run. Its instants are the steps after which a trial checks the state.
fn handed(suite: &str, setup: &RunSetup) -> Result<LevelProblem, SubjectError> {
    let dt = *setup.dt.first().ok_or("the run has no time step")?;
    let bare = unloaded(&setup.scene);
    let mut disturb = |subject: &mut dyn Perturbable| perturb(subject, setup);
    let particles = start(bodies(setup, &bare), setup.level, &mut disturb)?;
    let steps = setup.steps;
    let instants = (1..=steps).filter(|step| is_looked_at(*step, steps)).collect();
    let run = HandedRun {
        load_steps: None,
        steps,
        dt,
        until: steps as f64 * dt,
        instants,
        particles,
        initial: setup.scene.each().iter().map(Initial::stated).collect(),
        is_perturbed: setup.perturb > 0.0,
    };
    Ok(problem(suite, &setup.scene, None, setup.level, run))
}

/// Seed of the random perturbations of the initial state.
const SEED: u64 = 8;

pub(super) fn bodies<'a>(setup: &'a RunSetup, each: &'a [Scene]) -> Vec<Body<'a>> {
    each.iter().map(|own| Body::stated(&setup.scene, own, setup.lattice.clone())).collect()
}

/// Adds a random number to each component of the state, if requested: every mode is excited.
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
