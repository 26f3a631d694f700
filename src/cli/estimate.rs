//! `mpm-verify estimate`: estimates the order and the limit of a series of values.

use super::arguments::FormatArgs;
use super::output::{self, CommandError, Status};
use clap::Args;
use mpm_verify::suite::yaml::Diagnostic;
use mpm_verify::verify::{
    EstimateRefusal, Interval, LEVELS_OF_ESTIMATE, LimitEstimate, SeriesPoint, estimate_limit,
};
use serde_json::{Value, json};
use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct EstimateArgs {
    /// File with a spacing and a value on each line, separated by spaces, a tab, a comma or a
    /// semicolon; a heading and comments (`#`) are allowed. With the heading `cells`, the first
    /// number is the number of cells, and the spacing is its inverse. Default, or `-`: standard
    /// input
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Maximum size of the input (bytes).
const LONGEST: u64 = 1 << 20;

const FORMAT_HELP: &str = "each line has a spacing and a value, such as `0.125 1.0625`";

pub(super) fn estimate(args: &EstimateArgs) -> Result<Status, CommandError> {
    let (name, text) = read(args.file.as_deref())?;
    let lines = parse(&name, &text)?;
    let series: Vec<SeriesPoint> = lines.iter().map(|line| line.point).collect();
    let result = estimate_limit(&series);
    output::print(&if args.format.is_json() {
        serde_json::to_string_pretty(&as_json(&series, &result)).unwrap_or_default() + "\n"
    } else {
        as_text(&series, &result)
    });
    Ok(if result.is_ok() { Status::Passed } else { Status::Failed })
}

fn read(file: Option<&Path>) -> Result<(String, String), Diagnostic> {
    let file = file.filter(|file| file.as_os_str() != "-");
    let name = file.map_or_else(|| "<stdin>".to_owned(), |file| file.display().to_string());
    let failed = |error: &dyn std::fmt::Display| {
        Diagnostic::about(&name, &format!("cannot be read: {error}"))
    };
    let mut reader: Box<dyn Read> = match file {
        Some(file) => Box::new(std::fs::File::open(file).map_err(|error| failed(&error))?),
        None => Box::new(io::stdin().lock()),
    };
    let mut bytes = Vec::new();
    reader.by_ref().take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| failed(&error))?;
    if bytes.len() as u64 > LONGEST {
        let diagnostic = Diagnostic::about(&name, "the series is larger than 1 MB");
        return Err(diagnostic.with_help(FORMAT_HELP));
    }
    let text = String::from_utf8(bytes).map_err(|error| failed(&error))?;
    Ok((name, text))
}

/// A line of the input, with the byte range of its spacing.
struct InputLine {
    point: SeriesPoint,
    spacing: Range<usize>,
}

fn parse(file: &str, text: &str) -> Result<Vec<InputLine>, Diagnostic> {
    let mut lines: Vec<InputLine> = Vec::new();
    let mut is_first = true;
    // Whether the heading names the first column as a number of cells, not as a spacing.
    let mut is_count = false;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let content = line.split('#').next().unwrap_or_default();
        let fields = fields(content, start);
        start += line.len();
        if fields.is_empty() {
            continue;
        }
        let is_heading = std::mem::take(&mut is_first)
            && fields.iter().all(|field| text[field.clone()].parse::<f64>().is_err());
        if is_heading {
            let name = text[fields[0].clone()].to_lowercase();
            is_count = ["cells", "elements", "n"].contains(&name.as_str());
            continue;
        }
        let at = |range: &Range<usize>, message: &str| {
            Diagnostic::at(file, text, range.clone(), message).with_help(FORMAT_HELP)
        };
        let [spacing, value] = fields.as_slice() else {
            let whole = fields[0].start..fields[fields.len() - 1].end;
            let message =
                format!("expected two fields, a spacing and a value; found {}", fields.len());
            return Err(at(fields.get(2).unwrap_or(&whole), &message));
        };
        let number = |range: &Range<usize>, what: &str| {
            let known = text[range.clone()].parse().ok().filter(|x: &f64| x.is_finite());
            known.ok_or_else(|| {
                let found = &text[range.clone()];
                at(range, &format!("expected a finite number as {what}, found `{found}`"))
            })
        };
        let h = number(spacing, "spacing")?;
        if h <= 0.0 {
            return Err(at(spacing, "expected a positive spacing"));
        }
        let h = if is_count { h.recip() } else { h };
        if let Some(other) = lines.iter().find(|other| other.point.h == h) {
            let first = text[..other.spacing.start].matches('\n').count() + 1;
            return Err(at(spacing, &format!("line {first} has the same spacing")));
        }
        let resolution = resolution(&text[value.clone()]);
        let point = SeriesPoint { h, value: number(value, "value")?, resolution };
        lines.push(InputLine { point, spacing: spacing.clone() });
    }
    if lines.is_empty() {
        return Err(Diagnostic::about(file, "the series has no level").with_help(FORMAT_HELP));
    }
    // The value with the most digits decides, because a program may omit trailing zeros.
    let units = lines.iter().map(|line| line.point.resolution);
    let unit = units.fold(f64::INFINITY, f64::min);
    for line in &mut lines {
        line.point.resolution = unit;
    }
    Ok(lines)
}

