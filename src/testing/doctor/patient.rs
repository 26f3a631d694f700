//! A solver under examination: its capabilities, its runs, and requests to it.

use super::course::Course;
use super::finding::SolverFinding;
use super::scene::{BoxScene, Kind};
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::subject::{Precision, SubjectError};
use rayon::prelude::*;

/// Result of an examination.
#[derive(Default)]
pub(super) struct Examined {
    /// Figures that were measured.
    pub(super) measured: String,
    pub(super) findings: Vec<SolverFinding>,
}

/// Reason why an examination could not be made.
pub(super) enum Hindrance {
    /// Capabilities that are missing, or the solver's own reason.
    Lacks(String),
    /// Message of a solver that did not complete a run.
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

/// A solver under examination.
pub(super) struct Patient<'a> {
    pub(super) solver: &'a dyn SolverFactory,
}

impl Examined {
    pub(super) fn new(measured: String, findings: Vec<SolverFinding>) -> Self {
        Self { measured, findings }
    }
}

impl Patient<'_> {
    /// Largest relative error of a motion that is exact except for rounding.
    pub(super) fn rounding(&self) -> f64 {
        match self.solver.precision() {
            Precision::Double => 1e-9,
            // 24 bits are 6e-8; some hundred steps and a change of units add to that.
            Precision::Single => 1e-3,
        }
    }

    /// The first scene that the solver supports, over these dimensions and laws, in this order.
    pub(super) fn able(
        &self,
        dimensions: &[usize],
        laws: &[&'static str],
        scene: &dyn Fn(Kind) -> BoxScene,
    ) -> Result<BoxScene, Hindrance> {
        self.able_with(dimensions, laws, scene, &|_| {})
    }

    /// [`Patient::able`] for a scene with `more` needs than its suite has.
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
            let (_, mut needs) = scene.problem()?;
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

    /// Runs `scene`, which may end early with a failure.
    pub(super) fn run(&self, scene: &BoxScene) -> Result<Course, Hindrance> {
        let (problem, _) = scene.problem()?;
        self.run_problem(scene, problem)
    }

    /// The complete runs of `scenes`.
    pub(super) fn run_all(&self, scenes: &[BoxScene]) -> Result<Vec<Course>, Hindrance> {
        let complete = |scene| {
            let course = self.run(scene)?;
            match course.failure {
                Some(failure) => Err(Hindrance::Broke(failure)),
                None => Ok(course),
            }
        };
        // Collected first, so that the returned error does not depend on the order in which runs
        // end.
        let courses: Vec<Result<Course, Hindrance>> = scenes.par_iter().map(complete).collect();
        courses.into_iter().collect()
    }

    /// Runs `problem`, which belongs to `scene`, to its end or to a failure.
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

/// One question to a solver.
pub(super) struct Examination {
    /// Its name in reports.
    pub(super) name: &'static str,
    /// Expected behaviour of a correct solver, in one sentence.
    pub(super) expected: &'static str,
    /// Examinations that must be without defects before this one.
    pub(super) after: &'static [&'static str],
    pub(super) examine: fn(&Patient<'_>) -> Result<Examined, Hindrance>,
}
