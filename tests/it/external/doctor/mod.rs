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
use std::cell::Cell;
use std::env;
use std::sync::atomic::Ordering;

/// Runs the doctor on a client. Returns its defects, its other remarks, and the report.
/// Examinations after `last`, if given, are not applicable.
fn found(defect: Defect, last: Option<&str>) -> (Vec<&'static str>, Vec<&'static str>, String) {
    let clinic = Clinic::new(defect);
    let is_last = Cell::new(false);
    let progress = |examination: &str| {
        clinic.is_closed.fetch_or(is_last.get(), Ordering::Relaxed);
        is_last.set(last == Some(examination));
    };
    let report = doctor(&clinic, &progress);
    let of = |weight: FindingWeight| {
        let all = report.findings().filter(|finding| finding.weight == weight);
        all.map(|finding| finding.name).collect()
    };
    (of(FindingWeight::Defect), of(FindingWeight::Remark), page(&report))
}

/// Defects with the examination and the name of their finding. With the variable `NIGHTLY`, all
/// later examinations run, too.
#[rstest]
#[case(Defect::GravityLeftOn, "rest", "gravity-left-on")]
#[case(Defect::StressAtStart, "rest", "stress-at-rest")]
#[case(Defect::Drag, "translation", "drag")]
#[case(Defect::WeightsOfTheirOwn, "translation", "weights-do-not-sum-to-one")]
#[case(Defect::LowWeights, "translation", "weights-do-not-sum-to-one")]
#[case(Defect::UnevenWeightsInPic, "translation", "weights-do-not-sum-to-one")]
#[case(Defect::GradientsOfTheirOwn, "translation", "gradients-do-not-sum-to-zero")]
#[case(Defect::LossAtCrossings, "translation", "wrong-after-a-cell-crossing")]
#[case(Defect::LightNodesLeftOut, "translation", "light-nodes-left-out")]
#[case(Defect::NoCellOnFaces, "faces", "particles-on-faces")]
#[case(Defect::ForwardEuler, "fall", "positions-before-velocities")]
#[case(Defect::ForceAtPresentPositions, "force", "force-at-present-positions")]
#[case(Defect::ForceOfOtherPoints, "force", "force-of-other-points")]
#[case(Defect::WholeCells, "stress", "mass-or-volume-scaled")]
#[case(Defect::NoDensity, "stress", "mass-or-volume-scaled")]
#[case(Defect::NoWalls, "walls", "wall-missing")]
#[case(Defect::WallsLetGo, "walls", "wall-lets-go")]
#[case(Defect::StickyRollers, "walls", "roller-holds-tangent")]
#[case(Defect::LowWallsOnly, "walls", "wall-missing")]
#[case(Defect::FixedHoldsNormal, "walls", "fixed-lets-slide")]
#[case(Defect::LoadAfterWalls, "walls", "wall-moves-under-gravity")]
#[case(Defect::HeldAcceleration, "walls", "wall-holds-acceleration-only")]
#[case(Defect::AbsoluteThreshold, "faces", "light-nodes-left-out")]
fn a_defect_is_named_and_no_other(
    #[case] defect: Defect,
    #[case] examination: &str,
    #[case] name: &str,
) {
    let (defects, _, page) =
        found(defect, Some(examination).filter(|_| env::var_os("NIGHTLY").is_none()));
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
#[ignore = "ci/nightly runs it"]
#[case(
    Defect::PicAtFirst,
    &["rounding-grows-on-faces", "start-half-a-step-off", "first-step-spreads"]
)]
fn correct_client_has_remarks_only(#[case] scheme: Defect, #[case] remarks: &[&str]) {
    let (defects, found, page) = found(scheme, None);
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
    let (_, _, page) = found(Defect::Drag, None);
    let flat = flat(&page);
    assert!(flat.contains("speed is lost at a rate of 0.5"), "{page}");
    assert!(
        flat.ends_with(
            "verdict: drag; 1 not applicable; 24 skipped until all defects are corrected"
        ),
        "{page}"
    );
}
