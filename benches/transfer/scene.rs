//! Scene of the benchmarks: a cube of particles in random motion, and the passes over them.

use crate::random::Random;
use mpm_verify::mpm::{
    BasisName, Block, Grid, Kernel, Particles, Stage, Transfer, TransferName, Vector, g2p, kernel,
    transfer,
};

pub(crate) const H: f64 = 1.0;
pub(crate) const PER_AXIS: usize = 2;

/// Order of the particles in memory.
#[derive(Clone, Copy)]
pub(crate) enum Order {
    /// Sorted by cell.
    Sorted,
    /// Random.
    Shuffled,
}

impl Order {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Sorted => "sorted",
            Self::Shuffled => "shuffled",
        }
    }
}

/// Shuffles by the Fisher-Yates algorithm.
fn shuffle<T>(random: &mut Random, items: &mut [T]) {
    for last in (1..items.len()).rev() {
        items.swap(last, (random.next() % (last as u64 + 1)) as usize);
    }
}

/// Returns the number of cells along each side of a cube of about `count` particles.
fn side<const D: usize>(count: usize) -> usize {
    let per_cell = PER_AXIS.pow(D as u32) as f64;
    libm::round(libm::pow(count as f64 / per_cell, 1.0 / D as f64)).max(1.0) as usize
}

/// Returns the exact number of particles in a cube of about `count` particles.
pub(crate) fn total<const D: usize>(count: usize) -> usize {
    (PER_AXIS * side::<D>(count)).pow(D as u32)
}

/// Creates a cube of about `count` particles in random motion, with one empty cell along each wall.
pub(crate) fn scene<const D: usize>(
    kernel: &dyn Kernel<D>,
    count: usize,
    order: Order,
) -> (Grid<D>, Particles<D>) {
    let side = side::<D>(count);
    let grid = kernel.grid(Vector::zeros(), H, [side + 2; D], [false; D]);
    let (from, to) = (Vector::from_element(H), Vector::from_element(H * (side + 1) as f64));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, H, PER_AXIS);
    match order {
        Order::Sorted => particles.x.sort_by_key(|x| grid.node(&grid.cell(x).expect("inside"))),
        Order::Shuffled => shuffle(&mut Random(1), &mut particles.x),
    }
    particles.x0.clone_from(&particles.x);
    let mut random = Random(2);
    particles.v.fill_with(|| Vector::from_fn(|_, _| random.signed()));
    (grid, particles)
}

/// Loops of a basis, and a transfer that is initialised with the particles.
pub(crate) struct Method<const D: usize> {
    pub(crate) kernel: Box<dyn Kernel<D>>,
    pub(crate) transfer: Box<dyn Transfer<D>>,
    /// Position of each particle after the step (m).
    advected: Vec<Vector<D>>,
}

impl<const D: usize> Method<D> {
    /// Creates the method with these names, and its scene.
    pub(crate) fn new(
        (basis, name): (BasisName, TransferName),
        order: Order,
        count: usize,
    ) -> (Self, Grid<D>, Particles<D>) {
        let kernel = kernel::<D>(basis);
        let (grid, particles) = scene::<D>(&*kernel, count, order);
        let mut transfer = transfer::<D>(name);
        transfer.start(&*kernel, &grid, &particles);
        (Self { kernel, transfer, advected: Vec::new() }, grid, particles)
    }

    pub(crate) fn p2g(&mut self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let kernel = &*self.kernel;
        let all = [Stage::Mass, Stage::Momentum, Stage::Force];
        self.transfer.p2g(kernel, particles, grid, &all);
    }

    pub(crate) fn g2p(&mut self, grid: &Grid<D>, dt: f64, particles: &mut Particles<D>) {
        self.advected.resize(particles.len(), Vector::zeros());
        let all = [Stage::ParticleVelocity, Stage::Stress, Stage::Position];
        let (transfer, advected) = (&mut *self.transfer, &mut *self.advected);
        g2p(transfer, &*self.kernel, grid, dt, particles, &all, advected);
        std::mem::swap(&mut particles.x, &mut self.advected);
    }
}
