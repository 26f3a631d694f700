//! Convergence plot for a terminal: error against spacing, in braille characters.

use crate::report::columns::level;
use crate::report::columns::short;
use crate::report::figure::plot::scale::{Pad, Scale};
use crate::report::figure::study::spacing_label;
use crate::report::names::together;
use crate::verify::{CaseOutcome, Convergence, LevelOutcome, SuiteOutcome, format_number, grouped};

/// Size of the plot (characters). A braille character has two columns and four rows of dots.
const SIZE: [usize; 2] = [60, 13];
const DOTS: [usize; 2] = [2, 4];

/// Mark of a level that does not count for the order.
const EXCLUDED: char = 'o';

/// Draws the errors of a suite. Cases whose points coincide share a letter. `None` if the suite has
/// no errors on several levels.
pub fn convergence_plot(outcome: &SuiteOutcome) -> Option<String> {
    let is_compared = |(_, study): &(&str, &Convergence)| study.compared;
    let mut studies = outcome.results(CaseOutcome::convergence).filter(is_compared).peekable();
    let (_, first) = *studies.peek()?;
    let is_alike = |(_, study): &(&str, &Convergence)| {
        study.judged() == first.judged() && study.axis == first.axis
    };
    let series: Vec<_> = studies
        .filter(is_alike)
        .map(|(name, study)| (points(study), (name, study)))
        .filter(|(points, _)| points.len() > 1)
        .collect();
    if series.is_empty() {
        return None;
    }
    let all = || series.iter().flat_map(|(points, _)| points);
    let scales = [0, 1].map(|axis| Scale::log(all().map(|point| point.at[axis]), NONE));
    let dots = |points: &[PlottedLevel]| -> Vec<([usize; 2], bool)> {
        points.iter().map(|point| (dot(scales, point), point.counts)).collect()
    };
    let mut canvas = Canvas { dots: [[0; SIZE[0]]; SIZE[1]], marks: [[None; SIZE[0]]; SIZE[1]] };
    let mut key = Vec::new();
    let curves = grouped(series.iter().map(|(points, case)| (dots(points), *case)));
    for (letter, (dots, cases)) in ('a'..='z').zip(curves) {
        canvas.curve(&dots, letter);
        let (names, studies): (Vec<&str>, Vec<&Convergence>) = cases.into_iter().unzip();
        let order = studies[0].judgement.order.map(|order| order.shown());
        let order = order.unwrap_or_else(|| studies[0].verdict().name().to_owned());
        key.push(format!("  {letter}  {}: {order}", together(&names)));
    }
    if all().any(|point| !point.counts) {
        key.push(format!("  {EXCLUDED}  levels that do not count for the order"));
    }
    let mut lines = vec![format!("  {}: {}", outcome.suite, first.judged())];
    lines.extend(framed(&canvas, scales, spacing_label(first.axis)));
    lines.extend(key);
    Some(lines.join("\n") + "\n")
}

const NONE: Pad = Pad { lo: 0.0, hi: 0.0 };

struct PlottedLevel {
    at: [f64; 2],
    counts: bool,
}

/// Returns the levels that a logarithmic axis can show.
fn points(study: &Convergence) -> Vec<PlottedLevel> {
    let point = |(row, level): (level::LevelRow<'_>, &LevelOutcome)| {
        let at = [level.spacing, level.error];
        at.iter()
            .all(|x| x.is_finite() && *x > 0.0)
            .then(|| PlottedLevel { at, counts: row.counts() })
    };
    level::rows(study).zip(&study.levels).filter_map(point).collect()
}

/// Returns the place of a level, in dots from the bottom left.
fn dot(scales: [Scale; 2], point: &PlottedLevel) -> [usize; 2] {
    [0, 1].map(|axis| {
        let last = (SIZE[axis] * DOTS[axis] - 1) as f64;
        libm::round(scales[axis].fraction(point.at[axis]) * last) as usize
    })
}

fn framed(canvas: &Canvas, scales: [Scale; 2], spacing: &str) -> Vec<String> {
    let [[left, right], [bottom, top]] =
        scales.map(|scale| [scale.lo, scale.hi].map(|end| libm::pow(10.0, end)));
    let row = |(k, row): (usize, String)| {
        let label = match k {
            0 => short(top),
            _ if k + 1 == SIZE[1] => short(bottom),
            _ => String::new(),
        };
        format!("  {label:>9} |{row}").trim_end().to_owned()
    };
    let mut lines: Vec<String> = canvas.rows().into_iter().enumerate().map(row).collect();
    let (left, right) = (format_number(left), format_number(right));
    let gap = SIZE[0] - left.len();
    lines.push(format!("  {:>9} +{}", "", "-".repeat(SIZE[0])));
    lines.push(format!("  {:>9}  {left}{right:>gap$}  {spacing}", ""));
    lines
}

/// Dots of a plot, from the bottom left, and characters that cover them.
struct Canvas {
    dots: [[u32; SIZE[0]]; SIZE[1]],
    marks: [[Option<char>; SIZE[0]]; SIZE[1]],
}

impl Canvas {
    fn line(&mut self, from: [usize; 2], to: [usize; 2]) {
        /// Bits of the dots in a braille character, rows from the bottom.
        const BITS: [[u32; 2]; 4] = [[0x40, 0x80], [0x04, 0x20], [0x02, 0x10], [0x01, 0x08]];
        let steps = (0..2).map(|axis| from[axis].abs_diff(to[axis])).max().unwrap_or(0).max(1);
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let [x, y] = [0, 1].map(|axis| {
                let (from, to) = (from[axis] as f64, to[axis] as f64);
                libm::round(from + share * (to - from)) as usize
            });
            self.dots[y / DOTS[1]][x / DOTS[0]] |= BITS[y % DOTS[1]][x % DOTS[0]];
        }
    }

    /// Draws lines between dots, and marks them with `letter` if their levels count.
    fn curve(&mut self, dots: &[([usize; 2], bool)], letter: char) {
        for pair in dots.windows(2) {
            self.line(pair[0].0, pair[1].0);
        }
        for ([x, y], counts) in dots {
            let mark = if *counts { letter } else { EXCLUDED };
            self.marks[y / DOTS[1]][x / DOTS[0]].get_or_insert(mark);
        }
    }

    fn rows(&self) -> Vec<String> {
        let braille = |bits: u32| char::from_u32(0x2800 + bits).filter(|_| bits > 0);
        let row = |(dots, marks): (&[u32; SIZE[0]], &[Option<char>; SIZE[0]])| {
            let cell = |(bits, mark): (&u32, &Option<char>)| mark.or(braille(*bits)).unwrap_or(' ');
            dots.iter().zip(marks).map(cell).collect()
        };
        self.dots.iter().zip(&self.marks).rev().map(row).collect()
    }
}
