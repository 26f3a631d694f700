//! Columns of a stability study.

use super::{Cell, TableColumn, json_object, number, scientific};
use crate::verify::{
    Critical, Prediction, RunFigure, StabilityLimit, StabilityRow, StabilityStudy, Trial,
};
use serde_json::{Value, json};

type RowColumn<'a> = TableColumn<'a, StabilityRow>;
type TrialColumn<'a> = TableColumn<'a, Trial>;

fn swept(study: &StabilityStudy) -> RowColumn<'_> {
    RowColumn::new(study.swept.as_str(), "value", "value of the swept parameter", |row| {
        Cell::new(row.value.to_string(), number(row.value))
    })
}

fn figure<'a>(figure: RunFigure) -> TrialColumn<'a> {
    TrialColumn::new(figure.head(), figure.name(), "measured value of the run", move |trial| {
        let value = figure.of(trial);
        let text = match figure {
            _ if value.is_nan() => "-".to_owned(),
            _ => scientific(value),
        };
        Cell::new(text, number(value))
    })
}

fn verdict<'a>() -> TrialColumn<'a> {
    TrialColumn::new("verdict", "verdict", "verdict of the run", |trial| {
        Cell::new(trial.verdict.words(), trial.verdict.name())
    })
    .flush_left()
}

fn steps<'a>() -> TrialColumn<'a> {
    TrialColumn::plain("steps", "steps", "steps taken", |trial| trial.steps)
}

pub(crate) fn trials(study: &StabilityStudy) -> Vec<RowColumn<'_>> {
    let figures = study.figures.iter().map(|one| figure(*one));
    let columns = [verdict(), steps()].into_iter().chain(figures);
    let columns = columns.map(|column| column.within(|row: &StabilityRow| row.trial.as_ref()));
    std::iter::once(swept(study)).chain(columns).collect()
}

/// Returns the columns of stability limits. `sought` is the name of the parameter that is limited.
pub(crate) fn limits<'a>(study: &'a StabilityStudy, sought: &str) -> Vec<RowColumn<'a>> {
    let mut columns = vec![
        swept(study),
        RowColumn::new(
            format!("predicted {sought}"),
            "predicted",
            "limit at which the spectral radius of a step exceeds one",
            |row| limit_cell(predicted(row).map(|prediction| prediction.limit)),
        ),
        RowColumn::text("critical eigenvalue", "eigenvalue that leaves the unit circle", |row| {
            predicted(row).and_then(|prediction| leaves(&prediction))
        }),
        RowColumn::new(
            format!("observed {sought}"),
            "observed",
            "limit by bisection of runs",
            |row| limit_cell(row.critical.as_ref().and_then(|critical| critical.observed)),
        ),
    ];
    columns.extend(confirmed(study, sought));
    columns
}

/// Returns one column for each fraction of the predicted limit at which a run checks it.
fn confirmed<'a>(study: &'a StabilityStudy, sought: &str) -> Vec<RowColumn<'a>> {
    let critical = study.rows.iter().filter_map(|row| row.critical.as_ref());
    let longest = critical.max_by_key(|critical| critical.confirmed.len());
    let shares = longest.into_iter().flat_map(|critical| &critical.confirmed).enumerate();
    let column = |(k, (share, _)): (usize, &(f64, Trial))| {
        let about = "verdict of a run at this fraction of the predicted limit";
        let heading = format!("runs at {share} times the predicted {sought}");
        RowColumn::text(heading, about, move |row| {
            let run = row.critical.as_ref().and_then(|critical| critical.confirmed.get(k));
            run.map(|(_, trial)| trial.verdict.words())
        })
    };
    shares.map(column).collect()
}

pub(crate) fn json_columns(study: &StabilityStudy) -> Vec<RowColumn<'_>> {
    let mut columns = limits(study, study.sought.as_deref().unwrap_or_default());
    columns.extend([
        RowColumn::json("run", "verdict and measured values, if no limit is sought", |row| {
            row.trial.as_ref().map(run)
        }),
        RowColumn::json("confirmed", "runs at fractions of the predicted limit", |row| {
            row.critical.as_ref().map(confirmations)
        }),
        RowColumn::json(
            "refused",
            "reason why there is neither a prediction nor an observation",
            |row| row.refused.as_ref().map(ToString::to_string),
        ),
    ]);
    columns
}

fn run(trial: &Trial) -> Value {
    let figures: Vec<_> = RunFigure::ALL.iter().map(|one| figure(*one)).collect();
    let columns = [
        verdict(),
        TrialColumn::json("why", "reason why the run stopped early", |trial| trial.why.clone()),
        TrialColumn::json("figures", "all measured values", |trial| json_object(&figures, trial)),
    ];
    json_object(&columns, trial)
}

fn confirmations(critical: &Critical) -> Value {
    let run = |(share, trial): &(f64, Trial)| {
        let mut run = json_object(&[verdict(), steps()], trial);
        run["share"] = number(*share);
        run
    };
    critical.confirmed.iter().map(run).collect()
}

pub(crate) fn limit_of(row: &StabilityRow) -> Option<StabilityLimit> {
    row.critical.as_ref().and_then(Critical::limit)
}

/// Formats a limit with four decimals. A limit outside the searched range is given as a bound.
pub(crate) fn limit_text(limit: StabilityLimit) -> String {
    match limit {
        StabilityLimit::At(value) => format!("{value:.4}"),
        StabilityLimit::Above(high) => format!("> {high}"),
        StabilityLimit::Below(low) => format!("< {low}"),
    }
}

fn limit_cell(limit: Option<StabilityLimit>) -> Cell {
    let json = |limit: StabilityLimit| match limit {
        StabilityLimit::At(value) => json!({"at": number(value)}),
        StabilityLimit::Above(high) => json!({"above": number(high)}),
        StabilityLimit::Below(low) => json!({"below": number(low)}),
    };
    Cell { json: limit.map_or(Value::Null, json), ..Cell::text(limit.map(limit_text)) }
}

fn predicted(row: &StabilityRow) -> Option<Prediction> {
    row.critical.as_ref().and_then(|critical| critical.predicted)
}

/// Formats the critical eigenvalue as real and imaginary part, or as one number on the real axis.
fn leaves(prediction: &Prediction) -> Option<String> {
    let (re, im) = prediction.leaves?;
    Some(if im == 0.0 { format!("{re:.2}") } else { format!("{re:.2} +- {im:.2} i") })
}
