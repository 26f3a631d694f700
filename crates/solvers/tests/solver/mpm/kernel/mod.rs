//! Properties of the loops, for every basis in 1-D, 2-D and 3-D. A pass with several parts must
//! have the bits of passes with one part each, and all processor levels the same bits. Sums must
//! equal those of the textbook loops ([`textbook`]).

mod blocks;
mod textbook;

use crate::common::in_dimension;
use approx::{assert_abs_diff_eq, assert_relative_eq};
use fearless_simd::Level;
use mpm_solvers::mpm::{
    Affine, BasisName, Block, Divergence, Domain, G2pRequest, Grid, Kernel, LoopSettings, Matrix,
    Moments, P2gRequest, ParticleField, Particles, Vector, kernel, kernel_with,
};
use rstest::rstest;

const CELLS: usize = 4;

/// Creates a grid full of particles. Some domains are longer than a cell.
fn scene<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) -> (Grid<D>, Particles<D>) {
    let longer = |p: usize| if p.is_multiple_of(3) { 2.9 } else { 1.1 };
    let (grid, mut particles) = filled(kernel, (-0.3, [CELLS; D]), periodic, longer);
    particles.spacing *= 2.2;
    if kernel.domain() == Domain::Fixed {
        particles.domain.clear();
    }
    (grid, particles)
}

/// Fills a grid with particles, two to a cell and axis, with numbers in all columns. `longer`
/// returns the factor of the size of a domain.
fn filled<const D: usize>(
    kernel: &dyn Kernel<D>,
    (origin, cells): (f64, [usize; D]),
    periodic: bool,
    longer: impl Fn(usize) -> f64,
) -> (Grid<D>, Particles<D>) {
    let (h, origin) = (0.25, Vector::from_element(origin));
    let mut grid = kernel.grid(origin, h, cells, [periodic; D]);
    let to = origin + Vector::from_fn(|axis, _| h * cells[axis] as f64);
    let mut particles = Particles::fill(&Block { from: origin, to, density: 2.0 }, h, 2);
    let number = |k: usize, i: usize| libm::sin((7 * k + 3 * i + 1) as f64);
    let vector = |k: usize| Vector::<D>::from_fn(|i, _| number(k, i));
    let matrix = |k: usize| Matrix::<D>::from_fn(|i, j| number(k, i + 3 * j));
    particles.track_domains();
    for p in 0..particles.len() {
        particles.x[p] += vector(p) * (0.2 * h);
        particles.v[p] = vector(p + 1);
        particles.sigma[p] = matrix(p);
        particles.domain[p] *= longer(p);
    }
    grid.velocity.iter_mut().enumerate().for_each(|(i, v)| *v = vector(i + 2));
    grid.acceleration.iter_mut().enumerate().for_each(|(i, a)| *a = vector(i + 3));
    (grid, particles)
}

fn slopes<const D: usize>(particles: &Particles<D>) -> Vec<Matrix<D>> {
    particles.sigma.iter().map(|sigma| sigma.transpose() * 0.1).collect()
}

fn bits<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<u64> {
    numbers.into_iter().map(|x| x.to_bits()).collect()
}

/// Returns the bits of all columns that P2G writes.
fn nodes<const D: usize>(grid: &Grid<D>) -> Vec<u64> {
    bits(grid.mass.iter().chain(grid.velocity.iter().flatten()).chain(grid.force.iter().flatten()))
}

fn p2g_of_several_parts_is_that_of_each<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) {
    let (grid, particles) = scene(kernel, periodic);
    let slopes = slopes(&particles);
    for affine in [None, Some(Affine::Slope(&slopes)), Some(Affine::Moment(&slopes))] {
        for divergence in [Divergence::Gradient, Divergence::Fit] {
            let momentum = Some(ParticleField { v: &particles.v, affine });
            let (mut together, mut alone) = (grid.clone(), grid.clone());
            let all = P2gRequest { mass: true, momentum, force: Some(divergence) };
            kernel.p2g(&particles, &all, &mut together);
            for one in [
                P2gRequest { mass: true, ..P2gRequest::default() },
                P2gRequest { momentum, ..P2gRequest::default() },
                P2gRequest { force: Some(divergence), ..P2gRequest::default() },
            ] {
                kernel.p2g(&particles, &one, &mut alone);
            }
            assert_eq!(nodes(&together), nodes(&alone), "{affine:?} {divergence:?}");
        }
    }
}

