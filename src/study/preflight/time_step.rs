//! Time steps beyond the stable one, and steps that do not follow the cells.

use super::subject::Preflight;
use crate::study::convergence::judge_plan::in_time;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::yaml::locate::Path;
use crate::suite::yaml::{Diagnostic, Severity};
use crate::verify::Axis;

/// Warns of a step in which a wave, or a particle, crosses more than a cell, or in which heat does
/// not flow stably, and notes one that is the same on every level of a study of space.
pub(crate) fn check(preflight: &Preflight<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    found.extend(too_long(preflight));
    found.extend(too_long_for_heat(preflight));
    found.extend(fixed(preflight));
    found
}

/// A rule is a share of the stable time step.
fn too_long(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let plan = preflight.plan;
    let moves = plan.cases.iter().any(|case| matches!(case.method, Method::Mpm { .. }));
    if let Some(share) = plan.refine.rule {
        let message = format!("the time step is {share} times the stable time step");
        let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
        return (share > 1.0).then(|| found.with_label("expected a share of at most 1"));
    }
    if !moves {
        return None;
    }
    let waves = plan.scene.fastest_wave();
    let speed = preflight.extremes.as_ref().map_or(0.0, |motion| motion.speed);
    let courant = |level: &LevelPlan| level.dt * (waves + speed) / level.h;
    let level = preflight.levels().iter().find(|level| courant(level) > 1.0)?;
    let (cells, courant) = (level.cells, courant(level));
    let message = format!(
        "with {cells} cells the time step is {courant:.2} times what a wave takes to cross a cell"
    );
    let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
    let help = "`dt: {courant: 0.5}` takes half of the stable time step on every level";
    Some(found.with_label("expected a stable step").with_help(help))
}

/// Forward Euler on lumped linear elements is stable up to h^2 rho c/(2 k) (Hughes 2000, section
/// 8.2).
fn too_long_for_heat(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let scene = &preflight.plan.scene;
    let heat = scene.heat()?;
    let diffusivity = heat.conductivity / (scene.density.largest() * heat.capacity);
    let limit = |level: &LevelPlan| 0.5 * level.h * level.h / diffusivity;
    let level = preflight.levels().iter().find(|level| level.dt > limit(level))?;
    let (cells, limit, times) = (level.cells, limit(level), level.dt / limit(level));
    let message = format!(
        "with {cells} cells the time step is {times:.2} times the stable one of heat, {limit:.2e} s"
    );
    let found = preflight.finding(Severity::Warning, &steps(preflight), &message);
    let help = "steps of heat are stable up to about h^2*density*capacity/(2*conductivity)";
    Some(found.with_label("expected a stable step").with_help(help))
}

fn fixed(preflight: &Preflight<'_>) -> Option<Diagnostic> {
    let refine = &preflight.plan.refine;
    let levels = preflight.levels();
    let (first, last) = (levels.first()?, levels.last()?);
    let same = first.dt.total_cmp(&last.dt).is_eq() && first.h > last.h;
    if refine.axis != Axis::Space || refine.rule.is_some() || !same {
        return None;
    }
    let case = preflight.of_an_order().find(|case| matches!(case.method, Method::Mpm { .. }))?;
    let order = in_time(case.method, preflight.plan.exact.as_ref());
    let message = format!(
        "the time step is the same on every level: its error, of order {order}, stays while that of \
         the cells falls"
    );
    let found = preflight.finding(Severity::Note, &steps(preflight), &message);
    Some(found.with_help("a formula of h, or `{courant: 0.5}`, refines both together"))
}

fn steps(preflight: &Preflight<'_>) -> Path {
    if preflight.plan.refine.steps.len() > 1 {
        Path::top("refine").then("dt")
    } else {
        Path::top("run").then("dt")
    }
}
