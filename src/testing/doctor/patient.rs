//! A solver under examination: its capabilities and its runs.

use super::course::Course;
use super::finding::SolverFinding;
use super::scene::{BoxScene, Kind};
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::subject::{Precision, SubjectError};
use rayon::prelude::*;

#[derive(Default)]
pub(super) struct Examined {
    pub(super) measured: String,
    pub(super) findings: Vec<SolverFinding>,
}

/// Reason why an examination could not be completed.
pub(super) enum Hindrance {
    /// The solver lacks these capabilities, or refuses the problem for this reason.
    Lacks(String),
    /// An effect of the method masks the examined quantity, also from the examinations that depend
    /// on this one. The text completes "the solver lacks ...".
    Masked(String),
    /// The solver did not complete a run, and gave this message.
    Broke(String),
}

impl From<SubjectError> for Hindrance {
    fn from(error: SubjectError) -> Self {
        match error {
            SubjectError::Unsupported(reason) => Self::Lacks(reason),
            SubjectError::Failed(failure) => Self::Broke(failure.to_string()),
        }
    }
}

pub(super) struct Patient<'a> {
    pub(super) solver: &'a dyn SolverFactory,
    /// Method of the built-in solver that runs all scenes in place of `solver`.
    #[cfg(test)]
    pub(super) built_in: Option<&'a str>,
}

impl Examined {
    pub(super) fn new(measured: String, findings: impl IntoIterator<Item = SolverFinding>) -> Self {
        Self { measured, findings: findings.into_iter().collect() }
    }

    /// Adds the findings of `other` whose names are new, and its measured values.
    pub(super) fn add(&mut self, other: Self) {
        if !self.measured.is_empty() && !other.measured.is_empty() {
            self.measured.push_str("; ");
        }
        self.measured.push_str(&other.measured);
        for finding in other.findings {
            if self.findings.iter().all(|known| known.name != finding.name) {
                self.findings.push(finding);
            }
        }
    }
}

/// Returns the run, or its failure if it ended early.
pub(super) fn complete(course: Course) -> Result<Course, Hindrance> {
    match course.failure {
        Some(failure) => Err(Hindrance::Broke(failure)),
        None => Ok(course),
    }
}

impl Patient<'_> {
    /// Returns the maximum relative error of a motion that is exact except for rounding.
    pub(super) fn rounding(&self) -> f64 {
        // 24 bits resolve 6e-8. Several hundred steps and a change of units increase the error.
        self.tolerance(1e-9, 1e-3)
    }

    pub(super) fn tolerance(&self, double: f64, single: f64) -> f64 {
        match self.solver.precision() {
            Precision::Double => double,
            Precision::Single => single,
        }
    }

    /// Returns the first supported scene, trying all `laws` for each of the `dimensions` in turn.
    pub(super) fn able(
        &self,
        dimensions: &[usize],
        laws: &[&'static str],
        scene: &dyn Fn(Kind) -> BoxScene,
    ) -> Result<BoxScene, Hindrance> {
        self.able_with(dimensions, laws, scene, &|_| {})
    }

    /// Finds the scene as in [`Patient::able`], with the additional requirements that `more` sets.
    pub(super) fn able_with(
        &self,
        dimensions: &[usize],
        laws: &[&'static str],
        scene: &dyn Fn(Kind) -> BoxScene,
        more: &dyn Fn(&mut ProblemNeeds),
    ) -> Result<BoxScene, Hindrance> {
        let mut fewest: Option<Vec<String>> = None;
        for kind in dimensions.iter().flat_map(|d| laws.iter().map(|law| (*d, *law))) {
            let scene = scene(kind);
            let mut needs = scene.needs()?;
            more(&mut needs);
            let lacks = self.solver.lacks(&needs);
            if lacks.is_empty() {
                return Ok(scene);
            }
            if fewest.as_ref().is_none_or(|fewest| lacks.len() < fewest.len()) {
                fewest = Some(lacks);
            }
        }
        Err(Hindrance::Lacks(fewest.unwrap_or_default().join(", ")))
    }

    pub(super) fn run(&self, scene: &BoxScene) -> Result<Course, Hindrance> {
        #[cfg(test)]
        if let Some(method) = self.built_in {
            return Ok(scene.built_in(method)?);
        }
        let problem = scene.problem()?;
        self.run_problem(scene, problem)
    }

    /// Runs `scenes`. All runs must complete.
    pub(super) fn run_all(&self, scenes: &[BoxScene]) -> Result<Vec<Course>, Hindrance> {
        let run = |scene| complete(self.run(scene)?);
        // Results are collected first, so that the returned error does not depend on thread timing.
        let courses: Vec<Result<Course, Hindrance>> = scenes.par_iter().map(run).collect();
        courses.into_iter().collect()
    }

    /// Runs `problem`, created from `scene`, to its end or to a failure.
    pub(super) fn run_problem(
        &self,
        scene: &BoxScene,
        problem: LevelProblem,
    ) -> Result<Course, Hindrance> {
        let mut course = Course::new(&problem);
        let (steps, dt) = (problem.steps, problem.dt);
        let instants = problem.instants.clone();
        let mut subject = self.solver.subject(problem)?;
        course.look(0.0, subject.as_ref());
        course.start(&scene.displacement, &scene.velocity);
        for step in 1..=steps {
            if let Err(failure) = subject.step(dt) {
                course.failure = Some(format!("step {step} of {steps}: {failure}"));
                break;
            }
            if instants.contains(&step) {
                course.look(step as f64 * dt, subject.as_ref());
            }
        }
        if course.states.len() < 2 {
            return Err(Hindrance::Broke(course.failure.unwrap_or_default()));
        }
        Ok(course)
    }
}

pub(super) struct Examination {
    pub(super) name: &'static str,
    /// Expected behaviour of a correct solver, in one sentence.
    pub(super) expected: &'static str,
    /// Examinations that must have no defects before this one, without those that they require.
    pub(super) after: &'static [&'static str],
    /// Capabilities that the examination tests, in the notation of
    /// [`Capabilities::entries`](crate::external::Capabilities::entries). Declared capabilities
    /// that no applicable examination covers are listed at the end of the report.
    pub(super) covers: &'static [&'static str],
    pub(super) examine: fn(&Patient<'_>) -> Result<Examined, Hindrance>,
}
