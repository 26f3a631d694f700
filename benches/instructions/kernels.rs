//! Passes of P2G and G2P whose instructions are counted. Bases and transfers have the same names as
//! in suites.

use mpm_verify::mpm::{
    BasisName, Block, Grid, Kernel, Particles, Stage, Transfer, TransferName, Vector, g2p, kernel,
    transfer,
};

/// Particles in a cell, along each axis.
const PER_AXIS: usize = 2;

/// Names of the kernels with stored instruction counts: `DIMENSION/BASIS/TRANSFER/PASS`.
pub(crate) const NAMES: [&str; 16] = [
    "1d/linear/flip/p2g",
    "1d/linear/flip/g2p",
    "2d/linear/flip/p2g",
    "2d/linear/flip/g2p",
    "2d/quadratic_bspline/apic/p2g",
    "2d/quadratic_bspline/apic/g2p",
    "2d/cpdi/flip/p2g",
    "2d/cpdi/flip/g2p",
    "3d/quadratic_bspline/apic/p2g",
    "3d/quadratic_bspline/apic/g2p",
    "3d/cubic_bspline/apic/p2g",
    "3d/cubic_bspline/apic/g2p",
    "1d/cpgimp/flip/p2g",
    "1d/cpgimp/flip/g2p",
    "2d/cpgimp/apic/p2g",
    "2d/cpgimp/apic/g2p",
];

/// A cube of about 1000 particles that are displaced from their regular positions.
struct Scene<const D: usize> {
    kernel: Box<dyn Kernel<D>>,
    transfer: Box<dyn Transfer<D>>,
    grid: Grid<D>,
    particles: Particles<D>,
    advected: Vec<Vector<D>>,
}

impl<const D: usize> Scene<D> {
    fn new(basis: BasisName, name: TransferName) -> Self {
        let side = [500, 16, 5][D - 1];
        let kernel = kernel::<D>(basis);
        let grid = kernel.grid(Vector::zeros(), 1.0, [side + 2; D], [false; D]);
        let (from, to) = (Vector::from_element(1.0), Vector::from_element((side + 1) as f64));
        let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, PER_AXIS);
        for (p, (x, v)) in particles.x.iter_mut().zip(&mut particles.v).enumerate() {
            *v = Vector::from_fn(|axis, _| libm::sin((7 * p + axis) as f64));
            *x += *v * 0.2;
        }
        particles.track_domains();
        let mut transfer = transfer::<D>(name);
        transfer.start(&*kernel, &grid, &particles);
        let advected = vec![Vector::zeros(); particles.len()];
        Self { kernel, transfer, grid, particles, advected }
    }

    fn run(&mut self, pass: &str, times: u32) {
        let Self { kernel, transfer, grid, particles, advected } = self;
        for _ in 0..times {
            if pass == "p2g" {
                let all = [Stage::Mass, Stage::Momentum, Stage::Force];
                transfer.p2g(&**kernel, particles, grid, &all);
            } else {
                let all = [Stage::ParticleVelocity, Stage::Stress, Stage::Position];
                g2p(&mut **transfer, &**kernel, grid, 1e-9, particles, &all, advected);
            }
        }
    }
}

/// Runs a kernel `times` times; returns the number of particles, or `None` for an unknown name.
pub(crate) fn run(name: &str, times: u32) -> Option<usize> {
    let parts: Vec<&str> = name.split('/').collect();
    let &[dimension, basis, transfer, pass] = parts.as_slice() else { return None };
    let basis = BasisName::ALL.iter().copied().find(|known| known.name() == basis)?;
    let transfer = TransferName::ALL.iter().copied().find(|known| known.name() == transfer)?;
    Some(match dimension {
        "1d" => of::<1>(basis, transfer, pass, times),
        "2d" => of::<2>(basis, transfer, pass, times),
        "3d" => of::<3>(basis, transfer, pass, times),
        _ => return None,
    })
}

fn of<const D: usize>(basis: BasisName, name: TransferName, pass: &str, times: u32) -> usize {
    let mut scene = Scene::<D>::new(basis, name);
    scene.run(pass, times);
    scene.particles.len()
}
