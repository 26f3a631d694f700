//! Time of textbook loops without generic parameters, divided by the time of the loops of this
//! crate.
//!
//! `cargo bench --bench ratio` runs both in turn and prints the median of the ratios with its
//! quartiles: on a machine whose speed varies, only ratios of consecutive times are comparable.
//! `best` is the ratio of the minimum times, which other processes disturb least.
//! `cargo bench --bench ratio -- 1e6 step` sets the number of particles, and selects measurements
//! with `step` in their name. The program first checks that both loops give the same numbers.

#[path = "common/one_thread.rs"]
mod one_thread;
#[path = "common/random.rs"]
mod random;
#[path = "common/words.rs"]
mod words;
mod yardstick;

use mpm_verify::mpm::{
    Affine, BasisName, FrameName, G2pRequest, Grid, Kernel, LinearElastic, MassName, Matrix,
    NeoHookean, P2gRequest, ParticleField, Particles, SchemeName, Setup, Solver, TransferName,
    Vector, VolumeName, kernel, mass_matrix, transfer,
};
use mpm_verify::subject::{Start, Subject};
use mpm_verify::verify::Timing;
use one_thread::one_thread;
use random::Random;
use std::hint::black_box;
use std::time::Instant;
use yardstick::{
    cubic_3d, flip_1d, gradient_3d, linear_1d, mls_2d, mls_3d, quadratic_2d, quadratic_3d,
};

const H: f64 = 0.5;
/// Number of cells between the body and the walls, so that cubic B-splines are uniform.
const MARGIN: usize = 3;

/// Input of both loops.
struct Scene<const D: usize> {
    kernel: Box<dyn Kernel<D>>,
    grid: Grid<D>,
    particles: Particles<D>,
    b: Vec<Matrix<D>>,
}

/// Creates a cube of about `count` particles with random displacements, 2^D per cell, sorted by
/// cell.
fn scene<const D: usize>(basis: BasisName, count: f64) -> Scene<D> {
    let per_cell = f64::from(1 << D);
    let side = libm::round(libm::pow(count / per_cell, 1.0 / D as f64)).max(1.0) as usize;
    let kernel = kernel::<D>(basis);
    let grid = kernel.grid(Vector::zeros(), H, [side + 2 * MARGIN; D], [false; D]);
    let (from, to) = (H * MARGIN as f64, H * (side + MARGIN) as f64);
    let block = mpm_verify::mpm::Block {
        from: Vector::from_element(from),
        to: Vector::from_element(to),
        density: 2.0,
    };
    let mut particles = Particles::fill(&block, H, 2);
    let mut random = Random(1);
    particles.x.sort_by_key(|x| grid.node(&grid.cell(x).expect("inside")));
    for (x, v) in particles.x.iter_mut().zip(&mut particles.v) {
        *x += Vector::from_fn(|_, _| 0.24 * H * random.signed());
        *v = Vector::from_fn(|_, _| random.signed());
    }
    let b = particles.x.iter().map(|_| Matrix::from_fn(|_, _| random.signed())).collect();
    Scene { kernel, grid, particles, b }
}

fn columns<const D: usize>(of: &[Vector<D>]) -> Vec<[f64; D]> {
    of.iter().map(|v| std::array::from_fn(|i| v[i])).collect()
}

fn rows<const D: usize>(of: &[Matrix<D>]) -> Vec<[[f64; D]; D]> {
    of.iter().map(|m| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))).collect()
}

/// Panics if results differ, because a wrong loop must not be timed.
fn same<'a>(
    id: &str,
    found: impl Iterator<Item = &'a f64>,
    expected: impl Iterator<Item = &'a f64>,
) {
    let (found, expected): (Vec<_>, Vec<_>) = (found.collect(), expected.collect());
    assert_eq!(found.len(), expected.len(), "{id}");
    let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (found, expected) in found.iter().zip(&expected) {
        let error = (*found - *expected).abs();
        assert!(error <= 1e-12 * scale, "{id}: {found} is not {expected}, so nothing is timed");
    }
}

