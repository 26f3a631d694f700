//! The tables of docs/dispersion.md: phase error, damping and stability limit of each method.

use mpm_verify::mpm::{SchemeName, Spline, WaveMethod, WaveTransfer};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

const PAGE: &str = "docs/dispersion.md";

/// Courant number of the tables.
const COURANT: f64 = 0.4;

/// Relative phase error for which the table of wavelengths is computed.
const PHASE_ERROR: f64 = 0.01;

/// Maximum change of the amplitude in a period that counts as rounding.
const NO_DAMPING: f64 = 1e-9;

const SPLINES: [(&str, Spline); 3] =
    [("linear", Spline::Linear), ("quadratic", Spline::Quadratic), ("cubic", Spline::Cubic)];

const SCHEMES: [(&str, SchemeName); 2] = [("MUSL", SchemeName::Musl), ("USL", SchemeName::Usl)];

/// Transfers in the rows of the tables.
const TRANSFERS: [(&str, WaveTransfer); 8] = [
    ("FLIP", WaveTransfer::Flip),
    ("FLIP, 5 % PIC", WaveTransfer::Blend(0.95)),
    ("PIC", WaveTransfer::Pic),
    ("APIC", WaveTransfer::Apic),
    ("XPIC(2)", WaveTransfer::Xpic(2)),
    ("XPIC(5)", WaveTransfer::Xpic(5)),
    ("FMPM(2)", WaveTransfer::Fmpm(2)),
    ("FMPM(4)", WaveTransfer::Fmpm(4)),
];

/// A column of a table: its heading, and the function that returns the text of a cell.
type Column<'a> = (String, Box<dyn Fn(&WaveMethod) -> String + 'a>);

/// Lists methods with two particles per cell, for any basis. FLIP with a consistent mass matrix has
/// the same step under all schemes.
fn methods() -> Vec<(String, WaveMethod)> {
    let method = |transfer, scheme| WaveMethod {
        spline: Spline::Linear,
        ppc: 2,
        shift: 0.0,
        transfer,
        scheme,
    };
    let lumped = TRANSFERS.iter().flat_map(|(name, transfer)| {
        SCHEMES.iter().map(move |(scheme_name, scheme)| {
            (format!("{name}, {scheme_name}"), method(*transfer, *scheme))
        })
    });
    let consistent = method(WaveTransfer::FlipConsistent, SchemeName::Musl);
    lumped.chain([("FLIP, consistent mass".to_owned(), consistent)]).collect()
}

/// Creates a table with a row for each method.
fn table(columns: &[Column<'_>]) -> String {
    let heads: Vec<&str> = columns.iter().map(|(head, _)| head.as_str()).collect();
    let mut table =
        format!("\n| method | {} |\n|---|{}\n", heads.join(" | "), "--:|".repeat(columns.len()));
    for (name, method) in methods() {
        let cells: Vec<String> = columns.iter().map(|(_, cell)| cell(&method)).collect();
        table += &format!("| {name} | {} |\n", cells.join(" | "));
    }
    table
}

/// Creates a column for each basis.
fn by_basis<'a>(cell: impl Fn(&WaveMethod) -> String + Copy + 'a) -> Vec<Column<'a>> {
    let column = |(name, spline): (&str, Spline)| -> Column<'a> {
        (name.to_owned(), Box::new(move |method| cell(&WaveMethod { spline, ..*method })))
    };
    SPLINES.map(column).into()
}

fn cells_per_wavelength() -> String {
    table(&by_basis(|method| {
        let cells = method.cells_for_phase_error(COURANT, PHASE_ERROR);
        cells.map_or("-".to_owned(), |cells| format!("{cells:.1}"))
    }))
}

/// Creates a table of amplitudes in per cent, at two Courant numbers.
fn amplitudes(cells: f64) -> String {
    let mut columns = Vec::new();
    for courant in [COURANT, 0.5 * COURANT] {
        for (name, spline) in SPLINES {
            let cell = move |method: &WaveMethod| {
                let step = WaveMethod { spline, ..*method }.step(TAU / cells);
                let kept = step.kept_per_period(courant);
                if (kept - 1.0).abs() < NO_DAMPING {
                    return "-".to_owned();
                }
                format!("{:.1}", 100.0 * kept)
            };
            let column: Column<'_> = (format!("{name}, C = {courant}"), Box::new(cell));
            columns.push(column);
        }
    }
    table(&columns)
}

fn limits() -> String {
    table(&by_basis(|method| format!("{:.3}", method.stability_limit())))
}

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE)
}

/// Returns the current page and the generated page.
fn page() -> (String, String) {
    let page = std::fs::read_to_string(path()).expect(PAGE);
    let tables = [
        ("cells per wavelength", cells_per_wavelength()),
        ("amplitude of 8 cells", amplitudes(8.0)),
        ("amplitude of 16 cells", amplitudes(16.0)),
        ("stability limit", limits()),
    ];
    let expected = tables
        .iter()
        .fold(page.clone(), |page, (name, table)| super::with_table(&page, name, table));
    (page, expected)
}

#[test]
fn page_of_dispersion_is_up_to_date() {
    let (page, expected) = page();
    assert!(page == expected, "{PAGE} is stale: run ci/pages");
}

#[test]
#[ignore = "ci/pages runs it"]
fn the_page_of_dispersion_is_written() {
    std::fs::write(path(), page().1).expect("a page is written");
}
