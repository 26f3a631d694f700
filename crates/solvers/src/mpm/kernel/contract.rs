//! Passes over particles and nodes, the building blocks of transfers, mass matrices and effects.
//!
//! [`Kernel`] is object-safe: there is one virtual call per pass, none per particle. Each pass
//! recomputes the weights of all particles, so one pass can compute several quantities
//! ([`P2gRequest`], [`G2pRequest`]). Each quantity is bit-identical to the result of a separate
//! pass.

use crate::mpm::basis::{Domain, NodeWeight};
use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::Moments;
use crate::mpm::foundation::particles::Particles;
use fearless_simd::Level;
use std::sync::OnceLock;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

/// Passes of P2G and G2P for one basis.
pub trait Kernel<const D: usize>: Send + Sync {
    /// Calls `visit` for every node of particle `p`. If a node occurs in several calls, the weight
    /// and gradient of the node are sums over these calls. Frequent passes do not use this method,
    /// but loops that are compiled for each basis.
    fn visit(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: &mut dyn FnMut(NodeWeight<'_, D>),
    );

    /// Computes all quantities of `request`, from particles to nodes, in one pass.
    fn p2g(&self, particles: &Particles<D>, request: &P2gRequest<'_, D>, grid: &mut Grid<D>);

    /// Computes all quantities of `request`, from nodes to particles, in one pass. `field` takes
    /// the place of the nodal velocities.
    fn g2p_field(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        request: G2pRequest<'_, D>,
    );

    /// Computes all quantities of `request` from the nodal velocities, in one pass.
    fn g2p_all(&self, grid: &Grid<D>, particles: &Particles<D>, request: G2pRequest<'_, D>) {
        self.g2p_field(grid, &grid.velocity, particles, request);
    }

    /// Computes only the mass `m_i`, see [`P2gRequest::mass`].
    fn p2g_mass(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        self.p2g(particles, &P2gRequest { mass: true, ..P2gRequest::default() }, grid);
    }

    /// Computes only the momentum, see [`P2gRequest::momentum`], and writes it to `momentum`.
    fn p2g_momentum(
        &self,
        particles: &Particles<D>,
        shown: ParticleField<'_, D>,
        grid: &Grid<D>,
        momentum: &mut [Vector<D>],
    );

    /// Computes only the internal force from basis gradients, see [`P2gRequest::force`].
    fn p2g_internal_force(&self, particles: &Particles<D>, grid: &mut Grid<D>) {
        let force = Some(Divergence::Gradient);
        self.p2g(particles, &P2gRequest { force, ..P2gRequest::default() }, grid);
    }

    /// Adds a force per unit mass (m/s2) of each particle, `sum_p m_p b_p N_i`, to `grid.force`.
    fn p2g_body_force(&self, particles: &Particles<D>, b: &[Vector<D>], grid: &mut Grid<D>);

    /// Adds a `force` (N) on particle `p` to the forces of its nodes.
    fn p2g_point_force(
        &self,
        particles: &Particles<D>,
        p: usize,
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) {
        self.tally().add("p2g point force", 1);
        let mut column = std::mem::take(&mut grid.force);
        self.visit(grid, particles, p, &mut |i| column[i.node] += force * i.weight);
        grid.force = column;
    }

    /// Computes `value_p <- keep value_p + factor sum_i field_i N_i(x_p)`.
    fn g2p(
        &self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        particles: &Particles<D>,
        keep_and_factor: (f64, f64),
        value: &mut [Vector<D>],
    ) {
        let (mix, value) = (Some(keep_and_factor), Some(value));
        self.g2p_field(grid, field, particles, G2pRequest { mix, value, ..G2pRequest::default() });
    }

    /// Computes the moments of the weights of each particle.
    fn moments(&self, grid: &Grid<D>, particles: &Particles<D>, moments: &mut Moments<D>);

    /// Calls `entry` with i, j and `m_p N_i(x_p) N_j(x_p)` (kg) for every particle and every pair
    /// of its nodes. The consistent mass matrix is the sum of these entries.
    fn mass_entries(
        &self,
        grid: &Grid<D>,
        particles: &Particles<D>,
        entry: &mut dyn FnMut(usize, usize, f64),
    ) {
        self.tally().add("mass matrix", particles.len());
        for (p, m) in particles.mass.iter().enumerate() {
            self.visit(grid, particles, p, &mut |i| {
                self.visit(grid, particles, p, &mut |j| {
                    entry(i.node, j.node, m * i.weight * j.weight);
                });
            });
        }
    }

    /// Adds the nodal forces of a moment, `moment grad N_i(x_p)`, on particle `p`. The sum of these
    /// forces is zero. Together with a force f on the particle, the moment `f (x) d` (N m) has the
    /// effect of f at the distance d (m) from the particle.
    fn p2g_point_moment(
        &self,
        particles: &Particles<D>,
        p: usize,
        moment: &Matrix<D>,
        grid: &mut Grid<D>,
    ) {
        self.tally().add("p2g point moment", 1);
        let mut column = std::mem::take(&mut grid.force);
        self.visit(grid, particles, p, &mut |i| column[i.node] += moment * i.gradient);
        grid.force = column;
    }

    /// Corrects a `force` (N) that acts at the end of the domain of particle `p` along the axis
    /// `end.0`, in the direction `end.1` (1 or -1), and whose point and moment have been added
    /// ([`Basis::visit_domain_end`](crate::mpm::basis::Basis::visit_domain_end)). Sum and moment of
    /// the correction are zero. Returns whether there is a correction.
    fn p2g_domain_end(
        &self,
        particles: &Particles<D>,
        p: usize,
        end: (usize, f64),
        force: &Vector<D>,
        grid: &mut Grid<D>,
    ) -> bool;

    /// Writes `sum_p m_p grad N_i(x_p)` (kg/m) to `gradient`. At the surface of the body this
    /// vector points outwards.
    fn p2g_mass_gradient(
        &self,
        particles: &Particles<D>,
        grid: &Grid<D>,
        gradient: &mut [Vector<D>],
    );

    /// Computes `column_i = sum_p m_p (value_p + slope_p . (x_i - x_p)) N_i(x_p)`: P2G of a scalar
    /// and its gradient.
    fn p2g_scalar(
        &self,
        particles: &Particles<D>,
        value: &[f64],
        slope: &[Vector<D>],
        grid: &Grid<D>,
        column: &mut [f64],
    );

    /// Computes `column_i = factor sum_p V_p slope_p . grad N_i(x_p)`: the flow into the nodes due
    /// to a gradient.
    fn p2g_flow(
        &self,
        particles: &Particles<D>,
        slope: &[Vector<D>],
        factor: f64,
        grid: &Grid<D>,
        column: &mut [f64],
    );

    /// Adds `amount N_i(x_p)` of particle `p` to its nodes.
    fn p2g_amount(
        &self,
        particles: &Particles<D>,
        p: usize,
        amount: f64,
        grid: &Grid<D>,
        column: &mut [f64],
    ) {
        self.tally().add("p2g scalar source", 1);
        self.visit(grid, particles, p, &mut |i| column[i.node] += amount * i.weight);
    }

    /// Computes `s_p += factor sum_i field_i N_i(x_p)`.
    fn g2p_scalar(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        factor: f64,
        value: &mut [f64],
    );

    /// Computes `slope_p = sum_i field_i grad N_i(x_p)`.
    fn g2p_slope(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        slope: &mut [Vector<D>],
    );

    /// Returns the counts of visited particles.
    fn tally(&self) -> &Tally;

    /// Returns the maximum number of nodes of a particle.
    fn support(&self) -> u64;

    /// Returns the kind of particle domain that the basis needs.
    fn domain(&self) -> Domain;

    /// Creates an empty grid with the functions of this basis.
    fn grid(&self, origin: Vector<D>, h: f64, cells: [usize; D], periodic: [bool; D]) -> Grid<D>;
}

/// Gradient of the velocity field around each particle. `mean_p` is the weighted mean of the node
/// positions, and equals the particle position unless a wall truncates the particle domain. The
/// affine part is zero at `mean_p`, and therefore has no momentum.
#[derive(Debug, Clone, Copy)]
pub enum Affine<'a, const D: usize> {
    /// Gradients `C_p` (1/s).
    Slope(&'a [Matrix<D>]),
    /// First moments `B_p` (m^2/s), with `C_p = B_p D_p^-1`. D_p is the inertia tensor of the
    /// weights at the particle position.
    Moment(&'a [Matrix<D>]),
}

impl<'a, const D: usize> Affine<'a, D> {
    /// Returns C_p or B_p of each particle.
    pub fn state(self) -> &'a [Matrix<D>] {
        let (Self::Slope(state) | Self::Moment(state)) = self;
        state
    }

    /// Returns the typical magnitude of the state for velocities of magnitude `speed` (m/s) and
    /// cells of size `h` (m).
    pub fn size(self, speed: f64, h: f64) -> f64 {
        match self {
            Self::Slope(_) => speed / h,
            Self::Moment(_) => speed * h,
        }
    }
}

/// Velocity field around each particle, `v_p + C_p (x - mean_p)`.
#[derive(Debug, Clone, Copy)]
pub struct ParticleField<'a, const D: usize> {
    /// Velocities v_p (m/s).
    pub v: &'a [Vector<D>],
    /// Velocity gradients C_p; `None` for a constant field.
    pub affine: Option<Affine<'a, D>>,
}

/// Discrete divergence of the stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Divergence {
    /// With basis gradients: `f_int_i = - sum_p V_p sigma_p grad N_i(x_p)` (N).
    Gradient,
    /// With gradients of a least-squares fit:
    /// `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - mean_p) N_i(x_p)` (N) (Hu et al. 2018, eq. 18).
    Fit,
}

