//! Invalid states of particles: every method, scheme and material is run with every extreme state
//! in one, two and three dimensions. A step must end with finite numbers, or name the particle of
//! the failure. It must never panic or hide a NaN.

mod scene;
mod step_input;

use crate::common::in_dimension;
use mpm_solvers::mpm::{Matrix, Particles, SchemeName, Vector};
use mpm_subject::{Failure, Site, Start};
use proptest::prelude::*;
use rstest::rstest;
use scene::{Scene, body, every_method, materials};

/// A change that makes the state of particle 1 extreme.
type Spoil<const D: usize> = fn(&mut Particles<D>);

/// Returns extreme states. Only lengths of particle domains are NaN or infinite.
fn extremes<const D: usize>() -> Vec<(&'static str, Spoil<D>)> {
    vec![
        ("on a node", |b| b.x[1] = Vector::from_element(1.0)),
        ("on the last face", |b| b.x[1] = Vector::from_element(2.0)),
        ("on the first face", |b| b.x[1] = Vector::zeros()),
        ("just outside", |b| b.x[1][0] = -f64::MIN_POSITIVE),
        ("far outside", |b| b.x[1][0] = 1e300),
        ("far beyond a period", |b| b.x[1][D - 1] = -1e300),
        ("beyond what an integer counts", |b| b.x[1][D - 1] = 1e19),
        ("of a far label", |b| b.x0[1][0] = 1e300),
        ("where another is", |b| b.x[1] = b.x[0]),
        ("all in one place", |b| {
            let x = b.x[1];
            b.x.fill(x);
        }),
        ("heavy", |b| b.mass[1] = 1e300),
        ("light", |b| b.mass[1] = 1e-300),
        ("of the smallest mass", |b| b.mass[1] = f64::from_bits(1)),
        ("without mass", |b| b.mass[1] = 0.0),
        ("of negative mass", |b| b.mass[1] = -1.0),
        ("fast", |b| b.v[1] = Vector::from_element(1e300)),
        ("slow", |b| b.v[1] = Vector::from_element(1e-300)),
        ("under great tension", |b| b.sigma[1].fill(1e300)),
        ("under great pressure", |b| b.sigma[1].fill(-1e150)),
        ("large", |b| b.vol[1] = 1e300),
        ("small", |b| b.vol[1] = 1e-300),
        ("without volume", |b| b.vol[1] = 0.0),
        ("without reference volume", |b| b.vol0[1] = 0.0),
        ("of a negative volume", |b| b.vol[1] = -0.1),
        ("spinning", |b| b.grad_v[1].fill(1e200)),
        ("without size", |b| b.spacing.fill(0.0)),
        ("longer than the grid", |b| b.spacing.fill(1e300)),
        ("of negative length", |b| b.spacing.fill(-1e30)),
        ("of infinite length", |b| b.spacing.fill(f64::INFINITY)),
        ("of undefined length", |b| b.spacing.fill(f64::NAN)),
        ("inside out", |b| {
            b.track_deformation();
            b.def_grad[1][(0, 0)] = -1.0;
        }),
        ("flat", |b| {
            b.track_deformation();
            b.def_grad[1].fill(1.0);
        }),
        ("sheared without end", |b| {
            b.track_deformation();
            b.def_grad[1][(0, D - 1)] = 1e200;
        }),
        ("squeezed to nothing", |b| {
            b.track_deformation();
            b.def_grad[1] *= 1e-200;
        }),
        ("stretched without end", |b| {
            b.track_deformation();
            b.def_grad[1] *= 1e150;
        }),
    ]
}

/// Particles in which one number is `value`, each with the name of its column.
fn torn<const D: usize>(value: f64) -> Vec<(&'static str, Particles<D>)> {
    let mut bodies = vec![body::<D>(); 8];
    bodies[0].x[1][D - 1] = value;
    bodies[1].v[1][D - 1] = value;
    bodies[2].mass[1] = value;
    bodies[3].vol[1] = value;
    bodies[4].sigma[1][(0, D - 1)] = value;
    bodies[5].track_deformation();
    bodies[5].def_grad[1][(D - 1, 0)] = value;
    bodies[6].x0[1][0] = value;
    bodies[7].grad_v[1][(0, 0)] = value;
    let names = ["position", "velocity", "mass", "volume", "stress", "deformation gradient"];
    let names = names.into_iter().chain(["reference position", "velocity gradient"]);
    names.zip(bodies).collect()
}

/// Cells along each axis of the grid.
const CELLS: usize = 4;

