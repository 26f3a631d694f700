//! `mpm-verify list` (groups, suites, cases) and `mpm-verify steps` (time steps of levels).

use super::arguments::{FormatArgs, Targets};
use super::output::{self, Status};
use super::{select, show};
use clap::Args;
use mpm_verify::report::counted;
use mpm_verify::study::{Estimate, TimeStep, estimates, time_steps};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::{STEP_TOLERANCE, StepKind};
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;

#[derive(Debug, Args)]
pub(super) struct ListArgs {
    #[command(flatten)]
    targets: Targets,
    /// Also print the cases of each suite
    #[arg(long)]
    cases: bool,
    #[command(flatten)]
    format: FormatArgs,
}

pub(super) fn list(args: &ListArgs) -> Status {
    let suites = select::unchecked(&args.targets.targets);
    if args.format.is_json() {
        return show::json(suites, |source, suite| Ok(listed(source, suite)));
    }
    let by_group = !args.cases && suites.len() > MOST_LISTED;
    let mut groups: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    let code = show::try_each(suites, |source, suite| {
        let cases = suite.case_names();
        let [suites, count] = groups.entry(Source::group_of(Path::new(source.name()))).or_default();
        *suites += 1;
        *count += cases.len();
        let title = format!("{}: {}\n", suite.name, suite.title);
        let is_long = title.chars().count() > WIDTH;
        let title = if is_long { title.replacen(": ", ":\n    ", 1) } else { title };
        Ok(match (by_group, args.cases) {
            (true, _) => String::new(),
            (_, true) => format!("{title}  {}\n", cases.join("\n  ")),
            _ => title,
        })
    });
    let sum = |k: usize| groups.values().map(|counts| counts[k]).sum();
    let total = format!("{}, {}\n", counted(sum(0), "suite"), counted(sum(1), "case"));
    match groups.keys().next() {
        None => {}
        Some(first) if by_group => {
            for (group, [suites, cases]) in &groups {
                output::print(&format!("{group:32} {suites:>3} suites {cases:>5} cases\n"));
            }
            output::print(&format!("{total}next: mpm-verify list {first}\n"));
        }
        Some(_) => output::print(&total),
    }
    code
}

/// Maximum width of a line (characters).
const WIDTH: usize = 100;

/// Maximum number of suites that are listed one by one.
const MOST_LISTED: usize = 35;

fn listed(source: &Source, suite: &Suite) -> Value {
    let names = suite.case_names().into_iter();
    let cases = names.zip(estimates(suite, Extent::Usual)).map(|(name, cost)| {
        let figure = |of: fn(Estimate) -> f64| cost.map(of);
        json!({
            "case": name,
            "seconds": figure(|cost| cost.seconds),
            "particle_steps": figure(|cost| cost.particle_steps),
            "bytes": figure(|cost| cost.bytes),
        })
    });
    let cases: Vec<Value> = cases.collect();
    json!({"suite": suite.name, "title": suite.title, "file": source.name(), "cases": cases})
}

#[derive(Debug, Args)]
pub(super) struct StepsArgs {
    #[command(flatten)]
    targets: Targets,
    /// Also print the finer levels that suites list under `full`
    #[arg(long)]
    full: bool,
    #[command(flatten)]
    format: FormatArgs,
}

/// Prints the time steps of each suite. The status is `Failed` if a step differs from the requested
/// step by more than [`STEP_TOLERANCE`].
pub(super) fn steps(args: &StepsArgs) -> Status {
    let extent = if args.full { Extent::Full } else { Extent::Usual };
    let (all, off) = (Cell::new(0), Cell::new(0));
    let of_suite = |suite: &Suite| {
        let steps = time_steps(suite, extent);
        all.set(all.get() + steps.len());
        off.set(off.get() + steps.iter().filter(|step| beyond(step)).count());
        steps
    };
    let suites = select::unchecked(&args.targets.targets);
    let code = if args.format.is_json() {
        show::json(suites, |_, suite| {
            let levels: Vec<Value> = of_suite(suite).iter().map(level).collect();
            Ok(json!({"suite": suite.name, "levels": levels}))
        })
    } else {
        show::each(suites, |suite| {
            let plan = suite.convergence();
            let by_load_steps = plan.is_some_and(|plan| plan.steps == StepKind::Load);
            let row = if by_load_steps { load_steps_row } else { row };
            let mut text = format!("{}\n", suite.name);
            for steps in of_suite(suite).chunk_by(|one, next| one.case == next.case) {
                text += &format!("  {}\n", steps[0].case);
                text.extend(steps.iter().map(row));
            }
            text
        })
    };
    let (all, off) = (all.get(), off.get());
    if all > 0 && !args.format.is_json() {
        let all = counted(all, "level");
        let tolerance = 100.0 * STEP_TOLERANCE;
        output::print(&format!(
            "{all}: {off} with a step that differs from the requested step by more than \
             {tolerance} %\n"
        ));
    }
    if code == Status::Passed && off > 0 { Status::Failed } else { code }
}

fn beyond(step: &TimeStep) -> bool {
    !((step.ratio() - 1.0).abs() <= STEP_TOLERANCE)
}

fn row(step: &TimeStep) -> String {
    let TimeStep { level, wanted, clock, .. } = step;
    let cells = level.cells;
    let note = if beyond(step) { "  off" } else { "" };
    format!(
        "    {cells} cells: {} steps of {:.4e} s, {:.4} x {wanted:.4e} s, {} instants{note}\n",
        clock.steps,
        clock.dt(),
        step.ratio(),
        clock.instants,
    )
}

fn load_steps_row(step: &TimeStep) -> String {
    let TimeStep { level, clock, .. } = step;
    format!("    {} cells: {} load steps\n", level.cells, clock.steps)
}

fn level(step: &TimeStep) -> Value {
    let TimeStep { case, level, wanted, clock } = step;
    json!({
        "case": case, "cells": level.cells, "steps": clock.steps, "dt": clock.dt(),
        "wanted": wanted, "ratio": step.ratio(), "instants": clock.instants, "off": beyond(step),
    })
}
