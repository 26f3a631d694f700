//! The start of a run of a stability study, and the run as a problem for an external solver.

use crate::exact::Random;
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::study::handover::{HandedRun, is_deformed, of_scene, problem, start, unloaded};
use crate::study::setup::body::Body;
use crate::study::setup::initial_state::Initial;
use crate::subject::{Perturbable, Samples, Subject, SubjectError};
use crate::suite::compile::stability::setup::RunSetup;
use crate::suite::model::Scene;
use crate::verify::is_looked_at;

/// The needs of a run.
pub(super) fn needs(setup: &RunSetup) -> ProblemNeeds {
    let start = handed("", setup).map(|problem| problem.particles);
    let mut needs = ProblemNeeds {
        // The energy that a trial watches is partly stored.
        column: Some("stress"),
        // A run that cannot be passed to a solver is reported when it is run.
        initial_deformation: start.is_ok_and(|start| is_deformed(&start, setup.scene.dimension())),
        ..of_scene(&setup.scene)
    };
    for (is_needed, what) in [
        (setup.frozen, "a configuration that no step changes"),
        (setup.dt.len() > 1, "steps of two lengths"),
        (setup.scales.null_space, "the energy in the null space"),
        (setup.ledger, "the energy of each stage of a step"),
    ] {
        if is_needed {
            needs.beyond.push(what);
        }
    }
    needs
}

/// The solver at the start of a run of the suite named `suite`.
///
/// # Errors
/// One line with the reason why it cannot be observed.
pub(super) fn subject(
    solver: &dyn SolverFactory,
    suite: &str,
    setup: &RunSetup,
) -> Result<Box<dyn Subject>, SubjectError> {
    let subject = solver.subject(handed(suite, setup)?)?;
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    // Without either, growth of the energy could not be detected.
    match (subject.totals(), samples.stress.is_empty()) {
        (None, _) => Err("it gives no totals, from which the kinetic energy is read".into()),
        (_, true) => {
            Err("it gives no stress at the start, from which the energy is computed".into())
        }
        _ => Ok(subject),
    }
}

/// The problem of a run of the suite named `suite`. Its state is compared at the checks of a trial.
///
/// # Errors
/// One line with the reason why there is none.
fn handed(suite: &str, setup: &RunSetup) -> Result<LevelProblem, SubjectError> {
    let dt = *setup.dt.first().ok_or("the run has no time step")?;
    let bare = unloaded(&setup.scene);
    let mut disturb = |subject: &mut dyn Perturbable| perturb(subject, setup);
    let particles = start(&bodies(setup, &bare), setup.level, &mut disturb)?;
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

/// Seed of the perturbations at the start.
const SEED: u64 = 8;

/// The bodies at the start of a run, each in its own scene.
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

/// Adds a random number to each number of the state, so that every mode is present, if the run
/// requests it.
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