/// Compares body forces with the forces of single particles, and bit by bit with the momentum of
/// equal velocities.
fn a_body_force_is_a_force_on_each_particle<const D: usize>(
    kernel: &dyn Kernel<D>,
    periodic: bool,
) {
    let (mut together, particles) = scene(kernel, periodic);
    let (mut apart, mut momentum) = (together.clone(), together.force.clone());
    let field = ParticleField { v: &particles.v, affine: None };
    kernel.p2g_momentum(&particles, field, &apart, &mut momentum);
    let expected: Vec<_> = apart.force.iter().zip(&momentum).map(|(a, b)| a + b).collect();
    kernel.p2g_body_force(&particles, &particles.v, &mut together);
    assert_eq!(together.force, expected);
    for (p, (b, m)) in particles.v.iter().zip(&particles.mass).enumerate() {
        kernel.p2g_point_force(&particles, p, &(b * *m), &mut apart);
    }
    let size = apart.force.iter().map(Vector::norm).fold(0.0, f64::max);
    assert!(size > 0.0);
    for (together, apart) in together.force.iter().zip(&apart.force) {
        assert_abs_diff_eq!(*together, *apart, epsilon = 1e-14 * size);
    }
}

fn g2p_of_several_parts_is_that_of_each<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) {
    let (grid, particles) = scene(kernel, periodic);
    let (mut v, mut advected) = (particles.v.clone(), particles.v.clone());
    let (mut moment, mut gradient) = (particles.sigma.clone(), particles.sigma.clone());
    let (mut fit, mut fit1) = (particles.sigma.clone(), particles.sigma.clone());
    let request = G2pRequest {
        change: Some(0.25),
        mix: Some((0.75, 0.25)),
        value: Some(&mut v),
        moment: Some(&mut moment),
        fit: Some(&mut fit),
        gradient: Some(&mut gradient),
        advected: Some((0.5, &mut advected)),
    };
    kernel.g2p_all(&grid, &particles, request);
    let (mut v1, mut advected1) = (particles.v.clone(), particles.v.clone());
    let (mut moment1, mut gradient1) = (particles.sigma.clone(), particles.sigma.clone());
    kernel.g2p(&grid, &grid.acceleration, &particles, (1.0, 0.25), &mut v1);
    kernel.g2p(&grid, &grid.velocity, &particles, (0.75, 0.25), &mut v1);
    kernel.g2p(&grid, &grid.velocity, &particles, (0.0, 1.0), &mut advected1);
    let moment_alone = G2pRequest { moment: Some(&mut moment1), ..G2pRequest::default() };
    kernel.g2p_all(&grid, &particles, moment_alone);
    let gradient_alone = G2pRequest { gradient: Some(&mut gradient1), ..G2pRequest::default() };
    kernel.g2p_all(&grid, &particles, gradient_alone);
    assert_eq!(bits(v.iter().flatten()), bits(v1.iter().flatten()), "velocity");
    for (p, velocity) in advected1.iter().enumerate() {
        assert_eq!(advected[p], particles.x[p] + velocity * 0.5);
    }
    assert_eq!(bits(moment.iter().flatten()), bits(moment1.iter().flatten()), "moment");
    assert_eq!(bits(gradient.iter().flatten()), bits(gradient1.iter().flatten()), "gradient");
    let alone = G2pRequest { fit: Some(&mut fit1), ..G2pRequest::default() };
    kernel.g2p_all(&grid, &particles, alone);
    assert_eq!(bits(fit.iter().flatten()), bits(fit1.iter().flatten()), "fit");
}

