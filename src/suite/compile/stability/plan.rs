//! A stability study, checked before anything runs.

use super::{expect, recipe::setting};
use crate::{
    mpm::{MaterialPlan, combine},
    suite::{
        compile::{
            evaluator::Binder,
            expect::cases::{assign, because},
            path::Path,
            run::methods::methods,
            truth::law,
            wording::{shown, suggestion},
        },
        grammar::{EquationName, MethodWords, StabilityWords},
        model::{
            method::Method,
            stability::{Recipe, StabilityCase, StabilityPlan},
        },
        yaml::{Complaint, Source},
    },
};

/// Most rows and most cases of a study.
const MOST: usize = 500;

/// Checks a stability study.
pub(crate) fn plan(
    binder: &Binder<'_>,
    source: &Source,
    words: &StabilityWords,
) -> Result<StabilityPlan, Complaint> {
    let recipe = Recipe { source: source.clone(), words: words.clone() };
    // What the suite says before anything is swept: the use of every parameter is noted here.
    let base = setting(binder, words)?;
    let (swept, values) = sweep(binder, words)?;
    let sought = sought(binder, words, &swept)?;
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
    let drafts = drafts(binder, words, &material)?;
    let cases = cases(binder, &recipe, words, drafts, (&swept, &values, sought.is_some()))?;
    let mut figures = words.show.clone();
    for entry in &words.expect {
        for figure in expect::named(binder, &Path::top("expect"), entry)? {
            if !figures.contains(&figure) {
                figures.push(figure);
            }
        }
    }
    let frozen = words.run.frozen;
    Ok(StabilityPlan { recipe, swept, values, sought, frozen, figures, cases })
}

/// The parameter that is swept, and its values.
fn sweep(binder: &Binder<'_>, words: &StabilityWords) -> Result<(String, Vec<f64>), Complaint> {
    let path = Path::top("sweep");
    let [(name, list)] = words.sweep.as_slice() else {
        let complaint = binder.complain(&path, "one parameter is swept at a time");
        return Err(complaint.with_label("expected a parameter and its values"));
    };
    let path = path.then(name.as_str());
    declared(binder, &path, words, name)?;
    let values = list
        .as_slice()
        .iter()
        .enumerate()
        .map(|(i, text)| binder.number(&binder.alternative(&path, i), text))
        .collect::<Result<Vec<f64>, _>>()?;
    if values.len() > MOST {
        let message = format!("{} values of one parameter", values.len());
        let complaint = binder.complain(&path, &message);
        return Err(complaint.with_label(&format!("expected at most {MOST}")));
    }
    Ok((name.clone(), values))
}

/// Only what the suite declares can be swept or sought.
fn declared(
    binder: &Binder<'_>,
    path: &Path,
    words: &StabilityWords,
    name: &str,
) -> Result<(), Complaint> {
    if words.parameters.get(name).is_some() {
        return Ok(());
    }
    let known: Vec<&str> =
        words.parameters.as_slice().iter().map(|(name, _)| name.as_str()).collect();
    let complaint = binder.complain(path, &format!("`{name}` is not a parameter of this suite"));
    Err(complaint.with_help(&suggestion("parameters", name, &known)))
}

/// The parameter whose limit is sought, and the range.
fn sought(
    binder: &Binder<'_>,
    words: &StabilityWords,
    swept: &str,
) -> Result<Option<(String, f64, f64)>, Complaint> {
    let Some(critical) = &words.critical else { return Ok(None) };
    let path = Path::top("critical");
    declared(binder, &path.then("parameter"), words, &critical.parameter)?;
    if critical.parameter == swept {
        let message = format!("`{swept}` is swept, and its limit sought");
        return Err(binder.complain(&path.then("parameter"), &message));
    }
    let from = binder.positive(&path.then("from"), &critical.from, "the start of the range")?;
    let to = binder.positive(&path.then("to"), &critical.to, "the end of the range")?;
    if from < to {
        return Ok(Some((critical.parameter.clone(), from, to)));
    }
    let message = format!("the range ends at {} and starts at {}", shown(to), shown(from));
    Err(binder.complain(&path.then("to"), &message).with_label("expected a larger number"))
}

/// The product of the lists of `methods`.
fn drafts(
    binder: &Binder<'_>,
    words: &StabilityWords,
    material: &MaterialPlan,
) -> Result<Vec<(String, Method)>, Complaint> {
    let own = law::own(material).unwrap_or(EquationName::SmallStrain);
    let mut drafts: Vec<(String, Method)> = Vec::new();
    for (i, words) in words.methods.iter().enumerate() {
        let path = Path::top("methods").then(i);
        if matches!(words, MethodWords::Fem { .. }) {
            return Err(binder.complain(&path, "stability is studied of MPM only"));
        }
        for (name, method) in methods(words, own) {
            if let Method::Mpm { basis, transfer, mass, frame, .. } = method {
                combine(basis, transfer, mass, frame).map_err(|reason| {
                    let help = "give what goes together an entry of `methods` of its own";
                    binder.complain(&path, &reason).with_help(help)
                })?;
            }
            if drafts.len() == MOST || drafts.iter().any(|(known, _)| *known == name) {
                let message = if drafts.len() == MOST {
                    format!("more than {MOST} cases")
                } else {
                    format!("the case `{name}` appears twice")
                };
                return Err(binder.complain(&path, &message));
            }
            drafts.push((name, method));
        }
    }
    if drafts.is_empty() {
        let path = Path::top("methods");
        return Err(binder.complain(&path, "a suite without methods has no case"));
    }
    Ok(drafts)
}

fn cases(
    binder: &Binder<'_>,
    recipe: &Recipe,
    words: &StabilityWords,
    drafts: Vec<(String, Method)>,
    (swept, values, seeks): (&str, &[f64], bool),
) -> Result<Vec<StabilityCase>, Complaint> {
    let names: Vec<&str> = drafts.iter().map(|(name, _)| name.as_str()).collect();
    let selectors: Vec<_> = words.expect.iter().map(|words| words.case.as_ref()).collect();
    let owners = assign(binder, &selectors, &names)?;
    let rows: Vec<Vec<(&str, f64)>> = values.iter().map(|value| vec![(swept, *value)]).collect();
    let expected = words
        .expect
        .iter()
        .enumerate()
        .map(|(i, words)| {
            let path = Path::top("expect").then(i);
            Ok((
                expect::rows((binder, recipe), words, i, &rows, seeks)?,
                because(binder, &path, &words.because)?,
            ))
        })
        .collect::<Result<Vec<_>, Complaint>>()?;
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
