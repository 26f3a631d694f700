//! Stable time step, computed by power iteration with the passes of the solver.
//!
//! Nodal velocities strain the particles, the stresses give forces, and the forces accelerate the
//! nodes. This operator, `L = M^-1 K`, is applied by running the stages of a step with small nodal
//! velocities. Power iteration gives the largest eigenvalue of L, the square of the highest
//! frequency. In the formulas below, L denotes this eigenvalue.
//!
//! Under USL an explicit step is stable up to `dt^2 L = 4/(2 - a)`, where a, between 0 and 1, is
//! the fraction of a velocity that the particles return to the grid. So `dt = sqrt(2/L)` is stable
//! for every mode. Under USF and MUSL the strain comes from grid velocities that were mapped to
//! particles and back, `L = P N M^-1 K` with the maps N to particles and P to nodes. This operator
//! stays bounded if a node has little mass.
//!
//! A load that depends on the displacement adds a stiffness k per unit mass to each particle. The
//! maps to nodes and back are averages, so the load increases the square of a frequency by at most
//! k.
//!
//! Sources: von Neumann's analysis (the suite `courant-limit` has the closed forms); Ni & Zhang
//! (2020), IJNME 121, for the dependence on particle positions.

use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::scheme::{SchemeName, Stage};
use crate::mpm::step::schedule::passes_of;
use crate::mpm::step::setup::Setup;
use crate::mpm::step::solver::Solver;
use crate::mpm::step::subject::affine_state_mut;
use crate::mpm::transfer::{TransferChoice, TransferKind, TransferName, kick};
use mpm_subject::Failure;
use std::any::Any;

/// Largest nodal velocity in the iteration, in units of `h/longest` ([`Solver::stable_time_step`]).
/// The resulting strains are much larger than the rounding error, 1e-16, and much smaller than one.
/// A quadratic viscosity is negligible at this velocity.
const SPEED: f64 = 1e-7;

/// Maximum number of repetitions of the power iteration. If stresses depend on strain rates, the
/// frequency depends on the time step, so each repetition uses the step from the previous one.
const REPEATS: u32 = 12;

/// Number of iterations in each repetition after the first. A repetition starts from the mode of
/// the previous one, so a few iterations suffice.
const AGAIN: u32 = 4;

/// Shift of all eigenvalues, as a fraction of the largest estimate so far. The shift almost doubles
/// the rate at which the other modes decay. The shift must be less than 1/2, because otherwise the
/// smallest eigenvalue becomes the largest in magnitude.
const SHIFT: f64 = 0.45;

/// Relative decrease of the time step below which the step counts as converged.
const SETTLED: f64 = 1e-3;

impl<const D: usize> Solver<D> {
    /// Computes the maximum stable step (s) in the current state of the body, at most `longest`.
    /// The step takes into account the stiffness of loads, the viscosity of the material and
    /// artificial viscosity, but not the loads themselves, other damping and wall friction. Each of
    /// the `rounds` of the power iteration costs as much as a step. The result is an upper bound, a
    /// few percent too large after about twenty rounds.
    ///
    /// # Errors
    /// Failures of the passes; [`Failure::Solve`] if there is no highest frequency.
    pub fn stable_time_step(mut self, longest: f64, rounds: u32) -> Result<f64, Failure> {
        let held: f64 = self.setup.effects.iter().map(|effect| effect.stiffness()).sum();
        self.setup.effects.retain(|effect| effect.makes_stress());
        self.setup.boundary.retain(|condition| !condition.reads_velocity());
        self.run_all(&passes_of(&[Stage::Mass]), longest)?;
        let start = StartState::of(&mut self);
        let nodes = self.setup.grid.velocity.len();
        let mut mode: Vec<Vector<D>> = (0..nodes)
            .map(|i| Vector::from_fn(|axis, _| scattered((i * D + axis) as u64)))
            .collect();
        let (mut dt, mut rounds) = (longest, rounds);
        for _ in 0..REPEATS {
            let speed = SPEED * self.setup.grid.h / longest;
            let square = self.square_of_frequency(&start, &mut mode, dt, speed, rounds)?;
            let stable = (2.0 / (square + held)).sqrt();
            if stable.is_nan() {
                return Err(Failure::Solve("the body has no highest frequency".to_owned()));
            }
            if stable >= (1.0 - SETTLED) * dt {
                return Ok(stable.min(dt));
            }
            (dt, rounds) = (stable, AGAIN);
        }
        Ok(dt)
    }

