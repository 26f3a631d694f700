//! Terms of loads in the equation of motion, and parts of the body on which loads act.

use super::expansion::Expansion;
use super::formula::Formula;
use std::fmt::Debug;

/// The terms of a load in `rho0 u_tt = Div P + rho0 b`. A load implements the methods it needs.
pub trait Term: Debug + Send + Sync {
    /// Returns component i of the prescribed force per unit mass (m/s2) at the position `label` (m)
    /// and time `t` (s), for the displacement `u` (m).
    fn stated(&self, _i: usize, _label: &[f64], _t: f64, _u: &[f64; 3]) -> f64 {
        0.0
    }

    /// Whether the prescribed force depends on time at most, and is evaluated once per time.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Whether the prescribed force is independent of position, displacement and time.
    fn is_constant(&self) -> bool {
        false
    }

    /// Whether the prescribed force depends on the displacement.
    fn depends_on_displacement(&self) -> bool {
        false
    }

    /// Whether the load is a body force b. The check then compares b with the body force that the
    /// motion requires.
    fn is_body_force(&self) -> bool {
        false
    }

    /// Returns one component of a force that opposes the motion (m/s2), from the same component of
    /// the velocity (m/s) and of the unbalanced force, `Div P/rho0 + b` (m/s2).
    fn resistance(&self, _t: f64, _velocity: f64, _unbalanced: &dyn Fn() -> f64) -> f64 {
        0.0
    }

    /// Whether the resistance depends on the unbalanced force.
    fn resists_imbalance(&self) -> bool {
        false
    }

    /// Returns the thermal expansion, if any.
    fn expansion(&self) -> Option<Expansion> {
        None
    }

    /// Returns the index of a rim in [`Outline::rims`](super::Outline::rims) and the pressure on it
    /// (Pa, per current area), a formula of the coordinates and t.
    fn pressed_rim(&self) -> Option<(usize, &Formula)> {
        None
    }

    /// Returns a region and its prescribed velocity (m/s), formulas of the coordinates and t.
    fn driven(&self) -> Option<(&Region, &[Formula])> {
        None
    }
}

/// A part of the body: the material points in a box.
#[derive(Debug, Clone)]
pub struct Region {
    /// Name in the suite.
    pub name: String,
    /// Lowest corner (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
}

impl Region {
    /// Whether the box contains a reference position; its faces are included.
    pub fn holds(&self, label: &[f64]) -> bool {
        label.iter().zip(&self.from).zip(&self.to).all(|((x, from), to)| (from..=to).contains(&x))
    }

    /// Returns the corners of the intersection with a body from `from` to `to`.
    pub fn within(&self, from: &[f64], to: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let low = self.from.iter().zip(from).map(|(a, b)| a.max(*b));
        let high = self.to.iter().zip(to).map(|(a, b)| a.min(*b));
        (low.collect(), high.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_belong_to_it() {
        let region = Region { name: String::new(), from: vec![1.0, 2.0], to: vec![3.0, 4.0] };
        let inside = [[1.0, 2.0], [3.0, 4.0], [2.0, 4.0]].map(|label| region.holds(&label));
        let outside = [[2.0, 4.1], [f64::NAN, 3.0]].map(|label| region.holds(&label));
        assert_eq!((inside, outside), ([true; 3], [false; 2]));
    }
}
