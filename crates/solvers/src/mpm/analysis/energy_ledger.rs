//! Energy ledger: the change of the energy in each stage of a step.
//!
//! A particle p has the velocity field `u_pi = v_p + C_p (x_i - x_p)` at node i; C_p is zero for a
//! transfer without an affine field. The kinetic energy is `sum m_p N_i u_pi^2 / 2` for the
//! particles, and `sum M_i w_i^2 / 2` with the lumped mass for the grid. The entries are exact for
//! particles at any positions and for any transfer with the nodal mass `sum m_p N_i`. The entries
//! for effects, motion and stored energy are differences of energies. All other entries are sums
//! over particles or nodes. Primes mark values after the update of velocities:
//!
//! ```text
//! particle to grid    -sum m_p N_i (u_pi - w_i)^2 / 2
//! nodal velocity      sum w_i . (M_i w_i - p_i) with the momentum p_i
//! forces              sum dt f_i . (w_i + w'_i) / 2, internal and external
//! constraints         sum (M_i (w'_i - w_i) - dt f_i) . (w_i + w'_i) / 2
//! grid to particle    -sum m_p N_i (w'_i - u'_pi)^2 / 2
//! particle velocity   sum m_p N_i u'_pi . (u'_pi - w'_i)
//! effects             change by effects on velocities, such as damping
//! motion              change of the affine energy with the inertia D at the new position
//! stored energy       change of W(F)
//! ```
//!
//! The entries for nodal velocity and constraints are zero unless a consistent mass matrix, a wall
//! or the series of FMPM changes nodal velocities. The entry for the particle velocity is zero for
//! PIC and APIC. For FLIP this entry restores the energy lost in the map to the grid.
//!
//! The sum of the entries for internal forces and stored energy is the error of the stress work.
//! Velocities are half a step behind stresses, so the stored energy at the time of the velocities
//! is the mean of its values before and after the step. Sources: Burgess, Sulsky & Brackbill 1992
//! (J. Comput. Phys. 103); for APIC Jiang, Schroeder & Teran 2017 (J. Comput. Phys. 338).

use crate::mpm::basis::BasisName;
use crate::mpm::foundation::algebra::{self, Matrix, Vector, dyad};
use crate::mpm::kernel::contract::Affine;
use crate::mpm::scheme::Stage;
use crate::mpm::step::schedule::Pass;
use crate::mpm::step::solver::{CustomStep, Solver};
use mpm_subject::{EnergyBalance, Failure, LedgerStage, Subject};

/// Largest second moment of weights along an axis (squared cell sizes) that counts as zero.
const SMALLEST_MOMENT: f64 = 1e-13;

/// Energy changes of one body, summed over its steps.
struct EnergyLedger {
    basis: BasisName,
    /// `None` before the first step.
    balance: Option<EnergyBalance>,
    /// Stored energy (J) at the time of the velocities.
    stored: f64,
}

/// A node of a particle, its weight, and its offset from the weighted mean of the particle's nodes
/// (m).
struct NodeOfParticle<const D: usize> {
    node: usize,
    weight: f64,
    offset: Vector<D>,
}

/// Nodes of all particles, and inverse second moments of their weights (1/m2).
struct Weights<const D: usize> {
    nodes: Vec<Vec<NodeOfParticle<D>>>,
    inverse: Vec<Matrix<D>>,
    masses: Vec<f64>,
}

/// Velocity field of a particle: velocity (m/s) and slope (1/s).
type AffineVelocity<const D: usize> = (Vector<D>, Matrix<D>);

impl<const D: usize> Weights<D> {
    fn new(basis: BasisName, solver: &Solver<D>) -> Self {
        let grid = &solver.setup.grid;
        let count = solver.setup.particles.len();
        let places: Vec<Vector<D>> =
            (0..grid.nodes()).map(|node| basis.place(grid, node)).collect();
        let mut all = Self {
            nodes: Vec::with_capacity(count),
            inverse: Vec::with_capacity(count),
            masses: solver.setup.particles.mass.clone(),
        };
        for p in 0..count {
            let particles = &solver.setup.particles;
            let (x, mut nodes) = (*particles.position(p), Vec::new());
            solver.setup.kernel.functions(grid, particles, p, &mut |node, weight, _| {
                let offset = Vector::from_fn(|axis, _| {
                    let distance = places[node][axis] - x[axis];
                    let period = grid.h * grid.cells[axis] as f64;
                    let turns =
                        if grid.periodic[axis] { libm::round(distance / period) } else { 0.0 };
                    distance - turns * period
                });
                nodes.push(NodeOfParticle { node, weight, offset });
            });
            let mean: Vector<D> =
                nodes.iter().fold(Vector::zeros(), |sum, of| sum + of.offset * of.weight);
            let mut second = Matrix::zeros();
            for of in &mut nodes {
                of.offset -= mean;
                second += dyad(&of.offset, &of.offset) * of.weight;
            }
            all.inverse.push(inverse(&second, grid.h));
            all.nodes.push(nodes);
        }
        all
    }

