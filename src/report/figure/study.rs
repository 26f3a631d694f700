//! The figures of convergence studies.

use super::{Figure, LogLogPlot, Mark, PlotPoint, PlotSeries};
use crate::verify::{Axis, CaseOutcome, Convergence, LevelOutcome, SuiteOutcome, Verdict};

/// Maximum number of curves in one plot, because a reader cannot distinguish more.
const MOST_SERIES: usize = 6;

/// Plots errors over spacings. All plots of a suite have the same axes. Cases with a single level
/// have no order and are excluded; a table lists their errors.
pub(crate) fn figures(outcome: &SuiteOutcome) -> Vec<Figure> {
    let is_plotted = |(_, study): &(&str, &Convergence)| study.compared && study.levels.len() > 1;
    let studies: Vec<_> = outcome.results(CaseOutcome::convergence).filter(is_plotted).collect();
    let plots = studies.len().div_ceil(MOST_SERIES).max(1);
    let parts = studies.chunks(studies.len().div_ceil(plots).max(1));
    let drawn: Vec<LogLogPlot> = parts.map(|part| plot(outcome, part)).collect();
    let figure = |(i, one): (usize, &LogLogPlot)| {
        let number = if plots > 1 { format!("-{}", i + 1) } else { String::new() };
        let file = format!("{}{number}.svg", outcome.suite);
        Figure { file, svg: one.to_svg_among(&drawn), pgfplots: one.to_pgfplots() }
    };
    drawn.iter().enumerate().map(figure).collect()
}

/// Returns the index of a case in its suite. The index determines the colour of the case in all
/// figures.
fn look(outcome: &SuiteOutcome, case: &str) -> usize {
    outcome.cases.iter().position(|known| known.case == case).unwrap_or(0)
}

fn plot(outcome: &SuiteOutcome, studies: &[(&str, &Convergence)]) -> LogLogPlot {
    let series = |(name, study): &(&str, &Convergence)| PlotSeries {
        name: (*name).to_owned(),
        look: look(outcome, name),
        points: study.levels.iter().enumerate().map(|(i, level)| point(study, i, level)).collect(),
    };
    let converging = studies.iter().filter(|(_, study)| study.verdict() == Verdict::Converging);
    let orders = converging.filter_map(|(_, study)| study.judgement.order);
    let mut orders = slopes(orders.map(|order| order.value));
    if orders.is_empty() {
        orders.extend(studies.first().map(|(_, study)| study.formal_order));
    }
    let judged = studies.first().map_or(String::new(), |(_, study)| study.axis_label());
    LogLogPlot {
        title: outcome.title.clone(),
        x_label: spacing_label(studies.first().map_or(Axis::Space, |(_, study)| study.axis))
            .to_owned(),
        y_label: judged,
        series: studies.iter().map(series).collect(),
        reference_orders: orders,
        ..LogLogPlot::default()
    }
}

/// Returns the label of an axis of spacings.
pub(crate) fn spacing_label(axis: Axis) -> &'static str {
    match axis {
        Axis::Space => "cell size h (m)",
        Axis::Time => "time step dt (s)",
        Axis::Particles => "particle spacing h/ppc^(1/D) (m)",
    }
}

/// Converts observed orders to reference slopes: rounds to thirds and removes duplicates.
fn slopes(orders: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut slopes: Vec<f64> = orders.map(|order| libm::round(order * 3.0) / 3.0).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.dedup();
    slopes
}

fn point(study: &Convergence, index: usize, level: &LevelOutcome) -> PlotPoint {
    let window = study.judgement.window.as_deref().unwrap_or_default();
    let mark = if level.run.failure.is_some() {
        Mark::Failed
    } else if level.run.counters.crossings.unwrap_or(0) > 0 {
        Mark::Crossing
    } else if window.contains(&index) {
        Mark::Window
    } else {
        Mark::OutsideWindow
    };
    let error = study.judgement.levels.get(index).map_or(f64::NAN, |judged| judged.error);
    PlotPoint { x: level.spacing, error, mark }
}
