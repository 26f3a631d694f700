//! Findings about particles outside the grid and about moving walls.

use super::session::{Known, Session, accepts_grid, finding, only, refusal};
use crate::exact::Problem;
use crate::mpm::FrameName;
use crate::study::exact_motion::{Extremes, raster};
use crate::study::handover::level_problem;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{ConvergencePlan, SceneFace};
use crate::suite::scene::grid_axis;
use crate::verify::{KnownCause, KnownCauseKind, LevelOutcome};

/// Maximum distance (cells) from the end of the grid that counts as rounding error.
const ROUNDING: f64 = 1e-6;

/// Number of sampling intervals of walls, along each axis and over the run.
const INTERVALS: usize = 8;

/// `frame: total_lagrangian` is recommended if it reduces the error to at most this fraction.
const MENDED: f64 = 0.1;

pub(super) fn check(known: &Known<'_>) -> Option<KnownCause> {
    let is_lost = |level: &LevelOutcome| {
        level.run.counters.left_domain > Some(0) || level.run.failure.is_some()
    };
    let lost = known.levels.iter().position(is_lost);
    if let Some(finding) = moving_wall(known) {
        return Some(finding);
    }
    let level = *known.plan.refine.levels.get(lost?)?;
    beyond_the_grid(known, level).or_else(|| particle_on_wall(known.session, known.plan, level))
}

fn moving_wall(known: &Known<'_>) -> Option<KnownCause> {
    let (plan, session) = (known.plan, known.session);
    let problem = plan.exact.as_ref()?;
    let stays = match session.case.method {
        Method::Mpm(method) => method.frame == FrameName::Updated,
        Method::QuasiStatic { .. } | Method::External { .. } => true,
        Method::Fem { .. } | Method::Heat { .. } => false,
    };
    stays.then_some(())?;
    let finest = plan.refine.levels.last()?.h;
    let driven = plan.scene.faces.iter().filter(|face| face.hold.is_driven());
    let moved = driven.map(|face| (face, path(problem, face, session.case.until)));
    let (face, path) = moved.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, d)| *d > finest)?;
    let length = plan.scene.to[face.axis] - plan.scene.from[face.axis];
    let follows = follows_in_total_frame(known);
    let or_frame = if follows { ", or use `frame: total_lagrangian`" } else { "" };
    let evidence = format!(
        "It moves by {path:.3e} m, {:.2} times the length of the body and {:.1} cells of the \
         finest level.",
        path / length,
        path / finest
    );
    let cause = format!(
        "the {} wall moves along its normal, but walls are fixed at the end of the grid",
        face.name
    );
    let remedy =
        format!("let the wall move only along its surface, or by less than a cell{or_frame}");
    Some(finding(KnownCauseKind::OutsideGrid, cause, evidence, remedy))
}

/// Returns the largest distance (m) by which a face moves along its normal until time `until` (s).
fn path(problem: &Problem, face: &SceneFace, until: f64) -> f64 {
    let at = if face.high { problem.to[face.axis] } else { problem.from[face.axis] };
    let mut longest = 0.0_f64;
    for mut label in raster(problem, INTERVALS) {
        label[face.axis] = at;
        for step in 0..=INTERVALS {
            let t = until * step as f64 / INTERVALS as f64;
            longest = longest.max(problem.motion.component(face.axis, &label, t).abs());
        }
    }
    longest
}

fn follows_in_total_frame(known: &Known<'_>) -> bool {
    let (plan, session) = (known.plan, known.session);
    let mut case = session.case.clone();
    let Method::Mpm(method) = &mut case.method else { return false };
    method.frame = FrameName::Total;
    let finest = plan.refine.levels.len().saturating_sub(1)..;
    let changed = only(plan, &case, &plan.refine.levels[finest]);
    let accepted = refusal(session.source, plan, &only(plan, &case, &plan.refine.levels));
    let run = accepted.is_none().then(|| session.changed("`frame: total_lagrangian`", &changed));
    let after = run.flatten().and_then(|found| found.levels.last().map(|level| level.error));
    let before = known.levels.last().map_or(f64::NAN, |level| level.error);
    after.is_some_and(|after| after <= MENDED * before || (after.is_finite() && before.is_nan()))
}

fn beyond_the_grid(known: &Known<'_>, level: LevelPlan) -> Option<KnownCause> {
    let (plan, scene) = (known.plan, &known.plan.scene);
    let reach = Extremes::of(plan.exact.as_ref()?).reach;
    let axes = 0..scene.dimension();
    let grid: Vec<(f64, f64)> = axes
        .clone()
        .map(|axis| {
            let (start, cells) = grid_axis(scene, axis, level.h);
            (start, start + cells * level.h)
        })
        .collect();
    let room = ROUNDING * level.h;
    let is_beyond = |axis: &usize| {
        let ((low, high), (start, end)) = (reach[*axis], grid[*axis]);
        low < start - room || high > end + room
    };
    let axis = axes.clone().find(is_beyond)?;
    let name = ["x", "y", "z"][axis];
    let ((low, high), (start, end)) = (reach[axis], grid[axis]);
    let larger: Vec<(f64, f64)> = axes
        .map(|axis| {
            let ((low, high), (start, end)) = (reach[axis], grid[axis]);
            let spare = 0.1 * (scene.to[axis] - scene.from[axis]);
            let low = if low < start - room { low - spare } else { start };
            (low, if high > end + room { high + spare } else { end })
        })
        .collect();
    let (from, to): (Vec<f64>, Vec<f64>) = larger.into_iter().unzip();
    let is_accepted = accepts_grid(known.session.source, &from, &to);
    let grid = if is_accepted { "a larger `grid` in `scene`, or " } else { "" };
    let evidence = format!(
        "The exact motion takes {name} from {low:.4} to {high:.4} m, and with {} cells the grid \
         extends from {start:.4} to {end:.4} m.",
        level.cells
    );
    let (cause, remedy) =
        ("the grid ends where the body moves to", format!("{grid}a smaller motion"));
    Some(finding(KnownCauseKind::OutsideGrid, cause, evidence, remedy))
}

pub(super) fn particle_on_wall(
    session: &Session<'_>,
    plan: &ConvergencePlan,
    level: LevelPlan,
) -> Option<KnownCause> {
    let scene = &plan.scene;
    let problem = level_problem(session.suite, plan, session.case, level).ok()?;
    let d = scene.dimension();
    for axis in (0..d).filter(|axis| !problem.grid.periodic[*axis]) {
        let (start, cells) = grid_axis(scene, axis, level.h);
        let end = start + cells * level.h;
        let coordinates = problem.particles.position.iter().skip(axis).step_by(d);
        let is_on_wall = |x: &&f64| ((**x - start).min(end - **x)).abs() <= ROUNDING * level.h;
        let Some(x) = coordinates.clone().find(is_on_wall) else { continue };
        let name = ["x", "y", "z"][axis];
        let cause =
            "particles start on a wall, where rounding decides whether they are in the grid";
        let evidence = format!(
            "With {} cells a particle starts at {name} = {x} m, and the grid extends from \
             {start} to {end} m.",
            level.cells
        );
        let remedy =
            "place the particles inside the body: a smaller `shift` in `particles`, or none";
        return Some(finding(KnownCauseKind::OutsideGrid, cause, evidence, remedy));
    }
    None
}