/// Copies particle `p` without the others.
fn alone<const D: usize>(particles: &Particles<D>, p: usize) -> Particles<D> {
    let mut one = particles.clone();
    (one.x, one.v) = (vec![particles.x[p]], vec![particles.v[p]]);
    (one.mass, one.vol) = (vec![particles.mass[p]], vec![particles.vol[p]]);
    (one.sigma, one.domain) =
        (vec![particles.sigma[p]], particles.domain.get(p).copied().into_iter().collect());
    one.x0.truncate(1);
    one
}

/// Asserts that the result of a particle does not depend on its neighbours in memory. A particle
/// outside the grid has no nodes.
fn particles_are_independent<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) {
    let (grid, mut particles) = scene(kernel, periodic);
    particles.x[3] = Vector::from_element(f64::NAN);
    let request = |particles: &Particles<D>| {
        let (mut v, mut moment) = (particles.v.clone(), particles.sigma.clone());
        let (mut fit, mut gradient) = (particles.sigma.clone(), particles.sigma.clone());
        let request = G2pRequest {
            mix: Some((0.75, 0.25)),
            value: Some(&mut v),
            moment: Some(&mut moment),
            fit: Some(&mut fit),
            gradient: Some(&mut gradient),
            ..G2pRequest::default()
        };
        kernel.g2p_all(&grid, particles, request);
        (v, [moment, fit, gradient])
    };
    let (v, matrices) = request(&particles);
    for p in 0..particles.len() {
        let of_one = request(&alone(&particles, p));
        let here = matrices.each_ref().map(|matrices| vec![matrices[p]]);
        assert_eq!(of_one, (vec![v[p]], here), "particle {p}");
    }
    let [moment, ..] = matrices;
    assert_eq!(moment[3], Matrix::<D>::zeros());
    let mut mapped = grid.clone();
    kernel.p2g_mass(&particles, &mut mapped);
    let inside: f64 = particles.mass.iter().sum::<f64>() - particles.mass[3];
    assert_relative_eq!(mapped.mass.iter().sum::<f64>(), inside, max_relative = 1e-13);
}

/// Lists the levels below the best one of this processor, down to plain arrays.
fn lower_levels() -> Vec<Level> {
    let mut levels = vec![Level::baseline()];
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    levels.extend(Level::new().as_avx2().map(Level::Avx2));
    levels
}

/// Returns the bits of everything that one pass of P2G and one of G2P write.
fn passes<const D: usize>(
    kernel: &dyn Kernel<D>,
    (grid, particles): (&Grid<D>, &Particles<D>),
) -> [Vec<u64>; 2] {
    let (mut mapped, slopes) = (grid.clone(), slopes(particles));
    let momentum = Some(ParticleField { v: &particles.v, affine: Some(Affine::Moment(&slopes)) });
    let request = P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) };
    kernel.p2g(particles, &request, &mut mapped);
    let (mut v, mut sigma) = (particles.v.clone(), particles.sigma.clone());
    let (mut fit, mut gradient) = (sigma.clone(), sigma.clone());
    let request = G2pRequest {
        change: Some(0.25),
        mix: Some((0.75, 0.25)),
        value: Some(&mut v),
        moment: Some(&mut sigma),
        fit: Some(&mut fit),
        gradient: Some(&mut gradient),
        advected: None,
    };
    kernel.g2p_all(grid, particles, request);
    let matrices = sigma.iter().chain(&fit).chain(&gradient).flatten();
    [nodes(&mapped), bits(v.iter().flatten().chain(matrices))]
}

/// Asserts that all levels that this processor supports, and plain arrays, have the same bits.
fn levels_agree<const D: usize>(basis: BasisName, periodic: bool) {
    let best = kernel::<D>(basis);
    let (grid, particles) = scene(best.as_ref(), periodic);
    let scene = (&grid, &particles);
    let best = passes(best.as_ref(), scene);
    for level in lower_levels() {
        let lower = kernel_with(basis, LoopSettings { level, ..LoopSettings::default() });
        assert!(passes(lower.as_ref(), scene) == best, "{basis:?} at {level:?}");
    }
}

