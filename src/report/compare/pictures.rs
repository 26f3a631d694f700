//! Errors that moved, as pictures before and after, for a comment that cannot hold drawings itself.
//!
//! Both are drawn on the same axes from the levels of the two documents.

use super::changes::{Moved, ReportComparison};
use super::document::{CaseDocument, LevelDocument, ReportDocument, name};
use super::escape::prose;
use super::number::JsonNumber;
use crate::report::Figure;
use crate::report::figure::study::{MOST_SERIES, slopes, spacing};
use crate::report::figure::{ConvergencePlot, Mark, PlotPoint, PlotSeries};
use crate::verify::{Axis, Quantity, judged_error};
use std::collections::BTreeMap;

/// Most suites that are drawn; the others are counted.
const MOST_PAIRS: usize = 12;

/// Width in a comment (px): two stand side by side, and each leads to itself in full.
const WIDTH: u32 = 400;

/// Longest part of a file's name that is the suite's.
const LONGEST_NAME: usize = 60;

/// Pictures of the suites whose errors moved, the most important first.
#[derive(Debug, Clone, PartialEq)]
pub struct Pictures {
    pairs: Vec<PicturePair>,
    /// Suites that are not drawn.
    more: usize,
}

/// A suite before and after.
#[derive(Debug, Clone, PartialEq)]
struct PicturePair {
    suite: String,
    figures: [Figure; 2],
    /// Descriptions, for readers who do not see them.
    texts: [String; 2],
    /// Cases that are not drawn.
    more: usize,
}

/// A case that moved, before and after.
type CasePair<'a> = [&'a CaseDocument; 2];

impl Pictures {
    /// Draws what [`compare`](super::compare()) has found between `old` and `new`.
    pub fn draw(found: &ReportComparison, old: &ReportDocument, new: &ReportDocument) -> Self {
        let before: BTreeMap<String, &CaseDocument> =
            old.cases().map(|(suite, case)| (name(suite, case), case)).collect();
        let after: BTreeMap<String, _> =
            new.cases().map(|found| (name(found.0, found.1), found)).collect();
        let mut suites: Vec<(&str, Vec<CasePair<'_>>)> = Vec::new();
        let has_error = |moved: &&Moved| moved.error.is_some();
        for Moved { name, .. } in found.moved.iter().filter(has_error) {
            let (Some(old), Some((suite, new))) = (before.get(name), after.get(name)) else {
                continue;
            };
            let at = suites.iter().position(|(known, _)| *known == suite.name);
            let at = at.unwrap_or_else(|| {
                suites.push((&suite.name, Vec::new()));
                suites.len() - 1
            });
            suites[at].1.push([old, new]);
        }
        let drawn = suites.iter().take(MOST_PAIRS).enumerate();
        Self {
            pairs: drawn.map(|(k, (suite, cases))| pair(k + 1, suite, cases)).collect(),
            more: suites.len().saturating_sub(MOST_PAIRS),
        }
    }

    /// The drawings, each with the name of its file.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.pairs.iter().flat_map(|pair| &pair.figures)
    }

    /// Tables that show the files side by side, which are found at the address `at`.
    pub(super) fn markdown(&self, at: &str) -> String {
        let mut page = String::new();
        if !self.pairs.is_empty() {
            page += "\n**Errors that moved, before and after on the same axes**\n";
        }
        for PicturePair { suite, figures, texts, more } in &self.pairs {
            let image = |k: usize| {
                let address = address(at, &figures[k].file);
                let text = prose(&texts[k]);
                format!("<img src=\"{address}\" alt=\"{text}\" width=\"{WIDTH}\">")
            };
            let suite = prose(suite);
            page += &format!("\n| {suite}, before | {suite}, after |\n| --- | --- |\n");
            page += &format!("| {} | {} |\n", image(0), image(1));
            if *more > 0 {
                page += &format!("\nand {more} more cases of this suite\n");
            }
        }
        if self.more > 0 {
            page += &format!("\nand {} more suites\n", self.more);
        }
        page
    }
}

