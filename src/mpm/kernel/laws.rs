//! What every basis keeps in the loops: a pass that does several things has the bits of passes that do
//! one each, both widths have the same bits, and sums are those over the nodes one by one.

use super::{
    Loops,
    contract::Kernel,
    g2p::Gather,
    p2g::Scatter,
    request::{Affine, Divergence, G2pRequest, P2gRequest, ParticleField},
    workspace::pack,
};
use crate::mpm::{
    algebra::{Matrix, Vector, dyad},
    basis::{Basis, BasisName, with_basis},
    grid::Grid,
    packed_grid::{Columns, FieldViewMut, PackedField},
    particles::{Block, Particles},
    simd::{Pass, Plain, lower_levels, run_at},
};
use approx::assert_relative_eq;
use fearless_simd::Level;
use rstest::rstest;
use std::marker::PhantomData;

const CELLS: usize = 4;

/// A grid full of particles, two to a cell and axis, with every column filled with numbers. Some domains
/// are longer than a cell.
fn scene<const D: usize>(kernel: &dyn Kernel<D>, periodic: bool) -> (Grid<D>, Particles<D>) {
    let (h, origin) = (0.25, Vector::from_element(-0.3));
    let mut grid = kernel.grid(origin, h, [CELLS; D], [periodic; D]);
    let to = origin + Vector::from_element(h * CELLS as f64);
    let mut particles = Particles::fill(&Block { from: origin, to, density: 2.0 }, h, 2);
    let number = |k: usize, i: usize| libm::sin((7 * k + 3 * i + 1) as f64);
    let vector = |k: usize| Vector::<D>::from_fn(|i, _| number(k, i));
    let matrix = |k: usize| Matrix::<D>::from_fn(|i, j| number(k, i + 3 * j));
    particles.track_domains();
    particles.spacing *= 2.2;
    for p in 0..particles.len() {
        particles.x[p] += vector(p) * (0.2 * h);
        particles.v[p] = vector(p + 1);
        particles.sigma[p] = matrix(p);
        particles.domain[p] *= if p % 3 == 0 { 2.9 } else { 1.1 };
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

/// All that P2G writes.
fn nodes<const D: usize>(grid: &Grid<D>) -> Vec<u64> {
    bits(grid.mass.iter().chain(grid.velocity.iter().flatten()).chain(grid.force.iter().flatten()))
}

fn maps_together_are_maps_alone<B: Basis, const D: usize>(periodic: bool) {
    let kernel = Loops::<B>::default();
    let (grid, particles) = scene::<D>(&kernel, periodic);
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

fn takes_together_are_takes_alone<B: Basis, const D: usize>(periodic: bool) {
    let kernel = Loops::<B>::default();
    let (grid, particles) = scene::<D>(&kernel, periodic);
    let (mut v, mut advected) = (particles.v.clone(), particles.v.clone());
    let (mut moment, mut gradient) = (particles.sigma.clone(), particles.sigma.clone());
    let takes = G2pRequest {
        change: Some(0.25),
        mix: Some((0.75, 0.25)),
        value: Some(&mut v),
        moment: Some(&mut moment),
        gradient: Some(&mut gradient),
        advected: Some((0.5, &mut advected)),
    };
    kernel.g2p_all(&grid, &particles, takes);
    let (mut v1, mut advected1) = (particles.v.clone(), particles.v.clone());
    let (mut moment1, mut gradient1) = (particles.sigma.clone(), particles.sigma.clone());
    kernel.g2p(&grid, &grid.acceleration, &particles, (1.0, 0.25), &mut v1);
    kernel.g2p(&grid, &grid.velocity, &particles, (0.75, 0.25), &mut v1);
    kernel.g2p(&grid, &grid.velocity, &particles, (0.0, 1.0), &mut advected1);
    kernel.g2p_moment(&grid, &grid.velocity, &particles, &mut moment1);
    kernel.g2p_gradient(&grid, &grid.velocity, &particles, &mut gradient1);
    assert_eq!(bits(v.iter().flatten()), bits(v1.iter().flatten()), "velocity");
    for (p, velocity) in advected1.iter().enumerate() {
        assert_eq!(advected[p], particles.x[p] + velocity * 0.5);
    }
    assert_eq!(bits(moment.iter().flatten()), bits(moment1.iter().flatten()), "moment");
    assert_eq!(bits(gradient.iter().flatten()), bits(gradient1.iter().flatten()), "gradient");
}

/// Particle `p` of these, alone.
fn alone<const D: usize>(particles: &Particles<D>, p: usize) -> Particles<D> {
    let mut one = particles.clone();
    (one.x, one.v) = (vec![particles.x[p]], vec![particles.v[p]]);
    (one.mass, one.vol) = (vec![particles.mass[p]], vec![particles.vol[p]]);
    (one.sigma, one.domain) = (vec![particles.sigma[p]], vec![particles.domain[p]]);
    one.x0.truncate(1);
    one
}

/// What particles see does not depend on which others are near in their columns; those outside the grid
/// see zero.
fn together_is_alone<B: Basis, const D: usize>(periodic: bool) {
    let kernel = Loops::<B>::default();
    let (grid, mut particles) = scene::<D>(&kernel, periodic);
    particles.x[3] = Vector::from_element(f64::NAN);
    let takes = |particles: &Particles<D>| {
        let (mut v, mut moment) = (particles.v.clone(), particles.sigma.clone());
        let mut gradient = particles.sigma.clone();
        let takes = G2pRequest {
            mix: Some((0.75, 0.25)),
            value: Some(&mut v),
            moment: Some(&mut moment),
            gradient: Some(&mut gradient),
            ..G2pRequest::default()
        };
        kernel.g2p_all(&grid, particles, takes);
        (v, moment, gradient)
    };
    let (v, moment, gradient) = takes(&particles);
    for p in 0..particles.len() {
        let of_one = takes(&alone(&particles, p));
        assert_eq!(of_one, (vec![v[p]], vec![moment[p]], vec![gradient[p]]), "particle {p}");
    }
    assert_eq!(moment[3], Matrix::<D>::zeros());
    let mut mapped = grid.clone();
    kernel.p2g_mass(&particles, &mut mapped);
    let inside: f64 = particles.mass.iter().sum::<f64>() - particles.mass[3];
    assert_relative_eq!(mapped.mass.iter().sum::<f64>(), inside, max_relative = 1e-13);
}

/// The loops as the processor at hand runs them, as one of less can, and over plain arrays.
fn widths_agree<B: Basis, const D: usize>(periodic: bool) {
    let kernel = Loops::<B>::default();
    let (mut grid, particles) = scene::<D>(&kernel, periodic);
    let (slopes, start) = (slopes(&particles), grid.clone());
    let momentum = Some(ParticleField { v: &particles.v, affine: Some(Affine::Moment(&slopes)) });
    let maps = P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) };
    kernel.p2g(&particles, &maps, &mut grid);
    let mut workspace = [PackedField::default(), PackedField::default()];
    let mut fields = workspace.each_mut().map(|field| field.shaped(&start));
    fields.iter_mut().for_each(FieldViewMut::clear);
    let (maps, these, basis) = (&maps, 0..particles.len(), PhantomData);
    Scatter::<D, B> { grid: &start, particles: &particles, these, request: maps, fields, basis }
        .run(Plain);
    for field in &mut workspace {
        field.fold(&start);
    }
    let mut plain = start.clone();
    let columns = Columns {
        mass: Some(&mut plain.mass),
        momentum: Some(&mut plain.velocity),
        force: Some(&mut plain.force),
        is_one_field: D == 1,
        ..Columns::default()
    };
    columns.unpack_all(&start, &workspace.each_mut().map(|field| field.shaped(&start)));
    assert_eq!(nodes(&grid), nodes(&plain));

    let take = |run: &dyn Fn(G2pRequest<'_, D>)| {
        let (mut v, mut sigma) = (particles.v.clone(), particles.sigma.clone());
        let mut gradient = sigma.clone();
        run(G2pRequest {
            change: Some(0.25),
            mix: Some((0.75, 0.25)),
            value: Some(&mut v),
            moment: Some(&mut sigma),
            gradient: Some(&mut gradient),
            advected: None,
        });
        bits(v.iter().flatten().chain(sigma.iter().flatten()).chain(gradient.iter().flatten()))
    };
    let best = take(&|takes| kernel.g2p_all(&start, &particles, takes));
    let mut workspace = [PackedField::default(), PackedField::default()];
    pack(&mut workspace, &start, &start.velocity, true);
    let fields = workspace.each_ref().map(PackedField::view);
    let gather = |level: Option<Level>| {
        take(&|takes| {
            let (these, basis) = (0..particles.len(), PhantomData);
            let (grid, particles) = (&start, &particles);
            let pass = Gather::<D, B> { grid, particles, these, takes, fields, basis };
            match level {
                Some(level) => run_at(level, pass),
                None => pass.run(Plain),
            }
        })
    };
    assert_eq!(best, gather(None));
    for level in lower_levels() {
        assert_eq!(best, gather(Some(level)), "{level:?}");
    }
}

/// The sums of the formulas, over nodes one by one.
fn sums_are_those_over_nodes<B: Basis, const D: usize>(periodic: bool) {
    let kernel = Loops::<B>::default();
    let (mut grid, particles) = scene::<D>(&kernel, periodic);
    let (start, slopes) = (grid.clone(), slopes(&particles));
    let momentum = Some(ParticleField { v: &particles.v, affine: Some(Affine::Slope(&slopes)) });
    let maps = P2gRequest { mass: true, momentum, force: Some(Divergence::Gradient) };
    kernel.p2g(&particles, &maps, &mut grid);
    let mut expected = start.clone();
    expected.mass.fill(0.0);
    expected.velocity.fill(Vector::zeros());
    expected.force.fill(Vector::zeros());
    let (mut moment, mut gradient) = (particles.sigma.clone(), particles.sigma.clone());
    kernel.g2p_moment(&start, &start.velocity, &particles, &mut moment);
    kernel.g2p_gradient(&start, &start.velocity, &particles, &mut gradient);
    for p in 0..particles.len() {
        let (m, flux, mut mean) = (particles.mass[p], particles.flux(p), Vector::<D>::zeros());
        B::visit(&start, &particles, p, |i| mean += i.offset * i.weight);
        let (mut first, mut slope) = (Matrix::<D>::zeros(), Matrix::<D>::zeros());
        B::visit(&start, &particles, p, |i| {
            let v = particles.v[p] + slopes[p] * (i.offset - mean);
            expected.mass[i.node] += m * i.weight;
            expected.velocity[i.node] += v * (m * i.weight);
            expected.force[i.node] -= flux * i.gradient;
            first += dyad(&start.velocity[i.node], &(i.offset - mean)) * i.weight;
            slope += dyad(&start.velocity[i.node], i.gradient);
        });
        assert_relative_eq!(moment[p], first, epsilon = 1e-14);
        assert_relative_eq!(gradient[p], slope, epsilon = 1e-12);
    }
    for i in 0..grid.nodes() {
        assert_relative_eq!(grid.mass[i], expected.mass[i], epsilon = 1e-14);
        assert_relative_eq!(grid.velocity[i], expected.velocity[i], epsilon = 1e-14);
        assert_relative_eq!(grid.force[i], expected.force[i], epsilon = 1e-13);
    }
}

fn obey<B: Basis, const D: usize>(periodic: bool) {
    maps_together_are_maps_alone::<B, D>(periodic);
    takes_together_are_takes_alone::<B, D>(periodic);
    together_is_alone::<B, D>(periodic);
    widths_agree::<B, D>(periodic);
    sums_are_those_over_nodes::<B, D>(periodic);
}

#[rstest]
fn the_loops_of_every_basis_obey_their_laws(#[values(false, true)] periodic: bool) {
    for &name in BasisName::ALL {
        with_basis!(name, B => {
            obey::<B, 1>(periodic);
            obey::<B, 2>(periodic);
            obey::<B, 3>(periodic);
        });
    }
}
