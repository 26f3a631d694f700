//! A solver under examination: what it can be given, and how it takes its steps.

use super::course::Course;
use super::finding::SolverFinding;
use super::scene::{BoxScene, LAWS};
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::subject::Precision;

/// Result of an examination that was made.
pub(super) struct Examined {
    /// Figures that were measured.
    pub(super) measured: String,
    pub(super) findings: Vec<SolverFinding>,
}

/// Why an examination could not be made.
pub(super) enum Hindrance {
    /// Capabilities that are missing, or the solver's own reason.
    Lacks(String),
    /// Message of a solver that did not get through.
    Broke(String),
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
    /// Largest share by which a motion may be off that is exact but for rounding.
    pub(super) fn rounding(&self) -> f64 {
        match self.solver.precision() {
            Precision::Double => 1e-9,
            // 24 bits are 6e-8, some hundred steps add to that, and a code's units take some.
            Precision::Single => 1e-3,
        }
    }

    /// The first scene that the solver can be put to, in two dimensions if it can, and under the
    /// plainest law that it knows.
    pub(super) fn able(
        &self,
        dimensions: &[usize],
        scene: &dyn Fn((usize, &'static str)) -> BoxScene,
    ) -> Result<BoxScene, Hindrance> {
        self.able_with(dimensions, scene, &|_| {})
    }

    /// The same with `more` needs than the scene itself has.
    pub(super) fn able_with(
        &self,
        dimensions: &[usize],
        scene: &dyn Fn((usize, &'static str)) -> BoxScene,
        more: &dyn Fn(&mut ProblemNeeds),
    ) -> Result<BoxScene, Hindrance> {
        let mut fewest: Option<Vec<String>> = None;
        for kind in dimensions.iter().flat_map(|d| LAWS.map(|law| (*d, law))) {
            let scene = scene(kind);
            let (_, mut needs) = scene.problem().map_err(Hindrance::Lacks)?;
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

    /// A run of `scene`, as far as it gets.
    pub(super) fn run(&self, scene: &BoxScene) -> Result<Course, Hindrance> {
        let (problem, _) = scene.problem().map_err(Hindrance::Lacks)?;
        self.run_problem(problem)
    }

    /// A run of `problem`, as far as it gets.
    pub(super) fn run_problem(&self, problem: LevelProblem) -> Result<Course, Hindrance> {
        let mut course = Course::new(&problem);
        let (steps, dt) = (problem.steps, problem.dt);
        let instants = problem.instants.clone();
        let mut subject = self.solver.subject(problem).map_err(Hindrance::Lacks)?;
        course.look(0.0, subject.as_ref());
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
