//! Properties of every drawing.

use mpm_verify::report::figure::*;
use proptest::prelude::*;
use rstest::rstest;

const LONG: &str = "basis: cubic B-spline, APIC, dt = 1/8 CFL";

/// Creates a work-precision diagram of eight series with levels of every kind. It has a front, and
/// three unnamed methods that fail.
fn figure(name: &str) -> LogLogPlot {
    let series = |look: usize| {
        let point = |k: usize| {
            let x = 0.25 / f64::from(1 << k);
            let mark = [Mark::OutsideWindow, Mark::Window, Mark::Crossing, Mark::Failed][k];
            PlotPoint { x, error: libm::pow(2.3, look as f64) * x * x, mark }
        };
        PlotSeries { name: format!("{name} {look}"), look, points: (0..4).map(point).collect() }
    };
    LogLogPlot {
        title: "Vibrating bar, one element per cell".to_owned(),
        x_label: "cell size h (m)".to_owned(),
        y_label: "relative error in displacement (-)".to_owned(),
        series: (0..8).map(series).collect(),
        others: (0..3).map(series).collect(),
        front: vec![(0.01, 0.1), (0.1, 0.02)],
        reference_orders: vec![2.0, 5.0 / 3.0],
    }
}

/// Plain colours are attributes, which every viewer supports. The style sheet must replace each of
/// them.
#[test]
fn every_colour_has_a_dark_counterpart() {
    let svg = figure(LONG).to_svg();
    let (before, rest) = svg.split_once("<style>").expect("a style sheet");
    let (sheet, after) = rest.split_once("</style>").expect("its end");
    let mut count = 0;
    for (drawn, key) in
        [before, after].into_iter().flat_map(|part| ["fill", "stroke"].map(|key| (part, key)))
    {
        for value in drawn.split(&format!(" {key}=\"")).skip(1) {
            let colour = value.split('"').next().expect("a value");
            let rule = format!("[{key}=\"{colour}\"]{{{key}:light-dark({colour},#");
            assert!(colour == "none" || sheet.contains(&rule), "{key} {colour}");
            count += 1;
        }
    }
    assert!(count > 10);
}

#[test]
fn unnamed_methods_failures_and_points_without_a_position_are_explained() {
    let mut figure = figure("basis");
    figure.series[0].points[0].error = 0.0;
    let (svg, dropped) = (figure.to_svg(), "Not drawn on logarithmic axes: 1 point");
    for words in ["Pareto front", "3 others", "failed or not finite", dropped] {
        assert_eq!(svg.matches(words).count(), 1, "{words}");
    }
    // Only marks that occur have a key, and unnamed series only that of failures.
    for series in &mut figure.series {
        series.points.retain(|point| point.mark == Mark::Window);
    }
    let svg = figure.to_svg();
    for (key, count) in [
        ("in the asymptotic window", 1),
        ("outside the window", 0),
        ("particles changed cell", 0),
        ("failed or not finite", 1),
    ] {
        assert_eq!(svg.matches(key).count(), count, "{key}");
    }
}

#[test]
fn failures_at_the_same_size_are_stacked() {
    let failed = |look: usize| PlotSeries {
        name: look.to_string(),
        look,
        points: vec![PlotPoint { x: 0.1, error: f64::NAN, mark: Mark::Failed }],
    };
    let svg = LogLogPlot { series: [0, 1].map(failed).into(), ..LogLogPlot::default() }.to_svg();
    // The symbol of the first failure, and its key in the legend.
    assert_eq!(svg.matches("stroke-width=\"1.30\"").count(), 2);
}

fn any_points() -> impl Strategy<Value = Vec<PlotPoint>> {
    let all = [Mark::Window, Mark::OutsideWindow, Mark::Crossing, Mark::Failed];
    let any = (any_value(), any_value(), prop::sample::select(all.to_vec()));
    prop::collection::vec(any.prop_map(|(x, error, mark)| PlotPoint { x, error, mark }), 0..8)
}

