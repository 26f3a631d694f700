//! Checks that `docs/columns.md` lists all declared columns and no others.

use super::{
    TableColumn, cost, force, level, number, scientific, spectrum, stability, timed_level,
};
use crate::verify::{Axis, Quantity, Ranking, StabilityStudy};

const DOCUMENT: &str = include_str!("../../../docs/columns.md");

/// Creates a section of the document: one row for each column, without duplicates between tables.
fn section<R>(title: &str, tables: Vec<Vec<TableColumn<'_, R>>>) -> String {
    let mut rows = vec!["| column | JSON key | meaning |".to_owned(), "|---|---|---|".to_owned()];
    for column in tables.into_iter().flatten() {
        let code = |text: &str| match text {
            "" => String::new(),
            text => format!("`{text}`"),
        };
        let row =
            format!("| {} | {} | {} |", code(&column.heading), code(column.key), column.about);
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    format!("## {title}\n\n{}\n", rows.join("\n"))
}

#[test]
fn the_document_lists_the_columns() {
    let levels = vec![
        vec![level::name(Axis::Space), level::judged(), level::order()],
        level::largest_error(Quantity::Displacement).into(),
        vec![level::velocity()],
        level::counters(),
        level::energy_rate().into(),
        level::json_columns(),
    ];
    let study = StabilityStudy {
        swept: "VALUE".to_owned(),
        sought: Some("LIMIT".to_owned()),
        figures: Vec::new(),
        rows: Vec::new(),
    };
    let stability = vec![
        stability::trials(&study),
        stability::limits(&study, "LIMIT"),
        stability::json_columns(&study),
    ];
    let ranking = Ranking::new(String::new(), 1.0, &[], Vec::new());
    let cost = vec![cost::methods(&ranking), cost::json_columns(&ranking)];
    let timed = vec![timed_level::columns().into(), timed_level::json_columns()];
    let sections = [
        section("Levels of a convergence study (`levels`)", levels),
        section("Internal force (`forces`)", vec![force::columns().into()]),
        section("Rows of a stability study (`stability.rows`)", stability),
        section("Waves of a spectrum study (`spectrum`)", vec![spectrum::json_columns()]),
        section("Methods by cost (`cost.methods`)", cost),
        section("Exponents (`cost.methods.exponent`)", vec![cost::exponents()]),
        section("Timed levels of `mpm-verify cost` (`levels`)", timed),
    ];
    let (_, listed) = DOCUMENT.split_once("\n## ").expect("a section");
    let expected = sections.join("\n");
    assert_eq!(format!("## {listed}"), expected, "docs/columns.md must list:\n{expected}");
}

#[test]
fn numbers() {
    let values = [1.23456e-5, 0.0, -0.0, -2.5e12, 1e-300, f64::NAN, f64::INFINITY];
    let texts = ["1.235e-05", "0.000e+00", "0.000e+00", "-2.500e+12", "1.000e-300", "nan", "inf"];
    assert_eq!(values.map(scientific), texts);
}

#[test]
fn non_finite_numbers_are_strings_in_json() {
    let values = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.1];
    let texts = ["\"nan\"", "\"inf\"", "\"-inf\"", "0.1"];
    assert_eq!(values.map(|value| number(value).to_string()), texts);
}
