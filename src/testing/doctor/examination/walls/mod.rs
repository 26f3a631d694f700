//! Examination of walls on every face: a body is thrown against a wall, is pulled from the wall,
//! moves along the wall, and falls onto the wall.
//!
//! A bar with modulus E and zero Poisson's ratio is fixed at both ends and has the initial velocity
//! v. Each wall stops the adjacent half with the force `rho c v A`, c^2 = E/rho, one in compression
//! and one in tension, until a wave arrives from the other wall. Under the acceleration g from
//! rest, the force is `rho c g t A`. The momentum of the adjacent half gives the force of a wall. A
//! bar that is stretched from a wall shows whether linear fields are reproduced there.
//!
//! ```text
//! measure   the scenes, and the forces and motions at each wall
//! judge     the finding that explains the results
//! ```

mod judge;
mod measure;

use super::translation::VELOCITY;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::prelude::*;
use judge::finding;
pub(super) use measure::bar;
use measure::{Wall, walls_across};

pub(super) const EXAMINATION: Examination = Examination {
    name: "walls",
    expected: "on a body that is pushed against a wall or pulled from the wall, also under \
               gravity, every wall exerts the force rho c v per area (rho: density, c: wave \
               speed, v: speed), and a body slides along a roller without force",
    after: &["translation", "fall", "force", "transfer", "stress", "vibration"],
    covers: &["conditions: fixed", "conditions: roller"],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let (mut walls, mut lacks) = (Vec::new(), Vec::new());
    let mut sliding = Examined::default();
    for condition in ["fixed", "roller"] {
        let thrown = |kind| bar(kind, 0, condition);
        match patient.able(&[2, 1, 3], &ELASTIC, &thrown) {
            Ok(scene) => {
                let kind = (scene.dimension, scene.law);
                for axis in 0..kind.0 {
                    walls.extend(walls_across(patient, kind, axis, condition)?);
                    if condition == "roller" && kind.0 > 1 && sliding.findings.is_empty() {
                        sliding = slide(patient, kind, axis)?;
                    }
                }
            }
            Err(Hindrance::Lacks(what)) => lacks.push(what),
            Err(broke) => return Err(broke),
        }
    }
    if walls.is_empty() {
        lacks.dedup();
        return Err(Hindrance::Lacks(lacks.join("; ")));
    }
    let name = |wall: &Wall| format!("{} {}: {}", wall.condition, wall.face, wall.describe());
    let forces = walls.iter().map(name).collect::<Vec<_>>().join("; ");
    let mut measured = vec![format!(
        "forces divided by the expected forces: {forces}. A correct wall has 1 for a body that is \
         pushed, is pulled, or falls; 1 for a body that slides along a fixed wall, and 0 along a \
         roller; 0 in the first step of a fall; 0 for the error of displacements in a uniform \
         stretch"
    )];
    if !sliding.measured.is_empty() {
        measured.push(format!("sliding along a roller: {}", sliding.measured));
    }
    let mut findings: Vec<SolverFinding> = finding(&walls).into_iter().collect();
    // Non-uniform sliding is reported last, because a moving or missing wall also causes it.
    if findings.is_empty() {
        findings.extend(sliding.findings);
    }
    Ok(Examined::new(measured.join("; "), findings))
}

fn slide(patient: &Patient<'_>, kind: Kind, axis: usize) -> Result<Examined, Hindrance> {
    let other = (axis + 1) % kind.0;
    let mut from = [0.25; 3];
    from[other] += 0.1125 * H;
    let mut scene = BoxScene::of_cells(kind, from, 4.0, 4.0);
    scene.grid.0[axis] = scene.body.0[axis];
    scene.grid.1[axis] = scene.body.1[axis];
    scene.faces = FACES[axis].map(|face| (face, "roller")).to_vec();
    scene.velocity = AffineField::along(other, VELOCITY[0]);
    let scene = BoxScene { steps: 40, dt: 0.025, ..scene };
    let (examined, [low, high]) = (uniform(patient, &scene)?, FACES[axis]);
    let findings = examined.findings.into_iter().map(|finding| {
        SolverFinding::defect(
            "roller-holds-tangent",
            format!("between the faces {low} and {high}: {}", finding.seen),
            "a roller slows a body that slides along the roller",
            "the condition at nodes: a roller sets only the velocity along `axis` of the face to \
             zero",
        )
    });
    Ok(Examined { findings: findings.collect(), ..examined })
}
