//! `mpm-verify estimate`.

use super::{BAD_INPUT, FAILED, Folder, SOUND};
use approx::assert_relative_eq;
use serde_json::{Value, json};

/// `1 + h + h^2` with six decimals.
const SERIES: &str = "h,u\n1,3.000000\n0.5,1.750000\n0.25,1.312500\n0.125,1.140625\n";

const TEXT: &str = "  series   4 levels
  order    1.35 [0.85, 1.85]
  limit    1.03 +- 1.4e-1, 95 %: [0.89, 1.17]
  finest   1.140625, 1.1e-1 from the limit
";

#[test]
fn a_series_in_a_file_or_at_standard_input_has_an_order_and_a_limit() {
    let folder = Folder::with("series.csv", SERIES);
    assert_eq!(folder.accepted(&["estimate", "series.csv"]), TEXT);
    for arguments in [&["estimate"][..], &["estimate", "-"]] {
        assert_eq!(folder.call_with_input(arguments, SERIES).ended(SOUND).out, TEXT);
    }
}

#[test]
fn json_has_the_intervals() {
    let folder = Folder::with("series.csv", SERIES);
    let document = folder.call(&["estimate", "series.csv", "--format", "json"]).ended(SOUND).json();
    // The limits of the triples are 1.3125 - 0.4375 7/13 and 1.140625 - 0.171875 11/17, and the
    // orders are log2(20/7) and log2(28/11).
    let (coarse, limit) = (1.3125 - 0.4375 * 7.0 / 13.0, 1.140_625 - 0.171_875 * 11.0 / 17.0);
    let [before, order] = [20.0 / 7.0, 28.0 / 11.0].map(libm::log2);
    let (half_width, scatter) = (3.0 * (coarse - limit), 3.0 * (before - order));
    for (key, value, half_width) in [("limit", limit, half_width), ("order", order, scatter)] {
        for (end, sign) in [("low", -1.0), ("value", 0.0), ("high", 1.0)] {
            let found = document["estimate"][key][end].as_f64().expect("a number");
            assert_relative_eq!(found, value + sign * half_width, max_relative = 1e-9);
        }
    }
    assert_eq!(document["estimate"]["finest"], 1.140_625);
    assert_eq!(document["estimate"]["confidence"], 0.95);
    assert_eq!(document["levels"][3], json!({"h": 0.125, "value": 1.140_625}));
    assert_eq!(document["refusal"], Value::Null);
}

#[test]
fn a_series_without_a_limit_is_refused_with_the_reason() {
    let folder = Folder::with("series", "4 1.000\n2 2.000\n1 1.500\n0.5 1.800\n");
    let answer = folder.call(&["estimate", "series"]).ended(FAILED);
    insta::assert_snapshot!(answer.out, @"
    series   4 levels
    refused  oscillation: the changes between the finest levels alternate in sign
    ");
    let document = folder.call(&["estimate", "series", "--format", "json"]).ended(FAILED).json();
    assert_eq!(document["refusal"]["reason"], "oscillation");
    assert_eq!(document["estimate"], Value::Null);
}

#[test]
fn invalid_input_is_reported_with_its_position() {
    let folder = Folder::with("series", "4 1.0\n2 x\n");
    let errors = folder.refused(&["estimate", "series"]);
    insta::assert_snapshot!(errors, @"
    error: expected a finite number as value, found `x`
     --> series:2:3
      |
    2 | 2 x
      |   ^
      |
      = help: each line has a spacing and a value, such as `0.125 1.0625`
    ");
    let errors = folder.refused(&["estimate", "no-such-file"]);
    assert!(errors.contains("cannot be read"), "{errors}");
    folder.write("other", [0xff, 0xfe]);
    assert_eq!(folder.call(&["estimate", "other"]).code, BAD_INPUT);
    assert_eq!(folder.call(&["estimate", "."]).code, BAD_INPUT);
    folder.write("good", SERIES);
    assert_eq!(folder.call(&["estimate", "good"]).code, SOUND);
}
