//! Orders in space, on the vibrating bar.

use std::f64::consts::PI;

use rstest::rstest;

use super::{orders, rms, run, vibrating_bar};
use crate::fem::Element::{Linear, Quadratic};
use crate::fem::Mass::{Consistent, Lumped};
use crate::fem::Sampling::{Inside, Nodes};
use crate::fem::{Element, Mass, Sampling};

/// `u = v0/w sin(pi X / (2L)) sin(w t)`.
fn exact(x: f64, t: f64) -> f64 {
    let omega = PI / 50.0 * 10.0;
    0.1 / omega * libm::sin(PI * x / 50.0) * libm::sin(omega * t)
}

const UNTIL: f64 = 0.5;

/// With this step the error in time is below 1e-12 m, a third of the smallest nodal error met
/// here, 3e-12 m (quadratic elements, 64 of them); inside the elements 3e-9 m is the smallest.
const DT: f64 = 2e-5;

/// Order k + 1 inside the elements; 2k at the nodes. Lumping costs the quadratic element nothing,
/// because it is the quadrature of its Lobatto points, which integrates the mass to degree
/// 2k - 1: enough for the order of the frequencies, 2k (Fried & Malkus, *Int. J. Solids Struct.*
/// 11, 1975).
#[rstest]
#[case(Linear, Lumped, Inside, 2.0)]
#[case(Linear, Consistent, Inside, 2.0)]
#[case(Quadratic, Lumped, Inside, 3.0)]
#[case(Quadratic, Consistent, Inside, 3.0)]
#[case(Linear, Lumped, Nodes, 2.0)]
#[case(Linear, Consistent, Nodes, 2.0)]
#[case(Quadratic, Lumped, Nodes, 4.0)]
#[case(Quadratic, Consistent, Nodes, 4.0)]
fn the_vibrating_bar_shows_the_formal_order(
    #[case] element: Element,
    #[case] mass: Mass,
    #[case] sampling: Sampling,
    #[case] formal: f64,
) {
    let error = |cells| {
        let bar = run(vibrating_bar(cells, element, mass), UNTIL, DT);
        rms(&bar, sampling, |x| exact(x, UNTIL))
    };
    let observed = orders(&[4, 8, 16, 32, 64].map(error));
    println!("{element:?} {mass:?} {sampling:?} {observed:.2?}");
    // The first pair is not asymptotic at the nodes of lumped quadratic elements.
    for order in &observed[1..] {
        assert!((order - formal).abs() < 0.25, "{observed:?}");
    }
    assert!((observed[3] - formal).abs() < 0.05, "{observed:?}");
}
