//! `mpm-verify explain`: the problem, what a step of each case takes, and what is expected.

use super::args::ExplainArgs;
use super::status::BAD_INPUT;
use super::{output, show};
use mpm_verify::nearest;
use mpm_verify::report;
use mpm_verify::study;
use mpm_verify::study::describe::profiles::Dispensable;
use mpm_verify::suite::Suite;

/// Prints the page of each suite.
pub(super) fn explain(args: &ExplainArgs) -> u8 {
    let without = match args.without.as_deref().map(named).transpose() {
        Ok(without) => without,
        Err(message) => {
            output::complain(&message);
            return BAD_INPUT;
        }
    };
    show::each(&args.targets.targets, |suite| explanation(suite, without))
}

fn named(name: &str) -> Result<Dispensable, String> {
    if let Some(found) = Dispensable::all().find(|known| known.name() == name) {
        return Ok(found);
    }
    let known: Vec<&str> = Dispensable::all().map(Dispensable::name).collect();
    let hint = match nearest(name, known.iter().copied()) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("known effects: {}", known.join(", ")),
    };
    Err(format!("error: --without {name}: there is no such effect\nhelp: {hint}"))
}

fn explanation(suite: &Suite, without: Option<Dispensable>) -> String {
    let mut page = format!("{}: {}\n\n{}\n\n", suite.name, suite.title, suite.about.trim());
    page += &line("source", &suite.source);
    for (key, value) in study::statement(suite) {
        page += &line(&key, &value);
    }
    for (i, case) in suite.case_names().into_iter().enumerate() {
        page += &format!("\n{case}\n");
        page += &match suite.study.expectation(i) {
            Some((expected, because)) => format!("  expected: {expected}\n  because: {because}\n"),
            None => "  expected: nothing, so that the suite is no gate\n".to_owned(),
        };
        page += &taken(suite, case, without);
    }
    page + "\n"
}

fn line(key: &str, value: &str) -> String {
    format!("  {key:18}{value}\n")
}

/// Cost of a step of the case, and its difference without an effect.
fn taken(suite: &Suite, case: &str, without: Option<Dispensable>) -> String {
    let Some(all) = study::profile(suite, case, None) else { return String::new() };
    let mut page: String =
        report::profile(&all).iter().map(|(key, text)| line(key, text)).collect();
    let Some(effect) = without else { return page };
    page += &match study::profile(suite, case, Some(effect)) {
        _ if !all.effects.contains(&effect.name()) => {
            line("without", &format!("`{}` is not there, nothing changes", effect.name()))
        }
        None => line("without", &format!("`{}` the case does not run", effect.name())),
        Some(rest) => {
            let rows = report::difference(&all, &rest);
            let rows: String = rows.iter().map(|(key, text)| line(key, text)).collect();
            line("without", &format!("`{}` these lines change:", effect.name())) + &rows
        }
    };
    page
}