/// Returns the byte ranges of the fields of a line that begins at byte `start`. Spaces around a
/// comma or semicolon do not count, and two successive separators enclose an empty field.
fn fields(line: &str, start: usize) -> Vec<Range<usize>> {
    let is_mark = |c: char| matches!(c, ',' | ';');
    let range = |part: &str| {
        let is_quoted = |q| part.len() > 1 && part.starts_with(q) && part.ends_with(q);
        let part = if is_quoted('"') || is_quoted('\'') { &part[1..part.len() - 1] } else { part };
        let offset = part.as_ptr() as usize - line.as_ptr() as usize;
        start + offset..start + offset + part.len()
    };
    if line.trim().is_empty() {
        return Vec::new();
    }
    if line.contains(is_mark) {
        return line.split(is_mark).map(|part| range(part.trim())).collect();
    }
    line.split_whitespace().map(range).collect()
}

/// Returns the unit of the last printed digit, or zero for full double precision (16 digits).
fn resolution(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let digits = mantissa.chars().filter(char::is_ascii_digit).collect::<String>();
    if digits.trim_start_matches('0').len() >= 16 {
        return 0.0;
    }
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    libm::pow(10.0, f64::from(exponent) - decimals as f64)
}

fn as_text(series: &[SeriesPoint], result: &Result<LimitEstimate, EstimateRefusal>) -> String {
    let count = series.len();
    let used = if count > LEVELS_OF_ESTIMATE { ", the four finest are used" } else { "" };
    let level = if count == 1 { "level" } else { "levels" };
    let mut rows = vec![("series", format!("{count} {level}{used}"))];
    match result {
        Ok(estimate) => {
            let distance = (estimate.finest - estimate.limit.value).abs();
            rows.push(("order", estimate.order.shown()));
            rows.push(("limit", limit_shown(&estimate.limit)));
            rows.push(("finest", format!("{}, {distance:.1e} from the limit", estimate.finest)));
        }
        Err(refusal) => rows.push(("refused", refusal.to_string())),
    }
    let rows = rows.iter().map(|(key, value)| format!("  {key:<8} {value}"));
    rows.collect::<Vec<_>>().join("\n") + "\n"
}

/// Formats a limit to two digits of its half-width: `1.2346 +- 1.2e-3, 95 %: [1.2334, 1.2358]`.
fn limit_shown(limit: &Interval) -> String {
    let half_width = limit.half_width();
    let size = limit.value.abs().max(half_width);
    let exponent = libm::floor(libm::log10(size));
    let digits = 1.0 - libm::floor(libm::log10(half_width));
    let [value, low, high] = [limit.value, limit.low, limit.high].map(|x| {
        if (-4.0..6.0).contains(&exponent) {
            format!("{x:.*}", digits.clamp(0.0, 17.0) as usize)
        } else {
            format!("{x:.*e}", (exponent + digits).clamp(1.0, 16.0) as usize)
        }
    });
    format!("{value} +- {half_width:.1e}, 95 %: [{low}, {high}]")
}

