//! Slope triangles must not touch data, and legends must lie below the frame. Both are checked in
//! finished documents.

use super::samples;
use approx::assert_abs_diff_eq;
use mpm_verify::report::figure::Mark;
use proptest::prelude::*;
use rstest::rstest;

type Pt = (f64, f64);

/// Returns the value of an attribute in one line of the document.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    line[start..].split('"').next()
}

fn number(line: &str, name: &str) -> f64 {
    attribute(line, name).unwrap().parse().unwrap()
}

fn corners(line: &str) -> Vec<Pt> {
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    attribute(line, "points").unwrap().split(' ').map(pair).collect()
}

/// Returns the segments of the data. Keys of the legend are drawn around the origin and are
/// excluded.
fn data(svg: &str) -> Vec<(Pt, Pt)> {
    let strokes = |line: &&str| {
        line.contains("stroke-dasharray") || attribute(line, "stroke-width") == Some("1.60")
    };
    let lines = svg
        .lines()
        .filter(|l| l.starts_with("<line"))
        .filter(strokes)
        .map(|l| ((number(l, "x1"), number(l, "y1")), (number(l, "x2"), number(l, "y2"))));
    let curves = svg
        .lines()
        .filter(|l| l.starts_with("<polyline") && l.contains("stroke-linejoin"))
        .flat_map(|l| corners(l).windows(2).map(|w| (w[0], w[1])).collect::<Vec<_>>());
    lines.chain(curves).collect()
}

fn triangles(svg: &str) -> Vec<Vec<Pt>> {
    let polygons = svg.lines().filter(|line| line.starts_with("<polygon"));
    polygons.filter(|line| line.contains("#f3f3f3")).map(corners).collect()
}

fn distance_to_segment(p: Pt, (a, b): (Pt, Pt)) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    let s = if length > 0.0 { ((p.0 - a.0) * dx + (p.1 - a.1) * dy) / length } else { 0.0 };
    let s = s.clamp(0.0, 1.0);
    libm::hypot(p.0 - a.0 - s * dx, p.1 - a.1 - s * dy)
}

/// Returns the distance of a convex area from a segment; zero if they intersect.
fn distance(area: &[Pt], segment: (Pt, Pt)) -> f64 {
    let side = |p: Pt, a: Pt, b: Pt| (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0);
    let edges = || area.iter().copied().zip(area.iter().copied().cycle().skip(1));
    let inside = |p: Pt| {
        edges().all(|(a, b)| side(p, a, b) >= 0.0) || edges().all(|(a, b)| side(p, a, b) <= 0.0)
    };
    let crosses = |(a, b): (Pt, Pt)| {
        side(segment.0, a, b) * side(segment.1, a, b) < 0.0
            && side(a, segment.0, segment.1) * side(b, segment.0, segment.1) < 0.0
    };
    if inside(segment.0) || edges().any(crosses) {
        return 0.0;
    }
    let corners = area.iter().map(|&corner| distance_to_segment(corner, segment));
    let ends = edges()
        .map(|edge| distance_to_segment(segment.0, edge).min(distance_to_segment(segment.1, edge)));
    corners.chain(ends).fold(f64::INFINITY, f64::min)
}

/// Minimum distance (px): a marker extends about six pixels from its centre.
const APART: f64 = 7.0;

/// Whether all triangles of a drawing keep their distance from its data.
fn triangles_are_clear(svg: &str) -> bool {
    let data = data(svg);
    triangles(svg)
        .iter()
        .all(|triangle| data.iter().all(|segment| distance(triangle, *segment) > APART))
}

#[rstest]
#[case(samples::three_series().to_svg(), 2)]
#[case(samples::eight_long_names().to_svg(), 2)]
#[case(samples::less_than_a_decade().to_svg(), 1)]
#[case(samples::ten_decades().to_svg(), 1)]
fn triangles_touch_no_data(#[case] svg: String, #[case] count: usize) {
    assert_eq!(triangles(&svg).len(), count);
    assert!(data(&svg).len() > 3 && triangles_are_clear(&svg), "{svg}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    /// Each level halves the spacing. The errors fall, rise and jump.
    #[test]
    fn triangles_touch_no_data_of_any_series(
        errors in prop::collection::vec(prop::collection::vec(-4.0..1.0, 2..7), 1..4),
        orders in prop::collection::vec(0.3..5.0, 1..5),
    ) {
        let series = errors.iter().map(|exponents| samples::series("one", exponents.len(), |i, _| {
            (libm::pow(10.0, exponents[i]), Mark::Window)
        }));
        let svg = samples::convergence(series.collect(), &orders).to_svg();
        prop_assert!(triangles_are_clear(&svg), "{}", svg);
    }
}

#[rstest]
#[case(samples::three_series().to_svg())]
#[case(samples::eight_long_names().to_svg())]
#[case(samples::damped_sine(1.0).to_svg())]
#[case(samples::staircase().to_svg())]
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

#[test]
fn distance_of_intersecting_shapes_is_not_positive() {
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
    assert!(distance(&square, ((-1.0, 1.0), (3.0, 1.0))) <= 0.0);
    assert!(distance(&square, ((1.0, 1.0), (1.5, 1.0))) <= 0.0);
    assert_abs_diff_eq!(distance(&square, ((5.0, -9.0), (5.0, 9.0))), 3.0, epsilon = 1e-12);
}
