//! The figures of convergence and internal-force studies.

use super::Figure;
use super::{Curve, HistoryPlot, LogLogPlot, Mark, PlotPoint, PlotSeries};
use crate::subject::Totals;
use crate::verify::{Axis, Convergence, InternalForce, LevelOutcome, SuiteOutcome, Verdict};

/// Maximum number of curves in one plot, because a reader cannot distinguish more.
const MOST_SERIES: usize = 6;

/// Maximum ratio of the largest to the smallest curve range for which plots share a vertical axis.
const MOST_ALIKE: f64 = 3.0;

/// Draws convergence plots, velocity histories of cases with an observed point, and
/// energies of cases with a reported energy rate.
pub(crate) fn figures(outcome: &SuiteOutcome) -> Vec<Figure> {
    let mut figures = convergence(outcome);
    figures.extend(histories(outcome));
    figures.extend(energies(outcome));
    figures
}

fn studies(outcome: &SuiteOutcome) -> Vec<(&str, &Convergence)> {
    let cases = outcome.cases.iter();
    let studies = cases.filter_map(|case| Some((case.case.as_str(), case.convergence()?)));
    studies.filter(|(_, study)| study.compared).collect()
}

/// Plots errors over spacings. All plots of a suite have the same axes. Cases with a single level
/// have no order and are excluded; a table lists their errors.
fn convergence(outcome: &SuiteOutcome) -> Vec<Figure> {
    let mut studies = studies(outcome);
    studies.retain(|(_, study)| study.levels.len() > 1);
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
    let mut orders = slopes(studies.iter().filter_map(|(_, study)| order(study)));
    if orders.is_empty() {
        orders.extend(studies.first().map(|(_, study)| study.formal_order));
    }
    let judged = studies.first().map_or(String::new(), |(_, study)| study.axis_label());
    LogLogPlot {
        title: outcome.title.clone(),
        x_label: spacing(studies.first().map_or(Axis::Space, |(_, study)| study.axis)).to_owned(),
        y_label: judged,
        series: studies.iter().map(series).collect(),
        reference_orders: orders,
        ..LogLogPlot::default()
    }
}

fn spacing(axis: Axis) -> &'static str {
    match axis {
        Axis::Space => "cell size h (m)",
        Axis::Time => "time step dt (s)",
        Axis::Particles => "particle spacing h/ppc^(1/D) (m)",
    }
}

/// Returns the observed order of a converging series, for a reference slope.
fn order(study: &Convergence) -> Option<f64> {
    let order = study.judgement.order.filter(|_| study.verdict() == Verdict::Converging)?;
    Some(order.value)
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

/// Plots the exact and the computed velocity at the observed point, on the coarsest, the middle and
/// the finest level.
fn histories(outcome: &SuiteOutcome) -> Vec<Figure> {
    let figure = |(name, study): (&str, &Convergence)| {
        let seen: Vec<_> = study
            .levels
            .iter()
            .enumerate()
            .filter(|(_, level)| level.run.failure.is_none())
            .filter_map(|(k, level)| Some((k, level, level.run.history.as_ref()?)))
            .collect();
        let (_, _, first) = *seen.first()?;
        let pick = [0, seen.len() / 2, seen.len() - 1];
        let mut curves = vec![Curve {
            name: "exact".to_owned(),
            look: 0,
            points: first.velocity.iter().map(|[t, _, exact]| (*t, *exact)).collect(),
            exact: true,
            markers: false,
        }];
        for (i, (look, level, history)) in seen.iter().enumerate() {
            if pick.contains(&i) {
                curves.push(Curve {
                    name: level.name(study.axis),
                    look: *look,
                    points: history.velocity.iter().map(|[t, v, _]| (*t, *v)).collect(),
                    exact: false,
                    markers: false,
                });
            }
        }
        let title = format!("{}: velocity near X = {} m, {name}", outcome.title, study.place()?);
        let (x_label, y_label) = ("time (s)".to_owned(), "velocity (m/s)".to_owned());
        let file = format!("{}-{name}-velocity.svg", outcome.suite);
        Some((file, HistoryPlot { title, x_label, y_label, curves }))
    };
    let (files, plots): (Vec<String>, Vec<HistoryPlot>) =
        studies(outcome).into_iter().filter_map(figure).unzip();
    // A diverging method would make other curves look flat, so plots share an axis only if their
    // ranges are similar.
    let rises = || plots.iter().map(HistoryPlot::rise);
    let least = rises().fold(f64::INFINITY, f64::min);
    let alike = rises().fold(0.0, f64::max) <= MOST_ALIKE * least;
    let draw = |plot: &HistoryPlot| {
        if alike { plot.to_svg_among(&plots) } else { plot.to_svg() }
    };
    let figure = |(file, plot): (String, &HistoryPlot)| {
        let pgfplots = plot.to_pgfplots();
        Figure { file, svg: draw(plot), pgfplots }
    };
    files.into_iter().zip(&plots).map(figure).collect()
}

/// Plots the energy over time, relative to its initial value, on the finest level of each case with
/// a reported energy rate.
fn energies(outcome: &SuiteOutcome) -> Option<Figure> {
    let curve = |(name, study): (&str, &Convergence)| {
        let account = &study.levels.last().filter(|_| study.rated)?.run.account;
        let start = account.first()?.1.energy()?;
        let point = |(t, totals): &(f64, Totals)| Some((*t, totals.energy()? / start));
        let points = account.iter().map(point).collect::<Option<Vec<_>>>()?;
        let look = look(outcome, name);
        Some(Curve { name: name.to_owned(), look, points, exact: false, markers: false })
    };
    let curves: Vec<Curve> = studies(outcome).into_iter().filter_map(curve).collect();
    if curves.is_empty() {
        return None;
    }
    let title = format!("{}: energy", outcome.title);
    let (x_label, y_label) = ("time (s)".to_owned(), "energy / initial energy".to_owned());
    let plot = HistoryPlot { title, x_label, y_label, curves };
    let file = format!("{}-energy.svg", outcome.suite);
    Some(Figure { file, svg: plot.to_svg(), pgfplots: plot.to_pgfplots() })
}

pub(crate) fn forces(outcome: &SuiteOutcome) -> Option<Figure> {
    let mut curves = Vec::new();
    for case in &outcome.cases {
        let Some(InternalForce { rows }) = case.results() else { continue };
        if curves.is_empty() {
            let points = rows.iter().map(|row| (row.position, row.predicted)).collect();
            curves.push(Curve {
                name: "predicted".to_owned(),
                look: 0,
                points,
                exact: true,
                markers: false,
            });
        }
        let points = rows.iter().map(|row| (row.position, row.force)).collect();
        let (name, look) = (case.case.clone(), look(outcome, &case.case));
        curves.push(Curve { name, look, points, exact: false, markers: true });
    }
    if curves.is_empty() {
        return None;
    }
    let plot = HistoryPlot {
        title: outcome.title.clone(),
        x_label: "position of the moving particle, x/h".to_owned(),
        y_label: "internal force on the node (N)".to_owned(),
        curves,
    };
    let file = format!("{}.svg", outcome.suite);
    Some(Figure { file, svg: plot.to_svg(), pgfplots: plot.to_pgfplots() })
}