    /// Estimates the eigenvalue by power iteration: returns the largest ratio of the norm of
    /// `L mode` to the norm of `mode`. The norm is weighted by the nodal masses, because L is
    /// symmetric in this norm.
    fn square_of_frequency(
        &mut self,
        start: &StartState<D>,
        mode: &mut [Vector<D>],
        dt: f64,
        speed: f64,
        rounds: u32,
    ) -> Result<f64, Failure> {
        let still = vec![Vector::zeros(); mode.len()];
        let rest = self.response(start, &still, dt)?;
        let mut square = 0.0_f64;
        for _ in 0..rounds.max(1) {
            let largest = mode.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs()));
            if !(largest > 0.0) {
                break;
            }
            for v in mode.iter_mut() {
                *v *= speed / largest;
            }
            let mut found = self.response(start, mode, dt)?;
            for (found, rest) in found.iter_mut().zip(&rest) {
                *found = (*found - rest) / dt;
            }
            // The comparison is false for NaN, so the result becomes NaN.
            let ratio = (self.size(&found) / self.size(mode)).sqrt();
            square = if square > ratio { square } else { ratio };
            // The next mode is (L - shift) mode, up to a sign.
            let shift = SHIFT * square;
            for (mode, found) in mode.iter_mut().zip(found) {
                *mode = *mode * shift + found;
            }
        }
        Ok(square)
    }

    /// Returns the nodal accelerations (m/s2) that follow from a motion with `velocity` (m/s) for
    /// `dt` (s). If strains come from mapped velocities, the accelerations are mapped to particles
    /// and back.
    fn response(
        &mut self,
        start: &StartState<D>,
        velocity: &[Vector<D>],
        dt: f64,
    ) -> Result<Vec<Vector<D>>, Failure> {
        self.setup.grid.velocity.copy_from_slice(velocity);
        let stages = &[Stage::Stress, Stage::Force, Stage::Acceleration];
        self.run_all(&passes_of(stages), dt)?;
        self.restore(start);
        if !strains_by_mapped_velocity(self.setup.scheme, self.setup.transfer.kind()) {
            return Ok(self.setup.grid.acceleration.clone());
        }
        self.setup.particles.v.fill(Vector::zeros());
        let Setup { grid, particles, kernel, transfer, .. } = &mut self.setup;
        kick(transfer.as_mut(), kernel.as_ref(), grid, 1.0, particles);
        self.run_all(&passes_of(&[Stage::Momentum]), dt)?;
        self.restore(start);
        Ok(self.setup.grid.velocity.clone())
    }

    fn size(&self, field: &[Vector<D>]) -> f64 {
        self.setup.grid.mass.iter().zip(field).map(|(m, v)| m * v.norm_squared()).sum()
    }

    /// Restores all state that [`Self::response`] changes.
    fn restore(&mut self, start: &StartState<D>) {
        let Setup { particles, transfer, material, effects, .. } = &mut self.setup;
        particles.clone_from(&start.particles);
        affine_state_mut(transfer.as_mut()).copy_from_slice(&start.affine);
        if let Some(state) = &start.material {
            material.set_state(state.as_ref());
        }
        for (effect, state) in effects.iter_mut().zip(&start.effects) {
            if let Some(state) = state {
                effect.set_state(state.as_ref());
            }
        }
        self.velocity_time = start.velocity_time;
    }
}

/// State of a solver before a trial step.
struct StartState<const D: usize> {
    particles: Particles<D>,
    affine: Vec<Matrix<D>>,
    material: Option<Box<dyn Any>>,
    effects: Vec<Option<Box<dyn Any>>>,
    velocity_time: f64,
}

impl<const D: usize> StartState<D> {
    fn of(solver: &mut Solver<D>) -> Self {
        let Setup { particles, transfer, material, effects, .. } = &mut solver.setup;
        Self {
            particles: particles.clone(),
            affine: affine_state_mut(transfer.as_mut()).to_vec(),
            material: material.state(),
            effects: effects.iter().map(|effect| effect.state()).collect(),
            velocity_time: solver.velocity_time,
        }
    }
}

/// Whether the velocities that strain the particles were first mapped to particles and back.
/// Transfers with affine fields or series also map velocities, but their loss in this mapping is
/// neglected.
fn strains_by_mapped_velocity(scheme: SchemeName, kind: TransferKind) -> bool {
    scheme != SchemeName::Usl && kind == TransferKind::Velocity
}

/// Returns the simplest scheme and transfer whose stable time step is bit-identical to that of the
/// given scheme and transfer. Methods with the same result need only one computation.
///
/// All transfers except [`TransferKind::Fit`] compute forces and velocity gradients from the basis.
/// All except [`TransferKind::Series`] and [`TransferKind::Cells`] compute accelerations from the
/// basis. The map of velocities affects the step only if the velocities that strain the particles
/// were first mapped to particles and back.
pub fn simplest_with_same_response(
    scheme: SchemeName,
    transfer: TransferChoice,
) -> (SchemeName, TransferChoice) {
    let kind = transfer.kind();
    let scheme =
        if strains_by_mapped_velocity(scheme, kind) { SchemeName::Musl } else { SchemeName::Usl };
    match kind {
        TransferKind::Velocity | TransferKind::Field => (scheme, TransferName::Flip.into()),
        TransferKind::Fit | TransferKind::Series | TransferKind::Cells => (scheme, transfer),
    }
}

/// Returns a pseudo-random number from -1 to 1 (splitmix64, Steele, Lea & Flood 2014).
fn scattered(k: u64) -> f64 {
    let mut z = k.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