    /// Returns `sum m_p N_i term(p, i, u_pi)` over all particles and their nodes.
    fn sum(
        &self,
        fields: &[AffineVelocity<D>],
        term: impl Fn(usize, usize, &Vector<D>) -> f64,
    ) -> f64 {
        let mut sum = 0.0;
        for (p, (nodes, (v, slope))) in self.nodes.iter().zip(fields).enumerate() {
            for of in nodes {
                let u = v + slope * of.offset;
                sum += self.masses[p] * of.weight * term(p, of.node, &u);
            }
        }
        sum
    }

    fn momentum(&self, fields: &[AffineVelocity<D>], count: usize) -> Vec<Vector<D>> {
        let mut momentum = vec![Vector::zeros(); count];
        for (p, (nodes, (v, slope))) in self.nodes.iter().zip(fields).enumerate() {
            for of in nodes {
                momentum[of.node] += (v + slope * of.offset) * (self.masses[p] * of.weight);
            }
        }
        momentum
    }

    fn kinetic(&self, fields: &[AffineVelocity<D>]) -> f64 {
        0.5 * self.sum(fields, |_, _, u| u.norm_squared())
    }

    fn fields(&self, solver: &Solver<D>) -> Vec<AffineVelocity<D>> {
        let request = solver.setup.transfer.p2g_request(&solver.setup.particles);
        let affine = request.momentum.and_then(|momentum| momentum.affine);
        let slope = |p: usize| match affine {
            None => Matrix::zeros(),
            Some(Affine::Slope(slope)) => slope[p],
            Some(Affine::Moment(moment)) => moment[p] * self.inverse[p],
        };
        let velocities = solver.setup.particles.v.iter().enumerate();
        velocities.map(|(p, v)| (*v, slope(p))).collect()
    }
}

/// Inverts the second moments. The inverse is zero along an axis on which the moment is zero.
fn inverse<const D: usize>(second: &Matrix<D>, h: f64) -> Matrix<D> {
    let is_small = |axis: usize| !(second[(axis, axis)] > SMALLEST_MOMENT * h * h);
    let whole = if (0..D).any(is_small) { None } else { algebra::inverse(second) };
    let along_axes =
        || Matrix::from_fn(|i, j| if i == j && !is_small(i) { 1.0 / second[(i, i)] } else { 0.0 });
    whole.unwrap_or_else(along_axes)
}

/// Fields of a step, recorded pass by pass.
struct Recorder<const D: usize> {
    weights: Weights<D>,
    start: Vec<AffineVelocity<D>>,
    momentum: Vec<Vector<D>>,
    /// Nodal velocities before the update by forces (m/s); `after` holds those after the update.
    before: Option<Vec<Vector<D>>>,
    after: Vec<Vector<D>>,
    internal: Vec<Vector<D>>,
    force: Vec<Vector<D>>,
    mapped: Vec<AffineVelocity<D>>,
    end: Vec<AffineVelocity<D>>,
    dt: f64,
}

impl<const D: usize> Recorder<D> {
    fn new(basis: BasisName, solver: &Solver<D>, dt: f64) -> Self {
        let weights = Weights::new(basis, solver);
        let start = weights.fields(solver);
        let momentum = weights.momentum(&start, solver.setup.grid.nodes());
        Self {
            weights,
            start,
            momentum,
            before: None,
            after: Vec::new(),
            internal: Vec::new(),
            force: Vec::new(),
            mapped: Vec::new(),
            end: Vec::new(),
            dt,
        }
    }

    fn record(&mut self, solver: &Solver<D>, pass: Pass) {
        let grid = &solver.setup.grid;
        match pass {
            Pass::P2g(stages) if stages.contains(&Stage::Force) => {
                self.internal.clone_from(&grid.force);
            }
            Pass::Update(Stage::Momentum) if self.before.is_none() => {
                self.before = Some(grid.velocity.clone());
            }
            Pass::Update(Stage::Force) => self.force.clone_from(&grid.force),
            Pass::Update(Stage::Acceleration) => {
                // Some schemes do not compute these velocities.
                let before = self.before.get_or_insert_with(|| {
                    let mut field = self.momentum.clone();
                    solver.setup.mass.solve(grid, &mut field);
                    for condition in &solver.setup.boundary {
                        condition.hold_velocity(&mut field, solver.velocity_time);
                    }
                    field
                });
                let advanced = before.iter().zip(&grid.acceleration);
                self.after = advanced.map(|(w, a)| w + a * self.dt).collect();
            }
            Pass::Update(Stage::GridVelocity) => self.after.clone_from(&grid.velocity),
            Pass::G2p(stages) if stages.contains(&Stage::ParticleVelocity) => {
                self.mapped = self.weights.fields(solver);
            }
            Pass::Update(Stage::ParticleVelocity) => self.end = self.weights.fields(solver),
            _ => {}
        }
    }

