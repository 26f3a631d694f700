//! Volumetric locking: compares the errors of one motion for two Poisson's ratios, level by level.

use crate::common;
use rstest::rstest;

const SHEARS: &str =
    include_str!("../../../verification/equilibrium/two-shears-nearly-incompressible.yaml");

/// Returns the errors (m) on the levels `cells` of the suite with this Poisson's ratio, without
/// expectations.
fn errors(nu: &str, method: &str, cells: &str) -> Vec<f64> {
    let (suite, _) = SHEARS.split_once("methods:").expect("a list of methods");
    let (suite, _) = suite.split_once("any_method:").unwrap_or((suite, ""));
    assert!(suite.contains("nu: 0.4999"));
    let text = suite.replace("nu: 0.4999", &format!("nu: {nu}"));
    let levels = "cells: [8, 10, 12, 16], full: [24, 32]";
    assert!(text.contains(levels));
    let text = text.replace(levels, &format!("cells: [{cells}]"));
    let text = format!("{text}methods:\n  - mpm: {{{method}, start: half_step_back}}\n");
    common::errors(&common::cases(&text)[0])
}

#[rstest]
#[case::linear("basis: linear")]
#[case::domains("basis: cpdi")]
fn averaged_volume_ratios_prevent_locking(#[case] basis: &str) {
    let method = format!("{basis}, transfer: flip, scheme: musl");
    let compressible = errors("0.3", &method, "8, 16");
    let averaged = errors("0.4999", &format!("{method}, volume: averaged"), "8, 16");
    assert_eq!((compressible.len(), averaged.len()), (2, 2));
    for (averaged, compressible) in averaged.iter().zip(&compressible) {
        let ratio = averaged / compressible;
        assert!(ratio <= 1.2, "{basis}: {averaged:.3e} m is {ratio:.3} times {compressible:.3e} m");
    }
    let plain = errors("0.4999", &method, "16");
    let ratio = plain[0] / compressible[1];
    assert!(ratio > 1.2, "{basis}: without the average {ratio:.3} times");
}
