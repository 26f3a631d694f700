//! Properties of every drawing.

use mpm_verify::report::figure::*;
use proptest::prelude::*;
use rstest::rstest;
use xml::{well_formed, without_bad_numbers};

mod samples;
mod xml;

/// Plain colours are attributes, which every viewer supports. The style sheet must replace each of
/// them.
#[rstest]
#[case(samples::three_series().to_svg())]
#[case(samples::eight_long_names().to_svg())]
#[case(samples::work().to_svg())]
fn every_colour_has_a_dark_counterpart(#[case] svg: String) {
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
fn unnamed_methods_and_their_failures_are_explained() {
    let svg = samples::work().to_svg();
    for words in ["Pareto front", "3 others", "failed or not finite"] {
        assert_eq!(svg.matches(words).count(), 1, "{words}");
    }
}

#[test]
fn points_without_a_position_are_noted() {
    let mut figure = samples::three_series();
    figure.series[0].points[0].error = 0.0;
    assert!(figure.to_svg().contains("Not drawn on logarithmic axes: 1 point"));
}

#[test]
fn failures_at_the_same_size_are_stacked() {
    let failed = |name: &str| PlotSeries {
        name: name.to_owned(),
        look: 0,
        points: vec![PlotPoint { x: 0.1, error: f64::NAN, mark: Mark::Failed }],
    };
    let svg = samples::convergence(vec![failed("one"), failed("two")], &[]).to_svg();
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
        let figure = LogLogPlot { series, others, front, reference_orders, ..samples::work() };
        let svg = figure.to_svg();
        prop_assert_eq!(well_formed(&svg), Ok(()));
        prop_assert!(without_bad_numbers(&svg));
    }
}

/// Returns the value of an attribute in one line of the document.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    line[start..].split('"').next()
}

fn number(line: &str, name: &str) -> f64 {
    attribute(line, name).unwrap().parse().unwrap()
}

#[rstest]
#[case(samples::three_series().to_svg())]
#[case(samples::eight_long_names().to_svg())]
fn the_legend_is_below_the_frame_and_inside_the_figure(#[case] svg: String) {
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
