//! Time of the particle-node loops: P2G, G2P and the whole step.
//!
//! An identifier reads `transfer/3d/linear/flip/sorted/1e5/p2g`, and any part of it selects:
//! `cargo bench -- 3d/linear`. `p2g` is mass, momentum and internal force; `g2p` is velocity,
//! gradient and position; `step` is one step of MUSL. Longer runs: `cargo bench -- --sample-size
//! 100 --measurement-time 10`. Nothing is timed before its result has been checked.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mpm_verify::{
    mpm::{
        BasisName, Block, FrameName, Grid, Kernel, LinearElastic, MassName, Matrix, Particles,
        SchemeName, Setup, Solver, Transfer, TransferName, Vector, Wanted, kernel, mass_matrix,
        transfer,
    },
    subject::{Start, Subject},
};
use std::{hint::black_box, time::Duration};

const H: f64 = 1.0;
const PER_AXIS: usize = 2;
/// So short (s) that no particle changes its cell, however often a loop is repeated.
const DT: f64 = 1e-12;

#[derive(Clone, Copy)]
enum Order {
    Sorted,
    Shuffled,
}

/// `SplitMix64` (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1).
    fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Fisher-Yates.
    fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, (self.next() % (last as u64 + 1)) as usize);
        }
    }
}

/// A cube of about `count` particles in random motion, one empty cell inside the walls.
fn scene<const D: usize>(
    kernel: &dyn Kernel<D>,
    count: usize,
    order: Order,
) -> (Grid<D>, Particles<D>) {
    let per_cell = PER_AXIS.pow(D as u32) as f64;
    let side = libm::round(libm::pow(count as f64 / per_cell, 1.0 / D as f64)).max(1.0) as usize;
    let grid = kernel.grid(Vector::zeros(), H, [side + 2; D], [false; D]);
    let (from, to) = (Vector::from_element(H), Vector::from_element(H * (side + 1) as f64));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, H, PER_AXIS);
    match order {
        Order::Sorted => particles.x.sort_by_key(|x| grid.node(&grid.cell(x).expect("inside"))),
        Order::Shuffled => Random(1).shuffle(&mut particles.x),
    }
    particles.x0.clone_from(&particles.x);
    let mut random = Random(2);
    particles.v.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    (grid, particles)
}

/// What meets in a bench: loops, and a transfer that knows the particles.
struct Method<const D: usize> {
    kernel: Box<dyn Kernel<D>>,
    transfer: Box<dyn Transfer<D>>,
    /// How fast the grid carries each particle (m/s).
    carried: Vec<Vector<D>>,
}

impl<const D: usize> Method<D> {
    fn p2g(&mut self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let kernel = &*self.kernel;
        let all = Wanted { mass: true, momentum: true, force: true };
        self.transfer.p2g(kernel, particles, grid, all);
    }

    fn g2p(&mut self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        let kernel = &*self.kernel;
        self.transfer.g2p_velocity(kernel, grid, &[], dt, particles);
        self.transfer.g2p_gradient(kernel, grid, particles);
        self.carried.resize(particles.len(), Vector::zeros());
        kernel.g2p(grid, &grid.velocity, particles, (0.0, 1.0), &mut self.carried);
        for (x, v) in particles.x.iter_mut().zip(&self.carried) {
            *x += v * dt;
        }
    }
}

/// Whether `x` is zero, next to `scale`; not so if either is not a number.
fn vanishes(x: f64, scale: f64) -> bool {
    x.abs() <= 1e-12 * scale
}

/// Refuses to time a wrong P2G: mass and momentum are kept, and a uniform stress pushes no node
/// whose function lies inside the body as a whole: the body starts one cell from the wall, and the
/// function with index 4 at one cell or more, cubic B-splines included.
fn check_p2g<const D: usize>(
    id: &str,
    method: &mut Method<D>,
    mut grid: Grid<D>,
    p: &Particles<D>,
) {
    let mut stressed = p.clone();
    stressed.sigma.fill(Matrix::from_fn(|i, j| 1.0 + (i + j) as f64));
    method.p2g(&stressed, &mut grid);

    let mass: f64 = p.mass.iter().sum();
    let kept = grid.mass.iter().sum::<f64>();
    assert!(vanishes(kept - mass, mass), "{id}: not timed, P2G makes mass {kept} of {mass}");

    let momentum: Vector<D> = p.v.iter().zip(&p.mass).map(|(v, m)| v * *m).sum();
    let lost = (grid.velocity.iter().sum::<Vector<D>>() - momentum).norm();
    let scale: f64 = p.v.iter().zip(&p.mass).map(|(v, m)| v.norm() * m).sum();
    assert!(vanishes(lost, scale), "{id}: not timed, P2G changes momentum by {lost}");

    let scale = p.vol.iter().zip(&stressed.sigma).map(|(vol, s)| vol * s.norm() / H).sum();
    let total = grid.force.iter().sum::<Vector<D>>().norm();
    assert!(vanishes(total, scale), "{id}: not timed, internal forces add up to {total}");
    let cell_scale = scale * PER_AXIS.pow(D as u32) as f64 / p.len() as f64;
    let is_inside = |i| (0..D).all(|a| (4..grid.cells[a] - 2).contains(&grid.index_on_axis(i, a)));
    for (i, f) in grid.force.iter().enumerate().filter(|(i, _)| is_inside(*i)) {
        let push = f.norm();
        assert!(vanishes(push, cell_scale), "{id}: not timed, uniform stress pushes {i} by {push}");
    }
}

