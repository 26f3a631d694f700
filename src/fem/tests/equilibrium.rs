//! Forces that cancel, forces that add up, and what is reported beside them.

use approx::assert_relative_eq;
use rstest::rstest;

use super::{bar_at_rest, run};
use crate::fem::{Bar, BarSetup, Element, Mass, Sampling, pointwise};
use crate::subject::{Samples, Subject};

const STRETCH: f64 = 1.3;

fn neo_hookean(def_grad: f64) -> f64 {
    50.0 * (def_grad - 1.0 / def_grad)
}

/// The patch test: a uniform strain, held by its own stress, is in the discrete space.
#[rstest]
fn a_uniform_stretch_stays(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
    #[values([true, false], [false, true], [false, false])] fixed: [bool; 2],
) {
    let held_at = if fixed[1] { 2.0 } else { 0.0 };
    let stretched = move |x| (STRETCH - 1.0) * (x - held_at);
    let pull = |fixed: bool| -> Option<crate::fem::TimeFunction> {
        (!fixed).then(|| Box::new(|_| neo_hookean(STRETCH)) as _)
    };
    let bar = run(
        BarSetup {
            element,
            mass,
            fixed,
            law: Box::new(neo_hookean),
            traction: fixed.map(pull),
            initial_displacement: Box::new(stretched),
            ..bar_at_rest(2.0, 100.0, 1.0)
        },
        1.0,
        2e-3,
    );
    for (&x, &u) in bar.nodes().iter().zip(bar.nodal_displacements()) {
        assert_relative_eq!(u, stretched(x), epsilon = 1e-12);
    }
    assert_relative_eq!(bar.counters().min_j, STRETCH, epsilon = 1e-12);
}

/// A free bar under gravity falls as a whole, and needs no stress to do so.
#[rstest]
fn a_free_bar_falls(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Mass::Lumped, Mass::Consistent)] mass: Mass,
) {
    let setup = BarSetup {
        element,
        mass,
        fixed: [false; 2],
        body_force: Some(pointwise(|_, _| -9.81)),
        ..bar_at_rest(2.0, 100.0, 1.0)
    };
    let bar = run(setup, 0.5, 2e-3);
    for x in [0.0, 0.33, 1.7, 2.0] {
        assert_relative_eq!(bar.displacement_at(x), -0.5 * 9.81 * 0.25, max_relative = 1e-11);
        assert_relative_eq!(bar.velocity_at(x), -9.81 * 0.5, max_relative = 1e-11);
    }
}

#[rstest]
fn samples_cover_the_bar(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
    #[values(Sampling::Inside, Sampling::Nodes)] sampling: Sampling,
) {
    let (initial_displacement, initial_velocity) = (Box::new(|x| 0.1 * x), Box::new(|x| 3.0 * x));
    let start = bar_at_rest(2.0, 100.0, 1.0);
    let setup = BarSetup { element, initial_displacement, initial_velocity, sampling, ..start };
    let bar = Bar::new(setup).unwrap();
    let mut samples = Samples::default();
    bar.sample(&mut samples);
    let count = samples.len();
    bar.sample(&mut samples); // replaces what is there
    let lengths = [&samples.label, &samples.displacement, &samples.velocity].map(Vec::len);
    assert_eq!(lengths, [count; 3]);
    assert_eq!((samples.dimension, samples.len()), (1, count));
    assert_relative_eq!(samples.weight.iter().sum::<f64>(), 2.0, epsilon = 1e-14);
    for ((&x, &u), &v) in samples.label.iter().zip(&samples.displacement).zip(&samples.velocity) {
        assert_relative_eq!(u, 0.1 * x, epsilon = 1e-14);
        assert_relative_eq!(v, 3.0 * x, epsilon = 1e-14);
    }
}

/// Eight elements of two points and two nodes, visited by the strain and by the forces.
#[test]
fn every_visit_is_counted() {
    let mut bar = Bar::new(bar_at_rest(2.0, 100.0, 1.0)).unwrap();
    assert_eq!(bar.counters().transfers, 32);
    bar.step(1e-3).unwrap();
    assert_eq!(bar.counters().transfers, 32 + 64);
}