fn time(run: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64()
}

fn quartiles(of: impl Iterator<Item = f64>) -> Timing {
    Timing::of(&of.collect::<Vec<_>>()).expect("times are numbers")
}

/// Runs both loops in turn and prints the times per particle.
fn compare(id: &str, particles: usize, plain: &mut dyn FnMut(), ours: &mut dyn FnMut()) {
    if !words::selects(id) {
        return;
    }
    let once = time(plain).max(1e-6);
    ours();
    let repeats = ((1.0 / once) as usize).clamp(11, 501);
    let pairs: Vec<(f64, f64)> = (0..repeats).map(|_| (time(plain), time(ours))).collect();
    let nanoseconds = 1e9 / particles as f64;
    let plain = quartiles(pairs.iter().map(|pair| pair.0 * nanoseconds)).median;
    let ours = quartiles(pairs.iter().map(|pair| pair.1 * nanoseconds)).median;
    let Timing { low, median: ratio, high, .. } =
        quartiles(pairs.iter().map(|pair| pair.0 / pair.1));
    let least = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).fold(f64::INFINITY, f64::min);
    let best = least(|pair| pair.0) / least(|pair| pair.1);
    println!("{id:<28} {plain:>10.2} {ours:>10.2} {ratio:>7.2}  [{low:.2}, {high:.2}] {best:>7.2}");
}

/// Compares P2G and G2P with APIC.
macro_rules! apic {
    ($plain:ident, $dimension:literal, $basis:ident, $id:literal, $count:expr) => {{
        const D: usize = $dimension;
        let Scene { kernel, mut grid, mut particles, mut b } =
            scene::<D>(BasisName::$basis, $count);
        let (x, v, rows_of_b) = (columns(&particles.x), columns(&particles.v), rows(&b));
        let (n, m, total) = (grid.counts, particles.mass.clone(), particles.len());
        let (mut mass, mut momentum) = (vec![0.0; grid.nodes()], vec![[0.0; D]; grid.nodes()]);
        let mut plain = || $plain::p2g(H, n, &x, &v, &rows_of_b, &m, &mut mass, &mut momentum);
        let mut ours = || {
            let shown = ParticleField { v: &particles.v, affine: Some(Affine::Moment(&b)) };
            let maps = P2gRequest { mass: true, momentum: Some(shown), force: None };
            kernel.p2g(black_box(&particles), &maps, &mut grid);
        };
        plain();
        ours();
        compare(concat!($id, "/p2g"), total, &mut plain, &mut ours);
        same(concat!($id, "/p2g mass"), grid.mass.iter(), mass.iter());
        same($id, grid.velocity.iter().flatten(), momentum.iter().flatten());

        let mut random = Random(2);
        grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
        let velocity = columns(&grid.velocity);
        let (mut new_v, mut new_b) = (v.clone(), rows_of_b.clone());
        let mut ours_v = particles.v.clone();
        let mut plain = || $plain::g2p(H, n, &x, &velocity, &mut new_v, &mut new_b);
        let mut ours = || {
            let (mix, value, moment) = (Some((0.0, 1.0)), Some(&mut *ours_v), Some(&mut *b));
            let takes = G2pRequest { mix, value, moment, ..G2pRequest::default() };
            kernel.g2p_all(black_box(&grid), &particles, takes);
        };
        plain();
        ours();
        compare(concat!($id, "/g2p"), total, &mut plain, &mut ours);
        same($id, ours_v.iter().flatten(), new_v.iter().flatten());
        same($id, rows(&b).iter().flatten().flatten(), new_b.iter().flatten().flatten());
        particles.v = ours_v;
    }};
}

