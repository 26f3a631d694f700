//! Compiles the expectations for the rows of a stability study.

use super::setup::SetupTemplate;
use crate::suite::evaluator::{SuitePath, suggestion};
use crate::suite::grammar::{FigureSpec, StabilityExpectSpec};
use crate::suite::yaml::{Diagnostic, NumberText};
use crate::verify::{FigureBounds, RunFigure, StabilityExpectation, format_number};

pub(crate) fn named(
    path: &SuitePath<'_>,
    spec: &StabilityExpectSpec,
) -> Result<Vec<RunFigure>, Diagnostic> {
    let find = |(name, _): &(String, FigureSpec)| {
        RunFigure::by_name(name).ok_or_else(|| {
            let known: Vec<&str> = RunFigure::ALL.iter().map(|figure| figure.name()).collect();
            let at = path.then("figures").then(name.as_str());
            at.diagnostic_at_key(&format!("unknown figure `{name}`"))
                .with_help(&suggestion("figures", name, &known))
        })
    };
    spec.figures.as_slice().iter().map(find).collect()
}

pub(crate) fn rows(
    path: &SuitePath<'_>,
    template: &SetupTemplate,
    i: usize,
    rows: &[Vec<(&str, f64)>],
) -> Result<Vec<StabilityExpectation>, Diagnostic> {
    let spec = &template.spec.expect[i];
    let figures = named(path, spec)?;
    refuse_idle(path, spec, template.spec.critical.is_some())?;
    if let Some(verdicts) = spec.verdict.as_ref().filter(|list| list.as_slice().len() > 1) {
        let (got, needed) = (verdicts.as_slice().len(), rows.len());
        if got != needed {
            let message = format!("{got} verdicts for {needed} rows");
            return path.then("verdict").expected("one for all, or one for each", &message);
        }
    }
    // This evaluation, with the parameter values of the suite, also marks the parameters as used.
    row(path, spec, &figures, 0)?;
    rows.iter()
        .enumerate()
        .map(|(k, values)| {
            row(&template.evaluator(values)?.top("expect").then(i), spec, &figures, k)
        })
        .collect()
}

fn row(
    path: &SuitePath<'_>,
    spec: &StabilityExpectSpec,
    figures: &[RunFigure],
    k: usize,
) -> Result<StabilityExpectation, Diagnostic> {
    let verdict = spec.verdict.as_ref().and_then(|list| {
        let list = list.as_slice();
        list.get(k).or_else(|| list.first().filter(|_| list.len() == 1)).copied()
    });
    let critical = spec.critical.as_ref().map(|spec| wanted(&path.then("critical"), spec));
    let entries = figures.iter().zip(spec.figures.as_slice());
    let figures = entries.map(|(figure, (name, spec))| {
        Ok((*figure, wanted(&path.then("figures").then(name.as_str()), spec)?))
    });
    Ok(StabilityExpectation {
        verdict,
        critical: critical.transpose()?,
        figures: figures.collect::<Result<_, Diagnostic>>()?,
    })
}

fn refuse_idle(
    path: &SuitePath<'_>,
    spec: &StabilityExpectSpec,
    seeks: bool,
) -> Result<(), Diagnostic> {
    let help = "with `critical` the result of each row is a limit, without it that of a single run";
    if seeks && spec.verdict.is_some() {
        let message = "`verdict` is not supported with `critical`: no row is a single run";
        return path.then("verdict").refuse_key(message, help);
    }
    if seeks && !spec.figures.as_slice().is_empty() {
        let message = "`figures` is not supported with `critical`: no row is a single run";
        return path.then("figures").refuse_key(message, help);
    }
    if !seeks && spec.critical.is_some() {
        let message = "a limit is expected, but the suite has no `critical`";
        return path.then("critical").refuse_key(message, help);
    }
    let nothing = spec.verdict.is_none() && spec.figures.as_slice().is_empty();
    if !seeks && nothing {
        return path.expected("`verdict` or `figures`", "this expectation is empty");
    }
    Ok(())
}