/// Maximum rounding error of the fast loops, relative to the largest number of a column. Their sums
/// are factorised by axes and therefore rounded differently.
const ROUNDING: f64 = 1e-13;

fn agree<'a>(
    name: &str,
    fast: impl IntoIterator<Item = &'a f64>,
    textbook: impl IntoIterator<Item = &'a f64> + Clone,
) {
    let largest = textbook.clone().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (fast, textbook) in fast.into_iter().zip(textbook) {
        let error = (fast - textbook).abs();
        assert!(error <= ROUNDING * largest, "{name}: {fast}, by the textbook {textbook}");
    }
}

fn fast_loops_are_the_textbook_loops<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) {
    let (mut grid, particles) = scene(kernel, periodic);
    let (start, slopes) = (grid.clone(), slopes(&particles));
    let momentum = Some(ParticleField { v: &particles.v, affine: Some(Affine::Slope(&slopes)) });
    let request = P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) };
    kernel.p2g(&particles, &request, &mut grid);
    let nodes = textbook::p2g(kernel, &particles, &slopes, &start);
    agree("mass", &grid.mass, &nodes.mass);
    agree("momentum", grid.velocity.iter().flatten(), nodes.momentum.iter().flatten());
    agree("force", grid.force.iter().flatten(), nodes.force.iter().flatten());

    let (mut v, mut moment) = (particles.v.clone(), particles.sigma.clone());
    let mut gradient = particles.sigma.clone();
    kernel.g2p(&start, &start.velocity, &particles, (0.0, 1.0), &mut v);
    let moment_alone = G2pRequest { moment: Some(&mut moment), ..G2pRequest::default() };
    kernel.g2p_all(&start, &particles, moment_alone);
    let gradient_alone = G2pRequest { gradient: Some(&mut gradient), ..G2pRequest::default() };
    kernel.g2p_all(&start, &particles, gradient_alone);
    let sums = textbook::g2p(kernel, &start, &start.velocity, &particles);
    agree("velocity", v.iter().flatten(), sums.velocity.iter().flatten());
    agree("moment", moment.iter().flatten(), sums.moment.iter().flatten());
    agree("gradient", gradient.iter().flatten(), sums.gradient.iter().flatten());

    let (mut fit, mut moments) = (particles.sigma.clone(), Moments::default());
    moments.resize(particles.len());
    kernel.moments(&start, &particles, &mut moments);

    let mut pulled = particles.clone();
    for (p, sigma) in pulled.sigma.iter_mut().enumerate() {
        *sigma = slopes[p] * moments.second[p] / particles.vol[p];
    }
    let request = P2gRequest { mass: true, force: Some(Divergence::Fit), ..P2gRequest::default() };
    kernel.p2g(&pulled, &request, &mut grid);
    let force = textbook::force_by_fit(kernel, &pulled, &slopes, &start);
    agree("force by fit", grid.force.iter().flatten(), force.iter().flatten());

    let alone = G2pRequest { fit: Some(&mut fit), ..G2pRequest::default() };
    kernel.g2p_all(&start, &particles, alone);
    let product: Vec<Matrix<D>> = fit.iter().zip(&moments.second).map(|(c, d)| c * d).collect();
    agree("fit times D", product.iter().flatten(), sums.moment.iter().flatten());
}

fn obey<const D: usize>(periodic: bool) {
    for &basis in BasisName::ALL {
        let kernel = kernel::<D>(basis);
        a_body_force_is_a_force_on_each_particle(kernel.as_ref(), periodic);
        p2g_of_several_parts_is_that_of_each(kernel.as_ref(), periodic);
        g2p_of_several_parts_is_that_of_each(kernel.as_ref(), periodic);
        particles_are_independent(kernel.as_ref(), periodic);
        levels_agree::<D>(basis, periodic);
        fast_loops_are_the_textbook_loops(kernel.as_ref(), periodic);
    }
}

#[rstest]
fn loops_of_every_basis_agree_with_the_textbook(
    #[values(false, true)] periodic: bool,
    #[values(1, 2, 3)] dimension: usize,
) {
    in_dimension!(dimension, obey(periodic));
}
