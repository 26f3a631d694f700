//! Drawings that several tests use.

use mpm_verify::report::figure::{LogLogPlot, Mark, PlotPoint, PlotSeries};

/// Returns cell sizes from 1/4 m, each half of the previous one.
fn sizes(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(|i| 0.25 / f64::from(1 << i))
}

pub(super) fn series(
    name: &str,
    count: usize,
    error: impl Fn(usize, f64) -> (f64, Mark),
) -> PlotSeries {
    let point = |(i, h)| {
        let (error, mark) = error(i, h);
        PlotPoint { x: h, error, mark }
    };
    let points = sizes(count).enumerate().map(point).collect();
    PlotSeries { name: name.to_owned(), look: 0, points }
}

pub(super) fn convergence(series: Vec<PlotSeries>, orders: &[f64]) -> LogLogPlot {
    let series = series.into_iter().enumerate();
    let series = series.map(|(look, one)| PlotSeries { look, ..one }).collect();
    LogLogPlot {
        title: "Vibrating bar, one element per cell".to_owned(),
        x_label: "cell size h (m)".to_owned(),
        y_label: "relative error in displacement (-)".to_owned(),
        series,
        reference_orders: orders.to_vec(),
        ..LogLogPlot::default()
    }
}

/// Creates three series: a constant order with a plateau, an order that changes when particles
/// cross, and a failure.
pub(super) fn three_series() -> LogLogPlot {
    let plateau = series("displacement", 7, |i, h| {
        let mark = if (1..5).contains(&i) { Mark::Window } else { Mark::OutsideWindow };
        (0.3 * h * h + 4e-5, mark)
    });
    let crossing = series("velocity", 7, |i, h| match i {
        0..4 => (2.0 * h * h, Mark::Window),
        _ => (2e-3 * f64::from(1 << (i - 3)), Mark::Crossing),
    });
    let failing = series("stress", 7, |i, h| match i {
        6 => (f64::NAN, Mark::Window),
        0 => (6.0 * h, Mark::OutsideWindow),
        _ => (9.0 * libm::pow(h, 5.0 / 3.0), Mark::Window),
    });
    convergence(vec![plateau, crossing, failing], &[2.0, 5.0 / 3.0])
}

pub(super) fn eight_long_names() -> LogLogPlot {
    let all = (0..8).map(|k| {
        let name = format!("basis {k}: cubic B-spline, APIC, dt = {k}/8 CFL");
        series(&name, 5, |i, h| {
            let factor = libm::pow(2.3, f64::from(k));
            let mark = if i == 0 { Mark::OutsideWindow } else { Mark::Window };
            (1e-2 * factor * libm::pow(h, 1.0 + 0.15 * f64::from(k)), mark)
        })
    });
    convergence(all.collect(), &[1.0, 2.0])
}

/// Creates a work-precision diagram with a front and three unnamed methods. One of them fails.
pub(super) fn work() -> LogLogPlot {
    let mut others = three_series().series;
    others[0].points[0].error = f64::NAN;
    LogLogPlot { others, front: vec![(0.01, 0.1), (0.1, 0.02)], ..three_series() }
}
