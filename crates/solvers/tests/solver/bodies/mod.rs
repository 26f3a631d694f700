//! Several bodies on one grid: shared velocities, separate states, and contact.

use crate::common::{DT, H, free_body, in_dimension, methods, scattered_stress};
use mpm_solvers::mpm::{
    BasisName, Block, Bodies, LinearElastic, Particles, SchemeName, Setup, Solver, TransferKind,
    TransferName, Vector,
};
use mpm_subject::{Samples, Start, Subject, Totals};
use rstest::rstest;

/// Returns the methods for these tests; in 3-D only fast ones.
fn some(dimension: usize) -> impl Iterator<Item = (BasisName, TransferName)> {
    let few = |(basis, transfer): &(BasisName, TransferName)| match transfer {
        TransferName::Flip => matches!(basis, BasisName::Linear | BasisName::ContiguousGimp),
        TransferName::Apic => *basis == BasisName::Linear,
        _ => false,
    };
    methods().filter(move |method| dimension < 3 || few(method))
}

/// Returns the methods that support coupled bodies.
fn coupled_methods(dimension: usize) -> impl Iterator<Item = (BasisName, TransferName)> {
    some(dimension).filter(|(_, transfer)| {
        !matches!(transfer.kind(), TransferKind::Series | TransferKind::Cells)
    })
}

/// Creates the part of the free body between two coordinates on the first axis.
fn part<const D: usize>(
    method: (BasisName, TransferName),
    scheme: SchemeName,
    [low, high]: [f64; 2],
) -> Setup<D> {
    let mut setup = free_body::<D>(method, scheme);
    let (mut from, mut to) = (Vector::from_element(2.03 * H), Vector::from_element(5.03 * H));
    (from[0], to[0]) = (low * H, high * H);
    setup.particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
    for p in 0..setup.particles.len() {
        let x = setup.particles.x[p];
        setup.particles.v[p] = Vector::from_fn(|i, _| 0.3 * libm::sin(3.0 * x[(i + 1) % D]));
        setup.particles.sigma[p] = scattered_stress(5.0 * x[0]);
    }
    setup
}

fn ran(mut subject: impl Subject, steps: usize) -> Samples {
    (0..steps).for_each(|_| subject.step(DT).unwrap());
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    samples
}

fn is_the_solver<const D: usize>(scheme: SchemeName, friction: Option<f64>) {
    for method in some(D) {
        let setup = || free_body::<D>(method, scheme);
        let alone = ran(Solver::new(setup()).unwrap(), 20);
        let listed = ran(Bodies::new(vec![setup()], friction).unwrap(), 20);
        assert!(alone == listed, "{D}-D {method:?} {scheme:?}: not the same bits");
    }
}

#[rstest]
fn single_body_is_bit_identical_to_its_solver(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(None, Some(0.3))] friction: Option<f64>,
) {
    in_dimension!(dimension, is_the_solver(scheme, friction));
}

/// Asserts that two bodies without common nodes do not affect each other.
fn do_not_know_each_other<const D: usize>(scheme: SchemeName) {
    for method in coupled_methods(D) {
        let setups = || [[0.6, 1.6], [5.6, 6.4]].map(|ends| part::<D>(method, scheme, ends));
        let [one, other] = setups().map(|setup| ran(Solver::new(setup).unwrap(), 10));
        for friction in [None, Some(0.3)] {
            let both = ran(Bodies::new(setups().into(), friction).unwrap(), 10);
            let apart = [one.displacement.clone(), other.displacement.clone()].concat();
            assert!(both.displacement == apart, "{D}-D {method:?} {scheme:?} {friction:?}");
        }
    }
}

/// Asserts that a body cut in two, with one velocity field, moves like the whole body.
fn halves_are_the_whole<const D: usize>(scheme: SchemeName, start: Start) {
    for method in coupled_methods(D) {
        let of = |ends: [f64; 2]| Setup { start, ..part::<D>(method, scheme, ends) };
        let whole = ran(Solver::new(of([2.5, 4.5])).unwrap(), 30);
        let bodies = Bodies::new(vec![of([2.5, 3.5]), of([3.5, 4.5])], None).unwrap();
        let halves = ran(bodies, 30);
        let size = whole.displacement.iter().fold(0.0_f64, |all, u| all.max(u.abs()));
        for (p, label) in whole.label.chunks(D).enumerate() {
            let close = |other: &[f64]| label.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-9);
            let q = halves.label.chunks(D).position(close).expect("the same particle");
            for i in 0..D {
                let far = (whole.displacement[p * D + i] - halves.displacement[q * D + i]).abs();
                assert!(far <= 1e-12 * size, "{D}-D {method:?} {scheme:?}: {far:.1e} m apart");
            }
        }
    }
}

#[rstest]
fn bodies_with_a_shared_field_move_as_one_body(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(Start::AtZero, Start::HalfStepBack)] start: Start,
) {
    in_dimension!(dimension, halves_are_the_whole(scheme, start));
}