/// Quantities that one P2G pass computes.
#[derive(Debug, Clone, Copy, Default)]
pub struct P2gRequest<'a, const D: usize> {
    /// Whether to compute the mass `m_i = sum_p m_p N_i(x_p)` (kg) into `grid.mass`.
    pub mass: bool,
    /// Momentum `sum_p m_p (v_p + C_p (x_i - mean_p)) N_i(x_p)` (kg m/s) into `grid.velocity`.
    pub momentum: Option<ParticleField<'a, D>>,
    /// Internal force (N) into `grid.force`.
    pub force: Option<Divergence>,
}

impl<const D: usize> P2gRequest<'_, D> {
    /// Returns the names of the requested quantities, for reports. A request for the mass includes
    /// the name `weight moments`, so that the moments of the weights are counted once for each
    /// position of the particles.
    #[inline]
    pub fn parts(&self) -> impl Iterator<Item = &'static str> + use<D> {
        let affine = self.momentum.and_then(|field| field.affine);
        let has_moments = self.mass && matches!(affine, Some(Affine::Moment(_)));
        named_parts([
            ("p2g mass", self.mass),
            ("p2g momentum", self.momentum.is_some()),
            ("p2g internal force", self.force == Some(Divergence::Gradient)),
            ("p2g force by fit", self.force == Some(Divergence::Fit)),
            ("weight moments", has_moments),
        ])
    }
}

