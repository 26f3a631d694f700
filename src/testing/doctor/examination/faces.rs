//! Examination of a rigid body at constant speed whose particles repeatedly lie on cell faces.

use super::stress::largest_entry;
use super::translation::VELOCITY;
use crate::testing::doctor::finding::{LIGHT_NODES, MASS_THRESHOLD};
use crate::testing::doctor::motion::{CHANGED, uniform};
use crate::testing::doctor::prelude::*;
use crate::testing::doctor::scene::Extras;

pub(super) const EXAMINATION: Examination = Examination {
    name: "faces",
    expected: "a body without stress keeps its velocity, also in steps in which its particles lie \
               exactly on cell faces",
    after: &["translation"],
    covers: &[],
    examine,
};

/// Distance (cells) by which the outermost particles have crossed a cell face. The nodes that only
/// these particles reach have this fraction of a regular nodal mass.
const SLIVER: f64 = 1.0 / (1_u64 << 44) as f64;

/// Maximum strain of a rigid body due to rounding errors.
const RIGID: f64 = 1e-6;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    // All numbers have few binary digits, so one half of the particles lies exactly on faces after
    // 3, 11, ... steps, and the other half after 7, 15, ... steps. No particle starts on a face: a
    // total Lagrangian solver would find it there in every step, and invert it.
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| {
        let from = [0.75, 0.25, 0.5].map(|x| x + 0.375 * H);
        let mut scene = BoxScene::of_cells(kind, from, 4.0, 6.0);
        scene.velocity = scene.uniform([VELOCITY[0]; 3]);
        BoxScene { steps: 32, dt: 0.0625, ..scene }
    })?;
    let found = uniform(patient, &scene.soft())?;
    let first = found.findings.first();
    if first.is_some_and(|finding| finding.name == CHANGED) {
        return Ok(found);
    }
    // A node without mass has no velocity. The gradient of linear functions at this node then
    // changes affine matrices that follow from gradients, which is not a defect.
    if let Some(finding) = first.filter(|finding| finding.name != LIGHT_NODES) {
        let finding = SolverFinding::defect(
            "particles-on-faces",
            format!("{} ({})", finding.seen, finding.name),
            "the weights of a particle that lies exactly on a cell face do not sum to one",
            "the cell index of a particle on a cell face: `floor`, `ceil` or a cast to an integer; \
             `<` or `<=` at the ends of a cell",
        );
        return Ok(Examined::new(found.measured, vec![finding]));
    }
    let mut beyond = scene.soft();
    let ends = beyond.body.0.iter_mut().chain(&mut beyond.body.1);
    ends.for_each(|end| *end += SLIVER * H);
    if let Some(mut finding) = strained(patient, &beyond)? {
        let rounding = position_rounding(patient, &scene)?;
        if rounding > 0.5 * SLIVER * H {
            finding = rounding_remark(format!(
                "{}. Displacements of a rigid body have errors of {} m, more than the distance \
                 of the particles from the face",
                finding.seen,
                shown(rounding)
            ));
        }
        return Ok(Examined::new(found.measured, vec![finding]));
    }
    let stiff = uniform(patient, &scene)?;
    let finding = first.or(stiff.findings.first()).map(|_| {
        let (stiff, soft) = (&stiff.measured, &found.measured);
        rounding_remark(format!("with stiffness: {stiff}; without stiffness: {soft}"))
    });
    Ok(Examined::new(stiff.measured, finding))
}

fn rounding_remark(seen: String) -> SolverFinding {
    SolverFinding::remark(
        "rounding-grows-on-faces",
        seen,
        "a node next to the face has no mass, or a mass of the size of rounding errors, but \
         linear functions have a gradient at this node. The velocity of the node then strains \
         the particle",
        "basis functions with continuous gradients (quadratic B-splines, GIMP) avoid this error. \
         With linear functions, avoid initial positions on cell faces. Coordinates with a large \
         offset have larger rounding errors",
    )
}

/// Returns the largest error (m) of displacements in a rigid motion by a third of a cell in eight
/// steps. It shows the rounding of the positions, which is large if they have an offset.
pub(super) fn position_rounding(patient: &Patient<'_>, scene: &BoxScene) -> Result<f64, Hindrance> {
    let velocity = scene.h / (24.0 * scene.dt) * Vector3::x();
    let rigid = BoxScene {
        steps: 8,
        velocity: AffineField::uniform(velocity),
        gravity: None,
        faces: Vec::new(),
        extras: Extras::default(),
        ..scene.soft()
    };
    let course = patient.run(&rigid)?;
    let error = |k: usize| course.farthest(displacement, k, course.times[k] * velocity);
    Ok((1..=course.last()).map(error).fold(0.0, f64::max))
}

fn strained(patient: &Patient<'_>, scene: &BoxScene) -> Result<Option<SolverFinding>, Hindrance> {
    let course = patient.run(scene)?;
    let (lambda, mu) = scene.lame();
    let mut most = 0.0_f64;
    // Only changes since the first step count, because other examinations check the initial values.
    let after_start = course.states.get(1..).and_then(<[_]>::split_first);
    let Some((first, later)) = after_start else { return Ok(None) };
    for state in later {
        let change = |now: &[f64], then: &[f64]| {
            largest_entry(&now.iter().zip(then).map(|(now, then)| now - then).collect::<Vec<_>>())
        };
        most = most.max(change(&state.deformation_gradient, &first.deformation_gradient));
        // This check needs a law whose stress is proportional to an elastic modulus.
        if ELASTIC.contains(&scene.law) {
            most = most.max(change(&state.stress, &first.stress) / (lambda + 2.0 * mu));
        }
    }
    Ok((!(most <= RIGID)).then(|| {
        SolverFinding::defect(
            LIGHT_NODES,
            format!(
                "the outermost particles are {SLIVER:.0e} cells beyond a cell face, and the strain \
                 reaches {} although the body moves as a rigid body",
                shown(most)
            ),
            "nodes with little mass are skipped and have no velocity, which causes a velocity \
             gradient at the particles next to them",
            MASS_THRESHOLD,
        )
    }))
}