fn pair(number: usize, suite: &str, cases: &[CasePair<'_>]) -> PicturePair {
    let drawn = &cases[..cases.len().min(MOST_SERIES)];
    let sides = [(0, "before"), (1, "after")];
    let plots = sides.map(|(side, word)| plot(format!("{suite}, {word}"), drawn, side));
    PicturePair {
        suite: suite.to_owned(),
        figures: sides.map(|(side, word)| Figure {
            file: format!("{number:02}-{}-{word}.svg", file_name(suite)),
            svg: plots[side].to_svg_beside(&[&plots[0], &plots[1]]),
        }),
        texts: sides.map(|(side, word)| text(suite, word, drawn, side)),
        more: cases.len() - drawn.len(),
    }
}

fn plot(title: String, cases: &[CasePair<'_>], side: usize) -> ConvergencePlot {
    let series = |(look, pair): (usize, &CasePair<'_>)| PlotSeries {
        name: pair[side].name.clone(),
        look,
        points: pair[side].levels.iter().map(point).collect(),
    };
    let [_, first] = cases[0];
    let axis = Axis::ALL.iter().find(|axis| first.axis.as_deref() == Some(axis.name()));
    let judged = first.judge.as_ref().and_then(|judge| {
        let scale = judge.scale.map(|JsonNumber(scale)| scale);
        Some(judged_error(&judge.norm, Quantity::named(&judge.of)?, scale))
    });
    ConvergencePlot {
        title,
        x_label: axis.map_or("spacing", |axis| spacing(*axis)).to_owned(),
        y_label: judged.unwrap_or_else(|| "error".to_owned()),
        series: cases.iter().enumerate().map(series).collect(),
        reference_orders: slopes_before(cases),
    }
}

fn point(level: &LevelDocument) -> PlotPoint {
    let JsonNumber(h) = level.spacing;
    let mark = match level {
        _ if level.is_broken() => Mark::Failed,
        LevelDocument { crossings: Some(1..), .. } => Mark::Crossing,
        LevelDocument { counts: Some(false), .. } => Mark::OutsideWindow,
        _ => Mark::Window,
    };
    PlotPoint { h, error: level.error().unwrap_or(f64::NAN), mark }
}

/// Slopes of the orders that were observed before, to hold both pictures against.
fn slopes_before(cases: &[CasePair<'_>]) -> Vec<f64> {
    let order = |[old, _]: &CasePair<'_>| {
        let order = old.observed_order.filter(|_| old.verdict == "converging")?;
        Some(order.value.0)
    };
    slopes(cases.iter().filter_map(order))
}

/// The errors of the finest levels that count, in words.
fn text(suite: &str, word: &str, cases: &[CasePair<'_>], side: usize) -> String {
    let finest = |pair: &CasePair<'_>| {
        let CaseDocument { name, levels, .. } = pair[side];
        let counts = |level: &&LevelDocument| level.counts != Some(false);
        let level = levels.iter().rfind(counts).or(levels.last());
        let error = level.and_then(LevelDocument::error);
        error.map_or_else(|| format!("{name} failed"), |error| format!("{name} {error:.2e}"))
    };
    let finest: Vec<String> = cases.iter().map(finest).collect();
    format!("{suite} {word}: error on the finest level of {}", finest.join(", "))
}

/// The part of a file's name that tells the suite, which any folder and any address can have.
fn file_name(suite: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    suite.chars().take(LONGEST_NAME).map(plain).collect()
}

/// Address of a file, in which nothing ends an attribute of HTML or a cell.
fn address(at: &str, file: &str) -> String {
    let escaped = |byte: u8| match byte {
        b'&' => "&amp;".to_owned(),
        b if b.is_ascii_alphanumeric() || b"-._~:/?#@!$()*+,;=%".contains(&b) => {
            char::from(b).to_string()
        }
        b => format!("%{b:02X}"),
    };
    let folder = at.strip_suffix('/').unwrap_or(at);
    format!("{folder}/{file}").bytes().map(escaped).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::compare::{TOLERANCE, compare, illustrated};
    use rstest::rstest;
    use serde_json::{Value, json};

    /// A case that converges over two levels towards the error `finest`.
    fn case(name: &str, finest: f64) -> Value {
        let level = |cells: u32, error: f64| {
            let h = 1.0 / f64::from(cells);
            json!({"cells": cells, "h": h, "spacing": h, "transfers": 1, "judged": error})
        };
        json!({"case": name, "verdict": "converging", "passed": true, "axis": "space",
            "judge": {"of": "displacement", "norm": "rms", "scale": null},
            "observed_order": {"value": 2.02}, "levels": [level(10, 0.01), level(20, finest)]})
    }

    fn document(suites: &[(&str, Vec<Value>)]) -> ReportDocument {
        let suites = suites.iter().map(|(suite, cases)| json!({"suite": suite, "cases": cases}));
        let text = json!({ "suites": suites.collect::<Vec<_>>() }).to_string();
        ReportDocument::read(&text).expect("a document")
    }

    fn drawn(old: &ReportDocument, new: &ReportDocument) -> (String, Pictures) {
        let found = compare(old, new, TOLERANCE);
        let pictures = Pictures::draw(&found, old, new);
        (illustrated(&found, &pictures, "https://example.org/pictures/"), pictures)
    }

    /// Everything of a drawing but lines and markers of its series, and the title.
    fn setting(svg: &str) -> Vec<&str> {
        let of_series = |line: &&str| {
            line.contains("#0072b2") || line.contains("before") || line.contains("after")
        };
        svg.lines().filter(|line| !of_series(line)).collect()
    }

    #[test]
    fn only_what_moved_is_drawn_and_on_the_same_axes() {
        let old = document(&[
            ("bar", vec![case("same", 2.5e-3), case("moved", 2.5e-3)]),
            ("beam", vec![case("same", 2.5e-3)]),
        ]);
        let new = document(&[
            ("bar", vec![case("same", 2.5e-3), case("moved", 1e-6)]),
            ("beam", vec![case("same", 2.5e-3)]),
        ]);
        let (page, pictures) = drawn(&old, &new);
        let [before, after] = [0, 1].map(|k| pictures.figures().nth(k).expect("a picture"));
        assert_eq!(pictures.figures().count(), 2);
        assert_eq!([&before.file, &after.file], ["01-bar-before.svg", "01-bar-after.svg"]);
        assert_eq!(setting(&before.svg), setting(&after.svg));
        assert_ne!(before.svg, after.svg);
        assert!(!before.svg.contains("same") && before.svg.contains("rms error of displacement"));
        let row = "| <img src=\"https://example.org/pictures/01-bar-before.svg\" \
            alt=\"bar before&#58; error on the finest level of moved 2.50e-3\" width=\"400\"> | \
            <img src=\"https://example.org/pictures/01-bar-after.svg\" ";
        assert!(page.contains(row), "{page}");
        assert_eq!(drawn(&old, &new), (page, pictures));
    }

    /// A level that breaks has an arrow, and both drawings leave place for it.
    #[test]
    fn a_level_that_broke_is_marked() {
        let mut broken = case("a", 2.5e-3);
        broken["levels"][1]["failure"] = json!("inverted");
        let (old, new) =
            (document(&[("bar", vec![case("a", 2.5e-3)])]), document(&[("bar", vec![broken])]));
        let (page, pictures) = drawn(&old, &new);
        let svgs: Vec<&str> = pictures.figures().map(|figure| figure.svg.as_str()).collect();
        assert!(svgs.iter().all(|svg| svg.contains("failed or not finite")));
        assert!(
            page.contains("alt=\"bar after&#58; error on the finest level of a failed\""),
            "{page}"
        );
    }

    #[test]
    fn what_is_left_out_is_counted() {
        let names: Vec<String> = (0..MOST_PAIRS + 3).map(|k| format!("bar-{k}")).collect();
        let of = |finest: f64| {
            let cases = |k: usize| (0..=k).map(|j| case(&format!("c{j}"), finest)).collect();
            let suites: Vec<(&str, Vec<Value>)> = names
                .iter()
                .enumerate()
                .map(|(k, name)| (name.as_str(), cases(8 * usize::from(k == 0))))
                .collect();
            document(&suites)
        };
        let (page, pictures) = drawn(&of(2.5e-3), &of(3e-3));
        assert_eq!(pictures.figures().count(), 2 * MOST_PAIRS);
        assert!(page.contains("\nand 3 more cases of this suite\n"), "{page}");
        assert!(page.contains("\nand 3 more suites\n"), "{page}");
    }

    #[rstest]
    #[case("../../etc/passwd", "______etc_passwd")]
    #[case("a|b\" onerror=\"x", "a_b__onerror__x")]
    #[case("", "")]
    fn names_are_safe(#[case] suite: &str, #[case] part: &str) {
        let of = |finest: f64| document(&[(suite, vec![case("<b>", finest)])]);
        let (page, pictures) = drawn(&of(2.5e-3), &of(3e-3));
        let file = format!("01-{part}-before.svg");
        assert_eq!(pictures.figures().next().map(|figure| &figure.file), Some(&file));
        let row = page.lines().find(|line| line.contains("<img")).expect("a row of pictures");
        assert_eq!((row.matches('|').count(), row.matches('"').count()), (3, 12), "{row}");
    }

    #[rstest]
    #[case("https://example.org/a?b=1&c", "https://example.org/a?b=1&amp;c/f.svg")]
    #[case("a \"b\"|<c>", "a%20%22b%22%7C%3Cc%3E/f.svg")]
    #[case("ü/", "%C3%BC/f.svg")]
    fn addresses(#[case] at: &str, #[case] expected: &str) {
        assert_eq!(address(at, "f.svg"), expected);
    }
}
