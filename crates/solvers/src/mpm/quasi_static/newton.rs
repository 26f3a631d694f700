//! Newton's method for one load step, with a line search.
//!
//! The method first takes full steps, even if the residual rises for a few iterates: when particles
//! begin to yield, a full step increases the residual, and the next one reduces it by orders of
//! magnitude. If several successive iterates do not improve on the best one, for example because
//! they alternate between elastic and plastic response, the method returns to the best iterate and
//! then accepts only steps that reduce the residual (the watchdog technique of Chamberlain, Powell,
//! Lemarechal & Pedersen 1982, Math. Program. Study 16). A step that inverts a particle is always
//! halved.

use super::balance::{Iterate, StepEquations};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::Material;
use mpm_subject::Failure;

/// Residual, divided by the load, below which a step counts as converged. If the residual has
/// stopped falling, the rounding error of the stress ([`StepEquations::rounding`]) is added,
/// because it can exceed this fraction of the load if strains are small.
pub(super) const CONVERGED: f64 = 1e-10;

/// Multiple of the rounding error below which a residual that does not converge is attributed to
/// rounding.
const NEAR_ROUNDING: f64 = 100.0;

const MOST_CORRECTIONS: usize = 25;

/// Maximum number of successive iterates that do not improve on the best one.
const PATIENCE: usize = 4;

const MOST_HALVINGS: u32 = 12;

/// Reduction that the line search requires, as a fraction of the reduction predicted by a linear
/// model (Armijo 1966).
const SUFFICIENT: f64 = 1e-4;

pub(super) struct Solution<const D: usize> {
    /// Residuals of all iterates, divided by the load.
    pub(super) residuals: Vec<f64>,
    /// The last iterate, or the reason why the step failed.
    pub(super) last: Result<Iterate<D>, Failure>,
}

struct LoadStep<'a, const D: usize> {
    balance: &'a StepEquations<D>,
    particles: &'a Particles<D>,
    material: &'a dyn Material<D>,
    /// External forces (N).
    load: &'a [Vector<D>],
    /// Norm of the load over the unknowns (N).
    scale: f64,
    /// Rounding error of the residual (N).
    rounding: f64,
}

pub(super) fn solve<const D: usize>(
    balance: &StepEquations<D>,
    particles: &Particles<D>,
    material: &dyn Material<D>,
    load: &[Vector<D>],
) -> Solution<D> {
    let (scale, rounding) = (balance.norm(load), balance.rounding(particles, material));
    let step = LoadStep { balance, particles, material, load, scale, rounding };
    let mut residuals = Vec::new();
    let last = step.solve(&mut residuals);
    Solution { residuals, last }
}

impl<const D: usize> LoadStep<'_, D> {
    fn solve(&self, residuals: &mut Vec<f64>) -> Result<Iterate<D>, Failure> {
        let scale = self.scale;
        if !(scale > 0.0 && scale.is_finite()) {
            let message = "no load acts on a node that is free to move".to_owned();
            return Err(Failure::Solve(message));
        }
        let mut now = self.iterate(vec![zeros(); self.load.len()])?;
        residuals.push(now.norm / scale);
        let (mut best, mut waited, mut searches) = (now.increment.clone(), 0, false);
        let (mut best_norm, mut before) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..MOST_CORRECTIONS {
            if self.is_converged(&now, before) {
                return Ok(now);
            }
            before = now.norm;
            if now.norm < best_norm {
                (best, best_norm, waited) = (now.increment.clone(), now.norm, 0);
            } else if !searches {
                waited += 1;
            }
            if waited >= PATIENCE {
                (now, searches, waited) = (self.iterate(best.clone())?, true, 0);
            }
            now = self.corrected(&now, searches)?;
            residuals.push(now.norm / scale);
        }
        if self.is_converged(&now, before) { Ok(now) } else { Err(self.not_converged(&now)) }
    }

    /// Whether the residual is below [`CONVERGED`], or has stopped falling from the norm `before`
    /// of the previous iterate and is below this limit plus the rounding error of the stress.
    fn is_converged(&self, now: &Iterate<D>, before: f64) -> bool {
        let limit = CONVERGED * self.scale;
        now.norm < limit || (now.norm > 0.5 * before && now.norm < limit + self.rounding)
    }

    /// Returns the iterate after a Newton correction. The correction is shortened if required.
    fn corrected(&self, now: &Iterate<D>, searches: bool) -> Result<Iterate<D>, Failure> {
        let correction = self.balance.correction(self.particles, now).map_err(|node| {
            let reason = self.not_converged(now);
            Failure::Solve(format!("the tangent is singular at node {node}: {reason}"))
        })?;
        let mut share = 1.0;
        for _ in 0..=MOST_HALVINGS {
            let moved = now.increment.iter().zip(&correction);
            let next = self.iterate(moved.map(|(u, change)| u + change * share).collect());
            // A correction that inverts a particle gives an error instead of an iterate.
            let next = next
                .ok()
                .filter(|next| !searches || next.norm <= (1.0 - SUFFICIENT * share) * now.norm);
            if let Some(next) = next {
                return Ok(next);
            }
            share *= 0.5;
        }
        Err(self.not_converged(now))
    }

    fn iterate(&self, increment: Vec<Vector<D>>) -> Result<Iterate<D>, Failure> {
        self.balance.iterate(self.particles, self.material, self.load, increment)
    }

    fn not_converged(&self, now: &Iterate<D>) -> Failure {
        let (node, residual) = self.balance.largest(&now.residual);
        let residual = residual / self.scale;
        if now.norm < NEAR_ROUNDING * self.rounding {
            let (norm, rounding) = (now.norm / self.scale, self.rounding / self.scale);
            return Failure::Solve(format!(
                "Newton's method did not converge: the residual stalls at {norm:.1e} of the load, \
                 close to the rounding error of the stress ({rounding:.1e}), because strains are \
                 small"
            ));
        }
        Failure::NotConverged { residual, node }
    }
}