fn flip(count: f64) {
    let Scene { kernel, mut grid, particles, .. } = scene::<1>(BasisName::Linear, count);
    let flat = |of: &[Vector<1>]| of.iter().map(|v| v[0]).collect::<Vec<f64>>();
    let (x, v, m, total) =
        (flat(&particles.x), flat(&particles.v), particles.mass.clone(), particles.len());
    let (mut mass, mut momentum) = (vec![0.0; grid.nodes()], vec![0.0; grid.nodes()]);
    let mut plain = || linear_1d::p2g(H, &x, &v, &m, &mut mass, &mut momentum);
    let mut ours = || {
        let shown = ParticleField { v: &particles.v, affine: None };
        let maps = P2gRequest { mass: true, momentum: Some(shown), force: None };
        kernel.p2g(black_box(&particles), &maps, &mut grid);
    };
    plain();
    ours();
    compare("1d/linear/flip/p2g", total, &mut plain, &mut ours);
    same("1d/linear/flip/p2g mass", grid.mass.iter(), mass.iter());
    same("1d/linear/flip/p2g", grid.velocity.iter().flatten(), momentum.iter());

    let mut random = Random(2);
    grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    let (velocity, acceleration) = (flat(&grid.velocity), flat(&grid.acceleration));
    let (mut new_v, mut advected) = (v.clone(), v.clone());
    let (mut ours_v, mut ours_advected) = (particles.v.clone(), particles.v.clone());
    let fields = (&*velocity, &*acceleration);
    let mut plain = || linear_1d::g2p((H, 0.125), &x, fields, &mut new_v, &mut advected);
    let mut ours = || {
        let (value, advected) = (Some(&mut *ours_v), Some((0.125, &mut *ours_advected)));
        let takes = G2pRequest { change: Some(0.125), value, advected, ..G2pRequest::default() };
        kernel.g2p_all(black_box(&grid), &particles, takes);
    };
    plain();
    ours();
    compare("1d/linear/flip/g2p", total, &mut plain, &mut ours);
    same("1d/linear/flip/g2p", ours_v.iter().flatten(), new_v.iter());
    same("1d/linear/flip/g2p", ours_advected.iter().flatten(), advected.iter());
}

/// Length of a step (s): a body of modulus 1 Pa moves by less than a tenth of a cell in all
/// repeats.
const DT: f64 = 1e-4;

/// Creates the solver of a scene with velocities reduced to a thousandth, and its Lame constants
/// (Pa).
fn solver<const D: usize>(
    basis: BasisName,
    (name, scheme): (TransferName, SchemeName),
    count: f64,
) -> (Solver<D>, [f64; 2]) {
    let Scene { kernel, grid, mut particles, .. } = scene::<D>(basis, count);
    particles.v.iter_mut().for_each(|v| *v *= 1e-3);
    particles.x0.clone_from(&particles.x);
    let LinearElastic { lambda, mu } = LinearElastic::new(1.0, 0.3);
    let setup = Setup {
        grid,
        particles,
        kernel,
        transfer: transfer(name),
        mass: mass_matrix(MassName::Lumped),
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        material: Box::new(NeoHookean::new(1.0, 0.3)),
        effects: Vec::new(),
        boundary: Vec::new(),
        scheme,
        start: Start::AtZero,
    };
    (Solver::new(setup).expect("every particle is inside"), [lambda, mu])
}

/// Number of steps whose results are compared before the steps are timed.
const COMPARED: usize = 3;