/// Creates three bodies in an oblique collision; the middle one is heavy.
fn crash<const D: usize>(method: (BasisName, TransferName), scheme: SchemeName) -> Vec<Setup<D>> {
    let ends = [[1.4, 2.4], [2.7, 3.7], [4.0, 5.0]];
    let speeds = [0.8, 0.0, -0.6];
    let body = |(ends, speed): ([f64; 2], f64)| {
        let mut setup = part::<D>(method, scheme, ends);
        let heavy = if speed == 0.0 { 5.0 } else { 1.0 };
        for (v, m) in setup.particles.v.iter_mut().zip(&mut setup.particles.mass) {
            v[0] += speed;
            v[D - 1] += 0.3 * speed;
            *m *= heavy;
        }
        setup
    };
    ends.into_iter().zip(speeds).map(body).collect()
}

/// A distant body that is listed before two colliding bodies must not change their result, bit for
/// bit.
#[rstest]
fn a_body_far_away_changes_no_contact(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    let method = (BasisName::Linear, TransferName::Flip);
    let near = || crash::<2>(method, scheme).split_off(1);
    let far = part::<2>(method, scheme, [0.3, 0.9]);
    let two = ran(Bodies::new(near(), Some(0.3)).unwrap(), 60);
    let three = [far].into_iter().chain(near()).collect();
    let three = ran(Bodies::new(three, Some(0.3)).unwrap(), 60);
    assert!(three.displacement.ends_with(&two.displacement));
}

fn momentum_is_kept<const D: usize>(scheme: SchemeName) {
    for method in coupled_methods(D) {
        for friction in [None, Some(0.0), Some(0.4)] {
            let mut bodies = Bodies::new(crash::<D>(method, scheme), friction).unwrap();
            let what = format!("{D}-D {method:?} {scheme:?} {friction:?}");
            let before = bodies.totals().unwrap();
            let own = bodies.solvers()[0].totals().unwrap();
            (0..60).for_each(|_| bodies.step(DT).unwrap());
            let after = bodies.totals().unwrap();
            let change = change(&before, &after) / before.momentum_size;
            assert!(change <= 1e-13, "{what}: momentum changed by {change:.1e}");
            let given = self::change(&own, &bodies.solvers()[0].totals().unwrap());
            assert!(given > 1e-2 * own.momentum_size, "{what}: one body gave none to the others");
        }
    }
}

fn change(before: &Totals, after: &Totals) -> f64 {
    let pairs = before.momentum.iter().zip(after.momentum);
    pairs.fold(0.0, |all, (a, b)| libm::hypot(all, b - a))
}

#[rstest]
fn colliding_bodies_conserve_momentum_and_distant_bodies_are_bit_identical_to_two_solvers(
    #[values(1, 2, 3)] dimension: usize,
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
) {
    in_dimension!(dimension, momentum_is_kept(scheme));
    if dimension < 3 {
        in_dimension!(dimension, do_not_know_each_other(scheme));
    }
}

/// Presses and slides two periodic layers. Returns the impulses on the upper layer along the
/// interface and normal to it.
fn pressed(method: (BasisName, TransferName), scheme: SchemeName, friction: f64) -> [f64; 2] {
    let layer = |low: f64, v: Vector<2>| {
        let mut setup = free_body::<2>(method, scheme);
        let (from, to) = ([0.0, low * H].into(), [2.0 * H, (low + 2.0) * H].into());
        setup.grid = setup.kernel.grid(Vector::zeros(), H, [2, 7], [true, false]);
        setup.particles = Particles::fill(&Block { from, to, density: 1.0 }, H, 2);
        setup.particles.v.fill(v);
        setup.material = Box::new(LinearElastic::new(1.0, 0.0));
        setup
    };
    let lower = layer(1.3, [0.0, 0.01].into());
    let upper = layer(3.3, [0.5, -0.01].into());
    let mut bodies = Bodies::new(vec![lower, upper], Some(friction)).unwrap();
    let before = bodies.solvers()[1].totals().unwrap().momentum;
    (0..20).for_each(|_| bodies.step(DT).unwrap());
    let after = bodies.solvers()[1].totals().unwrap().momentum;
    [after[0] - before[0], after[1] - before[1]]
}

#[rstest]
fn friction_is_a_share_of_the_pressure_and_none_without(
    #[values(SchemeName::Usf, SchemeName::Usl, SchemeName::Musl)] scheme: SchemeName,
    #[values(0.0, 0.3)] friction: f64,
) {
    for method in coupled_methods(2) {
        let [along, across] = pressed(method, scheme, friction);
        assert!(across > 1e-5, "{method:?}: the layers push each other: {across:.1e}");
        let off = (along + friction * across).abs() / across;
        assert!(off <= 1e-11, "{method:?}: {along:.3e} along the surface, {across:.3e} across");
    }
}
