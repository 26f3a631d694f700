//! Kernel that counts the particles it visits, for each part of its passes.

use super::contract::Kernel;
use super::moments::Moments;
use super::request::{G2pRequest, P2gRequest, ParticleField};
use crate::mpm::algebra::{Matrix, Vector};
use crate::mpm::basis::Domain;
use crate::mpm::grid::Grid;
use crate::mpm::particles::Particles;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

/// Particles visited for each part of a pass.
#[derive(Debug, Default)]
pub struct Tally([AtomicU64; NAMES.len()]);

const NAMES: [&str; 18] = [
    "p2g mass",
    "p2g momentum",
    "p2g internal force",
    "p2g force by fit",
    "p2g point force",
    "p2g point moment",
    "g2p velocity",
    "g2p gradient",
    "g2p moment",
    "weight moments",
    "mass matrix",
    "g2p position",
    "p2g mass gradient",
    "p2g scalar",
    "p2g scalar flux",
    "p2g scalar source",
    "g2p scalar",
    "g2p scalar gradient",
];

impl Tally {
    pub(in crate::mpm) fn add(&self, name: &str, particles: usize) {
        if let Some(pass) = NAMES.iter().position(|known| *known == name) {
            self.0[pass].fetch_add(particles as u64, Relaxed);
        }
    }

    /// Parts of passes since the last call, with the number of particles visited.
    pub fn take(&self) -> Vec<(&'static str, u64)> {
        let sums = NAMES.iter().zip(&self.0).map(|(name, count)| (*name, count.swap(0, Relaxed)));
        sums.filter(|(_, visited)| *visited > 0).collect()
    }
}

/// Kernel whose passes are counted.
pub struct Counted<const D: usize> {
    pub(in crate::mpm) kernel: Box<dyn Kernel<D>>,
    pub(in crate::mpm) tally: Arc<Tally>,
}

impl<const D: usize> Counted<D> {
    /// Wraps a kernel, with a tally for the caller to read.
    pub fn new(kernel: Box<dyn Kernel<D>>) -> (Self, Arc<Tally>) {
        let tally = Arc::new(Tally::default());
        (Self { kernel, tally: Arc::clone(&tally) }, tally)
    }

    /// Wraps a kernel, with a tally shared with other kernels.
    pub fn sharing(kernel: Box<dyn Kernel<D>>, tally: &Arc<Tally>) -> Self {
        Self { kernel, tally: Arc::clone(tally) }
    }
}

impl<const D: usize> Kernel<D> for Counted<D> {
    fn p2g(&self, particles: &Particles<D>, request: &P2gRequest<'_, D>, grid: &mut Grid<D>) {
        request.parts().for_each(|name| self.tally.add(name, particles.len()));
        self.kernel.p2g(particles, request, grid);
    }

    fn g2p_all(&self, grid: &Grid<D>, particles: &Particles<D>, request: G2pRequest<'_, D>) {
        request.parts().for_each(|name| self.tally.add(name, particles.len()));
        self.kernel.g2p_all(grid, particles, request);
    }

    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: ParticleField<'_, D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    ) {
        self.tally.add("p2g momentum", particles.len());
        self.kernel.p2g_momentum(particles, shown, grid, momentum);
    }

    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) {
        self.tally.add("p2g point force", 1);
        self.kernel.p2g_point_force(particles, p, force, grid);
    }

    fn g2p(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        keep_and_factor: (f64, f64),
        value: &mut [Vector<D>],
    ) {
        self.tally.add("g2p velocity", particles.len());
        self.kernel.g2p(grid, field, particles, keep_and_factor, value);
    }

    fn g2p_gradient(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        gradient: &mut [Matrix<D>],
    ) {
        self.tally.add("g2p gradient", particles.len());
        self.kernel.g2p_gradient(grid, field, particles, gradient);
    }

    fn g2p_moment(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        moment: &mut [Matrix<D>],
    ) {
        self.tally.add("g2p moment", particles.len());
        self.kernel.g2p_moment(grid, field, particles, moment);
    }

    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>) {
        self.tally.add("weight moments", particles.len());
        self.kernel.moments(grid, particles, moments);
    }

    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    ) {
        self.tally.add("mass matrix", particles.len());
        self.kernel.mass_entries(grid, particles, entry);
    }

    /// Not counted: part of the pass that it prepares.
    fn divide_by_inertia(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        matrices: &mut [Matrix<D>],
    ) {
        self.kernel.divide_by_inertia(grid, particles, matrices);
    }

    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    ) {
        self.tally.add("p2g point moment", 1);
        self.kernel.p2g_point_moment(particles, p, moment, grid);
    }

    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    ) {
        self.tally.add("p2g mass gradient", particles.len());
        self.kernel.p2g_mass_gradient(particles, grid, gradient);
    }

    fn support(&self) -> u64 {
        self.kernel.support()
    }

    fn domain(&self) -> Domain {
        self.kernel.domain()
    }

    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D> {
        self.kernel.grid(origin, h, cells, periodic)
    }
}
