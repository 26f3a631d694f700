//! Runs one case of a gradient study: computes gradients and perturbed values.

use crate::exact::{ParametricMotion, ParametricState};
use crate::external::{Gradient, GradientError, GradientRequest, LevelProblem, SolverFactory};
use crate::study::handover::level_problem;
use crate::study::kind::{Progress, RunContext};
use crate::subject::{Functional, FunctionalValue, GradientParameter, Precision, Samples};
use crate::suite::model::fingerprint::fingerprint;
use crate::suite::model::gradient::{Differentiated, GradientCase, GradientPlan, SweepPlan};
use crate::suite::model::refine_plan::LevelPlan;
use crate::verify::{
    FIRST_LEVEL, GradientEntry, GradientEvidence, GradientLevel, GradientStudy, LAST_LEVEL,
    Perturbed, Sweep, SweepPoint, Taylor, ValueCheck,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Ratio of the rounding error of a functional value to the rounding error of its largest term.
const ROUNDING: f64 = 4.0;

/// Exponent k of the perturbation q 2^-k that checks the entries of a wrong gradient.
const EVIDENCE_LEVEL: u32 = 8;

/// Young's modulus of a run without stress, relative to the modulus of the problem.
const NO_STRESS: f64 = 1e-9;

pub(super) struct GradientRun<'a> {
    pub(super) context: RunContext<'a>,
    pub(super) plan: &'a GradientPlan,
    pub(super) case: &'a GradientCase,
    pub(super) solver: &'a dyn SolverFactory,
    /// Parameters of the suite for which the solver supports gradients.
    pub(super) request: Vec<GradientParameter>,
}

/// Result of one run of the solver, in the form that is stored for `--resume`.
#[derive(Debug, Default, Serialize, Deserialize)]
struct CachedAnswer {
    /// Either value and rounding error of a functional, or value and gradient.
    numbers: Vec<f64>,
    cannot: Option<String>,
    failed: Option<String>,
}

impl CachedAnswer {
    fn of(result: Result<Vec<f64>, GradientError>) -> Self {
        match result {
            Ok(numbers) => Self { numbers, ..Self::default() },
            Err(GradientError::Cannot(reason)) => Self { cannot: Some(reason), ..Self::default() },
            Err(GradientError::Failed(reason)) => Self { failed: Some(reason), ..Self::default() },
        }
    }

    fn numbers(self) -> Result<Vec<f64>, GradientError> {
        match self {
            Self { failed: Some(reason), .. } => Err(GradientError::Failed(reason)),
            Self { cannot: Some(reason), .. } => Err(GradientError::Cannot(reason)),
            Self { numbers, .. } => Ok(numbers),
        }
    }
}

