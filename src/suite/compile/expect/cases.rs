//! Which expectation holds for which case: exactly one for each, or none for any.

use super::because::because;
use super::limits::limits;
use crate::suite::compile::check::subject_support;
use crate::suite::compile::interval::interval;
use crate::suite::evaluator::{Evaluator, suggestion};
use crate::suite::grammar::{CrossingsName, ExpectSpec};
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;
use crate::suite::pattern;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany, Path};
use crate::verify::{Expectation, OrderHypothesis, Verdict};
use std::str::FromStr;

/// Expectation of a case, and of a full run if that differs.
type CaseExpectation = (Expectation, Option<Expectation>);

/// One expectation for each of the `cases`, in their order; none for any where the suite states
/// nothing.
pub(crate) fn expectations(
    evaluator: &Evaluator<'_>,
    spec: &[ExpectSpec],
    plan: &ConvergencePlan,
    cases: &[(&str, Method)],
) -> Result<Vec<Option<CaseExpectation>>, Diagnostic> {
    let names: Vec<&str> = cases.iter().map(|(name, _)| *name).collect();
    let selectors: Vec<_> = spec.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let both = |(i, spec): (usize, &ExpectSpec)| {
        let path = Path::top("expect").then(i);
        Ok((expectation(evaluator, &path, spec, plan)?, in_full(evaluator, &path, spec, plan)?))
    };
    let parsed = spec.iter().enumerate().map(both).collect::<Result<Vec<CaseExpectation>, _>>()?;
    for (owner, (_, method)) in owners.iter().zip(cases) {
        let Some(owner) = *owner else { continue };
        let path = Path::top("expect").then(owner);
        subject_support::check_drift(evaluator, &path, &parsed[owner].0.limits, *method)?;
        if let Some(full) = &parsed[owner].1 {
            subject_support::check_drift(evaluator, &path.then("full"), &full.limits, *method)?;
        }
    }
    Ok(owners.into_iter().map(|owner| Some(parsed[owner?].clone())).collect())
}

/// For each case the one entry of `expect` that speaks of it; none for any where there is no entry.
pub(crate) fn assign(
    evaluator: &Evaluator<'_>,
    selectors: &[Option<&OneOrMany<String>>],
    names: &[&str],
) -> Result<Vec<Option<usize>>, Diagnostic> {
    if selectors.is_empty() {
        return Ok(vec![None; names.len()]);
    }
    let path = Path::top("expect");
    let speaks = |i: usize, name: &str| {
        selectors[i]
            .is_none_or(|globs| globs.as_slice().iter().any(|glob| pattern::fits(glob, name)))
    };
    for (i, selector) in selectors.iter().enumerate() {
        let Some(globs) = selector else { continue };
        let idle = |glob: &String| !names.iter().any(|name| pattern::fits(glob, name));
        if let Some(k) = globs.as_slice().iter().position(idle) {
            let at = path.then(i).then("case").alternative(globs, k);
            let message = format!("`{}` fits no case", globs.as_slice()[k]);
            let diagnostic = evaluator.diagnostic(&at, &message);
            return Err(diagnostic.with_help(&format!("cases: {}", names.join(", "))));
        }
    }
    let owner = |name: &&str| {
        let owners: Vec<usize> = (0..selectors.len()).filter(|i| speaks(*i, name)).collect();
        match owners[..] {
            [only] => Ok(Some(only)),
            [] => {
                let message = format!("nothing is expected of the case `{name}`");
                Err(evaluator.diagnostic_at_key(&path, &message))
            }
            [_, second, ..] => {
                let message = format!("a second expectation for the case `{name}`");
                Err(evaluator.diagnostic(&path.then(second), &message))
            }
        }
    };
    names.iter().map(owner).collect()
}

/// Expectation of a full run, where an entry states that it differs.
fn in_full(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Option<Expectation>, Diagnostic> {
    let Some(full) = &spec.full else { return Ok(None) };
    let path = path.then("full");
    for (key, given) in [("case", full.case.is_some()), ("full", full.full.is_some())] {
        if given {
            let message = format!("what is expected of a full run has no `{key}` of its own");
            return Err(evaluator
                .diagnostic_at_key(&path.then(key), &message)
                .with_help("remove it"));
        }
    }
    expectation(evaluator, &path, full, plan).map(Some)
}

fn expectation(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &ExpectSpec,
    plan: &ConvergencePlan,
) -> Result<Expectation, Diagnostic> {
    let limits = limits(evaluator, path, spec, plan)?;
    let verdict = match &spec.verdict {
        Some(word) => Some(verdict(evaluator, &path.then("verdict"), word)?),
        None if spec.order.is_some() => Some(Verdict::Converging),
        None if !limits.is_empty() => None,
        None => {
            let diagnostic = evaluator
                .diagnostic(path, "this expects neither an order nor a verdict nor a bound");
            let help = "add `order: [1.9, 2.1]`, `verdict: divergent` or `error_below: 1e-12`";
            return Err(diagnostic.with_help(help));
        }
    };
    let because = because(evaluator, path, "an expectation", &spec.because)?;
    let bounds = |key: &str, spec: &Option<Vec<NumberText>>| {
        spec.as_ref().map(|pair| interval(evaluator, &path.then(key), pair)).transpose()
    };
    let order = bounds("order", &spec.order)?;
    if let Some((low, high)) = order
        && let Some(reason) = OrderHypothesis::within(low, low, high).diagnostic()
    {
        let diagnostic = evaluator.diagnostic(&path.then("order"), &reason);
        return Err(diagnostic.with_label("expected positive orders, no more than 1 apart"));
    }
    Ok(Expectation {
        verdict,
        order,
        finest_pair: bounds("finest_pair", &spec.finest_pair)?,
        crossings: spec.crossings.map(|name| name == CrossingsName::Some),
        floor: spec.floor,
        limits,
        because,
    })
}

fn verdict(evaluator: &Evaluator<'_>, path: &Path, word: &str) -> Result<Verdict, Diagnostic> {
    Verdict::from_str(word).map_err(|_| {
        let known = Verdict::ALL.map(|verdict| verdict.name().replace([' ', '-'], "_"));
        let known = known.each_ref().map(String::as_str);
        let diagnostic = evaluator.diagnostic(path, &format!("`{word}` is not a verdict"));
        diagnostic.with_help(&suggestion("verdicts", word, &known))
    })
}
