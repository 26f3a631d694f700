//! Convergence plot for a terminal: error against spacing on logarithmic axes, in braille
//! characters.

use super::table::together;
use crate::report::columns::level::{self, LevelRow};
use crate::report::columns::short;
use crate::verify::{Axis, CaseOutcome, Convergence, SuiteOutcome, format_number, grouped};

/// Size of the plot (characters). A braille character has two columns and four rows of dots.
const SIZE: [usize; 2] = [60, 13];
const DOTS: [usize; 2] = [2, 4];

/// Mark of a level that does not count for the order.
const EXCLUDED: char = 'o';

/// Draws the errors of a suite. Cases whose points coincide share a letter. `None` if the suite has
/// no errors on several levels.
pub fn convergence_plot(outcome: &SuiteOutcome) -> Option<String> {
    let studies: Vec<(&CaseOutcome, &Convergence)> = outcome
        .cases
        .iter()
        .filter_map(|case| Some((case, case.convergence().filter(|study| study.compared)?)))
        .collect();
    let (_, first) = studies.first()?;
    let studies = studies
        .iter()
        .filter(|(_, study)| study.judged() == first.judged() && study.axis == first.axis);
    let series = studies.map(|(case, study)| (points(study), *case));
    let series: Vec<(Vec<PlottedLevel>, &CaseOutcome)> =
        series.filter(|(points, _)| points.len() > 1).collect();
    let ends = [0, 1].map(|axis| {
        let values = series.iter().flat_map(|(points, _)| points).map(|point| point.at[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    });
    if ends.iter().any(|[low, high]| !(low < high)) {
        return None;
    }
    let mut canvas = Canvas { dots: [[0; SIZE[0]]; SIZE[1]], marks: [[None; SIZE[0]]; SIZE[1]] };
    let place = |point: &PlottedLevel| {
        [0, 1].map(|axis| {
            let [low, high] = ends[axis];
            let last = (SIZE[axis] * DOTS[axis] - 1) as f64;
            libm::round((point.at[axis] - low) / (high - low) * last) as usize
        })
    };
    let placed = series.iter().map(|(points, case)| {
        let dots: Vec<_> = points.iter().map(|point| (place(point), point.counts)).collect();
        (dots, *case)
    });
    let mut key = Vec::new();
    for (letter, (dots, cases)) in ('a'..='z').zip(grouped(placed)) {
        for pair in dots.windows(2) {
            canvas.line(pair[0].0, pair[1].0);
        }
        for (dot, counts) in dots {
            canvas.mark(dot, if counts { letter } else { EXCLUDED });
        }
        let names: Vec<&str> = cases.iter().map(|case| case.case.as_str()).collect();
        let order = cases[0].convergence().and_then(|study| study.judgement.order);
        let order = order.map_or_else(|| cases[0].verdict.clone(), |order| order.shown());
        key.push(format!("  {letter}  {}: {order}", together(&names)));
    }
    let value = |[low, high]: [f64; 2]| [libm::pow(10.0, low), libm::pow(10.0, high)];
    let ([left, right], [bottom, top]) = (value(ends[0]), value(ends[1]));
    let mut lines = vec![format!("  {}: {}", outcome.suite, first.judged())];
    for (k, row) in canvas.rows().into_iter().enumerate() {
        let label = match k {
            0 => short(top),
            _ if k + 1 == SIZE[1] => short(bottom),
            _ => String::new(),
        };
        lines.push(format!("  {label:>9} |{row}").trim_end().to_owned());
    }
    let x_label = match first.axis {
        Axis::Space => "cell size (m)",
        Axis::Time => "time step (s)",
        Axis::Particles => "particle spacing (m)",
    };
    let (left, right) = (format_number(left), format_number(right));
    let gap = SIZE[0] - left.len();
    lines.push(format!("  {:>9} +{}", "", "-".repeat(SIZE[0])));
    lines.push(format!("  {:>9}  {left}{right:>gap$}  {}", "", x_label));
    lines.extend(key);
    if series.iter().flat_map(|(points, _)| points).any(|point| !point.counts) {
        lines.push(format!("  {EXCLUDED}  levels that do not count for the order"));
    }
    Some(lines.join("\n") + "\n")
}

/// A level: logarithms of spacing and error.
struct PlottedLevel {
    at: [f64; 2],
    counts: bool,
}

fn points(study: &Convergence) -> Vec<PlottedLevel> {
    let point = |row: LevelRow<'_>| {
        let [spacing, error] = [row.level().spacing, row.level().error];
        let at = [libm::log10(spacing), libm::log10(error)];
        at.iter().all(|x| x.is_finite()).then(|| PlottedLevel { at, counts: row.counts() })
    };
    level::rows(study).filter_map(point).collect()
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

    /// Puts a mark at a dot, unless another mark is there.
    fn mark(&mut self, [x, y]: [usize; 2], mark: char) {
        self.marks[y / DOTS[1]][x / DOTS[0]].get_or_insert(mark);
    }

    /// Returns the rows from top to bottom.
    fn rows(&self) -> Vec<String> {
        let braille = |bits: u32| char::from_u32(0x2800 + bits).filter(|_| bits > 0);
        let row = |(dots, marks): (&[u32; SIZE[0]], &[Option<char>; SIZE[0]])| {
            let cell = |(bits, mark): (&u32, &Option<char>)| mark.or(braille(*bits)).unwrap_or(' ');
            dots.iter().zip(marks).map(cell).collect()
        };
        self.dots.iter().zip(&self.marks).rev().map(row).collect()
    }
}
