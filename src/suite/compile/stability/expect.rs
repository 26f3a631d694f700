//! What is expected of the rows of a stability study, from words.

use crate::{
    suite::{
        compile::{evaluator::Evaluator, path::Path, wording::suggestion},
        grammar::{FigureSpec, StabilityExpectSpec},
        model::stability::Recipe,
        yaml::Diagnostic,
    },
    verify::{RunFigure, StabilityExpectation, Wanted},
};

/// The figures that an entry of `expect` speaks of.
pub(crate) fn named(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StabilityExpectSpec,
) -> Result<Vec<RunFigure>, Diagnostic> {
    let find = |(name, _): &(String, FigureSpec)| {
        RunFigure::ALL.iter().copied().find(|figure| figure.name() == name).ok_or_else(|| {
            let known: Vec<&str> = RunFigure::ALL.iter().map(|figure| figure.name()).collect();
            let at = path.then("figures").then(name.as_str());
            evaluator
                .diagnostic_at_key(&at, &format!("unknown figure `{name}`"))
                .with_help(&suggestion("figures", name, &known))
        })
    };
    words.figures.as_slice().iter().map(find).collect()
}

/// What entry number `i` of `expect` expects of every row, whose values are `rows`.
pub(crate) fn rows(
    (evaluator, recipe): (&Evaluator<'_>, &Recipe),
    words: &StabilityExpectSpec,
    i: usize,
    rows: &[Vec<(&str, f64)>],
    seeks: bool,
) -> Result<Vec<StabilityExpectation>, Diagnostic> {
    let path = Path::top("expect").then(i);
    let figures = named(evaluator, &path, words)?;
    refuse_idle(evaluator, &path, words, seeks)?;
    if let Some(verdicts) = words.verdict.as_ref().filter(|list| list.as_slice().len() > 1) {
        let (got, needed) = (verdicts.as_slice().len(), rows.len());
        if got != needed {
            let message = format!("{got} verdicts for {needed} rows");
            let diagnostic = evaluator.diagnostic(&path.then("verdict"), &message);
            return Err(diagnostic.with_label("expected one for all, or one for each"));
        }
    }
    // What the suite itself says comes first: it is there that the use of parameters is noted.
    row(evaluator, &path, words, &figures, 0)?;
    rows.iter()
        .enumerate()
        .map(|(k, values)| row(&recipe.evaluator(values)?, &path, words, &figures, k))
        .collect()
}

fn row(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StabilityExpectSpec,
    figures: &[RunFigure],
    k: usize,
) -> Result<StabilityExpectation, Diagnostic> {
    let verdict = words.verdict.as_ref().and_then(|list| {
        let list = list.as_slice();
        list.get(k).or_else(|| list.first().filter(|_| list.len() == 1)).copied()
    });
    let critical =
        words.critical.as_ref().map(|words| wanted(evaluator, &path.then("critical"), words));
    let entries = figures.iter().zip(words.figures.as_slice());
    let figures = entries.map(|(figure, (name, words))| {
        Ok((*figure, wanted(evaluator, &path.then("figures").then(name.as_str()), words)?))
    });
    Ok(StabilityExpectation {
        verdict,
        critical: critical.transpose()?,
        figures: figures.collect::<Result<_, Diagnostic>>()?,
    })
}

/// Refuses to expect a limit that is not sought, or the outcome of a run that is not made.
fn refuse_idle(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &StabilityExpectSpec,
    seeks: bool,
) -> Result<(), Diagnostic> {
    let help = "a suite with `critical` has a limit for each row, one without it a run";
    if seeks && words.verdict.is_some() {
        let message = "a limit is sought, and no row has a single run";
        return Err(evaluator.diagnostic_at_key(&path.then("verdict"), message).with_help(help));
    }
    if seeks && !words.figures.as_slice().is_empty() {
        let message = "a limit is sought, and no row has the figures of a single run";
        return Err(evaluator.diagnostic_at_key(&path.then("figures"), message).with_help(help));
    }
    if !seeks && words.critical.is_some() {
        let message = "no limit is sought";
        return Err(evaluator.diagnostic_at_key(&path.then("critical"), message).with_help(help));
    }
    let nothing = words.verdict.is_none() && words.figures.as_slice().is_empty();
    if !seeks && nothing {
        let message = "nothing is expected of the runs of this case";
        return Err(evaluator
            .diagnostic(path, message)
            .with_label("expected `verdict` or `figures`"));
    }
    Ok(())
}

fn wanted(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &FigureSpec,
) -> Result<Wanted, Diagnostic> {
    let number = |key: &str, text: &Option<_>| {
        text.as_ref().map(|text| evaluator.number(&path.then(key), text)).transpose()
    };
    let (above, below) = (number("above", &words.above)?, number("below", &words.below)?);
    let is = match (number("is", &words.is)?, number("within", &words.within)?) {
        (Some(value), Some(within)) if within >= 0.0 => Some((value, within)),
        (None, None) => None,
        _ => {
            let message = "a closed form is given by `is` and held `within` a share of it";
            return Err(evaluator.diagnostic(path, message).with_label("expected both"));
        }
    };
    if is.is_none() && above.is_none() && below.is_none() {
        let diagnostic = evaluator.diagnostic(path, "nothing is said of this figure");
        return Err(diagnostic.with_label("expected `is` and `within`, `above` or `below`"));
    }
    Ok(Wanted { is, above, below })
}

/// What an entry expects, in one line.
pub(crate) fn summary(words: &StabilityExpectSpec, predicted: bool) -> String {
    let mut parts = Vec::new();
    if let Some(verdicts) = &words.verdict {
        let names: Vec<&str> = verdicts.as_slice().iter().map(|verdict| verdict.words()).collect();
        parts.push(names.join(", "));
    }
    if predicted {
        parts.push("predictions confirmed by runs".to_owned());
    }
    if let Some(critical) = &words.critical {
        parts.push(format!("the limit {}", in_words(critical)));
    }
    let figures = words.figures.as_slice().iter();
    parts.extend(figures.map(|(name, words)| {
        let known = RunFigure::ALL.iter().find(|figure| figure.name() == name);
        format!("{} {}", known.map_or(name.as_str(), |figure| figure.head()), in_words(words))
    }));
    parts.join("; ")
}

fn in_words(words: &FigureSpec) -> String {
    let mut parts = Vec::new();
    if let (Some(is), Some(within)) = (&words.is, &words.within) {
        parts.push(format!("{is} within {within}"));
    }
    parts.extend(words.above.as_ref().map(|least| format!("at least {least}")));
    parts.extend(words.below.as_ref().map(|most| format!("at most {most}")));
    parts.join(", ")
}
