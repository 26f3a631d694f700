//! The runs of one case: gradients and perturbed values.

use super::exact;
use crate::external::{Gradient, GradientError, GradientRequest, LevelProblem, SolverFactory};
use crate::study::handover::level_problem;
use crate::study::kind::Progress;
use crate::subject::{FunctionalValue, GradientParameter, Precision, Samples};
use crate::suite::model::gradient::{Differentiated, GradientCase, GradientPlan, SweepPlan};
use crate::suite::model::refine_plan::{Extent, LevelPlan};
use crate::verify::{
    FIRST_LEVEL, GradientLevel, GradientStudy, LAST_LEVEL, Perturbed, Sweep, SweepPoint, Taylor,
    ValueCheck,
};
use rayon::prelude::*;

/// Rounding of a value, in units of the rounding of its largest term.
const ROUNDING: f64 = 4.0;

/// Runs of one case.
pub(super) struct GradientRun<'a> {
    pub(super) suite: &'a str,
    pub(super) plan: &'a GradientPlan,
    pub(super) case: &'a GradientCase,
    pub(super) solver: &'a dyn SolverFactory,
    /// The parameters of the suite for which the solver has gradients.
    pub(super) request: Vec<GradientParameter>,
    pub(super) extent: Extent,
}

impl GradientRun<'_> {
    /// Runs all checks.
    ///
    /// # Errors
    /// [`GradientError::Cannot`] if the solver does not support a run, [`GradientError::Failed`]
    /// if it breaks.
    pub(super) fn study(&self, progress: Progress<'_>) -> Result<GradientStudy, GradientError> {
        let levels = self.plan.problem.refine.levels(self.extent);
        let on_level = |level: &LevelPlan| {
            let done = self.level(*level);
            progress();
            done
        };
        let on_levels =
            levels.par_iter().map(on_level).collect::<Result<Vec<_>, GradientError>>()?;
        let examined = self.plan.level;
        let problem = self.problem(levels[examined])?;
        let one = self.parameter();
        let q = nominal(&problem, one.parameter)?;
        let plain = self.value(problem.clone())?;
        let (_, reported, partial) = &on_levels[examined];
        let size = self.rounding() * plain.scale;
        let taylor = Taylor {
            value: plain.value,
            gradient: *partial,
            rounding: size,
            perturbed: self.perturbed(&problem, q, progress)?,
        };
        let points = match self.plan.sweep.filter(|sweep| sweep.parameter == one.parameter) {
            Some(sweep) => self.sweep(&problem, (q, sweep), progress)?,
            None => Vec::new(),
        };
        Ok(GradientStudy {
            functional: self.plan.of.name(),
            parameter: one.parameter.name(),
            value: ValueCheck {
                reported: *reported,
                computed: plain.value,
                tolerance: self.tolerance(plain),
            },
            taylor,
            levels: on_levels.iter().map(|(level, ..)| *level).collect(),
            sweep: Sweep::new(&points, size),
            points,
        })
    }

    fn parameter(&self) -> &Differentiated {
        &self.plan.parameters[self.case.parameter]
    }

    fn problem(&self, level: LevelPlan) -> Result<LevelProblem, GradientError> {
        let problem = level_problem(self.suite, &self.plan.problem, &self.case.solver, level);
        problem.map_err(GradientError::Cannot)
    }

    /// Rounding of the Taylor remainder, in units of the largest term of a value.
    fn rounding(&self) -> f64 {
        let half = match self.solver.precision() {
            Precision::Double => 0.5 * f64::EPSILON,
            Precision::Single => 0.5 * f64::from(f32::EPSILON),
        };
        ROUNDING * half
    }

    /// Allowed difference between the reported value and that of a plain run.
    fn tolerance(&self, plain: FunctionalValue) -> f64 {
        let relative = match self.solver.precision() {
            Precision::Double => 1e-12,
            Precision::Single => 1e-5,
        };
        let near_zero = 2.5 * self.rounding() * plain.scale;
        (relative * plain.value.abs()).max(near_zero)
    }

    /// One level with the reported value, and with the partial derivative as it is reported.
    fn level(&self, level: LevelPlan) -> Result<(GradientLevel, f64, f64), GradientError> {
        let (problem, one) = (self.problem(level)?, self.parameter());
        let exact = exact::derivative(self.plan, one, &problem);
        let dt = problem.dt;
        let Gradient { value, gradient } = self.gradient(problem)?;
        let of = |parameter: GradientParameter| {
            let index = self.request.iter().position(|known| *known == parameter);
            index.and_then(|index| gradient.get(index)).copied()
        };
        let lacks = |name: &str| GradientError::Cannot(format!("has no gradient of `{name}`"));
        let partial = of(one.parameter).ok_or_else(|| lacks(one.parameter.name()))?;
        let velocity = GradientParameter::InitialVelocity;
        let total = if one.velocity_factor == 0.0 || one.parameter == velocity {
            partial
        } else {
            let of_velocity = of(velocity).ok_or_else(|| lacks(velocity.name()))?;
            partial + one.velocity_factor * of_velocity
        };
        let LevelPlan { cells, h, .. } = level;
        Ok((GradientLevel { cells, h, dt, gradient: total, exact }, value, partial))
    }

    fn gradient(&self, problem: LevelProblem) -> Result<Gradient, GradientError> {
        let request = GradientRequest { of: self.plan.of, with_respect_to: self.request.clone() };
        let gradient = self.solver.gradient(problem, &request)?;
        if gradient.gradient.len() == self.request.len() {
            return Ok(gradient);
        }
        let (found, expected) = (gradient.gradient.len(), self.request.len());
        let reason = format!("gave a gradient of {found} numbers, expected {expected}");
        Err(GradientError::Failed(reason))
    }

    /// Value of the functional after a plain run.
    fn value(&self, problem: LevelProblem) -> Result<FunctionalValue, GradientError> {
        let (steps, dt) = (problem.steps, problem.dt);
        let mass = problem.particles.mass.clone();
        let mut subject = self.solver.subject(problem).map_err(GradientError::Cannot)?;
        for _ in 0..steps {
            subject.step(dt).map_err(|failure| GradientError::Failed(failure.to_string()))?;
        }
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        if samples.len() != mass.len() {
            let reason = "gives states at points that are not the particles".to_owned();
            return Err(GradientError::Cannot(reason));
        }
        Ok(self.plan.of.value(&mass, &samples))
    }

    /// Values with the parameter of the problem, `q`, perturbed by shares of it.
    fn perturbed(
        &self,
        problem: &LevelProblem,
        q: f64,
        progress: Progress<'_>,
    ) -> Result<Vec<Perturbed>, GradientError> {
        let parameter = self.parameter().parameter;
        let value = |q: f64| Ok(self.value(problem.clone().with_parameter(parameter, q))?.value);
        let perturbed = |level: u32| {
            let by = q * libm::exp2(-f64::from(level));
            let (above, below) = (value(q + by)?, value(q - by)?);
            progress();
            Ok(Perturbed { level, by, above, below })
        };
        (FIRST_LEVEL..=LAST_LEVEL).into_par_iter().map(perturbed).collect()
    }

    /// Values and derivatives over an interval of the parameter.
    fn sweep(
        &self,
        problem: &LevelProblem,
        (q, sweep): (f64, SweepPlan),
        progress: Progress<'_>,
    ) -> Result<Vec<SweepPoint>, GradientError> {
        let index = self.request.iter().position(|known| *known == sweep.parameter).unwrap_or(0);
        let point = |k: u64| {
            let share = 2.0 * k as f64 / (sweep.points - 1) as f64 - 1.0;
            let at = q * (1.0 + sweep.within * share);
            let Gradient { value, gradient } =
                self.gradient(problem.clone().with_parameter(sweep.parameter, at))?;
            progress();
            Ok(SweepPoint { at, value, gradient: gradient[index] })
        };
        (0..sweep.points).into_par_iter().map(point).collect()
    }
}

/// The value of a parameter in the problem.
fn nominal(problem: &LevelProblem, parameter: GradientParameter) -> Result<f64, GradientError> {
    let lacks = || GradientError::Cannot(format!("the problem has no `{}`", parameter.name()));
    problem.parameter(parameter).filter(|q| *q != 0.0).ok_or_else(lacks)
}
