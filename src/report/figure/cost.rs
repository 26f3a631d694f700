//! Work-precision diagrams of a ranking.

use super::{Figure, LogLogPlot, Mark, PlotPoint, PlotSeries};
use crate::verify::{Ranked, Ranking, Sample, SuiteOutcome, pareto_front};
use std::ops::Range;

/// Maximum number of lines with a separate colour and name, because a reader cannot distinguish
/// more.
const MOST_NAMED: usize = 7;

/// Maximum relative difference between points of two methods that are drawn as one line.
const SAME: f64 = 0.02;

/// Creates a diagram for each ranking of a suite. `work` is the label of the horizontal axis;
/// `unit` is part of the file name.
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
    let mut groups: Vec<(&Ranked, usize)> = Vec::new();
    for row in &ranking.rows {
        match groups.iter_mut().find(|(first, _)| coincide(first, row)) {
            Some((_, more)) => *more += 1,
            None => groups.push((row, 0)),
        }
    }
    // Methods on the Pareto front come first; the others follow by rank.
    let mut named = groups;
    named.sort_by_key(|(row, _)| row.front.is_empty());
    let others = named.split_off(named.len().min(MOST_NAMED));
    let every: Vec<Sample> =
        ranking.rows.iter().flat_map(|row| row.method.samples.iter().copied()).collect();
    let front = pareto_front(&every).into_iter().map(|k| (every[k].work, every[k].error));
    let series = |(row, more): &(&Ranked, usize)| PlotSeries {
        name: match more {
            0 => row.method.name.clone(),
            more => format!("{} (and {more} alike)", row.method.name),
        },
        look: methods.iter().position(|method| *method == row.method.name).unwrap_or(0),
        points: points(row),
    };
    LogLogPlot {
        title,
        x_label: work.to_owned(),
        y_label: "error / size of the solution".to_owned(),
        series: named.iter().map(series).collect(),
        others: others.iter().map(series).collect(),
        front: front.collect(),
        ..LogLogPlot::default()
    }
}

fn coincide(a: &Ranked, b: &Ranked) -> bool {
    let (a, b) = (&a.method.samples, &b.method.samples);
    let near = |x: f64, y: f64| (x / y - 1.0).abs() <= SAME;
    // Levels that count for neither method may differ.
    let same = |(a, b): (&Sample, &Sample)| {
        let counts = a.counts() || b.counts();
        !counts || (near(a.work, b.work) && near(a.error, b.error))
    };
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// Returns the points of the levels. Only levels in the converging part are marked as members of
/// the asymptotic window.
fn points(row: &Ranked) -> Vec<PlotPoint> {
    let levels = row.method.samples.iter().enumerate();
    levels.map(|(level, one)| point(&row.part.levels, level, one)).collect()
}

fn point(converging: &Range<usize>, level: usize, one: &Sample) -> PlotPoint {
    let mark = if one.failed {
        Mark::Failed
    } else if !one.usable {
        Mark::Crossing
    } else if one.asymptotic && converging.contains(&level) {
        Mark::Window
    } else {
        Mark::OutsideWindow
    };
    PlotPoint { x: one.work, error: one.error, mark }
}
