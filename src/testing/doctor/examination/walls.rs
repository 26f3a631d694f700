//! Walls: a body that is thrown against one, away from it, and along it.

use super::translation::VELOCITY;
use crate::testing::doctor::course::{line, shown, velocity};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::motion::uniform;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::{BoxScene, H};

pub(super) const EXAMINATION: Examination = Examination {
    name: "walls",
    expected: "a wall holds a body that comes and one that goes with the force rho c v of an elastic \
               bar, and a roller lets it slide",
    after: &["conversation", "rest", "translation", "stress"],
    examine,
};

/// Length of the bar (cells).
const CELLS: f64 = 12.0;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let (mut measured, mut findings, mut lacks) = (Vec::new(), Vec::new(), Vec::new());
    let held = ["fixed", "roller"].into_iter().flat_map(|wall| [(wall, -1.0), (wall, 1.0)]);
    for (wall, way) in held {
        match thrown(patient, wall, way) {
            Ok(force) => {
                let words = if way < 0.0 { "coming" } else { "going" };
                measured.push(format!("{wall}, {words}: {} of the force", shown(force)));
                let found = of_force(wall, way, force);
                // A wall that is missing holds nothing that goes either.
                let is_new = |finding: &SolverFinding| {
                    let names = [finding.name, "wall-missing"];
                    !findings.iter().any(|old: &SolverFinding| names.contains(&old.name))
                };
                findings.extend(found.filter(is_new));
            }
            Err(Hindrance::Lacks(what)) => lacks.push(what),
            Err(broke) => return Err(broke),
        }
    }
    match sliding(patient) {
        Ok(found) => {
            measured.push(format!("sliding: {}", found.measured));
            findings.extend(found.findings);
        }
        Err(Hindrance::Lacks(what)) => lacks.push(what),
        Err(broke) => return Err(broke),
    }
    if measured.is_empty() {
        lacks.dedup();
        return Err(Hindrance::Lacks(lacks.join("; ")));
    }
    Ok(Examined::new(measured.join("; "), findings))
}

/// Force of the wall over `rho c v A`, by the momentum of a bar without Poisson's effect.
fn thrown(patient: &Patient<'_>, wall: &'static str, way: f64) -> Result<f64, Hindrance> {
    let scene = patient.able(&[2, 1, 3], &|kind| {
        let mut scene = BoxScene::of_cells(kind, [0.25; 3], 4.0, 3.0);
        scene.body.1[0] = scene.body.0[0] + CELLS * scene.h;
        scene.grid.0[0] = scene.body.0[0];
        scene.grid.1[0] = scene.body.1[0] + 3.0 * scene.h;
        (scene.young, scene.poisson) = (3.0, 0.0);
        scene.faces = vec![("left", wall)];
        let speed = scene.wave_speed();
        scene.velocity[0] = format!("{:e}", way * 1e-3 * speed);
        BoxScene { steps: 40, dt: 0.5 * CELLS * scene.h / speed / 40.0, ..scene }
    })?;
    let course = patient.run(&scene)?;
    if let Some(failure) = course.failure {
        return Err(Hindrance::Broke(failure));
    }
    let start = way * 1e-3 * scene.wave_speed();
    let crossings = scene.wave_speed() / (CELLS * scene.h);
    let time: Vec<f64> = course.times.iter().map(|t| t * crossings).collect();
    let left: Vec<f64> = (0..=course.last()).map(|k| course.mean(velocity, k)[0] / start).collect();
    let (_, slope, _) = line(&time, &left);
    Ok(-slope)
}

fn of_force(wall: &str, way: f64, force: f64) -> Option<SolverFinding> {
    let near = 0.1;
    if (force - 1.0).abs() <= near {
        return None;
    }
    let seen = format!("`{wall}`: {} of the force that stops the bar", shown(force));
    Some(if force.abs() > near {
        SolverFinding::defect(
            "wall-force",
            seen,
            "the wall acts with another strength, or at another place",
            "nodes on the face of the body: their velocity along the normal is zero, also in the \
             velocities that move particles and strain them",
        )
    } else if way > 0.0 {
        SolverFinding::defect(
            "wall-lets-go",
            seen,
            "the wall holds a body that comes, and not one that goes",
            "walls here act both ways: a solver whose walls separate does not say `fixed` or `roller`",
        )
    } else {
        SolverFinding::defect(
            "wall-missing",
            seen,
            "no force acts at the wall",
            "`faces` of the problem: `at` is the place, `axis` and `high` the side; nodes beyond the \
             wall, if the solver has some there",
        )
    })
}

/// A body beside a roller moves along it as if there were none.
fn sliding(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3], &|kind| {
        // Particles pass faces of cells at a distance.
        let mut scene = BoxScene::of_cells(kind, [0.25, 0.25 + 0.1125 * H, 0.25], 4.0, 4.0);
        scene.grid.0[0] = scene.body.0[0];
        scene.faces = vec![("left", "roller")];
        scene.velocity[1] = VELOCITY[0].to_string();
        BoxScene { steps: 40, dt: 0.025, ..scene }
    })?;
    let found = uniform(patient, &scene, [0.0, VELOCITY[0], 0.0])?;
    let findings = found.findings.into_iter().map(|finding| {
        SolverFinding::defect(
            "roller-holds-tangent",
            finding.seen,
            "a roller brakes a body that moves along it",
            "at a roller only the velocity along `axis` of the face is zero",
        )
    });
    Ok(Examined { findings: findings.collect(), ..found })
}
