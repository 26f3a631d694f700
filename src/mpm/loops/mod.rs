//! The particle-node loops: the only place where a basis meets particles and grid.
//!
//! Sums run over particles in their order and over nodes in theirs, so results are the same bits
//! everywhere. Transfers are made of these loops and need none of their own: they exist once for
//! each basis and dimension. Fields of nodes are packed for a pass and unpacked after it, which costs
//! as much as the nodes of some few particles.

mod gather;
mod inertia;
#[cfg(test)]
mod laws;
mod scalars;
mod scatter;
mod sight;
mod unpack;

use self::{
    gather::Gather,
    inertia::inertia,
    scatter::Scatter,
    unpack::{fill, vector},
};
use super::{
    algebra::{Matrix, Vector},
    basis::{Basis, BasisName, Domain, with_basis},
    four,
    grid::Grid,
    kernel::{Kernel, Maps, Shown, Takes},
    moments::{Inertia, Moments},
    packed::Packed,
    particles::Particles,
};
use std::{
    marker::PhantomData,
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Builds the kernel of the basis that a suite names.
pub fn kernel<const D: usize>(basis: BasisName) -> Box<dyn Kernel<D>> {
    with_basis!(basis, B => Box::new(Loops::<B>::default()))
}

/// Two fields of nodes, packed.
type Fields = [Packed; 2];

/// The kernel of basis `B`.
struct Loops<B> {
    /// Room for the fields of a pass, kept from one to the next. No result depends on what it holds.
    room: Mutex<Fields>,
    basis: PhantomData<B>,
}

impl<B> Default for Loops<B> {
    fn default() -> Self {
        Self { room: Mutex::default(), basis: PhantomData }
    }
}

impl<B: Basis> Loops<B> {
    fn room(&self) -> MutexGuard<'_, Fields> {
        // A pass that has panicked leaves numbers that the next one overwrites.
        self.room.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn scatter<const D: usize>(
        &self,
        particles: &Particles<D>,
        maps: &Maps<'_, D>,
        grid: &Grid<D>,
    ) -> MutexGuard<'_, Fields> {
        let mut room = self.room();
        let wanted = [maps.mass || maps.momentum.is_some(), maps.force.is_some()];
        let in_use = |room: &mut Fields, work: fn(&mut Packed, &Grid<D>)| {
            for (field, _) in room.iter_mut().zip(wanted).filter(|(_, wanted)| *wanted) {
                work(field, grid);
            }
        };
        in_use(&mut room, Packed::clear);
        let fields = room.each_mut().map(Packed::view_mut);
        four::run(Scatter::<D, B> { grid, particles, maps, fields, basis: PhantomData });
        in_use(&mut room, Packed::fold);
        room
    }

    fn gather<const D: usize>(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        field: &[Vector<D>],
        takes: Takes<'_, D>,
    ) {
        let mut room = self.room();
        let [velocity, acceleration] = &mut *room;
        velocity.pack(grid, field);
        if takes.change.is_some() {
            acceleration.pack(grid, &grid.acceleration);
        }
        let fields = room.each_ref().map(Packed::view);
        four::run(Gather::<D, B> { grid, particles, takes, fields, basis: PhantomData });
    }
}

impl<const D: usize, B: Basis> Kernel<D> for Loops<B> {
    fn p2g(&self, particles: &Particles<D>, maps: &Maps<'_, D>, grid: &mut Grid<D>) {
        let room = self.scatter(particles, maps, grid);
        let [momentum, force] = &*room;
        if maps.mass {
            let mut column = std::mem::take(&mut grid.mass);
            fill(momentum, grid, &mut column, |lanes| lanes[3]);
            grid.mass = column;
        }
        if maps.momentum.is_some() {
            let mut column = std::mem::take(&mut grid.velocity);
            fill(momentum, grid, &mut column, vector);
            grid.velocity = column;
        }
        if maps.force.is_some() {
            let mut column = std::mem::take(&mut grid.force);
            fill(force, grid, &mut column, vector);
            grid.force = column;
        }
    }

    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: Shown<'_, D>,
        grid: &Grid<D>,
        column: &mut [Vector<D>],
    ) {
        let maps = Maps { momentum: Some(shown), ..Maps::default() };
        fill(&self.scatter(particles, &maps, grid)[0], grid, column, vector);
    }

    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, particles, p, |i| column[i.node] += force * i.weight);
        grid.force = column;
    }

    fn g2p_all(&self, grid: &Grid<D>, particles: &Particles<D>, takes: Takes<'_, D>) {
        self.gather(grid, particles, &grid.velocity, takes);
    }

    fn g2p(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        keep_and_factor: (f64, f64),
        value: &mut [Vector<D>],
    ) {
        let (mix, value) = (Some(keep_and_factor), Some(value));
        self.gather(grid, particles, field, Takes { mix, value, ..Takes::default() });
    }

    fn g2p_gradient(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        gradient: &mut [Matrix<D>],
    ) {
        let gradient = Some(gradient);
        self.gather(grid, particles, field, Takes { gradient, ..Takes::default() });
    }

    fn g2p_moment(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        moment: &mut [Matrix<D>],
    ) {
        let moment = Some(moment);
        self.gather(grid, particles, field, Takes { moment, ..Takes::default() });
    }

    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>) {
        for (p, (mean, second)) in moments.mean.iter_mut().zip(&mut moments.second).enumerate() {
            Inertia { mean: *mean, second: *second } = inertia::<D, B>(grid, particles, p);
        }
    }

    fn divide_by_inertia(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        matrices: &mut [Matrix<D>],
    ) {
        for (p, matrix) in matrices.iter_mut().enumerate() {
            *matrix = inertia::<D, B>(grid, particles, p).divide(matrix, grid.h);
        }
    }

    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    ) {
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| {
                B::visit(grid, particles, p, |j| entry(i.node, j.node, m * i.weight * j.weight));
            });
        }
    }

    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    ) {
        let mut column = std::mem::take(&mut grid.force);
        B::visit(grid, particles, p, |i| column[i.node] += moment * i.gradient);
        grid.force = column;
    }

    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    ) {
        gradient.fill(Vector::zeros());
        for (p, m) in particles.mass.iter().enumerate() {
            B::visit(grid, particles, p, |i| gradient[i.node] += i.gradient * *m);
        }
    }

    fn support(&self) -> u64 {
        B::support(D)
    }

    fn domain(&self) -> Domain {
        B::DOMAIN
    }

    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D> {
        let counts = std::array::from_fn(|axis| B::count(cells[axis], periodic[axis]));
        Grid::new(origin, h, cells, periodic, counts)
    }
}