fn as_json(series: &[SeriesPoint], result: &Result<LimitEstimate, EstimateRefusal>) -> Value {
    let levels: Vec<Value> =
        series.iter().map(|point| json!({"h": point.h, "value": point.value})).collect();
    let estimate = result.as_ref().ok().map(|estimate| {
        let LimitEstimate { order, limit, finest, .. } = estimate;
        json!({"order": order, "limit": limit, "finest": finest, "confidence": 0.95})
    });
    let refusal = result
        .as_ref()
        .err()
        .map(|refusal| json!({"reason": refusal.name(), "message": refusal.to_string()}));
    json!({"levels": levels, "estimate": estimate, "refusal": refusal})
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[test]
    fn the_resolution_is_one_unit_of_the_last_digit() {
        let numbers = ["1.25", "-1.25e-3", "125", "1E2", "0.0012500"];
        for (number, unit) in numbers.into_iter().zip([0.01, 1e-5, 1.0, 100.0, 1e-7]) {
            assert!((resolution(number) - unit).abs() <= 1e-12 * unit, "{number}");
        }
        assert_eq!(["1.2345678901234567", "0.01234567890123456"].map(resolution), [0.0; 2]);
    }

    #[rstest]
    #[case::spaces("  1 4\n0.5   2\n")]
    #[case::tabs("h\tu\n1\t4\n0.5\t2")]
    #[case::csv("h, u\n1,4\n 0.5 , 2\n")]
    #[case::semicolons("1;4\n\n0.5;2\n")]
    #[case::quotes("\"h\",\"u\"\n\"1\",\"4\"\n'0.5','2'\n")]
    #[case::cells("cells,u\n1,4\n2,2\n")]
    #[case::elements("\"Elements\" u\n1 4\n2 2\n")]
    #[case::comments("# a bar\n1 4 # coarse\r\n0.5 2\r\n")]
    fn formats_of_a_series(#[case] text: &str) {
        let lines = parse("a", text).unwrap();
        let pairs: Vec<[f64; 2]> =
            lines.iter().map(|line| [line.point.h, line.point.value]).collect();
        assert_eq!(pairs, [[1.0, 4.0], [0.5, 2.0]]);
    }

    #[rstest]
    #[case::no_number("1 4\n0.5 two\n", "a:2:5: expected a finite number as value, found `two`")]
    #[case::not_finite("1 nan\n", "a:1:3: expected a finite number as value, found `nan`")]
    #[case::one_field("1 4\n0.5\n", "a:2:1: expected two fields, a spacing and a value; found 1")]
    #[case::three_fields("1 4 7\n", "a:1:5: expected two fields, a spacing and a value; found 3")]
    #[case::empty_field("1,,4\n", "a:1:4: expected two fields, a spacing and a value; found 3")]
    #[case::negative("-1 4\n", "a:1:1: expected a positive spacing")]
    #[case::twice("1 4\n0.5 2\n1.0 3\n", "a:3:1: line 1 has the same spacing")]
    #[case::second_heading("h u\nh u\n", "a:2:1: expected a finite number as spacing, found `h`")]
    #[case::empty("\n# nothing\n", "a: the series has no level")]
    fn invalid_lines_are_reported_with_their_position(#[case] text: &str, #[case] expected: &str) {
        let error = parse("a", text).map(|lines| lines.len()).unwrap_err();
        assert_eq!(error.one_line(), expected);
    }

    #[test]
    fn value_with_the_most_digits_determines_the_resolution() {
        let lines = parse("a", "1 3\n0.5 1.75\n0.25 1.3125\n").unwrap();
        assert!(lines.iter().all(|line| (line.point.resolution - 1e-4).abs() < 1e-12));
    }

    #[rstest]
    #[case([1.234_56, 0.001_2], "1.2346 +- 1.2e-3, 95 %: [1.2334, 1.2358]")]
    #[case([-123_456.0, 7.0], "-123456.0 +- 7.0e0, 95 %: [-123463.0, -123449.0]")]
    #[case([1.5e6, 2e3], "1.5000e6 +- 2.0e3, 95 %: [1.4980e6, 1.5020e6]")]
    #[case([1.5e-7, 2e-9], "1.500e-7 +- 2.0e-9, 95 %: [1.480e-7, 1.520e-7]")]
    fn an_interval_has_the_digits_of_its_width(#[case] size: [f64; 2], #[case] expected: &str) {
        let [value, half_width] = size;
        let limit = Interval { value, low: value - half_width, high: value + half_width };
        assert_eq!(limit_shown(&limit), expected);
    }
}
