//! A body that spreads and shears: the stress in it, by the momentum that flows through its middle.
//!
//! With an initial velocity `v = L (X - C)` the strain is uniform, L t, until waves come in from
//! the free faces, and no force acts inside. Momentum goes from one half to the other as
//! `dP_j/dt = -sigma_ij A` through the middle plane with normal i: of a tube of particles about the
//! axis i it can be counted exactly, whatever the functions, from velocities alone.
//!
//! ```text
//! measure   the scene, and moduli by momentum
//! moduli    mistakes that give certain moduli
//! columns   the columns `stress` and `deformation_gradient`
//! ```

mod columns;
mod measure;
mod moduli;

pub(super) use measure::spreading;

use crate::subject::Precision;
use crate::testing::doctor::course::{Course, shown, size, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::BoxScene;
use measure::{STRETCH, SeenModuli, moduli_of};

pub(super) const EXAMINATION: Examination = Examination {
    name: "stress",
    expected: "a body that spreads and shears has the stress of its law, which moves momentum and keeps \
               its sum",
    after: &["conversation", "rest", "translation"],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene =
        patient.able(&[2, 3, 1], &|kind| spreading(kind, if kind.0 == 3 { 10.0 } else { 12.0 }))?;
    let mut course = patient.run(&scene)?;
    let mut seen = moduli_of(&course, &scene);
    let (lambda, mu) = scene.lame();
    let ratio = seen.along.abs() / (lambda + 2.0 * mu);
    // Faster waves than expected would have come in: again, in a shorter time.
    if ratio > 2.0 {
        let shorter = BoxScene { dt: scene.dt / ratio.sqrt(), ..scene.clone() };
        course = patient.run(&shorter)?;
        seen = moduli_of(&course, &shorter);
    }
    let measured = measured(&scene, &seen);
    let mut findings = Vec::new();
    if let Some(failure) = &course.failure {
        return Err(Hindrance::Broke(failure.clone()));
    }
    findings.extend(lost_momentum(patient, &course, &scene));
    if findings.is_empty() {
        findings.extend(moduli::cause(&scene, &seen));
    }
    if findings.is_empty() {
        findings.extend(columns::findings(&course, &scene));
    }
    let moduli_are_sound = findings.is_empty();
    if moduli_are_sound && seen.spread > 0.05 {
        findings.push(SolverFinding::remark(
            "momentum-spreads",
            format!("momentum spreads with a viscosity of {} m2/s", shown(seen.viscosity)),
            "velocities are averaged over cells in each step (PIC, or a share of it), or viscosity acts",
            "shares of PIC and FLIP; the smaller the step, the more of it: waves are damped, and their \
             order falls",
        ));
    }
    if moduli_are_sound && seen.jump > 0.05 {
        findings.push(SolverFinding::remark(
            "first-step-spreads",
            format!(
                "the first step moves momentum by itself: {} of what stress moves in the run",
                shown(seen.jump)
            ),
            "particles start without the gradient of their velocity: the first step is one of PIC, \
             which averages velocities over cells",
            "affine matrices (APIC, MLS-MPM) at the start: those of the grad v of the initial velocity, \
             which a fit through neighbours or one transfer without motion gives",
        ));
    }
    Ok(Examined::new(measured, findings))
}

fn measured(scene: &BoxScene, seen: &SeenModuli) -> String {
    let (lambda, mu) = scene.lame();
    let whole = shown(lambda + 2.0 * mu);
    let along = shown(seen.along);
    if scene.dimension == 1 {
        return format!("by momentum, the modulus is {along} Pa, where {whole} Pa was expected");
    }
    let [across, one, other] = [seen.across, seen.shear[0], seen.shear[1]].map(shown);
    format!(
        "by momentum, moduli are {along} Pa along a stretch, {across} Pa across it, and {one} and \
         {other} Pa of shear, where {whole}, {} and {} Pa were expected",
        shown(lambda),
        shown(mu)
    )
}

/// Momentum of all, which no inner force changes.
fn lost_momentum(
    patient: &Patient<'_>,
    course: &Course,
    scene: &BoxScene,
) -> Option<SolverFinding> {
    let last = course.last();
    let (start, end) = (course.mean(velocity, 0), course.mean(velocity, last));
    let change: [f64; 3] = std::array::from_fn(|i| end[i] - start[i]);
    // Speed that a face gains in the time.
    let gain = scene.wave_speed() * STRETCH * course.times[last];
    let share = size(change) / gain;
    let most = match patient.solver.precision() {
        Precision::Double => 1e-6,
        Precision::Single => 0.02,
    };
    (share > most).then(|| {
        SolverFinding::defect(
            "momentum-lost",
            format!(
                "the momentum of the whole body changes, in the mean by {} of the speed that its faces \
                 gain",
                shown(share)
            ),
            "inner forces do not sum to zero, or the momentum of nodes does not come back whole",
            "gradients of a particle, whose sum must be zero; nodes that are left out for their small \
             mass; walls and limits of velocity that nobody asked for",
        )
    })
}
