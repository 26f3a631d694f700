//! Examines a body that should move at constant speed, and determines the cause of deviations.
//!
//! ```text
//! as_one   errors of the motion; the body keeps its shape: drag, units, times
//! apart    the body changes its shape: weights, gradients, cells, limits
//! ```

mod apart;
mod as_one;

use crate::testing::doctor::prelude::*;
pub(super) use apart::CHANGED;

use crate::subject::Precision;
use as_one::UniformMotion;

/// Maximum relative error of a motion that single precision can explain.
const SINGLE: f64 = 1e-4;

pub(super) fn uniform(patient: &Patient<'_>, scene: &BoxScene) -> Result<Examined, Hindrance> {
    let course = patient.run(scene)?;
    let motion = UniformMotion { patient, scene, course, velocity: scene.velocity.value };
    let (way, speed) = motion.off();
    let (last, [far, fast]) = (motion.course.last(), [way, speed].map(shown));
    let measured = format!(
        "in {last} steps, displacement errors are up to {far} of the distance travelled, and \
         velocity errors up to {fast} of the speed"
    );
    if way <= patient.rounding() && speed <= patient.rounding() {
        complete(motion.course)?;
        return Ok(Examined::new(measured, None));
    }
    Ok(Examined::new(measured, Some(cause(&motion)?)))
}

fn cause(motion: &UniformMotion<'_>) -> Result<SolverFinding, Hindrance> {
    let (way, speed) = motion.off();
    let claims_double = motion.patient.solver.precision() == Precision::Double;
    let as_one = motion.errs_as_one();
    let found = if as_one { as_one::cause(motion)? } else { apart::plain(motion) };
    if let Some(found) = found {
        return Ok(found);
    }
    if claims_double && way <= SINGLE && speed <= SINGLE {
        return Ok(single(way, speed));
    }
    if as_one { Ok(as_one::unknown(motion)) } else { apart::cause(motion) }
}

/// Returns the finding for errors that single precision can explain, but double precision cannot.
pub(super) fn single(way: f64, speed: f64) -> SolverFinding {
    let [way, speed] = [way, speed].map(shown);
    SolverFinding::defect(
        "single-precision",
        format!(
            "the errors are typical of single precision: {way} of the distance travelled and \
             {speed} of the speed, where double precision gives about 1e-13"
        ),
        "numbers pass through single precision, but the solver states double precision",
        "`float` or `f32` in arrays or in the adapter; files or messages with seven digits. A \
         solver that computes in single precision must state `\"precision\": \"single\"`",
    )
}
