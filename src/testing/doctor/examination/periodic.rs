//! A rigid body that fills a periodic axis and moves along it.

use super::translation::VELOCITY;
use crate::testing::doctor::course::displacement;
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{BoxScene, H};

pub(super) const EXAMINATION: Examination = Examination {
    name: "periodic",
    expected: "a body that fills a periodic axis moves along it, its displacements not wrapped",
    after: &["conversation", "rest", "translation"],
    examine,
};

/// Cells along the axis.
const CELLS: f64 = 4.0;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 1, 3], &|kind| {
        let mut scene = BoxScene::of_cells(kind, [0.25; 3], CELLS, 3.0);
        scene.grid.0[0] = scene.body.0[0];
        scene.grid.1[0] = scene.body.1[0];
        scene.velocity[0] = VELOCITY[0].to_string();
        scene.faces = vec![("left", "periodic"), ("right", "periodic")];
        BoxScene { steps: 60, dt: 0.025, ..scene }
    })?;
    let found = uniform(patient, &scene, [VELOCITY[0], 0.0, 0.0])?;
    if found.findings.is_empty() {
        return Ok(found);
    }
    let course = patient.run(&scene)?;
    let (last, period) = (course.last(), CELLS * H);
    let way = VELOCITY[0] * course.times[last];
    let wrapped = course.points(displacement, last).any(|(_, u)| {
        let periods = (way - u[0]) / period;
        libm::round(periods) != 0.0 && (periods - libm::round(periods)).abs() <= 1e-3
    });
    let finding = if wrapped {
        SolverFinding::defect(
            "displacements-wrapped",
            format!("some displacements are off by periods of {period} m after {way} m"),
            "positions are put back into the period, and displacements are taken from those",
            "the answer to `advance`: displacements go on growing; keep them apart, or count periods",
        )
    } else {
        SolverFinding::defect(
            "periodic-axis",
            found.findings[0].seen.clone(),
            "the two ends of a periodic axis are not one place",
            "indices of nodes modulo the number of cells (not that of nodes); node N is node 0, in \
             every sum and for every function that reaches across the end",
        )
    };
    Ok(Examined::new(found.measured, vec![finding]))
}
