//! A stability study, checked before anything runs.

use super::{expect, recipe::setting};
use crate::{
    mpm::{MaterialPlan, combine},
    suite::{
        compile::{
            evaluator::Evaluator,
            expect::cases::{assign, because},
            path::Path,
            run::methods::methods,
            truth::law,
            wording::{shown, suggestion},
        },
        grammar::{MethodSpec, StabilitySpec},
        model::{
            method::Method,
            stability::{Recipe, StabilityCase, StabilityPlan},
        },
        yaml::{Diagnostic, Source},
    },
};

/// Most rows and most cases of a study.
const MOST: usize = 500;

/// Checks a stability study.
pub(crate) fn plan(
    evaluator: &Evaluator<'_>,
    source: &Source,
    words: &StabilitySpec,
) -> Result<StabilityPlan, Diagnostic> {
    let recipe = Recipe { source: source.clone(), words: words.clone() };
    // What the suite says before anything is swept: the use of every parameter is noted here.
    let base = setting(evaluator, words)?;
    let (swept, values) = sweep(evaluator, words)?;
    let sought = sought(evaluator, words, &swept)?;
    let mut material = base.scene.material;
    for value in &values {
        let ends = sought.as_ref().map_or(vec![None], |(name, from, to)| {
            vec![Some((name.as_str(), *from)), Some((name.as_str(), *to))]
        });
        for end in ends {
            let mut with = vec![(swept.as_str(), *value)];
            with.extend(end);
            material = recipe.setting(&with)?.scene.material;
        }
    }
    let drafts = drafts(evaluator, words, &material)?;
    let cases = cases(evaluator, &recipe, words, drafts, (&swept, &values, sought.is_some()))?;
    let mut figures = words.show.clone();
    for entry in &words.expect {
        for figure in expect::named(evaluator, &Path::top("expect"), entry)? {
            if !figures.contains(&figure) {
                figures.push(figure);
            }
        }
    }
    let frozen = words.run.frozen;
    Ok(StabilityPlan { recipe, swept, values, sought, frozen, figures, cases })
}

/// The parameter that is swept, and its values.
fn sweep(
    evaluator: &Evaluator<'_>,
    words: &StabilitySpec,
) -> Result<(String, Vec<f64>), Diagnostic> {
    let path = Path::top("sweep");
    let [(name, list)] = words.sweep.as_slice() else {
        let diagnostic = evaluator.diagnostic(&path, "one parameter is swept at a time");
        return Err(diagnostic.with_label("expected a parameter and its values"));
    };
    let path = path.then(name.as_str());
    declared(evaluator, &path, words, name)?;
    let values = list
        .as_slice()
        .iter()
        .enumerate()
        .map(|(i, text)| evaluator.number(&evaluator.alternative(&path, i), text))
        .collect::<Result<Vec<f64>, _>>()?;
    if values.len() > MOST {
        let message = format!("{} values of one parameter", values.len());
        let diagnostic = evaluator.diagnostic(&path, &message);
        return Err(diagnostic.with_label(&format!("expected at most {MOST}")));
    }
    Ok((name.clone(), values))
}

/// Only what the suite declares can be swept or sought.
fn declared(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StabilitySpec,
    name: &str,
) -> Result<(), Diagnostic> {
    if words.parameters.get(name).is_some() {
        return Ok(());
    }
    let known: Vec<&str> =
        words.parameters.as_slice().iter().map(|(name, _)| name.as_str()).collect();
    let diagnostic =
        evaluator.diagnostic(path, &format!("`{name}` is not a parameter of this suite"));
    Err(diagnostic.with_help(&suggestion("parameters", name, &known)))
}

/// The parameter whose limit is sought, and the range.
fn sought(
    evaluator: &Evaluator<'_>,
    words: &StabilitySpec,
    swept: &str,
) -> Result<Option<(String, f64, f64)>, Diagnostic> {
    let Some(critical) = &words.critical else { return Ok(None) };
    let path = Path::top("critical");
    declared(evaluator, &path.then("parameter"), words, &critical.parameter)?;
    if critical.parameter == swept {
        let message = format!("`{swept}` is swept, and its limit sought");
        return Err(evaluator.diagnostic(&path.then("parameter"), &message));
    }
    let from = evaluator.positive(&path.then("from"), &critical.from, "the start of the range")?;
    let to = evaluator.positive(&path.then("to"), &critical.to, "the end of the range")?;
    if from < to {
        return Ok(Some((critical.parameter.clone(), from, to)));
    }
    let message = format!("the range ends at {} and starts at {}", shown(to), shown(from));
    Err(evaluator.diagnostic(&path.then("to"), &message).with_label("expected a larger number"))
}

/// The product of the lists of `methods`.
fn drafts(
    evaluator: &Evaluator<'_>,
    words: &StabilitySpec,
    material: &MaterialPlan,
) -> Result<Vec<(String, Method)>, Diagnostic> {
    let own = law::own(material).unwrap_or_default();
    let mut drafts: Vec<(String, Method)> = Vec::new();
    for (i, words) in words.methods.iter().enumerate() {
        let path = Path::top("methods").then(i);
        if matches!(words, MethodSpec::Fem { .. }) {
            return Err(evaluator.diagnostic(&path, "stability is studied of MPM only"));
        }
        for (name, method) in methods(words, own) {
            if let Method::Mpm { basis, transfer, mass, frame, .. } = method {
                combine(basis, transfer, mass, frame).map_err(|reason| {
                    let help = "give what goes together an entry of `methods` of its own";
                    evaluator.diagnostic(&path, &reason).with_help(help)
                })?;
            }
            if drafts.len() == MOST || drafts.iter().any(|(known, _)| *known == name) {
                let message = if drafts.len() == MOST {
                    format!("more than {MOST} cases")
                } else {
                    format!("the case `{name}` appears twice")
                };
                return Err(evaluator.diagnostic(&path, &message));
            }
            drafts.push((name, method));
        }
    }
    if drafts.is_empty() {
        let path = Path::top("methods");
        return Err(evaluator.diagnostic(&path, "a suite without methods has no case"));
    }
    Ok(drafts)
}

fn cases(
    evaluator: &Evaluator<'_>,
    recipe: &Recipe,
    words: &StabilitySpec,
    drafts: Vec<(String, Method)>,
    (swept, values, seeks): (&str, &[f64], bool),
) -> Result<Vec<StabilityCase>, Diagnostic> {
    let names: Vec<&str> = drafts.iter().map(|(name, _)| name.as_str()).collect();
    let selectors: Vec<_> = words.expect.iter().map(|words| words.case.as_ref()).collect();
    let owners = assign(evaluator, &selectors, &names)?;
    let rows: Vec<Vec<(&str, f64)>> = values.iter().map(|value| vec![(swept, *value)]).collect();
    let expected = words
        .expect
        .iter()
        .enumerate()
        .map(|(i, words)| {
            let path = Path::top("expect").then(i);
            Ok((
                expect::rows((evaluator, recipe), words, i, &rows, seeks)?,
                because(evaluator, &path, &words.because)?,
            ))
        })
        .collect::<Result<Vec<_>, Diagnostic>>()?;
    let predicted = seeks && words.run.frozen;
    let case = |((name, method), owner): ((String, Method), usize)| StabilityCase {
        name,
        method,
        expected: expected[owner].0.clone(),
        summary: expect::summary(&words.expect[owner], predicted),
        because: expected[owner].1.clone(),
    };
    Ok(drafts.into_iter().zip(owners).map(case).collect())
}
