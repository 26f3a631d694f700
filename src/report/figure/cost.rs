//! Work-precision diagrams of a ranking.

use super::series::coincident;
use super::{Figure, LogLogPlot, Mark, PlotPoint, PlotSeries};
use crate::report::names::together;
use crate::verify::{Ranked, Ranking, Sample, SuiteOutcome, pareto_front};

/// Maximum number of lines with a separate colour and name that a reader can distinguish.
const MOST_NAMED: usize = 7;

/// Creates a diagram of each ranking; `work` is an axis label, `unit` part of file names.
pub fn cost_figures(
    outcome: &SuiteOutcome,
    rankings: &[Ranking],
    work: &str,
    unit: &str,
) -> Vec<Figure> {
    let SuiteOutcome { suite, title, cases, .. } = outcome;
    // Rankings may contain variants of the cases. Variants are styled after all cases.
    let rows = rankings.iter().flat_map(|ranking| &ranking.rows);
    let mut methods: Vec<&str> = cases.iter().map(|case| case.case.as_str()).collect();
    for row in rows {
        if !methods.contains(&row.method.name.as_str()) {
            methods.push(&row.method.name);
        }
    }
    let figure = |(i, ranking): (usize, &Ranking)| {
        let number = if rankings.len() > 1 { format!("-{}", i + 1) } else { String::new() };
        let title = match rankings.len() {
            1 => title.to_owned(),
            _ => format!("{title}, {}", ranking.problem),
        };
        let plot = diagram(ranking, title, work, &methods);
        let file = format!("{suite}-work-{unit}{number}.svg");
        Figure { file, svg: plot.to_svg(), pgfplots: plot.to_pgfplots() }
    };
    rankings.iter().enumerate().map(figure).collect()
}

fn diagram(ranking: &Ranking, title: String, work: &str, methods: &[&str]) -> LogLogPlot {
    let series = |row: &'_ Ranked| PlotSeries {
        name: String::new(),
        look: methods.iter().position(|method| *method == row.method.name).unwrap_or(0),
        points: row.method.samples.iter().enumerate().map(|one| point(row, one)).collect(),
    };
    let mut named = coincident(ranking.rows.iter().map(|row| (row, series(row))));
    // Methods on the Pareto front come first; the others follow by rank.
    named.sort_by_key(|(rows, _)| rows[0].front.is_empty());
    for (rows, series) in &mut named {
        let names: Vec<&str> = rows.iter().map(|row| row.method.name.as_str()).collect();
        series.name = together(&names);
    }
    let mut series: Vec<PlotSeries> = named.into_iter().map(|(_, series)| series).collect();
    let others = series.split_off(series.len().min(MOST_NAMED));
    let every: Vec<Sample> =
        ranking.rows.iter().flat_map(|row| row.method.samples.iter().copied()).collect();
    let front = pareto_front(&every).into_iter().map(|k| (every[k].work, every[k].error));
    LogLogPlot {
        title,
        x_label: work.to_owned(),
        y_label: "error / size of the solution".to_owned(),
        series,
        others,
        front: front.collect(),
        ..LogLogPlot::default()
    }
}

/// Returns a point. Only levels in the converging part belong to the asymptotic window.
fn point(row: &Ranked, (level, one): (usize, &Sample)) -> PlotPoint {
    let mark = if one.failed {
        Mark::Failed
    } else if !one.usable {
        Mark::Crossing
    } else if one.asymptotic && row.part.levels.contains(&level) {
        Mark::Window
    } else {
        Mark::OutsideWindow
    };
    PlotPoint { x: one.work, error: one.error, mark }
}