const DTS: [f64; 5] = [1e-2, 1e-30, 1e30, 1.0, -1e-2];

/// Runs a part of all combinations. In one dimension each method is run with each extreme under
/// several schemes and materials. Steps take longer in more dimensions, where each scheme and
/// material is run with each extreme under several methods.
fn meets_every_extreme<const D: usize>() {
    let mut turn = 0;
    for method in every_method() {
        for &scheme in SchemeName::ALL {
            for material in materials() {
                for (what, spoil) in extremes::<D>() {
                    turn += 1;
                    // The stride has no common factor with the periods of the choices.
                    if turn % [1, 7, 13, 61][D] != 0 {
                        continue;
                    }
                    let start = Start::ALL[turn % 2];
                    let (periodic, dt) = (turn % 3 == 0, DTS[turn % DTS.len()]);
                    let scene =
                        Scene { method, scheme, material, start, periodic, cells: CELLS, dt };
                    let mut particles = body::<D>();
                    spoil(&mut particles);
                    scene.holds(what, particles);
                }
            }
        }
    }
}

#[rstest]
fn no_extreme_causes_a_panic_or_a_silent_nan(#[values(1, 2, 3)] dimension: usize) {
    in_dimension!(dimension, meets_every_extreme());
}

/// The failing particle must be named before the failure spreads through common nodes.
fn names_the_culprit<const D: usize>(value: f64) {
    let start = Start::AtZero;
    for method in every_method() {
        for material in materials() {
            let scene = Scene {
                method,
                scheme: SchemeName::Musl,
                material,
                start,
                periodic: false,
                cells: CELLS,
                dt: 1e-2,
            };
            for (quantity, particles) in torn::<D>(value) {
                let met = scene.solver(particles).map(|_| ());
                let named = Failure::NonFinite { quantity, site: Site::Particle(1) };
                assert_eq!(met, Err(named), "{scene:?}");
            }
        }
    }
}

#[rstest]
fn nan_field_is_reported_by_name(
    #[values(1, 2, 3)] dimension: usize,
    #[values(f64::NAN, f64::INFINITY, f64::NEG_INFINITY)] value: f64,
) {
    in_dimension!(dimension, names_the_culprit(value));
}

/// Runs a body in which `numbers` set the state of one particle.
fn survives<const D: usize>(scene: &Scene, numbers: &[f64]) {
    let mut particles = body::<D>();
    let mut numbers = numbers.iter().copied();
    let mut next = |otherwise: f64| numbers.next().filter(|n| !n.is_nan()).unwrap_or(otherwise);
    particles.mass[1] = next(1.0);
    particles.vol[1] = next(0.25);
    particles.x[1] = Vector::from_fn(|axis, _| next(particles.x[1][axis]));
    particles.v[1] = Vector::from_fn(|_, _| next(0.0));
    particles.sigma[1] = Matrix::from_fn(|_, _| next(0.0));
    particles.grad_v[1] = Matrix::from_fn(|_, _| next(0.0));
    if next(0.0) > 0.0 {
        particles.track_deformation();
        particles.def_grad[1] = Matrix::from_fn(|i, j| next(f64::from(u8::from(i == j))));
    }
    scene.holds("numbers", particles);
}

/// Generates numbers for a column. Some mean the unchanged number (NaN), some are moderate, some
/// extreme.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => Just(f64::NAN),
        3 => -3.0..3.0_f64,
        1 => prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1500) })]

    #[test]
    fn no_numbers_cause_a_panic_or_a_silent_nan(
        dimension in 1..=3_usize,
        method in prop::sample::select(every_method()),
        scheme in prop::sample::select(SchemeName::ALL),
        material in prop::sample::select(materials()),
        start in prop::sample::select(Start::ALL),
        periodic in any::<bool>(),
        dt in prop_oneof![3 => 1e-4..1.0_f64, 1 => prop::num::f64::ANY],
        numbers in prop::collection::vec(number(), 33),
    ) {
        let scene = Scene { method, scheme, material, start, periodic, cells: CELLS, dt };
        in_dimension!(dimension, survives(&scene, &numbers));
    }
}

/// The corpus of the fuzzer, `tests/fuzz/corpus/step`: inputs that reach new code or once failed.
#[test]
fn fuzzer_corpus_causes_no_panic() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/fuzz/corpus/step");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let count = files.map(|file| step_input::step(&std::fs::read(file).unwrap())).count();
    assert!(count > 20, "{count} files");
}
