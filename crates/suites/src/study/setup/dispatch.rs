//! Creates solvers. Only this file uses all kinds of solvers.

use super::bar::bar;
use super::body::{Body, plan_input, scene_input};
use crate::mpm::input::{self, MethodInput, MpmMethod};
use crate::subject::{Perturbable, Profile, Subject, SubjectError};
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;

/// Creates the solver of `method` for one level.
///
/// # Errors
/// The reason why the solver cannot be created.
pub fn subject(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, SubjectError> {
    match (method, plan.scene.dimension()) {
        (Method::Fem { .. }, 1) => Ok(Box::new(bar(plan, method, level.cells)?)),
        (Method::Fem { .. }, d) => {
            Err(format!("the built-in FEM is 1-D, but the scene is {d}-D").into())
        }
        _ => input::subject(plan_input(plan, level)?, method_input(method)?),
    }
}

fn method_input(method: Method) -> Result<MethodInput, SubjectError> {
    Ok(match method {
        Method::Mpm(method) => MethodInput::Dynamic(method),
        Method::QuasiStatic { basis, load_steps } => MethodInput::QuasiStatic { basis, load_steps },
        Method::Heat { basis } => MethodInput::Heat { basis },
        Method::External { .. } => return Err("no solver was named on the command line".into()),
        Method::Fem { .. } => return Err("not an MPM method".into()),
    })
}

fn dynamic(method: Method) -> Result<MpmMethod, SubjectError> {
    let Method::Mpm(method) = method else { return Err("not an MPM method".into()) };
    Ok(method)
}

/// Returns the profile of the second step of `method`; `None` for FEM, and after a failure.
pub(crate) fn profile(plan: &ConvergencePlan, method: Method, level: LevelPlan) -> Option<Profile> {
    input::profile(plan_input(plan, level).ok()?, method_input(method).ok()?, level.dt)
}

/// Predicts the stable time step (s) of `method`, from `rounds` power iterations.
pub(crate) fn stable_time_step(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
    rounds: u32,
) -> Result<f64, SubjectError> {
    // The manufactured force does not affect the stable step and is expensive to prepare.
    let body = |own| Body { manufactured: None, ..Body::of(plan, own) };
    stable_time_step_of(plan.scene.each().iter().map(body).collect(), method, level, rounds)
}

/// Predicts the stable time step (s) for the `bodies` of one scene.
pub(crate) fn stable_time_step_of(
    bodies: Vec<Body<'_>>,
    method: Method,
    level: LevelPlan,
    rounds: u32,
) -> Result<f64, SubjectError> {
    let speeds: Vec<f64> = bodies.iter().map(|body| body.own.wave_speed()).collect();
    let scene = scene_input(bodies, level)?;
    input::stable_time_step(scene, dynamic(method)?, &speeds, rounds)
}

pub(crate) fn perturbable(
    bodies: Vec<Body<'_>>,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Perturbable>, SubjectError> {
    input::perturbable(scene_input(bodies, level)?, dynamic(method)?)
}
