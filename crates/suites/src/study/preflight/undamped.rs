//! Warns of an equilibrium without dissipation.

use super::subject::Preflight;
use crate::exact::{Problem, Truth, variables};
use crate::mpm::{TransferChoice, TransferName};
use crate::study::exact_motion::raster;
use crate::study::handover::level_problem;
use crate::suite::model::method::Method;
use crate::suite::model::{Case, ConvergencePlan, Scene};
use crate::suite::scene::load::EffectName;
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::StepKind;

/// Loading counts as sudden if more than this fraction of the final load acts at the start.
const SUDDEN: f64 = 0.1;

/// Number of intervals along each axis. Loads are evaluated at the ends of the intervals.
const INTERVALS: usize = 4;

/// Minimum initial distance from the equilibrium, as a fraction of its displacement.
const AWAY: f64 = 1e-3;

/// Warns of a body that oscillates about its equilibrium; a note if the load grows slowly.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let plan = preflight.plan;
    let Some(case) = plan.cases.iter().find(|case| oscillates(plan, case)) else {
        return Vec::new();
    };
    let message = format!(
        "the suite states an equilibrium, but neither the scene nor {} removes energy: the body \
         oscillates about its equilibrium",
        case.name
    );
    let severity = if is_loaded_at_once(plan, case) { Severity::Warning } else { Severity::Note };
    let found = preflight.finding(severity, &Path::top("equilibrium"), &message);
    vec![found.with_help(HELP)]
}

/// Advice on entries of `loads` that dissipate energy.
pub(crate) const HELP: &str = "list `damping` or `local_damping` in `loads`, and run until the body is \
                               at rest";

/// Whether a case without dissipation does not start in the stated equilibrium. External solvers
/// are assumed to have no dissipation.
pub(crate) fn oscillates(plan: &ConvergencePlan, case: &Case) -> bool {
    let Some(problem) = plan.exact.as_ref().filter(|exact| exact.at_rest) else { return false };
    plan.steps == StepKind::Time
        && !removes_energy(&plan.scene, case)
        && starts_away(plan, case, problem)
}

/// Whether anything dissipates energy. Plasticity does not: elastic oscillations remain.
fn removes_energy(scene: &Scene, case: &Case) -> bool {
    let terms = scene.terms();
    let resists = |share: f64| {
        terms.iter().any(|term| term.resistance(share * case.until, 1.0, &|| 1.0) != 0.0)
    };
    let is_viscous =
        |body: &Scene| body.material.parameter("viscosity").is_some_and(|value| value > 0.0);
    [0.0, 0.5, 1.0].into_iter().any(resists)
        || scene.lists(EffectName::ArtificialViscosity)
        || scene.each().iter().any(is_viscous)
        || scene.faces.iter().any(|face| face.condition() == "friction")
        || scene.contact.is_some_and(|friction| friction > 0.0)
        || matches!(case.method, Method::Mpm(method) if !keeps_energy(method.transfer))
}

/// Whether a transfer conserves the energy of motions that the grid resolves.
fn keeps_energy(transfer: TransferChoice) -> bool {
    use TransferName::{Apic, Flip, Mls, Tls, Tpic};
    [Flip, Apic, Mls, Tpic, Tls].into_iter().any(|name| transfer == name.into())
}

/// Whether a particle starts away from its equilibrium position or with a velocity.
fn starts_away(plan: &ConvergencePlan, case: &Case, problem: &Problem) -> bool {
    let Some(level) = plan.refine.levels.first() else { return false };
    // If the set-up of a level fails, its run reports the reason.
    let Ok(start) = level_problem("", plan, case, *level) else { return false };
    let (d, particles) = (plan.scene.dimension(), start.particles);
    let mut most = [0.0_f64; 2];
    let places = particles.reference_position.chunks(d).zip(particles.position.chunks(d));
    for (label, x) in places {
        let mut u = vec![0.0; d];
        problem.displacement(label, case.until, &mut u);
        for axis in 0..d {
            let away = x[axis] - label[axis] - u[axis];
            most = [most[0].max(away.abs()), most[1].max(u[axis].abs())];
        }
    }
    let moves = particles.velocity.iter().any(|v| *v != 0.0);
    moves || most[0] > AWAY * most[1]
}

/// Whether more than the fraction [`SUDDEN`] of the final forces acts at the start.
fn is_loaded_at_once(plan: &ConvergencePlan, case: &Case) -> bool {
    let Some(problem) = &plan.exact else { return true };
    let labels = raster(problem, INTERVALS);
    let size = |t: f64| {
        let mut most = 0.0_f64;
        for label in &labels {
            let values = &variables(label, t)[..=label.len()];
            for load in &plan.scene.loads {
                let stated = (0..label.len()).map(|i| load.stated(i, label, t, &[0.0; 3]));
                most = stated.chain(load.traction(values)).fold(most, |a, b| a.max(b.abs()));
            }
        }
        most
    };
    let last = size(case.until);
    !(size(0.0) <= SUDDEN * last) || last == 0.0
}