fn wanted(path: &SuitePath<'_>, spec: &FigureSpec) -> Result<FigureBounds, Diagnostic> {
    let number = |key: &str, text: &Option<_>| {
        text.as_ref().map(|text| path.then(key).number(text)).transpose()
    };
    let (above, below) = (number("above", &spec.above)?, number("below", &spec.below)?);
    let is = match (number("is", &spec.is)?, number("within", &spec.within)?) {
        (Some(value), Some(within)) if within >= 0.0 => Some((value, within)),
        (None, None) => None,
        _ => {
            let message = "a closed form needs its value, `is`, and a relative tolerance, `within`";
            return path.expected("both", message);
        }
    };
    if is.is_none() && above.is_none() && below.is_none() {
        return path.expected("`is` and `within`, `above` or `below`", "this figure has no bound");
    }
    Ok(FigureBounds { is, above, below })
}

pub(crate) fn summary(
    spec: &StabilityExpectSpec,
    expected: &[StabilityExpectation],
    rows: &[Vec<(&str, f64)>],
    predicted: bool,
) -> String {
    let mut parts = Vec::new();
    if let Some(verdicts) = &spec.verdict {
        let names: Vec<&str> = verdicts.as_slice().iter().map(|verdict| verdict.words()).collect();
        parts.push(names.join(", "));
    }
    if predicted {
        parts.push("predictions confirmed by runs".to_owned());
    }
    if let Some(critical) = &spec.critical {
        let bounds: Vec<FigureBounds> = expected.iter().filter_map(|row| row.critical).collect();
        parts.push(format!("the limit {}", bounds_text(critical, &bounds, rows)));
    }
    let figures = spec.figures.as_slice().iter().enumerate();
    parts.extend(figures.map(|(k, (name, spec))| {
        let of_row = |row: &StabilityExpectation| row.figures.get(k).map(|(_, bounds)| *bounds);
        let bounds: Vec<FigureBounds> = expected.iter().filter_map(of_row).collect();
        let known = RunFigure::by_name(name);
        let head = known.map_or(name.as_str(), |figure| figure.head());
        format!("{head} {}", bounds_text(spec, &bounds, rows))
    }));
    parts.join("; ")
}

fn bounds_text(spec: &FigureSpec, bounds: &[FigureBounds], rows: &[Vec<(&str, f64)>]) -> String {
    let text = |text: &NumberText, value: fn(&FigureBounds) -> Option<f64>| {
        let values: Vec<f64> = bounds.iter().filter_map(value).collect();
        with_values(&text.to_string(), &values, rows)
    };
    let mut parts = Vec::new();
    if let (Some(is), Some(within)) = (&spec.is, &spec.within) {
        let is = text(is, |bounds| Some(bounds.is?.0));
        let within = text(within, |bounds| Some(bounds.is?.1));
        // The tolerance applies to each of several values.
        let each = if is.contains(" for ") { ", each" } else { "" };
        parts.push(format!("{is}{each} within {within}"));
    }
    let above = spec.above.as_ref().map(|least| text(least, |bounds| bounds.above));
    let below = spec.below.as_ref().map(|most| text(most, |bounds| bounds.below));
    parts.extend(above.map(|least| format!("at least {least}")));
    parts.extend(below.map(|most| format!("at most {most}")));
    parts.join(", ")
}

/// Maximum number of rows for which the values of a formula are written out.
const MOST_VALUES: usize = 3;

fn with_values(formula: &str, values: &[f64], rows: &[Vec<(&str, f64)>]) -> String {
    if formula.parse::<f64>().is_ok() || values.len() != rows.len() {
        return formula.to_owned();
    }
    let shown: Vec<String> = values.iter().map(|value| format_number(*value)).collect();
    match &shown[..] {
        [first, others @ ..] if others.iter().all(|other| other == first) => {
            format!("{formula} = {first}")
        }
        _ if rows.len() <= MOST_VALUES => {
            let of_row = |(value, row): (&String, &Vec<(&str, f64)>)| {
                let swept: Vec<String> =
                    row.iter().map(|(name, swept)| format!("{name} = {swept}")).collect();
                format!("{value} for {}", swept.join(" and "))
            };
            shown.iter().zip(rows).map(of_row).collect::<Vec<_>>().join(", ")
        }
        _ => formula.to_owned(),
    }
}
