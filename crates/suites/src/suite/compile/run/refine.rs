//! Compiles the refinement plan. The refined key is the one with a list of values.

use crate::exact::formula::Formula;
use crate::suite::compile::study::{LevelPaths, StudyDraft};
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::{MethodSpec, RefineSpec, StepSpec};
use crate::suite::model::Scene;
use crate::suite::model::refine_plan::{LevelPlan, RefinePlan};
use crate::suite::scene::{cell_size, per_axis};
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany};
use crate::verify::Axis;

pub(crate) const COARSE_TO_FINE: &str = "expected levels from coarse to fine";

struct Located<'a, T> {
    value: T,
    at: SuitePath<'a>,
}

pub(crate) fn plan<'a>(
    draft: &StudyDraft<'a>,
) -> Result<(RefinePlan, Vec<LevelPaths<'a>>), Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let axis = axis(evaluator, &spec.refine)?;
    let idle = spec.expect.iter().position(|entry| entry.full.is_some());
    if let (Some(i), None) = (idle, &spec.refine.full) {
        let message = "this expectation needs a full run, but `refine` has no `full`";
        let diagnostic = evaluator.top("expect").then(i).then("full").diagnostic_at_key(message);
        return Err(diagnostic.with_help("list the levels of a full run under `full` in `refine`"));
    }
    let d = scene.dimension();
    let cells = counts(&listed(draft, Axis::Space, axis), "cells")?;
    let ppc = counts(&listed(draft, Axis::Particles, axis), "particles per cell")?;
    for entry in &ppc {
        equally_spaced(entry, d)?;
    }
    let at_run = evaluator.top("run.dt");
    let rule = spec.run.dt.as_ref().map(|spec| stable_share(&at_run, spec));
    let rule = rule.transpose()?.flatten();
    if rule.is_some() {
        refuse_methods_without_rule(draft)?;
    }
    let stated = spec.run.dt.as_ref();
    let stated = stated.map(|spec| step_formula(&at_run, spec, scene));
    let dt = steps(draft, axis, stated.transpose()?.as_ref())?;
    let count = cells.len().max(ppc.len()).max(dt.len());
    let level = |k: usize| {
        let cells = of_level(&cells, k)?.value;
        let h = cell_size(scene, cells);
        let dt = of_level(&dt, k)?.value.eval(&[h]);
        Some(LevelPlan { cells, h, dt, ppc: of_level(&ppc, k).map(|entry| entry.value) })
    };
    let place = |k: usize| {
        let size = if axis == Axis::Particles { &ppc } else { &cells };
        Some(LevelPaths { size: of_level(size, k)?.at.clone(), dt: of_level(&dt, k)?.at.clone() })
    };
    let plan = RefinePlan {
        axis,
        levels: (0..count).filter_map(level).collect(),
        usual: count - spec.refine.full.as_ref().map_or(0, |full| full.as_slice().len()),
        steps: dt.iter().map(|entry| entry.value.source().to_owned()).collect(),
        rule,
    };
    Ok((plan, (0..count).filter_map(place).collect()))
}

fn of_level<'s, 'a, T>(entries: &'s [Located<'a, T>], k: usize) -> Option<&'s Located<'a, T>> {
    entries.get(k).or_else(|| entries.first().filter(|_| entries.len() == 1))
}

fn is_list(spec: Option<&OneOrMany<NumberText>>) -> bool {
    spec.is_some_and(|list| list.as_slice().len() > 1)
}

/// Returns the refined axis. At most one key is a list, except for `cells` with `dt`.
fn axis(evaluator: &Evaluator<'_>, spec: &RefineSpec) -> Result<Axis, Diagnostic> {
    let path = evaluator.top("refine");
    let [cells, dt, ppc] = [Some(&spec.cells), spec.dt.as_ref(), spec.ppc.as_ref()].map(is_list);
    if ppc && (cells || dt) {
        let diagnostic =
            path.then("ppc").diagnostic("`ppc` is refined together with `cells` or `dt`");
        let help = "to refine `ppc`, state one number of cells and one `dt`";
        return Err(diagnostic.with_help(help));
    }
    let lengths = [Some(&spec.cells), spec.dt.as_ref()]
        .map(|list| list.map_or(0, |list| list.as_slice().len()));
    if cells && dt && lengths[0] != lengths[1] {
        let message = format!("{} time steps for {} levels of cells", lengths[1], lengths[0]);
        let diagnostic = path.then("dt").diagnostic(&message);
        return Err(diagnostic.with_label("expected one for each").with_help(STEP_OF_EACH_H));
    }
    if let (true, Some(_)) = (cells && dt, &spec.full) {
        let message = "`full` is one list, so it cannot refine both cells and time steps";
        return path.then("full").refuse_key(message, STEP_OF_EACH_H);
    }
    Ok(match (dt && !cells, ppc) {
        (true, _) => Axis::Time,
        (_, true) => Axis::Particles,
        _ => Axis::Space,
    })
}

pub(crate) const STEP_OF_EACH_H: &str = "or give the time step in `run`, as a formula of h";

