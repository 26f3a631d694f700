//! External solvers of tests that consist of functions.

use mpm_verify::external::{Capabilities, LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::subject::{Failure, Precision, RunCounters, Samples, Subject, SubjectError};

pub(crate) type NewSubject = Result<Box<dyn Subject>, SubjectError>;

/// A solver whose subjects are created by a function.
pub(crate) struct Solver<F> {
    pub(crate) name: &'static str,
    pub(crate) precision: Precision,
    /// Capabilities, if the solver states them.
    pub(crate) able: Option<Capabilities>,
    pub(crate) create: F,
}

/// Creates a solver in double precision that does not state its capabilities.
pub(crate) fn solver<F: Fn(LevelProblem) -> NewSubject + Sync>(
    name: &'static str,
    create: F,
) -> Solver<F> {
    Solver { name, precision: Precision::Double, able: None, create }
}

impl<F: Fn(LevelProblem) -> NewSubject + Sync> SolverFactory for Solver<F> {
    fn name(&self) -> &str {
        self.name
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        self.able.as_ref().map(|able| able.lacking(needs)).unwrap_or_default()
    }

    fn subject(&self, problem: LevelProblem) -> NewSubject {
        (self.create)(problem)
    }
}

struct Prescribed<F>(LevelProblem, u64, F);

/// Creates a subject whose samples are a function of its problem and of the number of steps. The
/// function receives the particles at rest in the reference configuration.
pub(crate) fn prescribed(
    problem: LevelProblem,
    sample: impl Fn(&LevelProblem, u64, &mut Samples) + 'static,
) -> Box<dyn Subject> {
    Box::new(Prescribed(problem, 0, sample))
}

impl<F: Fn(&LevelProblem, u64, &mut Samples)> Subject for Prescribed<F> {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        self.1 += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        let Self(problem, steps, sample) = self;
        let particles = &problem.particles;
        samples.restart(problem.dimension);
        samples.label.clone_from(&particles.reference_position);
        samples.weight.clone_from(&particles.reference_volume);
        samples.displacement = vec![0.0; samples.label.len()];
        samples.velocity = vec![0.0; samples.label.len()];
        sample(problem, *steps, samples);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}
