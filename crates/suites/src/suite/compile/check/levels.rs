//! Checks each level: its size, nodes on fixed faces, particles, and time step.

use crate::suite::compile::run::refine::COARSE_TO_FINE;
use crate::suite::compile::study::CompiledStudy;
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::MethodSpec;
use crate::suite::model::refine_plan::{LevelPlan, MOST_POINTS, SameMethod};
use crate::suite::model::{Against, Case, Scene};
use crate::suite::scene::lattice::{any_particle, is_vacant};
use crate::suite::scene::{cell_size, grid_axis, per_axis};
use crate::suite::yaml::Diagnostic;
use crate::verify::{Axis, Clock, STEP_TOLERANCE};

/// Maximum distance (cells) between a fixed face of the body and the grid face next to it.
const ROUNDING: f64 = 1e-6;

pub(crate) fn refuse_unfit(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { spec, plan, levels, .. } = study;
    references(study)?;
    if !spec.methods.iter().all(|method| matches!(method, MethodSpec::Fem { .. })) {
        for (level, place) in plan.refine.levels.iter().zip(levels) {
            fits(&place.size, &plan.scene, *level)?;
        }
    }
    refuse_unusable_steps(study)
}

fn fits(path: &SuitePath<'_>, scene: &Scene, level: LevelPlan) -> Result<(), Diagnostic> {
    if let Some((what, amount)) = level.too_large(scene) {
        let cells = level.cells;
        let message = format!("with {cells} cells along the first axis, {amount:.1e} {what}");
        return path.expected(&format!("at most {MOST_POINTS:e} {what}"), &message);
    }
    vacant(path, scene, level)?;
    held_faces(path, scene, level.cells)?;
    sets(path, scene, level)
}

fn vacant(path: &SuitePath<'_>, scene: &Scene, level: LevelPlan) -> Result<(), Diagnostic> {
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, scene.dimension()));
    if !per_axis.is_some_and(|n| is_vacant(scene, level.h, n)) {
        return Ok(());
    }
    let cells = level.cells;
    let message =
        format!("with {cells} cells along the first axis the body is smaller than a particle");
    let label = "expected cells small enough that the body contains a particle";
    Err(path.diagnostic(&message).with_label(label))
}

/// Refuses a grid without nodes on a fixed high face, because the condition applies to nodes, and a
/// periodic grid whose length is not the stated period.
pub(crate) fn held_faces(
    path: &SuitePath<'_>,
    scene: &Scene,
    cells: u64,
) -> Result<(), Diagnostic> {
    let h = cell_size(scene, cells);
    for face in scene.faces.iter().filter(|face| !face.hold.is_free() && face.high) {
        let (origin, along) = grid_axis(scene, face.axis, h);
        let end = origin + along * h;
        let body = match &scene.grid {
            Some((_, to)) if face.hold.is_periodic() => to[face.axis],
            _ => scene.to[face.axis],
        };
        if (end - body).abs() > ROUNDING * h {
            let (name, verb, h, end) = (face.name, face.hold.kind().verb, shown(h), shown(end));
            let message = format!(
                "with {cells} cells along the first axis the {name} face, which {verb}, is at {}, \
                 but the nearest nodes are at {end}",
                shown(body)
            );
            let label = format!("expected a cell size that divides the length, not {h} m");
            return Err(path.diagnostic(&message).with_label(&label));
        }
    }
    Ok(())
}

fn sets(path: &SuitePath<'_>, scene: &Scene, level: LevelPlan) -> Result<(), Diagnostic> {
    let cells = level.cells;
    let per_axis = level.ppc.and_then(|ppc| per_axis(ppc, scene.dimension()));
    for set in &scene.sets {
        // Particle centres are at from + length (i + 1/2)/count, see `Particles::fill`.
        let some = |axis: usize| {
            let (from, length) = (scene.from[axis], scene.to[axis] - scene.from[axis]);
            let count = libm::round(level.particles_along(scene, axis)).max(1.0);
            let index = libm::ceil((set.from[axis] - from) / length * count - 0.5).max(0.0);
            from + length * (index.min(count - 1.0) + 0.5) / count <= set.to[axis]
        };
        let inside = |x0: &[f64], _| set.holds(x0);
        let is_held = match (&scene.outline, per_axis) {
            (Some(_), Some(n)) if scene.mapped.is_none() => {
                any_particle(scene, scene, level.h, n, inside)
            }
            _ => (0..scene.dimension()).all(some),
        };
        if !is_held {
            let name = &set.name;
            let message = format!(
                "with {cells} cells along the first axis the set `{name}` contains no particle"
            );
            return path.expected("more cells", &message);
        }
    }
    Ok(())
}