#[inline]
fn named_parts(parts: [(&'static str, bool); 5]) -> impl Iterator<Item = &'static str> {
    parts.into_iter().filter_map(|(name, is_requested)| is_requested.then_some(name))
}

/// Quantities that one G2P pass computes. Nodal velocities are interpolated unless stated
/// otherwise.
#[derive(Debug, Default)]
pub struct G2pRequest<'a, const D: usize> {
    /// Time `dt` (s) in `value_p += dt sum_i a_i N_i(x_p)`, from nodal accelerations.
    pub change: Option<f64>,
    /// Factors `keep` and `factor` in `value_p <- keep value_p + factor sum_i v_i N_i(x_p)`, after
    /// `change`.
    pub mix: Option<(f64, f64)>,
    /// Column that `change` and `mix` update (m/s).
    pub value: Option<&'a mut [Vector<D>]>,
    /// Column for `moment_p = sum_i v_i (x) (x_i - mean_p) N_i(x_p)` (m^2/s).
    pub moment: Option<&'a mut [Matrix<D>]>,
    /// Column for `moment_p D_p^-1` (1/s): the gradient of a least-squares fit (Hu et al. 2018, eq.
    /// 17), computed in the same loop over the nodes as the moment.
    pub fit: Option<&'a mut [Matrix<D>]>,
    /// Column for `gradient_p = sum_i v_i (x) grad N_i(x_p)` (1/s).
    pub gradient: Option<&'a mut [Matrix<D>]>,
    /// Time `dt` (s), and the column for the positions after this time,
    /// `advected_p = x_p + dt sum_i v_i N_i(x_p)` (m).
    pub advected: Option<(f64, &'a mut [Vector<D>])>,
}

impl<const D: usize> G2pRequest<'_, D> {
    /// Returns the names of the requested quantities, for reports.
    #[inline]
    pub fn parts(&self) -> impl Iterator<Item = &'static str> + use<D> {
        named_parts([
            ("g2p velocity", self.change.is_some()),
            ("g2p velocity", self.mix.is_some()),
            ("g2p moment", self.moment.is_some() || self.fit.is_some()),
            ("g2p gradient", self.gradient.is_some()),
            ("g2p position", self.advected.is_some()),
        ])
    }
}

/// Settings of the particle loops.
#[derive(Debug, Clone, Copy)]
pub struct LoopSettings {
    /// Instruction set of the loops. Results are bit-identical for every set.
    pub level: Level,
    /// Minimum number of particles for a division into blocks. Smaller bodies fit into the cache.
    /// The division changes the order of sums, and therefore their rounding.
    pub min_particles: usize,
    /// Minimum number of particles per block. A large block shares only a small part of its nodes
    /// with neighbouring blocks.
    pub min_block: usize,
}

impl Default for LoopSettings {
    /// Returns the fastest instruction set of this processor, and default block sizes.
    fn default() -> Self {
        Self { level: Level::new(), min_particles: 1 << 17, min_block: 1 << 13 }
    }
}

/// Number of particles visited for each quantity that passes compute. Counting starts with the
/// first call of `take`.
#[derive(Debug, Default)]
pub struct Tally(OnceLock<[AtomicU64; NAMES.len()]>);

const NAMES: [&str; 19] = [
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
    "basis functions",
    "g2p position",
    "p2g mass gradient",
    "p2g scalar",
    "p2g scalar flux",
    "p2g scalar source",
    "g2p scalar",
    "g2p scalar gradient",
];

impl Tally {
    #[inline]
    pub(in crate::mpm) fn add(&self, name: &str, particles: usize) {
        let Some(counts) = self.0.get() else { return };
        if let Some(part) = NAMES.iter().position(|known| *known == name) {
            counts[part].fetch_add(particles as u64, Relaxed);
        }
    }

    /// Returns the quantities computed since the last call, each with the number of visited
    /// particles, summed over `tallies`.
    pub(in crate::mpm) fn take(tallies: &[&Self]) -> Vec<(&'static str, u64)> {
        let taken = |part: usize| {
            let counts = tallies.iter().map(|tally| tally.0.get_or_init(Default::default));
            counts.map(|counts| counts[part].swap(0, Relaxed)).sum()
        };
        let sums = NAMES.iter().enumerate().map(|(part, name)| (*name, taken(part)));
        sums.filter(|(_, visited)| *visited > 0).collect()
    }
}
