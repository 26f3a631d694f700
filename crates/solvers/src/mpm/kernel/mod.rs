//! The P2G and G2P loops, compiled once for each basis and dimension.
//!
//! ```text
//! particles   [ 16 particles ][ 16 particles ] ...   batch.rs: weights of a batch, four at once
//!                  | one patch after another
//! patch        K^D nodes   . x x x .                p2g.rs: particle -> x   g2p.rs: x -> particle
//! (K = 3, 2-D)             . x x x .                one register holds the components of a node
//!                          . x x x .                K nodes of a row are neighbours in memory
//!                  |
//! grid         packed_grid: four or eight numbers per node, packed before, unpacked after a pass
//!
//! threads      |  even 0  | odd 0 |  even 1  | odd 1 |  even 2  |      blocks along the last axis
//!              +----------+-------+----------+-------+----------+
//!              1. even blocks at once: they have no node in common
//!              2. odd block k, after even blocks k and k + 1 (colouring.rs, parallel.rs)
//! ```
//!
//! `tests/solver/mpm/kernel/textbook.rs` computes the same sums with textbook loops. Sums run over
//! particles and nodes in a fixed order, so results are bit-identical on any processor and for any
//! number of threads.

pub(crate) mod contract;

mod batch;
mod colouring;
mod g2p;
mod p2g;
mod parallel;
mod source;
mod workspace;

use self::source::inertia;
use self::workspace::Workspace;
use super::basis::{Basis, BasisName, Domain, LoopsUser, NodeWeight, with_basis};
use super::foundation::algebra::{Vector, zeros};
use super::foundation::grid::Grid;
use super::foundation::moments::{Moments, WeightMoments};
use super::foundation::packed_grid::Columns;
use super::foundation::particles::Particles;
use contract::{G2pRequest, Kernel, LoopSettings, P2gRequest, ParticleField, Tally};
use mpm_subject::with_dimension;
use std::any::Any;
use std::marker::PhantomData;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Creates the kernel of the basis with this name.
pub fn kernel<const D: usize>(basis: BasisName) -> Box<dyn Kernel<D>> {
    kernel_with(basis, LoopSettings::default())
}

/// Creates the kernel of the basis with this name and the given loop settings.
pub fn kernel_with<const D: usize>(basis: BasisName, settings: LoopSettings) -> Box<dyn Kernel<D>> {
    let kernel = kernel_in_dimension(D, basis, settings).downcast::<Box<dyn Kernel<D>>>();
    *kernel.unwrap_or_else(|_| unreachable!("no kernel in {D} dimensions"))
}

/// Creates a `Box<dyn Kernel<D>>` and returns it as `Any`. The function is not generic, so that the
/// loops are compiled only in this crate.
fn kernel_in_dimension(dimension: usize, basis: BasisName, settings: LoopSettings) -> Box<dyn Any> {
    fn boxed<const D: usize>(basis: BasisName, settings: LoopSettings) -> Box<dyn Kernel<D>> {
        let domain = with_basis!(basis, B => B::DOMAIN);
        with_basis!(basis, B => B::with_loops(NewLoops::<D> { settings, domain }))
    }
    with_dimension!(dimension, D => Box::new(boxed::<D>(basis, settings)))
}

/// Creates the kernel of a basis.
struct NewLoops<const D: usize> {
    settings: LoopSettings,
    domain: Domain,
}

impl<const D: usize> LoopsUser for NewLoops<D> {
    type Output = Box<dyn Kernel<D>>;

    fn call<B: Basis>(self) -> Self::Output {
        let Self { settings, domain } = self;
        let workspace = Mutex::new(Workspace::new(settings));
        Box::new(Loops::<B> { workspace, tally: Tally::default(), domain, basis: PhantomData })
    }
}

struct Loops<B> {
    /// Memory reused by all passes. Results do not depend on the old contents.
    workspace: Mutex<Workspace>,
    tally: Tally,
    domain: Domain,
    basis: PhantomData<B>,
}