fn references(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, plan, .. } = study;
    let fits_into_memory = |path: &SuitePath<'_>, count: f64, text: &str, what: &str| {
        if count * plan.instants as f64 <= MOST_POINTS {
            return Ok(());
        }
        let message = format!("{text} {what} at {} instants are too many to store", plan.instants);
        let label = format!("expected at most {MOST_POINTS:e} {what} times instants");
        Err(path.diagnostic(&message).with_label(&label))
    };
    let top = evaluator.top("reference");
    if let Some(fine) = &plan.reference {
        let path = top.then("fem").then("cells");
        fits_into_memory(&path, fine.cells as f64, &fine.cells.to_string(), "elements")?;
    }
    if let Some(SameMethod::FineGrid(level)) = plan.same_method {
        let path = top.then("same_method").then("cells");
        fits(&path, &plan.scene, level)?;
        let particles = level.particles(&plan.scene);
        fits_into_memory(&path, particles, &format!("{particles:.1e}"), "particles")?;
    }
    Ok(())
}

/// A stated time step (s), and the actual steps computed from it.
#[derive(Clone, Copy)]
struct StatedStep {
    dt: f64,
    clock: Clock,
}

/// Checks the time steps of all levels and of the reference. Refined steps must decrease. Steps
/// that are compared with a computed reference must end at its instants, up to [`STEP_TOLERANCE`].
fn refuse_unusable_steps(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let CompiledStudy { evaluator, plan, levels, .. } = study;
    for case in &plan.cases {
        let mut coarser: Option<StatedStep> = None;
        for (level, place) in plan.refine.levels.iter().zip(levels) {
            let clock = case.clock(plan, level.dt);
            let clock = usable(&place.dt, clock, level.cells, level.dt)?;
            let step = StatedStep { dt: level.dt, clock };
            if plan.refine.axis == Axis::Time || plan.refine.steps.len() > 1 {
                if let Some(coarser) = coarser {
                    finer(&place.dt, coarser, step)?;
                }
                coarser = Some(step);
            }
            if case.against.is_computed() && plan.refine.rule.is_none() {
                as_wanted(&place.dt, case, step)?;
            }
        }
        if let Some(fine) = case.against.fine_grid() {
            let path = evaluator.top("reference.same_method.cells");
            let clock = usable(&path, case.clock(plan, fine.dt), fine.cells, fine.dt)?;
            if plan.refine.rule.is_none() {
                as_wanted(&path, case, StatedStep { dt: fine.dt, clock })?;
            }
        }
        if let Some(fine) = &plan.reference {
            let path = evaluator.top("reference.fem.dt");
            let dt = fine.dt.eval(&[cell_size(&plan.scene, fine.cells)]);
            let clock = plan.clock(Against::Reference, case.until, dt);
            usable(&path, clock, fine.cells, dt)?;
        }
    }
    Ok(())
}

fn usable(
    path: &SuitePath<'_>,
    clock: Option<Clock>,
    cells: u64,
    dt: f64,
) -> Result<Clock, Diagnostic> {
    clock.ok_or_else(|| {
        let message = format!("with {cells} cells the time step is {}", shown(dt));
        let label = "expected a positive step, and at most 1e9 of them";
        path.diagnostic(&message).with_label(label)
    })
}

/// Refuses a level whose stated or rounded time step is not smaller than on the previous level.
fn finer(path: &SuitePath<'_>, coarse: StatedStep, fine: StatedStep) -> Result<(), Diagnostic> {
    let (wide, narrow) = (shown(coarse.dt), shown(fine.dt));
    if !(fine.dt < coarse.dt) {
        let message = format!("a level with dt = {narrow} after one with {wide}");
        return Err(path.diagnostic(&message).with_label(COARSE_TO_FINE));
    }
    if fine.clock.steps > coarse.clock.steps {
        return Ok(());
    }
    let message = format!("dt = {narrow} and {wide} both become {} s", shown(fine.clock.dt()));
    let label = format!("both runs take {} steps", fine.clock.steps);
    Err(path.diagnostic(&message).with_label(&label))
}

/// Refuses instants that change the time step of `case` by more than [`STEP_TOLERANCE`].
fn as_wanted(path: &SuitePath<'_>, case: &Case, step: StatedStep) -> Result<(), Diagnostic> {
    let StatedStep { dt: wanted, clock } = step;
    let is_near = |clock: &Clock| (clock.dt() / wanted - 1.0).abs() <= STEP_TOLERANCE;
    if is_near(&clock) {
        return Ok(());
    }
    let (dt, instants) = (shown(clock.dt()), clock.instants);
    let message = format!(
        "dt = {} is changed to {dt} s, so that steps end at {instants} instants",
        shown(wanted)
    );
    let label = "expected a step that divides the time between instants to 1 %";
    let fewer = (1..instants).rev().find(|instants| {
        Clock::with_common_instants(case.until, wanted, *instants).is_some_and(|c| is_near(&c))
    });
    let help = fewer.map_or_else(
        || format!("no step near this length divides a run until {} s", shown(case.until)),
        |fewer| format!("`instants: {fewer}` keeps this step"),
    );
    Err(path.diagnostic(&message).with_label(label).with_help(&help))
}
