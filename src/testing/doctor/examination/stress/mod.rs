//! A body that stretches and shears: the stress in it, by the momentum that flows through its middle.
//!
//! With an initial velocity `v = L (X - C)` the strain is uniform, L t, until waves come in from the free
//! faces, and no force acts inside. Momentum goes from one half to the other as `dP_j/dt = -sigma_ij A`
//! through the middle plane with normal i. In a tube of points about the axis i it can be counted exactly,
//! for any functions, from velocities alone.
//!
//! ```text
//! measure   the scene, and stresses by momentum
//! moduli    mistakes with characteristic moduli
//! columns   the columns `stress` and `deformation_gradient`
//! ```

mod columns;
mod measure;
mod moduli;

pub(super) use columns::inside;
pub(super) use measure::{STEPS, TRAVEL, constant_and_rate, impulses, spreading};

use crate::subject::Precision;
use crate::testing::doctor::course::{Course, shown, size, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{BoxScene, ELASTIC};
use measure::{MeasuredModuli, STRETCH};

pub(super) const EXAMINATION: Examination = Examination {
    name: "stress",
    expected: "a body that stretches and shears has the stress of its law, which moves momentum and \
               conserves its sum",
    after: &["conversation", "rest", "translation", "force", "transfer"],
    examine,
};

/// Examines every dimension that the solver can take, until one has findings.
fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = patient.able(&[2, 3, 1], &ELASTIC, &spreading)?;
    let mut all = Examined::default();
    let others = [2, 3, 1].into_iter().filter(|d| *d != first.dimension);
    let others = others.filter_map(|d| patient.able(&[d], &[first.law], &spreading).ok());
    for scene in std::iter::once(first.clone()).chain(others) {
        let examined = examine_scene(patient, &scene)?;
        if !all.measured.is_empty() {
            all.measured.push_str("; ");
        }
        all.measured.push_str(&examined.measured);
        if !examined.findings.is_empty() {
            all.findings = examined.findings;
            break;
        }
    }
    Ok(all)
}

fn examine_scene(patient: &Patient<'_>, scene: &BoxScene) -> Result<Examined, Hindrance> {
    let mut scene = scene.clone();
    let mut courses = patient.run_all(&[scene.clone(), scene.soft()])?;
    let mut measured = measure::moduli(&courses[0], &courses[1], &scene);
    let (lambda, mu) = scene.lame();
    let ratio = measured.along.abs() / (lambda + 2.0 * mu);
    // Waves that are faster than expected have come in: repeat with a shorter time.
    if ratio > 2.0 {
        scene.dt /= ratio.sqrt();
        courses = patient.run_all(&[scene.clone(), scene.soft()])?;
        measured = measure::moduli(&courses[0], &courses[1], &scene);
    }
    let text = describe(&scene, &measured);
    let course = &courses[0];
    if let Some(finding) = lost_momentum(patient, course, &scene) {
        return Ok(Examined::new(text, vec![finding]));
    }
    if let Some(finding) = moduli::cause(course, &scene, &measured) {
        return Ok(Examined::new(text, vec![finding]));
    }
    let mut findings = columns::findings(course, &scene);
    if findings.is_empty() && measured.viscous_share > 0.05 {
        findings.push(SolverFinding::remark(
            "viscosity",
            format!(
                "stress has a part of {} m2/s times the rate of strain",
                shown(measured.viscosity)
            ),
            "a viscosity acts that the problem does not have, and that vanishes with the stiffness",
            "artificial viscosity, damping in proportion to the stiffness (Rayleigh's beta)",
        ));
    }
    Ok(Examined::new(text, findings))
}

fn describe(scene: &BoxScene, measured: &MeasuredModuli) -> String {
    let (lambda, mu) = scene.lame();
    let whole = shown(lambda + 2.0 * mu);
    let along = shown(measured.along);
    if scene.dimension == 1 {
        return format!("in 1-D, the modulus by momentum is {along} Pa, expected {whole} Pa");
    }
    let [across, one, other] = [measured.across, measured.shear[0], measured.shear[1]].map(shown);
    format!(
        "in {}-D, moduli by momentum are {along} Pa along a stretch, {across} Pa across it, and {one} and \
         {other} Pa in shear, expected {whole}, {} and {} Pa",
        scene.dimension,
        shown(lambda),
        shown(mu)
    )
}

/// The total momentum, which inner forces do not change.
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
    (!(share <= most)).then(|| {
        SolverFinding::defect(
            "momentum-lost",
            format!(
                "the total momentum changes; the mean velocity by {} of the speed that the faces gain",
                shown(share)
            ),
            "inner forces do not sum to zero, or the momentum of nodes is not returned completely",
            "gradients of a particle, whose sum must be zero; nodes that are left out for their small \
             mass; walls and limits of velocity that the problem does not have",
        )
    })
}
