//! The figures of convergence studies.

use super::series::coincident;
use super::{Figure, LogLogPlot, Mark, PlotPoint, PlotSeries};
use crate::report::columns::level::NamedStudy;
use crate::report::names::together;
use crate::verify::{
    Axis, CaseOutcome, Convergence, LevelOutcome, SuiteOutcome, Verdict, distinct,
};

/// Maximum number of curves in one plot, because a reader cannot distinguish more.
const MOST_SERIES: usize = 6;

/// Plots errors over spacings, on the same axes in all plots, for cases with several levels.
pub(crate) fn figures(outcome: &SuiteOutcome) -> Vec<Figure> {
    let is_plotted = |(_, study): &NamedStudy<'_>| study.compared && study.levels.len() > 1;
    let studies = outcome.results(CaseOutcome::convergence).filter(is_plotted);
    let curves =
        coincident(studies.map(|(name, study)| ((name, study), series(outcome, name, study))));
    let plots = curves.len().div_ceil(MOST_SERIES).max(1);
    let parts = curves.chunks(curves.len().div_ceil(plots).max(1));
    let drawn: Vec<LogLogPlot> = parts.map(|part| plot(outcome, part)).collect();
    let figure = |(i, one): (usize, &LogLogPlot)| {
        let number = if plots > 1 { format!("-{}", i + 1) } else { String::new() };
        let file = format!("{}{number}.svg", outcome.suite);
        Figure { file, svg: one.to_svg_among(&drawn), pgfplots: one.to_pgfplots() }
    };
    drawn.iter().enumerate().map(figure).collect()
}

fn series(outcome: &SuiteOutcome, name: &str, study: &Convergence) -> PlotSeries {
    let levels = study.levels.iter().enumerate();
    let points = levels.map(|(i, level)| point(study, i, level)).collect();
    // The index of a case in its suite gives its colour in all figures.
    let look = outcome.cases.iter().position(|known| known.case == name).unwrap_or(0);
    PlotSeries { name: name.to_owned(), look, points }
}

/// Returns the legend text of a curve: its cases, and their orders or verdicts.
fn label(cases: &[NamedStudy<'_>]) -> String {
    let names: Vec<&str> = cases.iter().map(|(name, _)| *name).collect();
    let order = |(_, study): &NamedStudy<'_>| match study.judgement.order {
        Some(order) => format!("order {:.2}", order.value),
        None => study.verdict().name().to_owned(),
    };
    format!("{}: {}", together(&names), distinct(cases.iter().map(order)).join(", "))
}

fn plot(outcome: &SuiteOutcome, curves: &[(Vec<NamedStudy<'_>>, PlotSeries)]) -> LogLogPlot {
    let studies: Vec<_> = curves.iter().flat_map(|(cases, _)| cases).collect();
    let converging = studies.iter().filter(|(_, study)| study.verdict() == Verdict::Converging);
    let orders = converging.filter_map(|(_, study)| study.judgement.order);
    let mut orders = slopes(orders.map(|order| order.value));
    if orders.is_empty() {
        orders.extend(studies.first().map(|(_, study)| study.formal_order));
    }
    let named = |(cases, series): &(Vec<NamedStudy<'_>>, PlotSeries)| PlotSeries {
        name: label(cases),
        ..series.clone()
    };
    let judged = studies.first().map_or(String::new(), |(_, study)| study.axis_label());
    LogLogPlot {
        title: outcome.title.clone(),
        x_label: spacing_label(studies.first().map_or(Axis::Space, |(_, study)| study.axis))
            .to_owned(),
        y_label: judged,
        series: curves.iter().map(named).collect(),
        reference_orders: orders,
        ..LogLogPlot::default()
    }
}

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