impl GradientRun<'_> {
    pub(super) fn study(&self, progress: Progress<'_>) -> Result<GradientStudy, GradientError> {
        let levels = self.plan.problem.refine.levels(self.context.extent);
        // With several failed levels, the coarsest one is reported, in any order of the runs.
        let on_levels = levels.par_iter().map(|level| self.level(*level));
        let on_levels = on_levels.inspect(|_| progress()).collect::<Vec<_>>();
        let on_levels = on_levels.into_iter().collect::<Result<Vec<_>, GradientError>>()?;
        let examined = self.plan.level;
        let problem = self.problem(levels[examined])?;
        let one = self.parameter();
        let q = nominal(&problem, one.parameter)?;
        let plain = self.value(&problem)?;
        let (_, reported, partial) = &on_levels[examined];
        let size = self.rounding() * plain.scale;
        let taylor = Taylor {
            value: plain.value,
            gradient: *partial,
            rounding: size,
            perturbed: self.perturbed(&problem, q, progress)?,
        };
        let points = match self.plan.sweep.filter(|sweep| sweep.parameter == one.parameter) {
            Some(sweep) => self.sweep(&problem, q, sweep, progress)?,
            None => Vec::new(),
        };
        let partials = on_levels.iter().map(|(.., partial)| *partial);
        let derivatives: Vec<f64> = partials.chain(points.iter().map(|p| p.gradient)).collect();
        let mut study = GradientStudy {
            single_precision: self.solver.precision() == Precision::Double
                && is_single(plain.value, &derivatives),
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
            evidence: None,
        };
        if study.fails() {
            study.evidence = Some(self.evidence(&problem)?);
        }
        Ok(study)
    }

    fn evidence(&self, problem: &LevelProblem) -> Result<GradientEvidence, GradientError> {
        let Gradient { gradient, .. } = self.gradient(problem)?;
        let value = |problem: LevelProblem| Ok(self.value(&problem)?.value);
        let entry = |(parameter, reported): (&GradientParameter, f64)| {
            let q = nominal(problem, *parameter)?;
            let difference = self.around(problem, *parameter, q, EVIDENCE_LEVEL)?.difference();
            Ok(GradientEntry { parameter: parameter.name(), reported, difference })
        };
        let entries = self.request.iter().zip(gradient).map(entry);
        let entries = entries.collect::<Result<Vec<_>, GradientError>>()?;
        let mut shorter = problem.clone();
        shorter.steps -= 1;
        shorter.instants = vec![shorter.steps];
        let young = GradientParameter::Young;
        let soft = problem.parameter(young).map(|young| NO_STRESS * young);
        let soft = soft.map(|soft| problem.clone().with_parameter(young, soft));
        let moves_more = problem.clone().with_parameter(GradientParameter::InitialVelocity, 2.0);
        // A value is NaN if the solver fails in its run.
        let or_none = |value: Result<f64, GradientError>| value.unwrap_or(f64::NAN);
        Ok(GradientEvidence {
            entries,
            one_step_less: or_none(value(shorter)),
            errors: [problem, &moves_more].map(|problem| or_none(self.relative_error(problem))),
            without_stress: soft.map_or(f64::NAN, |soft| or_none(value(soft))),
        })
    }

    /// Computes the relative error of the derivative, from an extrapolated central difference.
    fn relative_error(&self, problem: &LevelProblem) -> Result<f64, GradientError> {
        let parameter = self.parameter().parameter;
        let q = nominal(problem, parameter)?;
        let index = self.request.iter().position(|known| *known == parameter).unwrap_or(0);
        let reported = self.gradient(problem)?.gradient[index];
        let around = |level: u32| self.around(problem, parameter, q, level);
        let (fine, coarse) = (around(EVIDENCE_LEVEL)?, around(EVIDENCE_LEVEL - 1)?);
        let exact = (4.0 * fine.difference() - coarse.difference()) / 3.0;
        Ok((reported - exact) / exact)
    }

    fn parameter(&self) -> &Differentiated {
        &self.plan.parameters[self.case.parameter]
    }

    fn problem(&self, level: LevelPlan) -> Result<LevelProblem, GradientError> {
        Ok(level_problem(self.context.suite, &self.plan.problem, &self.case.solver, level)?)
    }

    /// Returns the rounding error of the Taylor remainder, in units of the largest term.
    fn rounding(&self) -> f64 {
        let half = match self.solver.precision() {
            Precision::Double => 0.5 * f64::EPSILON,
            Precision::Single => 0.5 * f64::from(f32::EPSILON),
        };
        ROUNDING * half
    }

    /// Returns the maximum difference of the reported value from that of a run without derivatives.
    fn tolerance(&self, plain: FunctionalValue) -> f64 {
        let relative = match self.solver.precision() {
            Precision::Double => 1e-12,
            Precision::Single => 1e-5,
        };
        let near_zero = 2.5 * self.rounding() * plain.scale;
        (relative * plain.value.abs()).max(near_zero)
    }

    /// Runs one level. Also returns the reported value and partial derivative.
    fn level(&self, level: LevelPlan) -> Result<(GradientLevel, f64, f64), GradientError> {
        let (problem, one) = (self.problem(level)?, self.parameter());
        let exact = exact_derivative(self.plan, one, &problem);
        let dt = problem.dt;
        let Gradient { value, gradient } =
            self.gradient(&problem).map_err(|error| match error {
                GradientError::Failed(reason) => {
                    GradientError::Failed(format!("{reason} (on {} cells)", level.cells))
                }
                refused @ GradientError::Cannot(_) => refused,
            })?;
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

    fn gradient(&self, problem: &LevelProblem) -> Result<Gradient, GradientError> {
        let request = GradientRequest { of: self.plan.of, with_respect_to: self.request.clone() };
        let names: Vec<&str> = self.request.iter().map(|one| one.name()).collect();
        let numbers = self.kept(problem, &format!("gradient {}", names.join(" ")), |problem| {
            let Gradient { value, gradient } = self.solver.gradient(problem, &request)?;
            Ok(std::iter::once(value).chain(gradient).collect())
        })?;
        if let Some((value, gradient)) = numbers.split_first()
            && gradient.len() == self.request.len()
        {
            return Ok(Gradient { value: *value, gradient: gradient.to_vec() });
        }
        let (found, expected) = (numbers.len().saturating_sub(1), self.request.len());
        let reason = format!("sent a gradient of {found} numbers, expected {expected}");
        Err(GradientError::Failed(reason))
    }

    fn value(&self, problem: &LevelProblem) -> Result<FunctionalValue, GradientError> {
        let run = |problem| self.plain_run(problem).map(|done| vec![done.value, done.scale]);
        match self.kept(problem, "value", run)?[..] {
            [value, scale] => Ok(FunctionalValue { value, scale }),
            _ => Err(GradientError::Failed("has a stored result without a value".to_owned())),
        }
    }

    /// Returns the stored numbers that `what` describes, or else stores and returns those of `run`.
    fn kept(
        &self,
        problem: &LevelProblem,
        what: &str,
        run: impl FnOnce(LevelProblem) -> Result<Vec<f64>, GradientError>,
    ) -> Result<Vec<f64>, GradientError> {
        let run = || CachedAnswer::of(run(problem.clone()));
        if self.context.cache.is_none() {
            return run().numbers();
        }
        // The key includes all that a parameter changes, also masses and velocities.
        let numbers = serde_json::to_string(problem)
            .map_err(|error| GradientError::Failed(error.to_string()))?;
        let particles = [&problem.particles.mass, &problem.particles.velocity];
        let bytes = particles.into_iter().flatten().flat_map(|number| number.to_le_bytes());
        let (numbers, particles) =
            (fingerprint(numbers.as_bytes()), fingerprint(&bytes.collect::<Vec<u8>>()));
        let text = self.context.fingerprint;
        let of = serde_json::to_string(&self.plan.of).unwrap_or_default();
        let key = format!("{text:016x} {numbers:016x} {particles:016x} {of} {what}");
        let name = format!("`{what}` of the suite {}", self.context.suite);
        let broken = |answer: &CachedAnswer| answer.cannot.is_some() || answer.failed.is_some();
        let answer = self.context.cached(&key, &name, broken, || Ok(run()));
        answer.map_err(|error| GradientError::Failed(error.to_string()))?.numbers()
    }

    fn plain_run(&self, problem: LevelProblem) -> Result<FunctionalValue, GradientError> {
        let (steps, dt) = (problem.steps, problem.dt);
        let mass = problem.particles.mass.clone();
        let mut subject = self.solver.subject(problem)?;
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

    /// Returns the functional with the parameter value `q` changed by q 2^-level both ways.
    fn around(
        &self,
        problem: &LevelProblem,
        parameter: GradientParameter,
        q: f64,
        level: u32,
    ) -> Result<Perturbed, GradientError> {
        let at = |q: f64| self.value(&problem.clone().with_parameter(parameter, q));
        let by = q * libm::exp2(-f64::from(level));
        Ok(Perturbed { level, by, above: at(q + by)?.value, below: at(q - by)?.value })
    }

    fn perturbed(
        &self,
        problem: &LevelProblem,
        q: f64,
        progress: Progress<'_>,
    ) -> Result<Vec<Perturbed>, GradientError> {
        let perturbed = |level: u32| {
            let found = self.around(problem, self.parameter().parameter, q, level)?;
            progress();
            Ok(found)
        };
        (FIRST_LEVEL..=LAST_LEVEL).into_par_iter().map(perturbed).collect()
    }

    fn sweep(
        &self,
        problem: &LevelProblem,
        q: f64,
        sweep: SweepPlan,
        progress: Progress<'_>,
    ) -> Result<Vec<SweepPoint>, GradientError> {
        let index = self.request.iter().position(|known| *known == sweep.parameter).unwrap_or(0);
        let point = |k: u64| {
            let share = 2.0 * k as f64 / (sweep.points - 1) as f64 - 1.0;
            let at = q * (1.0 + sweep.within * share);
            let Gradient { value, gradient } =
                self.gradient(&problem.clone().with_parameter(sweep.parameter, at))?;
            progress();
            Ok(SweepPoint { at, value, gradient: gradient[index] })
        };
        (0..sweep.points).into_par_iter().map(point).collect()
    }
}

/// Whether all derivatives are numbers of single precision, although the `value` is not.
fn is_single(value: f64, derivatives: &[f64]) -> bool {
    let single = |x: f64| x != 0.0 && f64::from(x as f32) == x;
    let differ = derivatives.iter().any(|x| *x != derivatives[0]);
    !single(value) && differ && derivatives.len() > 2 && derivatives.iter().all(|x| single(*x))
}

/// Returns the value of a parameter. Zero is an error, because perturbations are relative.
fn nominal(problem: &LevelProblem, parameter: GradientParameter) -> Result<f64, GradientError> {
    let lacks = || GradientError::Cannot(format!("the problem has no `{}`", parameter.name()));
    problem.parameter(parameter).filter(|q| *q != 0.0).ok_or_else(lacks)
}

type ValueAndSlope = (f64, f64);

/// Computes the exact total derivative of the functional at the end of the run. If the initial
/// velocity depends on the parameter, its effect on the motion is included.
pub(super) fn exact_derivative(
    plan: &GradientPlan,
    one: &Differentiated,
    problem: &LevelProblem,
) -> f64 {
    let slope = slope(plan.of, one, problem);
    match one.parameter {
        // `InitialVelocity` is a factor on the parameter of the suite.
        GradientParameter::InitialVelocity => one.motion.value * slope,
        _ => slope,
    }
}

fn slope(of: Functional, one: &Differentiated, problem: &LevelProblem) -> f64 {
    let (motion, t) = (&one.motion, problem.until);
    match of {
        Functional::MeanDisplacement { axis } => {
            mean(motion, t, &|state| (state.displacement[axis], state.displacement_slope[axis])).1
        }
        Functional::MeanSquareDisplacement => {
            mean(motion, t, &|state| square(&state.displacement, &state.displacement_slope)).1
        }
        Functional::KineticEnergy => {
            let density = problem.materials.first().map_or(f64::NAN, |one| one.density);
            let (integral, slope) =
                integral(motion, t, &|state| square(&state.velocity, &state.velocity_slope));
            let mass =
                if one.parameter == GradientParameter::Density { 0.5 * integral } else { 0.0 };
            0.5 * density * slope + mass
        }
        Functional::PositionOf { particle, axis } => {
            let d = problem.dimension;
            let label = problem.particles.reference_position.get(particle * d..(particle + 1) * d);
            label.map_or(f64::NAN, |label| motion.at(label, t).displacement_slope[axis])
        }
    }
}

fn square(vector: &[f64], slope: &[f64]) -> ValueAndSlope {
    let both = vector.iter().zip(slope);
    both.fold((0.0, 0.0), |(sum, rise), (x, dx)| (sum + x * x, rise + 2.0 * x * dx))
}

fn integral(
    motion: &ParametricMotion,
    t: f64,
    of: &dyn Fn(&ParametricState) -> ValueAndSlope,
) -> ValueAndSlope {
    let states = motion.states(t);
    states.iter().fold((0.0, 0.0), |(sum, rise), (state, weight)| {
        let (value, slope) = of(state);
        (sum + weight * value, rise + weight * slope)
    })
}

fn mean(
    motion: &ParametricMotion,
    t: f64,
    of: &dyn Fn(&ParametricState) -> ValueAndSlope,
) -> ValueAndSlope {
    let (sum, slope) = integral(motion, t, of);
    let volume: f64 = motion.from.iter().zip(&motion.to).map(|(from, to)| to - from).product();
    (sum / volume, slope / volume)
}