/// Returns the entries of a key of `refine`. If the key is refined, the entries of `full` follow.
fn listed<'a>(
    draft: &StudyDraft<'a>,
    key: Axis,
    refined: Axis,
) -> Vec<Located<'a, &'a NumberText>> {
    let (evaluator, refine) = (draft.evaluator, &draft.spec.refine);
    let (name, list) = match key {
        Axis::Space => ("cells", Some(&refine.cells)),
        Axis::Time => ("dt", refine.dt.as_ref()),
        Axis::Particles => ("ppc", refine.ppc.as_ref()),
    };
    let further = refine.full.as_ref().filter(|_| key == refined);
    let entries = |name: &str, list: &'a OneOrMany<NumberText>| {
        let path = evaluator.top("refine").then(name);
        let texts = list.as_slice().iter().enumerate();
        texts.map(|(i, value)| Located { value, at: path.alternative(list, i) }).collect::<Vec<_>>()
    };
    let mut all = list.map_or_else(Vec::new, |list| entries(name, list));
    all.extend(further.into_iter().flat_map(|list| entries("full", list)));
    all
}

fn counts<'a>(
    texts: &[Located<'a, &NumberText>],
    what: &str,
) -> Result<Vec<Located<'a, u64>>, Diagnostic> {
    let mut counts: Vec<Located<'a, u64>> = Vec::new();
    for Located { value, at } in texts {
        let count = at.count(value, &format!("the number of {what}"))?;
        if counts.iter().any(|known| known.value == count) {
            let message = format!("a level with {count} {what} appears twice");
            return Err(at.diagnostic(&message).with_label("the second time"));
        }
        if let Some(coarser) = counts.last().filter(|coarser| coarser.value > count) {
            let message = format!("a level with {count} {what} after one with {}", coarser.value);
            return Err(at.diagnostic(&message).with_label(COARSE_TO_FINE));
        }
        counts.push(Located { value: count, at: at.clone() });
    }
    Ok(counts)
}

fn equally_spaced(ppc: &Located<'_, u64>, dimension: usize) -> Result<(), Diagnostic> {
    if per_axis(ppc.value, dimension).is_some() {
        return Ok(());
    }
    let message = format!("{} particles per cell cannot be equally spaced", ppc.value);
    let label = format!("expected n^{dimension} in {dimension}-D");
    Err(ppc.at.diagnostic(&message).with_label(&label))
}

fn steps<'a>(
    draft: &StudyDraft<'a>,
    axis: Axis,
    stated: Option<&NumberText>,
) -> Result<Vec<Located<'a, Formula>>, Diagnostic> {
    let StudyDraft { evaluator, spec, .. } = draft;
    let at_run = evaluator.top("run.dt");
    let at_refine = evaluator.top("refine.dt");
    if spec.run.load_steps.is_some() {
        // For load steps, the length of a step is one.
        let value = at_run.formula(&NumberText::Number(1.0), &["h"])?;
        return Ok(vec![Located { value, at: evaluator.top("run.load_steps") }]);
    }
    let texts = match (stated, &spec.refine.dt) {
        (Some(_), Some(_)) => {
            return at_refine
                .refuse_key("the time step is already stated in `run`", "keep one of them");
        }
        (None, None) => {
            let diagnostic = evaluator.top("run").diagnostic_at_key("a run needs a time step");
            return Err(diagnostic.with_help("add `dt`, or a list of them to `refine`"));
        }
        (None, Some(list)) if list.as_slice().len() == 1 => {
            let diagnostic = at_refine.diagnostic_at_key("a single time step refines nothing");
            return Err(diagnostic.with_help("move it to `run`, or list several"));
        }
        (Some(value), None) => vec![Located { value, at: at_run }],
        (None, Some(_)) => listed(draft, Axis::Time, axis),
    };
    let bind = |Located { value, at }: Located<'a, &NumberText>| {
        Ok(Located { value: at.formula(value, &["h"])?, at })
    };
    texts.into_iter().map(bind).collect()
}

const AUTO: f64 = 0.5;

/// Returns the share of the stable time step, if the step of `spec` at `path` is automatic.
pub(crate) fn stable_share(
    path: &SuitePath<'_>,
    spec: &StepSpec,
) -> Result<Option<f64>, Diagnostic> {
    match spec {
        StepSpec::Length(_) => Ok(None),
        StepSpec::Auto => Ok(Some(AUTO)),
        StepSpec::Courant(text) => {
            path.then("courant").positive(text, "the share of the stable step").map(Some)
        }
    }
}

/// Returns the time step (s) as a formula of h, which is preliminary for an automatic step.
pub(crate) fn step_formula(
    path: &SuitePath<'_>,
    spec: &StepSpec,
    scene: &Scene,
) -> Result<NumberText, Diagnostic> {
    let share = match (spec, stable_share(path, spec)?) {
        (StepSpec::Length(text), _) => return Ok(text.clone()),
        (_, share) => share.unwrap_or(AUTO),
    };
    let speed = scene.fastest_wave();
    if speed > 0.0 && speed.is_finite() {
        let [share, speed] = [share, speed].map(NumberText::Number);
        return Ok(NumberText::Formula(format!("{share}*h/{speed}")));
    }
    path.expected("a number", "an automatic time step needs a wave speed, but this body has none")
}

fn refuse_methods_without_rule(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let steps = |method: &MethodSpec| {
        matches!(method, MethodSpec::Mpm { .. } | MethodSpec::External { .. })
    };
    let other = draft.spec.methods.iter().position(|method| !steps(method));
    let Some(i) = other else { return Ok(()) };
    draft.evaluator.top("methods").then(i).refuse(
        "an automatic time step is available for MPM only",
        "state `dt` as a number or a formula of h, or move this method to a separate suite",
    )
}