fn any_value() -> impl Strategy<Value = f64> {
    // Any bit pattern, and numbers in the range that drawings usually contain.
    prop_oneof![any::<f64>(), prop::num::f64::ANY, -2.0..2.0]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn no_input_breaks_the_figure(
        points in prop::collection::vec(any_points(), 0..9),
        others in prop::collection::vec(any_points(), 0..3),
        front in prop::collection::vec((any_value(), any_value()), 0..4),
        reference_orders in prop::collection::vec(any_value(), 0..3),
        text in any::<String>(),
    ) {
        let named = |all: Vec<Vec<PlotPoint>>| -> Vec<PlotSeries> {
            let one = |points| PlotSeries { name: text.clone(), look: 0, points };
            all.into_iter().map(one).collect()
        };
        let (series, others) = (named(points), named(others));
        let figure = LogLogPlot { series, others, front, reference_orders, ..figure(LONG) };
        let svg = figure.to_svg();
        prop_assert_eq!(well_formed(&svg), Ok(()));
        prop_assert!(without_bad_numbers(&svg));
    }
}

/// Returns the number in an attribute in one line of the document.
fn number(line: &str, name: &str) -> f64 {
    let (_, rest) = line.split_once(&format!(" {name}=\"")).unwrap();
    rest.split('"').next().unwrap().parse().unwrap()
}

#[rstest]
fn the_legend_is_below_the_frame_and_inside_the_figure(#[values("basis", LONG)] name: &str) {
    let svg = figure(name).to_svg();
    let root = svg.lines().next().unwrap();
    let frame = svg.lines().filter(|line| line.starts_with("<rect")).nth(1).unwrap();
    let bottom = number(frame, "y") + number(frame, "height");
    let (_, legend) = svg.split_once("<g class=\"legend\">").unwrap();
    let entries: Vec<&str> = legend.lines().filter(|line| line.starts_with("<text")).collect();
    assert!(!entries.is_empty());
    for entry in entries {
        assert!(number(entry, "y") > bottom + 50.0 && number(entry, "y") < number(root, "height"));
        assert!(number(entry, "x") > 10.0 && number(entry, "x") < number(root, "width") - 20.0);
    }
}

/// Checks that tags are balanced and attributes quoted, and that markup appears nowhere else.
fn well_formed(svg: &str) -> Result<(), String> {
    let mut open = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        entities(&rest[..start])?;
        let end = rest[start..].find('>').ok_or("unclosed tag")? + start;
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Err(format!("</{name}> closes nothing"));
            }
            continue;
        }
        let body = tag.strip_suffix('/').unwrap_or(tag);
        let (name, attributes) = body.split_once(' ').unwrap_or((body, ""));
        let quoted: Vec<_> = attributes.split('"').collect();
        let names_only = quoted.iter().step_by(2).all(|gap| {
            let name = gap.trim();
            name.is_empty() || name.ends_with('=') && !name.contains(' ')
        });
        if !names_only || quoted.len() % 2 == 0 || tag.contains('<') {
            return Err(format!("<{tag}>"));
        }
        entities(attributes)?;
        if !tag.ends_with('/') {
            open.push(name);
        }
    }
    (open.is_empty() && rest.trim().is_empty())
        .then_some(())
        .ok_or_else(|| format!("{open:?} left open"))
}

fn entities(text: &str) -> Result<(), String> {
    let known = ["amp;", "lt;", "gt;", "quot;", "apos;"];
    text.split('&')
        .skip(1)
        .all(|after| known.iter().any(|entity| after.starts_with(entity)))
        .then_some(())
        .ok_or_else(|| text.to_owned())
}

/// Whether the values of attributes contain no invalid number, such as NaN.
fn without_bad_numbers(svg: &str) -> bool {
    svg.split('"')
        .skip(1)
        .step_by(2)
        .all(|value| !["NaN", "inf", "-0.00"].iter().any(|bad| value.contains(bad)))
}
