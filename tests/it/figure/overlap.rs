//! Slope triangles and legends touch no data, measured in the finished documents.

use super::samples;
use rstest::rstest;

type Pt = (f64, f64);

/// The value of an attribute in one line of the document.
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

/// The segments of the data; keys of the legend are drawn around the origin and lie elsewhere.
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
    svg.lines().filter(|l| l.contains("#f3f3f3")).map(corners).collect()
}

/// The legend, which is the only white box with a grey border.
fn legend(svg: &str) -> Vec<Pt> {
    let line = svg.lines().find(|l| l.contains("fill=\"#ffffff\" stroke=\"#e3e3e3\"")).unwrap();
    let (x, y) = (number(line, "x"), number(line, "y"));
    let (right, bottom) = (x + number(line, "width"), y + number(line, "height"));
    vec![(x, y), (right, y), (right, bottom), (x, bottom)]
}

fn distance_to_segment(p: Pt, (a, b): (Pt, Pt)) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    let s = if length > 0.0 { ((p.0 - a.0) * dx + (p.1 - a.1) * dy) / length } else { 0.0 };
    let s = s.clamp(0.0, 1.0);
    libm::hypot(p.0 - a.0 - s * dx, p.1 - a.1 - s * dy)
}

/// Distance of a convex area from a segment; zero where they meet.
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

/// Required distance, less the errors of the raster.
const APART: f64 = 7.0;

#[rstest]
#[case(samples::three_series().to_svg(), 2)]
#[case(samples::eight_long_names().to_svg(), 2)]
#[case(samples::less_than_a_decade().to_svg(), 1)]
#[case(samples::ten_decades().to_svg(), 2)]
fn triangles_touch_no_data(#[case] svg: String, #[case] count: usize) {
    let triangles = triangles(&svg);
    assert_eq!(triangles.len(), count);
    for triangle in triangles {
        for segment in data(&svg) {
            assert!(distance(&triangle, segment) > APART, "{triangle:?} {segment:?}");
        }
    }
}

#[rstest]
#[case(samples::three_series().to_svg())]
#[case(samples::eight_long_names().to_svg())]
#[case(samples::ten_decades().to_svg())]
#[case(samples::damped_sine(1.0).to_svg())]
#[case(samples::square_wave().to_svg())]
#[case(samples::staircase().to_svg())]
fn the_legend_hides_no_data(#[case] svg: String) {
    let data = data(&svg);
    assert!(data.len() > 5);
    for segment in data {
        assert!(distance(&legend(&svg), segment) > APART, "{segment:?}");
    }
}

#[test]
fn the_measure_sees_what_meets() {
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
    assert!(distance(&square, ((-1.0, 1.0), (3.0, 1.0))) <= 0.0);
    assert!(distance(&square, ((1.0, 1.0), (1.5, 1.0))) <= 0.0);
    assert!((distance(&square, ((5.0, -9.0), (5.0, 9.0))) - 3.0).abs() < 1e-12);
}