/// Compares whole steps with quadratic B-splines and USL.
macro_rules! quadratic_step {
    ($transfer:ident, $plain:ident, $step:expr, $dimension:literal, $id:literal, $count:expr) => {{
        const D: usize = $dimension;
        let method = (TransferName::$transfer, SchemeName::Usl);
        let (mut ours, [lambda, mu]) = solver::<D>(BasisName::QuadraticBSpline, method, $count);
        let (particles, grid) = (ours.particles(), ours.grid());
        let (n, total) = (grid.counts, particles.len());
        let identity = rows(&[Matrix::<D>::identity()])[0];
        let mut body = $plain::Body {
            x: columns(&particles.x),
            v: columns(&particles.v),
            b: vec![[[0.0; D]; D]; total],
            f: vec![identity; total],
            flux: vec![[[0.0; D]; D]; total],
            m: particles.mass[0],
            volume: particles.vol0[0],
            nodes: vec![[0.0; 2 * D + 1]; grid.nodes()],
        };
        let mut plain = || $step(&mut body, (H, n, DT), (lambda, mu));
        for _ in 0..COMPARED {
            plain();
            ours.step(DT).expect("no particle is inverted");
        }
        same($id, ours.particles().x.iter().flatten(), body.x.iter().flatten());
        same($id, ours.particles().v.iter().flatten(), body.v.iter().flatten());
        let mut plain = || $step(&mut body, (H, n, DT), (lambda, mu));
        let mut ours = || ours.step(black_box(DT)).expect("no particle is inverted");
        compare($id, total, &mut plain, &mut ours);
    }};
}

/// A textbook step of a body, for (h, dt) and the Lame constants.
type FlipStep = fn(&mut flip_1d::Body, (f64, f64), (f64, f64));

/// Compares whole steps of FLIP.
fn flip_step(id: &str, scheme: SchemeName, step: FlipStep, count: f64) {
    let method = (TransferName::Flip, scheme);
    let (mut ours, [lambda, mu]) = solver::<1>(BasisName::Linear, method, count);
    let flat = |of: &[Vector<1>]| of.iter().map(|v| v[0]).collect::<Vec<f64>>();
    let (particles, nodes) = (ours.particles(), ours.grid().nodes());
    let total = particles.len();
    let mut body = flip_1d::Body {
        x: flat(&particles.x),
        v: flat(&particles.v),
        f: vec![1.0; total],
        flux: vec![0.0; total],
        m: particles.mass[0],
        volume: particles.vol0[0],
        nodes: vec![[0.0; 3]; nodes],
    };
    for _ in 0..COMPARED {
        step(&mut body, (H, DT), (lambda, mu));
        ours.step(DT).expect("no particle is inverted");
    }
    same(id, ours.particles().x.iter().flatten(), body.x.iter());
    same(id, ours.particles().v.iter().flatten(), body.v.iter());
    let mut plain = || step(&mut body, (H, DT), (lambda, mu));
    let mut ours = || ours.step(black_box(DT)).expect("no particle is inverted");
    compare(id, total, &mut plain, &mut ours);
}

fn main() {
    one_thread();
    let count = words::count(1e5);
    println!("ns per particle, {count:e} particles, sorted by cell, one thread");
    println!(
        "{:<28} {:>10} {:>10} {:>7}  quartiles      best",
        "", "yardstick", "library", "ratio"
    );
    apic!(quadratic_3d, 3, QuadraticBSpline, "3d/quadratic/apic", count);
    apic!(quadratic_2d, 2, QuadraticBSpline, "2d/quadratic/apic", count);
    apic!(cubic_3d, 3, CubicBSpline, "3d/cubic/apic", count);
    flip(count);
    quadratic_step!(Mls, mls_3d, mls_3d::step, 3, "3d/quadratic/mls/usl step", count);
    let (apic, flip_3d) = (gradient_3d::step::<true>, gradient_3d::step::<false>);
    quadratic_step!(Apic, mls_3d, apic, 3, "3d/quadratic/apic/usl step", count);
    quadratic_step!(Flip, mls_3d, flip_3d, 3, "3d/quadratic/flip/usl step", count);
    quadratic_step!(Mls, mls_2d, mls_2d::step, 2, "2d/quadratic/mls/usl step", count);
    flip_step("1d/linear/flip/usl step", SchemeName::Usl, flip_1d::step, count);
    flip_step("1d/linear/flip/musl step", SchemeName::Musl, flip_1d::musl_step, count);
}
