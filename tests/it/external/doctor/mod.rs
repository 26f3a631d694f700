//! The doctor: defects of the built-in solver in the role of an external one, and the solver of the
//! example.

#[cfg(unix)]
mod program;

use crate::common::folder::flat;
use crate::false_alarms::{BuiltIn, built_in};
use crate::testing::OwnSolver;
use mpm_verify::external::{LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::subject::{Subject, SubjectError};
use mpm_verify::testing::{ExaminationReport, ExaminationResult, doctor, page};
use rstest::rstest;

/// The built-in solver, which receives other problems.
struct Faulty(BuiltIn, fn(&mut LevelProblem));

impl SolverFactory for Faulty {
    fn name(&self) -> &'static str {
        "faulty"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        self.0.lacks(needs)
    }

    fn subject(&self, mut problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        self.1(&mut problem);
        self.0.subject(problem)
    }
}

/// Some authors read only the last lines, the verdict.
#[rstest]
#[case::no_density(
    |p: &mut LevelProblem| p.particles.mass.clone_from(&p.particles.volume),
    "mass-or-volume-scaled"
)]
#[case::sticky_rollers(
    |p: &mut LevelProblem| p.faces.iter_mut().for_each(|face| if face.condition == "roller" {
        face.condition = "fixed";
    }),
    "roller-holds-tangent"
)]
#[case::transposed(
    |p: &mut LevelProblem| {
        p.particles.deformation_gradient.chunks_exact_mut(4).for_each(|f| f.swap(1, 2));
    },
    "initial-deformation-transposed"
)]
fn report_ends_with_the_only_defect(#[case] fault: fn(&mut LevelProblem), #[case] name: &str) {
    let sound = built_in(2, "basis: linear, transfer: flip, scheme: usl");
    let page = page(&doctor(&Faulty(sound, fault), &|_| ()));
    let flat = flat(&page);
    let verdict = flat.rsplit_once("verdict: ").expect("a verdict").1;
    assert!(verdict.starts_with(&format!("{name}; ")), "{page}");
    let end = " skipped until all defects are corrected; remarks: rounding-grows-on-faces, \
               start-half-a-step-off";
    assert!(verdict.ends_with(end), "{page}");
}

/// The solver of the example is one-dimensional, has no gravity, and sends no requests.
#[test]
fn solver_of_the_example_has_no_defects() {
    let report = doctor(&OwnSolver, &|_| ());
    assert_eq!(report.defects(), 0, "{}", page(&report));
    let not_applicable =
        |made: &&ExaminationReport| matches!(made.result, ExaminationResult::NotApplicable { .. });
    let names: Vec<_> =
        report.examinations.iter().filter(not_applicable).map(|made| made.examination).collect();
    assert_eq!(
        names,
        [
            "fall",
            "force",
            "periodic",
            "laws",
            "soils",
            "clay",
            "plasticity",
            "plane-stress",
            "start",
            "fluids",
            "hourglass",
            "traction",
            "damping",
            "moving-wall",
            "friction",
            "bodies",
            "contact",
            "periodic-ends",
            "load-steps"
        ]
    );
}
