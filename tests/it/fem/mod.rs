//! Tests of properties that theory guarantees for the finite element method.

mod convergence;
mod equilibrium;

use mpm_verify::fem::{Bar, BarSetup, Element, Mass, Sampling};
use mpm_verify::subject::{Samples, Start, Subject};
use std::f64::consts::PI;

/// Creates a bar at rest: fixed on the left, free on the right, `P = E (F - 1)`.
fn bar_at_rest(length: f64, young: f64, density: f64) -> BarSetup {
    BarSetup {
        from: 0.0,
        to: length,
        cells: 8,
        element: Element::Linear,
        mass: Mass::Lumped,
        density,
        law: Box::new(move |def_grad| young * (def_grad - 1.0)),
        fixed: [true, false],
        body_force: None,
        traction: [None, None],
        initial_displacement: Box::new(|_| 0.0),
        initial_velocity: Box::new(|_| 0.0),
        start: Start::HalfStepBack,
        sampling: Sampling::Inside,
    }
}

/// Creates the vibrating bar of Wobbes & Tielen (2015): wave speed 10 m/s, a quarter wave in 25 m.
fn vibrating_bar(cells: usize, element: Element, mass: Mass) -> BarSetup {
    let initial_velocity = Box::new(|x| 0.1 * libm::sin(PI * x / 50.0));
    BarSetup { cells, element, mass, initial_velocity, ..bar_at_rest(25.0, 100.0, 1.0) }
}

/// Runs to `until` with equal steps of at most `dt`.
fn run(setup: BarSetup, until: f64, dt: f64) -> Bar {
    let mut bar = Bar::new(setup).unwrap();
    let steps = libm::ceil(until / dt - 1e-6);
    for _ in 0..steps as usize {
        bar.step(until / steps).unwrap();
    }
    bar
}

/// Returns the root mean square of `u - exact`.
fn rms(bar: &Bar, sampling: Sampling, exact: impl Fn(f64) -> f64) -> f64 {
    let mut samples = Samples::default();
    bar.sample_as(sampling, &mut samples);
    let errors = samples.label.iter().zip(&samples.displacement).map(|(&x, u)| u - exact(x));
    let square: f64 = errors.zip(&samples.weight).map(|(e, weight)| weight * e * e).sum();
    libm::sqrt(square / samples.weight.iter().sum::<f64>())
}

/// Computes the orders between consecutive errors. From each error to the next, h or dt is halved.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| libm::log2(pair[0] / pair[1])).collect()
}
