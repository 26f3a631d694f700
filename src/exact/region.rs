//! Loads on part of the body.
//!
//! A total force f on a box of volume V is a body force `f/V` (N/m^D) inside and none outside; a
//! velocity that is given inside is one that the motion must have there.

use super::formula::Formula;

/// The material points in a box, and what acts on them.
#[derive(Debug, Clone)]
pub struct Region {
    /// Name that a suite gives it.
    pub name: String,
    /// Lowest corner (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// Total force (N, per m^(3-D) of thickness), one formula of t for each component.
    pub force: Option<Vec<Formula>>,
    /// Velocity (m/s), one formula of the coordinates and t for each component.
    pub velocity: Option<Vec<Formula>>,
}

impl Region {
    /// Whether a reference position is inside; the faces belong to it.
    pub fn holds(&self, label: &[f64]) -> bool {
        label.iter().zip(&self.from).zip(&self.to).all(|((x, from), to)| (from..=to).contains(&x))
    }

    /// Component i of the force density (N/m^D) at `label` for a body that reaches from `from` to
    /// `to`.
    pub fn force_density(&self, i: usize, label: &[f64], t: f64, body: (&[f64], &[f64])) -> f64 {
        let Some(force) = self.force.as_ref().filter(|_| self.holds(label)) else { return 0.0 };
        let (from, to) = self.within(body);
        let volume: f64 = from.iter().zip(&to).map(|(from, to)| to - from).product();
        force.get(i).map_or(0.0, |formula| formula.eval(&[t])) / volume
    }

    /// The corners of the part that lies in the body.
    pub(super) fn within(&self, (from, to): (&[f64], &[f64])) -> (Vec<f64>, Vec<f64>) {
        let low = self.from.iter().zip(from).map(|(a, b)| a.max(*b));
        let high = self.to.iter().zip(to).map(|(a, b)| a.min(*b));
        (low.collect(), high.collect())
    }
}