/// Refuses to time a wrong G2P: a grid that translates translates the particles.
fn check_g2p<const D: usize>(
    id: &str,
    method: &mut Method<D>,
    mut grid: Grid<D>,
    p: &Particles<D>,
) {
    let velocity = Vector::from_fn(|axis, _| 1.0 + axis as f64);
    let dt = 0.125 * H;
    grid.velocity.fill(velocity);
    grid.acceleration.fill(velocity);
    let mut moved = p.clone();
    moved.v.fill(velocity * (1.0 - dt));
    method.g2p(&grid, dt, &mut moved);
    for k in 0..p.len() {
        let dv = (moved.v[k] - velocity).norm();
        let dx = (moved.x[k] - p.x[k] - velocity * dt).norm();
        let exact = vanishes(dv, 1.0) && vanishes(dx, p.x[k].norm());
        let rigid = vanishes(moved.grad_v[k].norm(), velocity.norm() / H);
        assert!(exact && rigid, "{id}: not timed, G2P bends a translation at particle {k}");
    }
}

/// A solver that has made one step and kept its momentum.
fn checked_solver<const D: usize>(
    id: &str,
    Method { kernel, transfer, .. }: Method<D>,
    grid: Grid<D>,
    particles: Particles<D>,
) -> Solver<D> {
    let momentum = |p: &Particles<D>| -> Vector<D> { p.v.iter().sum::<Vector<D>>() * p.mass[0] };
    let before = momentum(&particles);
    let material = Box::new(LinearElastic::new(1.0, 0.3));
    let (effects, boundary) = (Vec::new(), Vec::new());
    let (scheme, start) = (SchemeName::Musl, Start::AtZero);
    let (mass, frame) = (mass_matrix(MassName::Lumped), FrameName::Updated);
    let setup = Setup {
        grid,
        particles,
        kernel,
        transfer,
        mass,
        frame,
        material,
        effects,
        boundary,
        scheme,
        start,
    };
    let mut solver = Solver::new(setup).expect("every particle is inside");
    solver.step(DT).expect("the first step succeeds");
    let p = solver.particles();
    let scale = p.v.iter().map(|v| v.norm() * p.mass[0]).sum();
    let lost = (momentum(p) - before).norm();
    assert!(vanishes(lost, scale), "{id}: not timed, a step changes momentum by {lost}");
    solver
}

fn compare<const D: usize>(
    criterion: &mut Criterion,
    (basis, name): (BasisName, TransferName),
    (order, order_name): (Order, &str),
    (count, count_name): (usize, &str),
) {
    let names = format!("{}/{}/{order_name}/{count_name}", basis.name(), name.name());
    let id = format!("transfer/{D}d/{names}");
    let mut group = criterion.benchmark_group(&id);
    let make = || {
        let kernel = kernel::<D>(basis);
        let scene = scene::<D>(&*kernel, count, order);
        let mut transfer = transfer::<D>(name);
        transfer.start(&*kernel, &scene.0, &scene.1);
        (Method { kernel, transfer, carried: Vec::new() }, scene)
    };
    group.throughput(Throughput::Elements(make().1.1.len() as u64));

    group.bench_function(BenchmarkId::from_parameter("p2g"), |bencher| {
        let (mut method, (mut grid, particles)) = make();
        check_p2g(&id, &mut method, grid.clone(), &particles);
        bencher.iter(|| method.p2g(black_box(&particles), black_box(&mut grid)));
    });
    group.bench_function(BenchmarkId::from_parameter("g2p"), |bencher| {
        let (mut method, (mut grid, mut particles)) = make();
        check_g2p(&id, &mut method, grid.clone(), &particles);
        let mut random = Random(3);
        grid.velocity.fill_with(|| Vector::from_fn(|_, _| random.signed()));
        grid.acceleration.fill_with(|| Vector::from_fn(|_, _| random.signed()));
        bencher.iter(|| method.g2p(black_box(&grid), DT, black_box(&mut particles)));
    });
    group.bench_function(BenchmarkId::from_parameter("step"), |bencher| {
        let (method, (grid, particles)) = make();
        let mut solver = checked_solver(&id, method, grid, particles);
        bencher.iter(|| solver.step(black_box(DT)).expect("a later step succeeds"));
        assert_eq!(solver.census().crossings, Some(0), "{id}: the order of particles must last");
    });
    group.finish();
}

/// Every basis with FLIP; with APIC, which carries a field, in one order and number of particles.
fn every_method(criterion: &mut Criterion) {
    for &basis in BasisName::ALL {
        let (apic, order) = ((basis, TransferName::Apic), (Order::Sorted, "sorted"));
        compare::<1>(criterion, apic, order, (10_000, "1e4"));
        compare::<2>(criterion, apic, order, (10_000, "1e4"));
        compare::<3>(criterion, apic, order, (10_000, "1e4"));
        let method = (basis, TransferName::Flip);
        for order in [(Order::Sorted, "sorted"), (Order::Shuffled, "shuffled")] {
            for count in [(10_000, "1e4"), (100_000, "1e5")] {
                compare::<1>(criterion, method, order, count);
                compare::<2>(criterion, method, order, count);
                compare::<3>(criterion, method, order, count);
            }
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(15)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = every_method
}
criterion_main!(benches);
