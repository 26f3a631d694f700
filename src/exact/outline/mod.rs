//! Bodies that are not boxes: round bodies and polygons.
//!
//! Rims are free, except for a pressure on a rim of a round body and for the sides of a
//! quadrilateral that lie on a face.

mod piece;
mod polygon;
mod round;
#[cfg(test)]
mod tests;

pub use piece::{Cut, Piece, join_small};
pub use polygon::Polygon;
pub use round::{Circle, Round};

use super::random::Random;
use std::fmt::Debug;

/// Share of a length or an area that counts as rounding error.
const ROUNDING: f64 = 1e-12;

/// Shape of a body that is not a box, in the reference configuration.
pub trait Outline: Debug + Send + Sync {
    /// Its kind, as suites write it.
    fn kind(&self) -> &'static str;

    /// The body in one line of a report.
    fn row(&self) -> String;

    /// Lowest and highest corner of the box around the body (m).
    fn ends(&self) -> (Vec<f64>, Vec<f64>);

    /// Whether the body contains the point with reference position `label`.
    fn holds(&self, label: &[f64]) -> bool;

    /// Distance (m) of a point from the body, whose holes count as filled.
    fn distance(&self, label: &[f64]) -> f64;

    /// Centre and radius (m) of a round body, ignoring holes; `None` for other shapes.
    fn ball(&self) -> Option<(&[f64], f64)> {
        None
    }

    /// Circles that a pressure can act on; empty unless the body is a disk or an annulus.
    fn circles(&self) -> Vec<Circle> {
        Vec::new()
    }

    /// Radius (m) of the hole in the middle of a body that is round, 0 without a hole.
    fn hole(&self) -> f64 {
        0.0
    }

    /// The particle or particles of one lattice cell, a box of half-lengths `half` (m) about
    /// `centre`: the part of the cell that lies in the body.
    fn cut(&self, centre: &[f64], half: &[f64]) -> Cut;

    /// Volume (m^D) of the part of the body in a box.
    fn volume_within(&self, from: &[f64], to: &[f64]) -> f64;

    /// A closed line along the rim, in the plane of the first two axes (m).
    fn trace(&self) -> Vec<(f64, f64)>;

    /// The parts of the rim, as messages name them.
    fn rims(&self) -> Vec<String>;

    /// A random point of a part of the rim, and the outward normal there.
    fn on_rim(&self, rim: usize, random: &mut Random) -> (Vec<f64>, [f64; 3]);

    /// A point inside, uniform in the body.
    fn point(&self, random: &mut Random) -> Vec<f64>;

    /// Centre and half-lengths of a box inside the body.
    fn patch(&self, random: &mut Random) -> (Vec<f64>, Vec<f64>);

    /// Charts: maps of boxes that cover the body. Returns the ranges of the coordinates of each.
    fn charts(&self) -> Vec<Vec<(f64, f64)>>;

    /// The point of a chart at `coordinates`, and the volume of the body per unit of the
    /// coordinates.
    fn place(&self, chart: usize, coordinates: &[f64]) -> (Vec<f64>, f64);
}