    /// Returns the entries of the step, except that the entry for the stored energy is zero.
    /// `moved_kinetic` is the kinetic energy at the end of the step (J).
    fn entries(&self, masses: &[f64], moved_kinetic: f64) -> [f64; LedgerStage::ALL.len()] {
        let before = self.before.as_deref().unwrap_or_default();
        let nodes = || before.iter().zip(&self.after).zip(masses);
        let half = |(w, after): (&Vector<D>, &Vector<D>)| (w + after) * 0.5;
        let work = |force: &dyn Fn(usize) -> Vector<D>| -> f64 {
            before
                .iter()
                .zip(&self.after)
                .enumerate()
                .map(|(i, pair)| force(i).dot(&half(pair)))
                .sum()
        };
        let weights = &self.weights;
        let entry = |stage: LedgerStage| match stage {
            LedgerStage::ParticleToGrid => {
                -0.5 * weights.sum(&self.start, |_, i, u| (u - before[i]).norm_squared())
            }
            LedgerStage::NodalVelocity => nodes()
                .zip(&self.momentum)
                .map(|(((w, _), mass), momentum)| w.dot(&(w * *mass - momentum)))
                .sum(),
            LedgerStage::InternalForce => work(&|i| self.internal[i] * self.dt),
            LedgerStage::ExternalForce => work(&|i| (self.force[i] - self.internal[i]) * self.dt),
            LedgerStage::Constraints => {
                work(&|i| (self.after[i] - before[i]) * masses[i] - self.force[i] * self.dt)
            }
            LedgerStage::GridToParticle => {
                -0.5 * weights.sum(&self.mapped, |_, i, u| (self.after[i] - u).norm_squared())
            }
            LedgerStage::ParticleVelocity => {
                weights.sum(&self.mapped, |_, i, u| u.dot(&(u - self.after[i])))
            }
            LedgerStage::Effects => weights.kinetic(&self.end) - weights.kinetic(&self.mapped),
            LedgerStage::Motion => moved_kinetic - weights.kinetic(&self.end),
            LedgerStage::Stored => 0.0,
        };
        std::array::from_fn(|i| entry(LedgerStage::ALL[i]))
    }
}

impl<const D: usize> Solver<D> {
    /// Adds an empty energy ledger for the steps of this solver, whose basis is `basis`
    /// ([`Subject::energy_balance`]). Steps with a ledger are bit-identical to those without.
    #[must_use]
    pub fn with_ledger(self, basis: BasisName) -> Self {
        let ledger = EnergyLedger { basis, balance: None, stored: 0.0 };
        Self { custom_step: Some(Box::new(ledger)), ..self }
    }
}

impl<const D: usize> CustomStep<D> for EnergyLedger {
    fn step(&mut self, solver: &mut Solver<D>, dt: f64) -> Result<(), Failure> {
        solver.begin(dt, &mut |_, _| {})?;
        let old = stored(solver);
        let mut recorder = Recorder::new(self.basis, solver, dt);
        let mut balance = self.balance.unwrap_or_else(|| {
            self.stored = old;
            EnergyBalance::new(recorder.weights.kinetic(&recorder.start) + old)
        });
        let mut masses = Vec::new();
        solver.finish(dt, &mut |solver, pass| {
            recorder.record(solver, pass);
            if pass == Pass::Update(Stage::Mass) {
                masses.clone_from(&solver.setup.grid.mass);
            }
        })?;
        let kinetic = kinetic_energy(self.basis, solver);
        let mut entries = recorder.entries(&masses, kinetic);
        // The stored energy at the time of the velocities, half a step before the end.
        let now = 0.5 * (old + stored(solver));
        entries[LedgerStage::Stored as usize] = now - self.stored;
        self.stored = now;
        balance.add(&entries, kinetic + now);
        self.balance = Some(balance);
        Ok(())
    }

    fn energy_balance(&self) -> Option<EnergyBalance> {
        self.balance
    }
}

/// Returns the kinetic energy of the particles, including their affine fields (J).
pub fn kinetic_energy<const D: usize>(basis: BasisName, solver: &Solver<D>) -> f64 {
    let weights = Weights::new(basis, solver);
    weights.kinetic(&weights.fields(solver))
}

fn stored<const D: usize>(solver: &Solver<D>) -> f64 {
    solver.totals().and_then(|totals| totals.strain_energy).unwrap_or(0.0)
}
