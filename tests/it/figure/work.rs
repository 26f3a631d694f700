//! The work-precision diagram.

use super::xml::{well_formed, without_bad_numbers};
use super::{any_value, marks, samples};
use mpm_verify::report::figure::{LogLogPlot, Mark, PlotPoint, PlotSeries};
use proptest::prelude::*;

pub(super) fn diagram() -> LogLogPlot {
    let convergence = samples::three_series();
    let mut others = convergence.series.clone();
    others[0].points[0].error = f64::NAN;
    LogLogPlot {
        title: convergence.title,
        x_label: "particle-node transfers".to_owned(),
        y_label: convergence.y_label,
        series: convergence.series,
        others,
        front: vec![(0.01, 0.1), (0.1, 0.02)],
        ..LogLogPlot::default()
    }
}

fn band(svg: &str) -> usize {
    // The Pareto front in the frame, and its key.
    svg.matches("stroke-width=\"11.00\"").count()
}

#[test]
fn the_front_the_others_and_their_failures_are_explained() {
    let svg = diagram().to_svg();
    assert_eq!(well_formed(&svg), Ok(()));
    assert!(without_bad_numbers(&svg));
    assert_eq!(band(&svg), 2);
    for words in ["Pareto front", "3 others", "failed or not finite"] {
        assert_eq!(svg.matches(words).count(), 1, "{words}");
    }
    assert_eq!(svg, diagram().to_svg());
}

#[test]
fn legend_omits_absent_markers() {
    let svg = LogLogPlot { others: Vec::new(), front: Vec::new(), ..diagram() }.to_svg();
    assert!(!svg.contains("others") && !svg.contains("Pareto") && band(&svg) == 0);
}

#[test]
fn a_failure_of_a_method_without_a_name_is_explained_too() {
    let sound = PlotSeries {
        name: "sound".to_owned(),
        look: 0,
        points: vec![PlotPoint { x: 1.0, error: 0.1, mark: Mark::Window }],
    };
    let failed = PlotSeries {
        name: "failed".to_owned(),
        look: 1,
        points: vec![PlotPoint { x: 2.0, error: f64::NAN, mark: Mark::Failed }],
    };
    let figure = LogLogPlot { series: vec![sound], others: vec![failed], ..diagram() };
    assert!(figure.to_svg().contains("failed or not finite"));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]

    #[test]
    fn no_input_panics(
        points in prop::collection::vec((any_value(), any_value(), marks()), 0..9),
        front in prop::collection::vec((any_value(), any_value()), 0..4),
    ) {
        let points: Vec<PlotPoint> =
            points.into_iter().map(|(x, error, mark)| PlotPoint { x, error, mark }).collect();
        let one = PlotSeries { name: "one".to_owned(), look: 0, points };
        let (series, others) = (vec![one.clone(), one.clone()], vec![one]);
        let svg = LogLogPlot { series, others, front, ..diagram() }.to_svg();
        prop_assert_eq!(well_formed(&svg), Ok(()));
        prop_assert!(without_bad_numbers(&svg));
    }
}
