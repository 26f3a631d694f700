//! Properties of blocks of particles: passes must have the same bits for any number of threads, and
//! the sums of one block up to rounding.

use super::{bits, filled};
use crate::common::in_dimension;
use approx::assert_relative_eq;
use mpm_solvers::mpm::{
    Affine, BasisName, Divergence, G2pRequest, Grid, Kernel, LoopSettings, P2gRequest,
    ParticleField, Particles, kernel, kernel_with,
};
use rayon::ThreadPoolBuilder;
use rstest::rstest;

const H: f64 = 0.25;

/// Creates loops that divide even small scenes into blocks.
fn cutting<const D: usize>(basis: BasisName) -> Box<dyn Kernel<D>> {
    let settings = LoopSettings { min_particles: 0, min_block: 128, ..LoopSettings::default() };
    kernel_with(basis, settings)
}

/// Creates a body in a grid that is long along its last axis. A test in
/// `crates/solvers/src/mpm/kernel/colouring.rs` checks that such a body is divided into blocks.
fn scene<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) -> (Grid<D>, Particles<D>) {
    let cells = std::array::from_fn(|axis| match (axis + 1 == D, D) {
        (true, 1) => 600,
        (true, _) => 60,
        (false, 2) => 9,
        (false, _) => 3,
    });
    filled(kernel, (0.0, cells), periodic, |_| 1.1)
}

/// Returns mass, momentum and force of all nodes.
fn mapped<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<f64> {
    let (mut grid, slope) = (grid.clone(), Affine::Slope(&particles.sigma));
    let momentum = Some(ParticleField { v: &particles.v, affine: Some(slope) });
    let force = Some(Divergence::Gradient);
    kernel.p2g(particles, &P2gRequest { mass: true, momentum, force }, &mut grid);
    let vectors = grid.velocity.iter().chain(&grid.force).flatten();
    grid.mass.iter().chain(vectors).copied().collect()
}

fn sums<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<f64> {
    let (mut value, mut moment) = (particles.v.clone(), particles.sigma.clone());
    let (mut fit, mut gradient, mut advected) = (moment.clone(), moment.clone(), value.clone());
    let request = G2pRequest {
        change: Some(0.5),
        mix: Some((0.5, 0.5)),
        value: Some(&mut value),
        moment: Some(&mut moment),
        fit: Some(&mut fit),
        gradient: Some(&mut gradient),
        advected: Some((0.5, &mut advected)),
    };
    kernel.g2p_all(grid, particles, request);
    let matrices = moment.iter().chain(&fit).chain(&gradient).flatten();
    value.iter().chain(&advected).flatten().chain(matrices).copied().collect()
}

fn is_shared<const D: usize>(basis: BasisName, periodic: bool) {
    let (loops, whole) = (cutting::<D>(basis), kernel::<D>(basis));
    let (grid, particles) = scene(whole.as_ref(), periodic);
    let serial = mapped(whole.as_ref(), &grid, &particles);
    let run = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let loops = loops.as_ref();
        pool.install(|| (mapped(loops, &grid, &particles), sums(loops, &grid, &particles)))
    };
    let (nodes, request) = run(1);
    for (shared, one) in nodes.iter().zip(&serial) {
        assert_relative_eq!(*shared, *one, epsilon = 1e-13);
    }
    for threads in [2, 3] {
        let (others, took) = run(threads);
        assert_eq!(bits(&others), bits(&nodes), "{threads} threads");
        assert_eq!(bits(&took), bits(&request), "{threads} threads");
    }
}

/// Asserts that the sums are correct for particles in any order and at any position.
fn is_right_anywhere<const D: usize>(basis: BasisName, periodic: bool) {
    let (loops, whole) = (cutting::<D>(basis), kernel::<D>(basis));
    let (grid, mut particles) = scene(whole.as_ref(), periodic);
    let n = particles.len();
    let length = H * grid.cells[D - 1] as f64;
    let mut check = |change: &mut dyn FnMut(&mut Particles<D>)| {
        change(&mut particles);
        let serial = mapped(whole.as_ref(), &grid, &particles);
        for (shared, one) in mapped(loops.as_ref(), &grid, &particles).iter().zip(&serial) {
            assert!(
                (shared - one).abs() <= 1e-12 * (1.0 + one.abs()) || one.is_nan(),
                "{shared} {one}"
            );
        }
    };
    check(&mut |of| of.x[n / 3][D - 1] = f64::NAN);
    check(&mut |of| of.x[n / 4][D - 1] = -0.3 * H);
    check(&mut |of| of.x[n / 2][D - 1] = length);
    check(&mut |of| of.x[n - 1][D - 1] = length + 0.7 * H);
    check(&mut |of| of.domain[n / 5] *= 40.0);
    check(&mut |of| of.domain[n / 6] *= f64::INFINITY);
    check(&mut |of| of.x.reverse());
}

fn are_the_same<const D: usize>(periodic: bool) {
    for &basis in BasisName::ALL {
        is_shared::<D>(basis, periodic);
        is_right_anywhere::<D>(basis, periodic);
    }
}

#[rstest]
fn blocks_do_not_depend_on_the_number_of_threads(
    #[values(false, true)] periodic: bool,
    #[values(1, 2, 3)] dimension: usize,
) {
    in_dimension!(dimension, are_the_same(periodic));
}
