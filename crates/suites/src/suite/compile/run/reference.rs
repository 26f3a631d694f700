//! Compiles `reference`: a fine FEM computation, or a finer run by the same method.

use super::RunPlan;
use super::refine::{STEP_OF_EACH_H, step_formula};
use crate::suite::compile::study::StudyDraft;
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::ReferenceSpec;
use crate::suite::model::refine_plan::{FINE_GRID, LevelPlan};
use crate::suite::model::{ReferencePlan, SameMethod};
use crate::suite::scene::cell_size;
use crate::suite::yaml::{Diagnostic, NumberText};
use crate::verify::{Axis, Clock};

pub(crate) fn references(
    draft: &StudyDraft<'_>,
    run: &RunPlan<'_>,
) -> Result<(Option<ReferencePlan>, Option<SameMethod>), Diagnostic> {
    let Some(stated) = &draft.spec.reference else { return Ok((None, None)) };
    Ok((fem(draft, stated)?, same_method(draft, stated, run)?))
}

fn fem(draft: &StudyDraft<'_>, spec: &ReferenceSpec) -> Result<Option<ReferencePlan>, Diagnostic> {
    let (path, dimension) = (draft.evaluator.top("reference"), draft.scene.dimension());
    let (equation, fem) = match (spec.equation, &spec.fem) {
        (Some(equation), Some(fem)) => (equation, fem),
        (None, None) if spec.same_method.is_some() => return Ok(None),
        _ => {
            let message = "a reference needs `equation` and `fem`, or `same_method`";
            return Err(path.diagnostic_at_key(message));
        }
    };
    if dimension != 1 {
        let message = format!("the built-in FEM is 1-D, but the scene is {dimension}-D");
        return path.refuse_key(&message, "give this scene an `exact` solution");
    }
    let path = path.then("fem");
    Ok(Some(ReferencePlan {
        equation,
        element: fem.element,
        mass: fem.mass,
        cells: path.then("cells").count(&fem.cells, "the number of elements")?,
        dt: path.then("dt").formula(&fem.dt, &["h"])?,
    }))
}

/// Minimum ratio of the finest level's time step to that of the reference. With a method of second
/// order, the reference has 1/64 of the error.
const SHORTER: f64 = 8.0;

fn same_method(
    draft: &StudyDraft<'_>,
    stated: &ReferenceSpec,
    RunPlan { until, refine, instants, .. }: &RunPlan<'_>,
) -> Result<Option<SameMethod>, Diagnostic> {
    let (Some(same), Some(finest)) = (&stated.same_method, refine.levels.last()) else {
        return Ok(None);
    };
    let path = draft.evaluator.top("reference.same_method");
    let refused = |message, help| path.refuse_key(message, help);
    match (&same.dt, &same.cells) {
        (Some(_), None) if refine.axis != Axis::Time => {
            let message =
                "`same_method` with shorter steps measures only the error of the time step";
            refused(message, "list time steps under `dt` in `refine`, or use a fine grid (`cells`)")
        }
        (None, Some(_)) if refine.axis != Axis::Space => {
            let message = "`same_method` on a fine grid measures only the error of the cell size";
            refused(message, "list `cells` in `refine`, or use shorter steps (`dt`)")
        }
        (Some(dt), None) => {
            let dt = shorter(&path.then("dt"), dt, *finest, until, *instants)?;
            Ok(Some(SameMethod::ShorterSteps(dt)))
        }
        (None, Some(cells)) => {
            one_lattice(&path, draft)?;
            let path = path.then("cells");
            let cells = path.count(cells, "the number of cells")?;
            let level = LevelPlan { cells, ..*finest };
            let level = with_step(&path, draft, level)?;
            finer(&path, *finest, level)?;
            Ok(Some(SameMethod::FineGrid(level)))
        }
        _ => {
            let message =
                "`same_method` needs either shorter steps (`dt`) or a fine grid (`cells`)";
            refused(message, "state one of them")
        }
    }
}

/// Returns the time step of the reference run (s). Refuses a step that is too long.
fn shorter(
    path: &SuitePath<'_>,
    dt: &NumberText,
    finest: LevelPlan,
    until: &[(String, f64)],
    instants: u64,
) -> Result<f64, Diagnostic> {
    let dt = path.formula(dt, &["h"])?.eval(&[finest.h]);
    for (_, until) in until {
        let clock = |dt| {
            Clock::with_common_instants(*until, dt, instants)
                .map_or(0.0, |clock| clock.steps as f64)
        };
        if !(clock(dt) >= SHORTER * clock(finest.dt)) {
            let message = format!(
                "the time step is {}, but the finest level already has {}",
                shown(dt),
                shown(finest.dt)
            );
            let label = format!("expected at most 1/{SHORTER} of that, and at most 1e9 steps");
            return Err(path.diagnostic(&message).with_label(&label));
        }
    }
    Ok(dt)
}

/// Refuses a fine grid with fewer than [`FINE_GRID`] times the cells of the finest level, because
/// its error is not negligible.
fn finer(path: &SuitePath<'_>, finest: LevelPlan, fine: LevelPlan) -> Result<(), Diagnostic> {
    if fine.cells >= finest.cells.saturating_mul(FINE_GRID) {
        return Ok(());
    }
    let message = format!(
        "the fine grid has {} cells, but the finest level already has {}",
        fine.cells, finest.cells
    );
    let label = format!("expected at least {FINE_GRID} times as many");
    Err(path.diagnostic(&message).with_label(&label))
}

fn with_step(
    path: &SuitePath<'_>,
    StudyDraft { spec, scene, .. }: &StudyDraft<'_>,
    level: LevelPlan,
) -> Result<LevelPlan, Diagnostic> {
    if spec.run.load_steps.is_some() {
        return Ok(LevelPlan { h: cell_size(scene, level.cells), ..level });
    }
    let Some(stated) = &spec.run.dt else {
        let message = "`refine` lists a time step for each level, but none for the fine grid";
        return path.refuse(message, STEP_OF_EACH_H);
    };
    let at_run = path.evaluator.top("run.dt");
    let text = step_formula(&at_run, stated, scene)?;
    let h = cell_size(scene, level.cells);
    let dt = at_run.formula(&text, &["h"])?.eval(&[h]);
    Ok(LevelPlan { h, dt, ..level })
}

fn one_lattice(path: &SuitePath<'_>, draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { spec, scene, .. } = draft;
    let body = match &scene.outline {
        _ if !scene.bodies.is_empty() => "several bodies",
        Some(_) if scene.mapped.is_some() => return Ok(()),
        Some(outline) => &format!("a body of kind `{}`", outline.kind()),
        None if spec.particles.is_some() => "moved `particles`",
        None => return Ok(()),
    };
    let message = format!(
        "a fine grid is interpolated between regular particles of a single box, but the scene has \
         {body}"
    );
    path.refuse_key(&message, "give this scene an `exact` solution")
}
