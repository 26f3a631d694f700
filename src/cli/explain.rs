//! `mpm-verify explain`: prints the problem, the cost of a step of each case, and the expectations.

use super::arguments::{FormatArgs, Targets};
use super::output::{self, CommandError, Status};
use super::{select, show};
use clap::Args;
use mpm_verify::study::describe::Dispensable;
use mpm_verify::study::{self, Estimate, PlannedLevel, planned_levels};
use mpm_verify::suite::Suite;
use mpm_verify::verify::UnmetCode;
use mpm_verify::{nearest, report};
use serde_json::{Value, json};

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    #[command(flatten)]
    targets: Targets,
    /// Show what a step would save without this effect of the scene
    #[arg(long, value_name = "EFFECT")]
    without: Option<String>,
    #[command(flatten)]
    format: FormatArgs,
}

pub(super) fn explain(args: &ExplainArgs) -> Result<Status, CommandError> {
    let without = args.without.as_deref().map(named).transpose()?;
    if let [target] = &args.targets.targets[..]
        && let Some(code) = UnmetCode::ALL.iter().find(|code| target.as_os_str() == code.name())
    {
        let [meaning, remedy] = mpm_verify::suite::meaning(*code);
        output::print(&format!("{}{}", line(code.name(), meaning), line("what to do", remedy)));
        return Ok(Status::Passed);
    }
    let suites = select::with_sources(&args.targets.targets);
    if args.format.is_json() {
        return Ok(show::json(suites, |_, suite| Ok(explained(suite, without))));
    }
    let first = suites.iter().flatten().next().map(|(_, suite)| suite.name.clone());
    let status = show::each(suites, |suite| explanation(suite, without));
    if let Some(suite) = first {
        output::next([(&*format!("run {suite}"), "verdicts and report")]);
    }
    Ok(status)
}

fn named(name: &str) -> Result<Dispensable, CommandError> {
    if let Some(found) = Dispensable::all().find(|known| known.name() == name) {
        return Ok(found);
    }
    let known: Vec<&str> = Dispensable::all().map(Dispensable::name).collect();
    let hint = match nearest(name, known.iter().copied()) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("known effects: {}", known.join(", ")),
    };
    let reason = format!("there is no such effect\nhelp: {hint}");
    Err(CommandError::option("--without", name, reason))
}

/// Note on how the solver integrates the linear elastic law; the printed equation omits this.
const PLAIN_RATE: &str = "the solver integrates the plain rate, sigma' = C : D, without the spin terms of \
                          an objective rate";

fn explanation(suite: &Suite, without: Option<Dispensable>) -> String {
    let mut page = format!("{}: {}\n\n", suite.name, suite.title);
    let about = suite.about.trim();
    if !about.is_empty() {
        page += &format!("{about}\n\n");
    }
    page += &levels(suite);
    if let Some(cost) = study::estimate(suite) {
        let Estimate { particle_steps, seconds, bytes } = cost;
        let mb = bytes / 1e6;
        let text = format!(
            "{particle_steps:.0e} particle steps, about {seconds:.0e} s of one thread; {mb:.0e} MB"
        );
        page += &line("cost", &text);
    }
    page += &line("source", &suite.source);
    for (key, value) in study::statement(suite) {
        page += &line(&key, &value);
        if key.trim() == "material" && value.starts_with("linear elastic") {
            page += &line("", PLAIN_RATE);
        }
    }
    for (i, case) in suite.case_names().into_iter().enumerate() {
        page += &format!("\n{case}\n");
        page += &match suite.study.expectation(i) {
            Some((expected, because)) => {
                report::wrapped_row(9, "expected:", &expected)
                    + &report::wrapped_row(8, "because:", because)
            }
            None => "  expected: nothing, so the suite is not a gate\n".to_owned(),
        };
        page += &taken(suite, case, without);
    }
    page + "\n"
}

fn levels(suite: &Suite) -> String {
    let mut page = String::new();
    let planned = planned_levels(suite);
    let mut groups: Vec<(Vec<&str>, &[PlannedLevel])> = Vec::new();
    for (case, levels) in &planned {
        match groups.iter_mut().find(|(_, known)| known == levels) {
            Some((cases, _)) => cases.push(case),
            None => groups.push((vec![case], levels)),
        }
    }
    for (cases, levels) in &groups {
        let whose = if groups.len() == 1 { "all cases".to_owned() } else { cases.join(", ") };
        page += &line("levels", &whose);
        let by_load_steps = levels.iter().all(|level| level.courant.is_none());
        let time =
            if by_load_steps { "  load steps" } else { "     dt (s)    steps  Courant number" };
        page += &line("", &format!("  cells      h (m)  particles{time}"));
        for level in *levels {
            let PlannedLevel { cells, h, particles, dt, steps, courant } = level;
            let mut text = format!("{cells:>7} {h:>10.4e} {particles:>10.0} ");
            text += &match courant {
                Some(courant) => format!("{dt:>10.4e} {steps:>8} {courant:>8.4}"),
                None => format!("{steps:>11}"),
            };
            page += &line("", &text);
        }
    }
    page
}

fn explained(suite: &Suite, without: Option<Dispensable>) -> Value {
    let levels = |levels: &[PlannedLevel]| -> Value {
        let one = |level: &PlannedLevel| {
            let PlannedLevel { cells, h, particles, dt, steps, courant } = level;
            json!({"cells": cells, "h": h, "particles": particles, "dt": dt, "steps": steps,
                "courant": courant})
        };
        levels.iter().map(one).collect()
    };
    let planned = planned_levels(suite);
    let profile = |case: &str, without| {
        study::profile(suite, case, without).map(|profile| report::profile_json(&profile))
    };
    let cases = suite.case_names().into_iter().enumerate().map(|(i, case)| {
        let (expected, because) = suite.study.expectation(i).unzip();
        let planned = planned.iter().find(|(name, _)| *name == case);
        json!({
            "case": case,
            "expected": expected,
            "because": because,
            "levels": planned.map_or_else(|| json!([]), |(_, planned)| levels(planned)),
            "profile": profile(case, None),
            "without": without.and_then(|effect| profile(case, Some(effect))),
        })
    });
    let statement = study::statement(suite).into_iter();
    let cost = study::estimate(suite);
    json!({
        "suite": suite.name,
        "title": suite.title,
        "about": suite.about.trim(),
        "source": suite.source,
        "statement": statement.map(|(name, value)| json!([name, value])).collect::<Vec<_>>(),
        "seconds": cost.map(|cost| cost.seconds),
        "bytes": cost.map(|cost| cost.bytes),
        "cases": cases.collect::<Vec<_>>(),
    })
}

fn line(key: &str, value: &str) -> String {
    report::wrapped_row(17, key, value)
}

/// Describes the cost of a step, and what a step would save without the effect `without`.
fn taken(suite: &Suite, case: &str, without: Option<Dispensable>) -> String {
    let Some(all) = study::profile(suite, case, None) else { return String::new() };
    let mut page: String =
        report::profile(&all).iter().map(|(key, text)| line(key, text)).collect();
    let Some(effect) = without else { return page };
    page += &match study::profile(suite, case, Some(effect)) {
        _ if !all.effects.contains(&effect.name()) => {
            line("without", &format!("`{}` is not used, so nothing changes", effect.name()))
        }
        None => line("without", &format!("`{}` the case cannot run", effect.name())),
        Some(rest) => {
            let rows = report::difference(&all, &rest);
            let rows: String = rows.iter().map(|(key, text)| line(key, text)).collect();
            line("without", &format!("`{}` these lines change:", effect.name())) + &rows
        }
    };
    page
}
