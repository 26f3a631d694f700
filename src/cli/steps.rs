//! `mpm-verify steps`: the time step of every level, asked for and taken.

use super::args::StepsArgs;
use super::show;
use super::status::{FAILED, PASSED};
use mpm_verify::study::{TimeStep, time_steps};
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::STEP_TOLERANCE;
use serde_json::{Value, json};
use std::cell::Cell;

/// Prints the steps of each suite. The status says whether all are within the tolerance.
pub(super) fn steps(args: &StepsArgs) -> u8 {
    let extent = if args.full { Extent::Full } else { Extent::Usual };
    let is_off = Cell::new(false);
    let of_suite = |suite: &Suite| {
        let steps = time_steps(suite, extent);
        is_off.set(is_off.get() || steps.iter().any(beyond));
        steps
    };
    let targets = &args.targets.targets;
    let code = if args.format.is_json() {
        show::json(targets, |_, suite| {
            let levels: Vec<Value> = of_suite(suite).iter().map(level).collect();
            Ok(json!({"suite": suite.name, "levels": levels}))
        })
    } else {
        show::each(targets, |suite| {
            let rows: String = of_suite(suite).iter().map(row).collect();
            format!("{}\n{rows}", suite.name)
        })
    };
    if code == PASSED && is_off.get() { FAILED } else { code }
}

fn beyond(step: &TimeStep) -> bool {
    !((step.ratio() - 1.0).abs() <= STEP_TOLERANCE)
}

fn row(step: &TimeStep) -> String {
    let TimeStep { case, level, wanted, clock } = step;
    let cells = level.cells;
    let note = if beyond(step) { "  off by more than 1 %" } else { "" };
    format!(
        "  {case}, {cells} cells: {} steps of {:.4e} s, {:.4} of {wanted:.4e} s, {} instants{note}\n",
        clock.steps,
        clock.dt(),
        step.ratio(),
        clock.instants,
    )
}

fn level(step: &TimeStep) -> Value {
    let TimeStep { case, level, wanted, clock } = step;
    json!({
        "case": case, "cells": level.cells, "steps": clock.steps, "dt": clock.dt(),
        "wanted": wanted, "ratio": step.ratio(), "instants": clock.instants, "off": beyond(step),
    })
}
