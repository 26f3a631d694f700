mod bodies;
mod clay;
mod conversation;
mod damping;
mod faces;
mod fall;
mod force;
mod friction;
mod hourglass;
mod laws;
mod load_steps;
mod moving_wall;
mod paths;
mod periodic;
mod rest;
mod start;
mod start_gradient;
mod stress;
mod symmetry;
mod traction;
mod transfer;
mod translation;
mod vibration;
mod walls;

use super::patient::Examination;

/// All examinations, one per file, starting with the simplest. The first one examines the protocol.
pub(super) const ALL: &[Examination] = &[
    conversation::EXAMINATION,
    rest::EXAMINATION,
    transfer::INITIAL_VELOCITY,
    translation::EXAMINATION,
    faces::EXAMINATION,
    fall::EXAMINATION,
    force::EXAMINATION,
    transfer::EXAMINATION,
    stress::EXAMINATION,
    periodic::EXAMINATION,
    laws::EXAMINATION,
    paths::SOILS,
    clay::EXAMINATION,
    paths::PLASTICITY,
    paths::PLANE_STRESS,
    start::EXAMINATION,
    paths::FLUIDS,
    vibration::EXAMINATION,
    walls::EXAMINATION,
    hourglass::EXAMINATION,
    traction::EXAMINATION,
    damping::EXAMINATION,
    moving_wall::EXAMINATION,
    friction::EXAMINATION,
    bodies::EXAMINATION,
    friction::CONTACT,
    periodic::ENDS,
    symmetry::EXAMINATION,
    load_steps::EXAMINATION,
];

#[cfg(test)]
mod tests {
    use super::ALL;
    use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
    use crate::subject::{Subject, SubjectError};
    use crate::testing::doctor::patient::{Hindrance, Patient};
    use rstest::rstest;

    struct Able(usize);

    impl SolverFactory for Able {
        fn name(&self) -> &'static str {
            "able"
        }

        fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
            if needs.dimension == self.0 { Vec::new() } else { vec!["dimension".to_owned()] }
        }

        fn subject(&self, _: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
            Err("the built-in solver runs the scenes".into())
        }
    }

    /// Examinations of plane stress, loads, moving walls, friction and several bodies, which the
    /// solver of tests/it/false_alarms does not support, and of other laws.
    #[rstest]
    #[case(2, "basis: linear, transfer: flip, scheme: usl")]
    #[ignore = "ci/nightly runs it"]
    #[case(2, "basis: linear, transfer: pic, scheme: musl")]
    #[ignore = "ci/nightly runs it"]
    #[case(2, "basis: cpdi, transfer: flip, scheme: usf")]
    #[ignore = "ci/nightly runs it"]
    #[case(2, "basis: quadratic_bspline, transfer: apic, scheme: usl")]
    #[ignore = "ci/nightly runs it"]
    #[case(2, "basis: cubic_bspline, transfer: flip, scheme: musl")]
    #[ignore = "ci/nightly runs it"]
    #[case(1, "basis: ugimp, transfer: flip_99, scheme: musl")]
    fn built_in_solver_has_no_defect(#[case] dimension: usize, #[case] method: &str) {
        let patient = Patient { solver: &Able(dimension), built_in: Some(method) };
        let position = |name: &str| ALL.iter().position(|made| made.name == name);
        let [laws, loads] = ["soils", "hourglass"].map(|name| position(name).expect("a name"));
        let of_laws = ALL[laws..][..6].iter().filter(|made| made.name != "clay");
        for examination in of_laws.chain(&ALL[loads..][..7]) {
            match (examination.examine)(&patient) {
                Ok(made) => assert!(made.findings.is_empty(), "{}", made.findings[0].seen),
                Err(Hindrance::Lacks(why)) => assert_eq!((dimension, &*why), (1, "dimension")),
                Err(Hindrance::Masked(why) | Hindrance::Broke(why)) => {
                    panic!("{}: {why}", examination.name)
                }
            }
        }
    }
}
