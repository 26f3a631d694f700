//! References on a fine grid, errors without order, and volumetric locking.

use crate::cli::BAR;
use crate::common::{cases, edited, errors};
use mpm_verify::verify::Convergence;
use rstest::rstest;

/// Creates a vibrating bar that is compared with its formula and with a run on 192 cells.
fn bar(dt: &str) -> String {
    let run = format!("{{until: 0.1, dt: \"{dt}\", instants: 4}}");
    let edits = [
        ("1e-3*sin", "1e-4*sin"),
        ("1e-3*sin", "1e-4*sin"),
        ("{until: 0.05, dt: 1e-3}", run.as_str()),
        ("run:", "reference: {same_method: {cells: 192}}\nrun:"),
        ("[4, 6, 8, 12]", "[8, 12, 16, 24]"),
        ("basis: linear,", "basis: [linear, cpgimp], start: half_step_back,"),
        ("mass: lumped", "mass: lumped, start: half_step_back"),
        ("observe: {at: [0.5]}", "judge: {norm: max_rms}"),
        ("[1.7, 2.3]", "[1.95, 2.05]"),
    ];
    edited(BAR, &edits)
}

fn order(study: &Convergence) -> f64 {
    study.judgement.order.expect("an order").value
}

/// The error of the fine grid is smaller by the square of the ratio of cell sizes. It varies within
/// each cell: at the labels of a level it is up to twice its mean.
#[test]
fn a_fine_grid_and_a_formula_give_the_same_order() {
    let cases = cases(&bar("h/40"));
    let truths = ["-vs-exact", "-vs-fine-grid"];
    for pair in cases.chunks(2) {
        let [exact, fine] = [0, 1].map(|k| {
            assert!(pair[k].case.ends_with(truths[k]), "{}", pair[k].case);
            assert_eq!(pair[k].failure(), "", "{}", pair[k].case);
            pair[k].convergence().unwrap()
        });
        let apart = order(fine) - order(exact);
        assert!(apart.abs() < 0.03, "{}: {apart}", pair[0].case);
        for (exact, fine) in exact.levels.iter().zip(&fine.levels) {
            let ratio = exact.cells as f64 / 192.0;
            let apart = (fine.error / exact.error - 1.0).abs();
            assert!(apart < 2.0 * ratio * ratio, "{}: {apart}", pair[0].case);
        }
    }
    assert_eq!(cases.len(), 6);
}

/// The time step is stable on the levels, but four times too long on the fine grid.
#[test]
fn a_case_without_its_fine_grid_is_refused() {
    for case in cases(&bar("0.5/240")) {
        let is_fine = case.case.ends_with("-vs-fine-grid");
        assert_eq!(is_fine, case.study.is_none(), "{}: {}", case.case, case.reason);
        assert_eq!(is_fine, case.reason.starts_with("reference: "), "{}", case.reason);
    }
}

/// A footing on stiff elastic soil under small loads. Strains are about 1e-4 and 1e-7, and with the
/// smaller one rounding of the stress limits the residual. Settlements are proportional to the
/// pressure, so errors divided by `q b/E` are equal up to the effect of domains that cross nodes.
#[test]
fn settlements_of_stiff_soil_are_proportional_to_the_load() {
    let footing = include_str!("../../../verification/soils/strip-footing-load-steps.yaml");
    let (footing, _) = footing.split_once("expect:").unwrap();
    let errors_under = |pressure: &str| {
        let edits = [
            ("E: 1000 ", "E: 1e8 "),
            ("c: 1 ", "c: 1e5 "),
            ("q: 5 ", pressure),
            ("same_method: {cells: 32}", "same_method: {cells: 64}"),
        ];
        cases(&edited(footing, &edits)).iter().flat_map(errors).collect::<Vec<f64>>()
    };
    let (large, small) = (errors_under("q: 1e4 "), errors_under("q: 10 "));
    assert_eq!(large.len(), 6);
    for (large, small) in large.iter().zip(&small) {
        assert!((large - small).abs() <= 5e-4, "{large:e} and {small:e}");
    }
}

/// Errors that are rounding errors have no order, except by chance.
#[test]
fn rounding_errors_need_no_expectation() {
    let block = include_str!("../../../verification/first-checks/translating-block.yaml");
    let (block, _) = block.split_once("\nexpect:").unwrap();
    for case in cases(block) {
        assert!(case.verdict == "at rounding" && !case.fails(), "{}: {}", case.case, case.reason);
        assert!(case.reason.contains("count as rounding: 4 of 4 levels"), "{}", case.reason);
    }
}

const SHEARS: &str =
    include_str!("../../../verification/equilibrium/two-shears-nearly-incompressible.yaml");

/// Returns the errors (m) of [`SHEARS`] on the levels `cells` with this Poisson's ratio.
fn errors_with(nu: &str, method: &str, cells: &str) -> Vec<f64> {
    let (suite, _) = SHEARS.split_once("methods:").expect("a list of methods");
    let (suite, _) = suite.split_once("any_method:").unwrap_or((suite, ""));
    assert!(suite.contains("nu: 0.4999"));
    let text = suite.replace("nu: 0.4999", &format!("nu: {nu}"));
    let levels = "cells: [8, 10, 12, 16], full: [24, 32]";
    assert!(text.contains(levels));
    let text = text.replace(levels, &format!("cells: [{cells}]"));
    let text = format!("{text}methods:\n  - mpm: {{{method}, start: half_step_back}}\n");
    errors(&cases(&text)[0])
}

#[rstest]
#[case::linear("basis: linear")]
#[case::domains("basis: cpdi")]
fn averaged_volume_ratios_prevent_locking(#[case] basis: &str) {
    let method = format!("{basis}, transfer: flip, scheme: musl");
    let compressible = errors_with("0.3", &method, "8, 16");
    let averaged = errors_with("0.4999", &format!("{method}, volume: averaged"), "8, 16");
    assert_eq!((compressible.len(), averaged.len()), (2, 2));
    for (averaged, compressible) in averaged.iter().zip(&compressible) {
        let ratio = averaged / compressible;
        assert!(ratio <= 1.2, "{basis}: {averaged:.3e} m is {ratio:.3} times {compressible:.3e} m");
    }
    let plain = errors_with("0.4999", &method, "16");
    let ratio = plain[0] / compressible[1];
    assert!(ratio > 1.2, "{basis}: without the average {ratio:.3} times");
}
