//! Parameters given as a table.

use super::samples::BAR;
use super::{load, refused};
use mpm_verify::suite::Extent;
use rstest::rstest;

/// Creates a bar whose amplitude is a table instead of a number.
fn edited(table: &str) -> String {
    BAR.replace("v0: 0.1", &format!("v0: {table}"))
}

#[rstest]
#[case::a_row_of_three("{by: L, table: [[0, 1], ▸[50, 1, 1]]}", &["this row does not have two numbers", "expected a value of `L` and the value of the parameter"])]
#[case::one_row("{by: L, table: ▸[[0, 1]]}", &["a table needs at least two rows", "for a constant parameter, write a number"])]
#[case::rows_out_of_order("{by: L, table: [[50, 1], [▸0, 1]]}", &["0 follows 50", "expected rows in ascending order"])]
#[case::a_row_twice("{by: L, table: [[50, 1], [▸50, 1]]}", &["50 follows 50"])]
#[case::an_infinite_value("{by: L, table: [[0, 1], [1, ▸1/0]]}", &["not finite"])]
#[case::a_text("{by: L, table: [[0, 1], [1, ▸gg]]}", &["unknown name `gg`"])]
#[case::by_itself("{by: ▸v0, table: [[0, 1], [1, 2]]}", &["the table of `v0` depends on `v0` itself"])]
#[case::by_a_later_parameter("{by: ▸omega, table: [[0, 1], [1, 2]]}", &["unknown name `omega`", "declared further down"])]
#[case::by_a_formula("{by: ▸\"2*L\", table: [[0, 1], [1, 2]]}", &["`2*L` is not a name"])]
#[case::another_key("{by: L, ▸rows: [[0, 1], [1, 2]]}", &["unknown key `rows`", "`table`"])]
#[case::a_list("▸[1, 2]", &["a number, a formula, or `{by: t, table: [[0, 0], [0.1, 1]]}`"])]
fn a_table_with(#[case] table: &str, #[case] words: &[&str]) {
    refused(&edited(table), &[], words);
}

#[rstest]
#[case::by_a_parameter("{by: L, table: [[0, 0], [50, 0.2]]}", Some(0.1))]
#[case::with_formulas_in_its_rows(
    "{by: L, table: [[\"L/2\", \"E/1000\"], [\"2*L\", 0.1]]}",
    Some(0.1)
)]
#[case::by_a_variable("{by: X, table: [[0, 0.1], [50, 0.1]]}", None)]
fn a_table_has_a_value(#[case] table: &str, #[case] value: Option<f64>) {
    let suite = load(&edited(table)).unwrap();
    let declared = suite.parameters.iter().find(|(name, ..)| name == "v0").unwrap();
    assert_eq!(declared.2, value);
}

#[test]
fn a_table_gives_each_level_its_step() {
    let table = "0.1\n  pace: {by: h, table: [[0, 0], [5, 5e-3]]}";
    let suite = load(&edited(table).replace("dt: 1e-3", "dt: pace")).unwrap();
    let plan = suite.convergence().unwrap();
    for level in plan.refine.levels(Extent::Usual) {
        assert!((level.dt / (1e-3 * level.h) - 1.0).abs() < 1e-12, "{level:?}");
    }
}
