//! Creates scenes: bodies in any number of dimensions, and the methods to run them with.

pub(crate) mod columns;
pub(crate) mod effect;

use mpm_solvers::mpm::{
    BasisName, Block, FrameName, LinearElastic, MassName, Matrix, Particles, SchemeName, Setup,
    TransferName, Vector, VolumeName, combine, kernel, mass_matrix, transfer,
};
use mpm_subject::Start;
use mpm_suites::suite::{Suite, yaml::Source};

/// Cell size (m).
pub(crate) const H: f64 = 0.25;

/// Time step (s) at a Courant number of about 0.01: the wave speed of the body is 1.16 m/s. At a
/// Courant number of 0.1 (but not at 0.05), USL inverts a body like this one in 3-D within 200
/// steps.
pub(crate) const DT: f64 = 2e-3;

/// Loads a suite of the repository.
pub(crate) fn suite(name: &str) -> Suite {
    let folders = std::fs::read_dir("../../verification").expect("the folder of suites");
    let files = folders.map(|folder| folder.expect("a folder").path().join(format!("{name}.yaml")));
    let file = files.into_iter().find(|file| file.is_file());
    let file = file.unwrap_or_else(|| panic!("there is no suite `{name}`"));
    Suite::load(&Source::read(&file).expect("a text")).unwrap()
}

/// Calls a function that is generic in the dimension.
macro_rules! in_dimension {
    ($dimension:expr, $check:ident($($argument:expr),*)) => {
        match $dimension {
            1 => $check::<1>($($argument),*),
            2 => $check::<2>($($argument),*),
            3 => $check::<3>($($argument),*),
            other => unreachable!("{other} dimensions"),
        }
    };
}
pub(crate) use in_dimension;

/// Lists every basis with FLIP and with APIC, and every transfer with quadratic B-splines. This is
/// the subset of [`pairs`] for whole runs.
pub(crate) fn methods() -> impl Iterator<Item = (BasisName, TransferName)> {
    pairs().filter(|(basis, transfer)| {
        matches!(transfer, TransferName::Flip | TransferName::Apic)
            || *basis == BasisName::QuadraticBSpline
    })
}

/// Lists every valid pair of a registered basis and a registered transfer.
pub(crate) fn pairs() -> impl Iterator<Item = (BasisName, TransferName)> {
    let with_every_transfer = |&basis| TransferName::ALL.iter().map(move |&t| (basis, t));
    let together = |(basis, transfer): &(BasisName, TransferName)| {
        combine(*basis, *transfer, MassName::Lumped, FrameName::Updated).is_ok()
    };
    BasisName::ALL.iter().flat_map(with_every_transfer).filter(together)
}

/// Creates a body of three cells a side in the middle of a grid of seven. No end of the body is on
/// a node, no face is fixed, and there is no effect. It moves, spins, stretches and is under
/// stress.
pub(crate) fn free_body<const D: usize>(
    method: (BasisName, TransferName),
    scheme: SchemeName,
) -> Setup<D> {
    let (from, to) = (Vector::from_element(2.03 * H), Vector::from_element(5.03 * H));
    let mut particles = Particles::<D>::fill(&Block { from, to, density: 1.0 }, H, 2);
    for p in 0..particles.len() {
        let (x, k) = (particles.x[p], p as f64);
        particles.v[p] = Vector::from_fn(|i, _| 1.2 + 0.1 * libm::sin(3.0 * x[(i + 1) % D]));
        particles.sigma[p] = scattered_stress(k);
    }
    body(method, scheme, particles, (H, 7))
}

/// Returns a symmetric stress (Pa) of irregular numbers.
pub(crate) fn scattered_stress<const D: usize>(seed: f64) -> Matrix<D> {
    let stress = Matrix::<D>::from_fn(|i, j| libm::cos(seed + (3 * i + j) as f64));
    (stress + stress.transpose()) * 0.005
}

/// Creates a set-up of `particles` on a grid of `cells` cells of size `h` (m) along every axis,
/// with a lumped mass matrix and a linear elastic material of modulus 1 Pa; no boundary conditions,
/// no effects.
pub(crate) fn body<const D: usize>(
    (basis, name): (BasisName, TransferName),
    scheme: SchemeName,
    particles: Particles<D>,
    (h, cells): (f64, usize),
) -> Setup<D> {
    let kernel = kernel::<D>(basis);
    Setup {
        grid: kernel.grid(Vector::zeros(), h, [cells; D], [false; D]),
        particles,
        kernel,
        transfer: transfer(name),
        mass: mass_matrix(MassName::Lumped),
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        material: Box::new(LinearElastic::new(1.0, 0.3)),
        effects: Vec::new(),
        boundary: Vec::new(),
        scheme,
        start: Start::AtZero,
    }
}
