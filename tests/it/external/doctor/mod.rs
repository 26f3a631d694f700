//! The doctor: each defect of a small client is reported, without false positives.

mod client;
mod defect;
#[cfg(unix)]
mod program;

use crate::common::folder::flat;
use crate::testing::OwnSolver;
use client::Clinic;
use defect::Defect;
use mpm_verify::testing::{ExaminationReport, ExaminationResult, FindingWeight, doctor, page};
use rstest::rstest;

/// Runs the doctor on a client. Returns its defects, its other remarks, and the report.
fn found(defect: Defect) -> (Vec<&'static str>, Vec<&'static str>, String) {
    let report = doctor(&Clinic::new(defect), &|_| ());
    let of = |weight: FindingWeight| {
        let all = report.findings().filter(|finding| finding.weight == weight);
        all.map(|finding| finding.name).collect()
    };
    (of(FindingWeight::Defect), of(FindingWeight::Remark), page(&report))
}

#[rstest]
#[case(Defect::GravityLeftOn, "gravity-left-on")]
#[case(Defect::StressAtStart, "stress-at-rest")]
#[case(Defect::Positions, "positions-for-displacements")]
#[case(Defect::Millimetres, "displacement-scaled")]
#[case(Defect::Exchanged, "axes-exchanged")]
#[case(Defect::Random, "another-way-each-time")]
#[case(Defect::OwnStep, "own-step")]
#[case(Defect::Drag, "drag")]
#[case(Defect::UnevenDrag, "drag")]
#[case(Defect::LossPerStep, "speed-lost-each-step")]
#[case(Defect::SinglePrecision, "single-precision")]
#[case(Defect::PositionsHalfAStepOn, "start-half-a-step-off")]
#[case(Defect::WeightsOfTheirOwn, "weights-do-not-sum-to-one")]
#[case(Defect::LowWeights, "weights-do-not-sum-to-one")]
#[case(Defect::UnevenWeightsInPic, "weights-do-not-sum-to-one")]
#[case(Defect::GradientsOfTheirOwn, "gradients-do-not-sum-to-zero")]
#[case(Defect::LossAtCrossings, "wrong-after-a-cell-crossing")]
#[case(Defect::LightNodesLeftOut, "light-nodes-left-out")]
#[case(Defect::UnitCube, "position-limited")]
#[case(Defect::NoCellOnFaces, "particles-on-faces")]
#[case(Defect::Wrapped, "displacements-wrapped")]
#[case(Defect::GravityTwice, "gravity-scaled")]
#[case(Defect::GravityUpwards, "gravity-upwards")]
#[case(Defect::GravityIgnored, "gravity-missing")]
#[case(Defect::GravityTimesDensity, "gravity-scaled")]
#[case(Defect::VelocityAhead, "velocity-of-another-time")]
#[case(Defect::ForwardEuler, "positions-before-velocities")]
#[case(Defect::ForceAtPresentPositions, "force-at-present-positions")]
#[case(Defect::ForceOfTheStart, "force-of-one-time")]
#[case(Defect::ForceOfOtherPoints, "force-of-other-points")]
#[case(Defect::NoStress, "stress-missing")]
#[case(Defect::PushingStress, "stress-sign")]
#[case(Defect::WholeCells, "mass-or-volume-scaled")]
#[case(Defect::NoDensity, "mass-or-volume-scaled")]
#[case(Defect::PlaneStress, "plane-stress")]
#[case(Defect::LameExchanged, "lame-parameters-exchanged")]
#[case(Defect::BulkForLambda, "bulk-modulus-for-lambda")]
#[case(Defect::MuTwice, "mu-doubled")]
#[case(Defect::NoVolumeTerm, "volume-term-missing")]
#[case(Defect::EngineeringShear, "shear-doubled")]
#[case(Defect::OneSidedShear, "stress-not-symmetric")]
#[case(Defect::PressurePositive, "stress-column")]
#[case(Defect::Transposed, "deformation-gradient-transposed")]
#[case(Defect::NoWalls, "wall-missing")]
#[case(Defect::WallsLetGo, "wall-lets-go")]
#[case(Defect::StickyRollers, "roller-holds-tangent")]
#[case(Defect::LowWallsOnly, "wall-missing")]
#[case(Defect::FixedHoldsNormal, "fixed-lets-slide")]
#[case(Defect::LoadAfterWalls, "wall-moves-under-gravity")]
#[case(Defect::HeldAcceleration, "wall-holds-acceleration-only")]
#[case(Defect::PositionsShort, "displacement-scaled")]
#[case(Defect::RoundedOutput, "single-precision")]
#[case(Defect::AbsoluteThreshold, "light-nodes-left-out")]
fn a_defect_is_named_and_no_other(#[case] defect: Defect, #[case] name: &str) {
    let (defects, _, page) = found(defect);
    assert_eq!(defects, [name], "{page}");
}

/// Properties of a scheme are reported as remarks, not as defects.
#[rstest]
#[case(Defect::Nothing, &["rounding-grows-on-faces", "start-half-a-step-off"])]
#[case(Defect::Leapfrog, &["rounding-grows-on-faces", "velocity-half-a-step-behind"])]
#[case(
    Defect::Pic,
    &["rounding-grows-on-faces", "start-half-a-step-off", "momentum-spreads"]
)]
#[case(
    Defect::PicAtFirst,
    &["rounding-grows-on-faces", "start-half-a-step-off", "first-step-spreads"]
)]
#[case(
    Defect::ForceOfTheEnd,
    &["rounding-grows-on-faces", "start-half-a-step-off", "force-of-the-end-of-the-step"]
)]
fn correct_client_has_remarks_only(#[case] scheme: Defect, #[case] remarks: &[&str]) {
    let (defects, found, page) = found(scheme);
    assert!(defects.is_empty(), "{page}");
    assert_eq!(found, remarks, "{page}");
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

/// The last lines must be the verdict, because some authors read only these.
#[test]
fn report_ends_with_the_verdict() {
    let (_, _, page) = found(Defect::Drag);
    let flat = flat(&page);
    assert!(flat.contains("speed is lost at a rate of 0.5"), "{page}");
    assert!(
        flat.ends_with(
            "verdict: drag; 1 not applicable; 24 skipped until all defects are corrected"
        ),
        "{page}"
    );
}
