//! Compiles a stability study: a parameter is swept, and every run gets a verdict.

pub(crate) mod expect;
pub(crate) mod setup;

use crate::mpm::input::MpmMethod;
use crate::mpm::{combine, combine_across, combine_volume};
use crate::suite::compile::expect::assign;
use crate::suite::compile::run::methods::{NamedMethod, methods};
use crate::suite::evaluator::{Evaluator, SuitePath, shown, suggestion};
use crate::suite::grammar::{MethodSpec, StabilityExpectSpec, StabilitySpec};
use crate::suite::model::Scene;
use crate::suite::model::method::Method;
use crate::suite::model::stability::{CompileSetup, RowExpectations, StabilityCase, StabilityPlan};
use crate::suite::yaml::Diagnostic;
use setup::{SetupTemplate, setup};
use std::sync::Arc;

const MOST: usize = 500;

pub(crate) fn plan(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
) -> Result<StabilityPlan, Diagnostic> {
    let template = SetupTemplate { source: evaluator.source().clone(), spec: spec.clone() };
    // This evaluation, with the parameter values of the suite, also marks the parameters as used.
    let scene = setup(evaluator, spec)?.scene;
    let methods = time_stepping_methods(evaluator, &spec.methods, &scene)?;
    let (swept, values) = sweep(evaluator, spec)?;
    let sought = sought(evaluator, spec, &swept)?;
    // Each swept value must give a valid setup.
    for value in &values {
        let ends = sought.as_ref().map_or(vec![None], |(name, from, to)| {
            vec![Some((name.as_str(), *from)), Some((name.as_str(), *to))]
        });
        for end in ends {
            let mut with = vec![(swept.as_str(), *value)];
            with.extend(end);
            template.setup(&with)?;
        }
    }
    let rows: Vec<Vec<(&str, f64)>> = values.iter().map(|value| vec![(&*swept, *value)]).collect();
    let (of_cases, has_any) = split(evaluator, spec)?;
    let names: Vec<String> = methods.iter().map(NamedMethod::name).collect();
    let selectors: Vec<_> = of_cases.iter().map(|spec| spec.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let entries = (0..spec.expect.len()).map(|i| entry(evaluator, &template, i, &rows));
    let entries = entries.collect::<Result<Vec<RowExpectations>, Diagnostic>>()?;
    let case = |(named, owner): (NamedMethod, Option<usize>)| {
        let (name, method) = (named.name(), named.method);
        let expectations = owner.map(|owner| entries[owner].clone()).unwrap_or_default();
        StabilityCase { name, method, expectations, gating: None }
    };
    let cases = methods.into_iter().zip(owners).map(case).collect();
    let any_method = entries.last().filter(|_| has_any).cloned();
    let mut figures = spec.show.clone();
    for entry in &spec.expect {
        for figure in expect::named(&evaluator.top("expect"), entry)? {
            if !figures.contains(&figure) {
                figures.push(figure);
            }
        }
    }
    let frozen = spec.run.frozen;
    let setup = CompileSetup(Arc::new(move |values| template.setup(values)));
    Ok(StabilityPlan { setup, swept, values, sought, frozen, figures, cases, any_method })
}

fn sweep(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
) -> Result<(String, Vec<f64>), Diagnostic> {
    let path = evaluator.top("sweep");
    let [(name, list)] = spec.sweep.as_slice() else {
        return path
            .expected("one parameter with its values", "`sweep` must vary exactly one parameter");
    };
    let path = path.then(name.as_str());
    declared(&path, spec, name)?;
    let values = list
        .as_slice()
        .iter()
        .enumerate()
        .map(|(i, text)| path.alternative(list, i).number(text))
        .collect::<Result<Vec<f64>, _>>()?;
    if values.len() > MOST {
        let message = format!("{} values of one parameter", values.len());
        return path.expected(&format!("at most {MOST}"), &message);
    }
    Ok((name.clone(), values))
}

fn declared(path: &SuitePath<'_>, spec: &StabilitySpec, name: &str) -> Result<(), Diagnostic> {
    if spec.parameters.get(name).is_some() {
        return Ok(());
    }
    let known: Vec<&str> =
        spec.parameters.as_slice().iter().map(|(name, _)| name.as_str()).collect();
    let diagnostic = path.diagnostic(&format!("`{name}` is not a parameter of this suite"));
    Err(diagnostic.with_help(&suggestion("parameters", name, &known)))
}

fn sought(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    swept: &str,
) -> Result<Option<(String, f64, f64)>, Diagnostic> {
    let Some(critical) = &spec.critical else { return Ok(None) };
    let path = evaluator.top("critical");
    declared(&path.then("parameter"), spec, &critical.parameter)?;
    if critical.parameter == swept {
        let message = format!("`{swept}` cannot be the parameter of both `sweep` and `critical`");
        return Err(path.then("parameter").diagnostic(&message));
    }
    let from = path.then("from").positive(&critical.from, "the start of the range")?;
    let to = path.then("to").positive(&critical.to, "the end of the range")?;
    if from < to {
        return Ok(Some((critical.parameter.clone(), from, to)));
    }
    let message = format!("the range ends at {} and starts at {}", shown(to), shown(from));
    path.then("to").expected("a larger number", &message)
}

fn time_stepping_methods(
    evaluator: &Evaluator<'_>,
    specs: &[MethodSpec],
    scene: &Scene,
) -> Result<Vec<NamedMethod>, Diagnostic> {
    for (i, spec) in specs.iter().enumerate() {
        let path = evaluator.top("methods").then(i);
        if matches!(spec, MethodSpec::Fem { .. } | MethodSpec::External { .. }) {
            return Err(path.diagnostic("a stability study supports MPM only"));
        }
        if spec.is_quasi_static() {
            let message = "a stability study needs time steps, but `quasi_static` has none";
            return Err(path.then("mpm").then("scheme").diagnostic(message));
        }
    }
    let methods = methods(evaluator, specs, &scene.material, MOST, 1)?;
    let plane = scene.plane;
    for named in &methods {
        let path = named.path(evaluator);
        if named.method.is_single_precision() {
            let message = "a stability study needs double precision: small perturbations vanish \
                           in single precision";
            return Err(path.then("mpm").then("precision").diagnostic(message));
        }
        if let Method::Mpm(MpmMethod { basis, transfer, mass, frame, volume, .. }) = named.method {
            let across = |()| combine_across(plane, basis, transfer);
            let averaged = |()| {
                scene.each().iter().try_for_each(|body| {
                    let dimension = scene.dimension();
                    combine_volume(volume, frame, &body.material, dimension, plane)
                })
            };
            let known = combine(basis, transfer, mass, frame).and_then(across);
            known.and_then(averaged).map_err(|reason| {
                let help = "list compatible settings in separate entries of `methods`";
                path.diagnostic(&reason.to_string()).with_help(help)
            })?;
        }
    }
    Ok(methods)
}

fn entry(
    evaluator: &Evaluator<'_>,
    template: &SetupTemplate,
    i: usize,
    rows: &[Vec<(&str, f64)>],
) -> Result<RowExpectations, Diagnostic> {
    let (path, spec) = (evaluator.top("expect").then(i), &template.spec.expect[i]);
    let expected = expect::rows(&path, template, i, rows)?;
    let because = path.because("this expectation", &spec.because)?;
    let predicted = template.spec.critical.is_some() && template.spec.run.frozen;
    let summary = Some(expect::summary(spec, &expected, rows, predicted));
    Ok(RowExpectations { expected, summary, because })
}

/// Returns the entries of `expect` for cases, and whether an entry for external solvers follows.
fn split<'a>(
    evaluator: &Evaluator<'_>,
    spec: &'a StabilitySpec,
) -> Result<(&'a [StabilityExpectSpec], bool), Diagnostic> {
    let at = |i: usize, key: &str| evaluator.top("expect").then(i).then(key);
    let Some(first) = spec.expect.iter().position(|entry| entry.any_method) else {
        return Ok((&spec.expect, false));
    };
    if first + 1 < spec.expect.len() {
        let message = "only the last entry can have `any_method`";
        return Err(at(first, "any_method").diagnostic_at_key(message));
    }
    if spec.expect[first].case.is_some() {
        let message = "an entry with `any_method` applies to no case of the suite";
        return Err(at(first, "case").diagnostic_at_key(message));
    }
    Ok((&spec.expect[..first], true))
}
