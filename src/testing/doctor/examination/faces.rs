//! A rigid body at constant speed whose particles lie on faces of cells, again and again.

use super::translation::VELOCITY;
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{ANY, BoxScene, H};
use crate::testing::doctor::vectors::AffineField;

pub(super) const EXAMINATION: Examination = Examination {
    name: "faces",
    expected: "the same where particles lie on faces of cells, again and again",
    after: &["conversation", "rest", "translation"],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    // Every eighth step all particles lie on faces again: no number here has more than a few bits.
    let scene = patient.able(&[2, 3, 1], &ANY, &|kind| {
        let from = [0.75 + 0.25 * H, 0.25 + 0.25 * H, 0.5 + 0.25 * H];
        let mut scene = BoxScene::of_cells(kind, from, 4.0, 6.0);
        let mut velocity = [VELOCITY[0]; 3];
        velocity[kind.0..].fill(0.0);
        scene.velocity = AffineField::uniform(velocity);
        BoxScene { steps: 32, dt: 0.0625, ..scene }
    })?;
    let found = uniform(patient, &scene.soft())?;
    if let Some(finding) = found.findings.first() {
        let finding = SolverFinding::defect(
            "particles-on-faces",
            format!("{} ({})", finding.seen, finding.name),
            "a particle that lies on the face of a cell has weights that do not sum to one",
            "`floor` against `ceil` or a cast to an integer, `<` against `<=` where a cell ends",
        );
        return Ok(Examined::new(found.measured, vec![finding]));
    }
    let stiff = uniform(patient, &scene)?;
    let finding = stiff.findings.first().map(|_| {
        SolverFinding::remark(
            "rounding-grows-on-faces",
            format!("{}, and without stiffness {}", stiff.measured, found.measured),
            "a node beside a face has no mass, or one of the size of rounding, and linear functions have \
             a gradient there all the same: its velocity strains the particle",
            "functions with continuous gradients (quadratic B-splines, GIMP); until then, no lattice \
             whose particles lie on faces of cells",
        )
    });
    Ok(Examined::new(stiff.measured, finding.into_iter().collect()))
}