impl<B: Basis> Loops<B> {
    fn workspace(&self) -> MutexGuard<'_, Workspace> {
        // A panic in an earlier pass is harmless, because the next pass overwrites all contents.
        self.workspace.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<const D: usize, B: Basis> Kernel<D> for Loops<B> {
    #[inline(never)]
    fn visit(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: &mut dyn FnMut(NodeWeight<'_, D>),
    ) {
        B::visit(grid, particles, p, visit);
    }

    fn p2g(&self, particles: &Particles<D>, request: &P2gRequest<'_, D>, grid: &mut Grid<D>) {
        request.parts().for_each(|name| self.tally.add(name, particles.len()));
        let mut mass = std::mem::take(&mut grid.mass);
        let mut momentum = std::mem::take(&mut grid.velocity);
        let mut force = std::mem::take(&mut grid.force);
        let columns = Columns {
            mass: request.mass.then_some(&mut mass),
            momentum: request.momentum.is_some().then_some(&mut momentum),
            force: request.force.is_some().then_some(&mut force),
            ..Columns::default()
        };
        self.workspace().scatter::<B, D>(particles, request, grid, columns);
        (grid.mass, grid.velocity, grid.force) = (mass, momentum, force);
    }

    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: ParticleField<'_, D>,
        grid: &Grid<D>,
        column: &mut [Vector<D>],
    ) {
        self.tally.add("p2g momentum", particles.len());
        let request = P2gRequest { momentum: Some(shown), ..P2gRequest::default() };
        let columns = Columns { momentum: Some(column), ..Columns::default() };
        self.workspace().scatter::<B, D>(particles, &request, grid, columns);
    }

    fn p2g_body_force(&self, particles: &Particles<D>, b: &[Vector<D>], grid: &mut Grid<D>) {
        self.tally.add("p2g point force", particles.len());
        // The sums equal those of the momentum for the velocities b.
        let field = ParticleField { v: b, affine: None };
        let request = P2gRequest { momentum: Some(field), ..P2gRequest::default() };
        let mut force = std::mem::take(&mut grid.force);
        let columns = Columns { added: Some(&mut force), ..Columns::default() };
        self.workspace().scatter::<B, D>(particles, &request, grid, columns);
        grid.force = force;
    }

    fn g2p_field(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        request: G2pRequest<'_, D>,
    ) {
        request.parts().for_each(|name| self.tally.add(name, particles.len()));
        self.workspace().gather::<B, D>(grid, particles, field, request);
    }

    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>) {
        self.tally.add("weight moments", particles.len());
        for (p, (mean, second)) in moments.mean.iter_mut().zip(&mut moments.second).enumerate() {
            WeightMoments { mean: *mean, second: *second } = inertia::<D, B>(grid, particles, p);
        }
    }

    fn p2g_domain_end(
        &self,
        particles: &Particles<D>,
        p: usize,
        end: (usize, f64),
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) -> bool {
        let mut column = std::mem::take(&mut grid.force);
        let mut is_corrected = false;
        B::visit_domain_end(grid, particles, p, end, |i| {
            column[i.node] += force * i.weight;
            is_corrected = true;
        });
        grid.force = column;
        self.tally.add("p2g point force", usize::from(is_corrected));
        is_corrected
    }

    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    ) {
        self.tally.add("p2g mass gradient", particles.len());
        gradient.fill(zeros());
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| gradient[i.node] += i.gradient * *m);
        }
    }

    fn p2g_scalar(
        &self,
        particles: &Particles<D>,
        value: &[f64],
        slope: &[Vector<D>],
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar", particles.len());
        column.fill(0.0);
        for (p, m) in particles.mass.iter().enumerate() {
            let (value, slope) = (value[p] * *m, slope[p] * *m);
            B::visit(grid, particles, p, |i| {
                column[i.node] += (value + slope.dot(&i.offset)) * i.weight;
            });
        }
    }

    fn p2g_flow(
        &self,
        particles: &Particles<D>,
        slope: &[Vector<D>],
        factor: f64,
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally.add("p2g scalar flux", particles.len());
        column.fill(0.0);
        for (p, vol) in particles.vol.iter().enumerate() {
            let flow = slope[p] * (factor * vol);
            B::visit(grid, particles, p, |i| column[i.node] += flow.dot(i.gradient));
        }
    }

    fn g2p_scalar(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        factor: f64,
        value: &mut [f64],
    ) {
        self.tally.add("g2p scalar", particles.len());
        for (p, value) in value.iter_mut().enumerate() {
            let mut sum = 0.0;
            B::visit(grid, particles, p, |i| sum += field[i.node] * i.weight);
            *value += sum * factor;
        }
    }

    fn g2p_slope(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        slope: &mut [Vector<D>],
    ) {
        self.tally.add("g2p scalar gradient", particles.len());
        for (p, slope) in slope.iter_mut().enumerate() {
            slope.fill(0.0);
            B::visit(grid, particles, p, |i| *slope += i.gradient * field[i.node]);
        }
    }

    fn tally(&self) -> &Tally {
        &self.tally
    }

    fn support(&self) -> u64 {
        B::support(D)
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D> {
        let counts = std::array::from_fn(|axis| B::count(cells[axis], periodic[axis]));
        Grid::new(origin, h, cells, periodic, counts)
    }
}
