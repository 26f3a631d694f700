//! Creates solvers of the types that methods and scenes select. Only this file uses all kinds of
//! solvers.

use super::bar::bar;
use super::body::{Body, conductor, quasi_static, setup};
use crate::dimension::with_dimension;
use crate::mpm::{Bodies, HeatSolver, QuasiStatic, Setup, Solver, Vector};
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
        (Method::External { .. }, _) => Err("no solver was named on the command line".into()),
        (Method::Mpm { .. }, d) => with_dimension!(d, D => mpm::<D>(plan, method, level)),
        (Method::QuasiStatic { basis, load_steps }, d) => with_dimension!(d, D => {
            Ok(Box::new(quasi_static::<D>(plan, basis, level, load_steps)?))
        }),
        (Method::Heat { basis }, d) => with_dimension!(d, D => {
            Ok(Box::new(conductor::<D>(plan, basis, level)?))
        }),
    }
}

/// Returns the profile of the second step of `method` on one level, because the first step also
/// allocates memory. `None` for FEM, and if the solver fails earlier.
pub(crate) fn profile(plan: &ConvergencePlan, method: Method, level: LevelPlan) -> Option<Profile> {
    fn of_second_step<S: Subject>(
        mut subject: S,
        dt: f64,
        take_visits: fn(&S) -> Vec<(&'static str, u64)>,
        profile: fn(&S) -> Profile,
    ) -> Option<Profile> {
        subject.step(dt).ok()?;
        take_visits(&subject);
        subject.step(dt).ok()?;
        let visits = take_visits(&subject);
        Some(Profile { passes: subject.passes(), visits, ..profile(&subject) })
    }
    let dt = level.dt;
    with_dimension!(plan.scene.dimension(), D => match method {
        Method::QuasiStatic { basis, .. } => {
            let body = quasi_static::<D>(plan, basis, level, 2).ok()?;
            of_second_step(body, 1.0, QuasiStatic::take_visits, QuasiStatic::profile)
        }
        Method::Fem { .. } | Method::External { .. } => None,
        Method::Heat { basis } => {
            let body = conductor::<D>(plan, basis, level).ok()?;
            of_second_step(body, dt, HeatSolver::take_visits, HeatSolver::profile)
        }
        Method::Mpm { .. } => {
            let setups = setups::<D>(plan, method, level).ok()?;
            let bodies = Bodies::new(setups, plan.scene.contact).ok()?;
            of_second_step(bodies, dt, Bodies::take_visits, Bodies::profile)
        }
    })
}

/// Predicts the stable time step (s) of `method` on one level: the minimum over the bodies, from
/// `rounds` power iterations. Each body may be treated separately, because nodes shared with other
/// bodies do not make it less stable.
pub(crate) fn stable_time_step(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
    rounds: u32,
) -> Result<f64, SubjectError> {
    plan.scene.each().iter().try_fold(f64::INFINITY, |least, own| {
        // The manufactured force does not affect the stable step and is expensive to prepare.
        let body = Body { manufactured: None, ..Body::of(plan, own) };
        Ok(least.min(stable_time_step_of(&body, method, level, rounds)?))
    })
}

/// Predicts the stable time step (s) of one body with `method` on one level, from `rounds` power
/// iterations.
pub(crate) fn stable_time_step_of(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
    rounds: u32,
) -> Result<f64, SubjectError> {
    fn of<const D: usize>(
        body: &Body<'_>,
        method: Method,
        level: LevelPlan,
        rounds: u32,
    ) -> Result<f64, SubjectError> {
        let solver = solver::<D>(body, method, level)?;
        let fastest = solver.particles().v.iter().map(Vector::norm).fold(0.0, f64::max);
        let longest = level.h / (body.own.wave_speed() + fastest);
        Ok(solver.stable_time_step(longest, rounds)?)
    }
    with_dimension!(body.scene.dimension(), D => of::<D>(body, method, level, rounds))
}

/// Creates an MPM solver whose state can be perturbed, for the `bodies` of one scene on the cells
/// of `level`.
pub(crate) fn perturbable(
    bodies: &[Body<'_>],
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Perturbable>, SubjectError> {
    fn of<const D: usize>(
        bodies: &[Body<'_>],
        method: Method,
        level: LevelPlan,
    ) -> Result<Box<dyn Perturbable>, SubjectError> {
        if let [one] = bodies {
            return Ok(Box::new(solver::<D>(one, method, level)?));
        }
        let setups: Result<Vec<Setup<D>>, SubjectError> =
            bodies.iter().map(|body| setup(body, method, level)).collect();
        let contact = bodies.first().and_then(|body| body.scene.contact);
        Ok(Box::new(Bodies::new(setups?, contact)?))
    }
    let dimension = bodies.first().map_or(1, |body| body.scene.dimension());
    with_dimension!(dimension, D => of::<D>(bodies, method, level))
}

/// Creates an MPM solver with an energy ledger. `bodies` must contain exactly one body.
pub(crate) fn with_ledger(
    bodies: &[Body<'_>],
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Perturbable>, SubjectError> {
    let ([one], Method::Mpm { basis, .. }) = (bodies, method) else {
        return Err("an energy ledger is that of one body with an MPM method".into());
    };
    with_dimension!(one.scene.dimension(), D => {
        Ok(Box::new(solver::<D>(one, method, level)?.with_ledger(basis)))
    })
}

fn solver<const D: usize>(
    body: &Body<'_>,
    method: Method,
    level: LevelPlan,
) -> Result<Solver<D>, SubjectError> {
    Ok(Solver::new(setup(body, method, level)?)?)
}

fn mpm<const D: usize>(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Box<dyn Subject>, SubjectError> {
    let mut setups = setups::<D>(plan, method, level)?;
    Ok(match (setups.pop(), setups.is_empty(), plan.scene.contact) {
        (Some(one), true, None) if method.is_single_precision() => {
            Box::new(Solver::in_single_precision(one)?)
        }
        (Some(one), true, None) => Box::new(Solver::new(one)?),
        (last, _, contact) => {
            setups.extend(last);
            Box::new(Bodies::new(setups, contact)?)
        }
    })
}

fn setups<const D: usize>(
    plan: &ConvergencePlan,
    method: Method,
    level: LevelPlan,
) -> Result<Vec<Setup<D>>, SubjectError> {
    plan.scene.each().iter().map(|own| setup(&Body::of(plan, own), method, level)).collect()
}
