//! Bodies that are not boxes: round bodies and polygons.
//!
//! The parts of the boundary are called rims. Rims are free, except that a pressure may act on a
//! rim of a round body, and sides of a quadrilateral may lie on a face.

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

/// Fraction of a length or an area that is treated as rounding error.
const ROUNDING: f64 = 1e-12;

/// Shape of a body that is not a box, in the reference configuration.
pub trait Outline: Debug + Send + Sync {
    /// Returns the name of this kind of shape in suites.
    fn kind(&self) -> &'static str;

    /// Returns a one-line description for reports.
    fn row(&self) -> String;

    /// Returns lowest and highest corner of the bounding box (m).
    fn ends(&self) -> (Vec<f64>, Vec<f64>);

    /// Whether the body contains the point with reference position `label`.
    fn holds(&self, label: &[f64]) -> bool;

    /// Returns the distance of a point from the body (m); holes count as filled.
    fn distance(&self, label: &[f64]) -> f64;

    /// Returns centre and radius (m) of a round body, ignoring holes; `None` for other shapes.
    fn ball(&self) -> Option<(&[f64], f64)> {
        None
    }

    /// Returns the circles on which a pressure can act; empty unless the body is a disk or annulus.
    fn circles(&self) -> Vec<Circle> {
        Vec::new()
    }

    /// Returns the radius of the central hole of a round body (m); 0 without a hole.
    fn hole(&self) -> f64 {
        0.0
    }

    /// Returns the part of a lattice cell that belongs to the body, as particles. The cell has the
    /// half-lengths `half` (m) around `centre`.
    fn cut(&self, centre: &[f64], half: &[f64]) -> Cut;

    /// Returns the volume of the part of the body in a box (m^D).
    fn volume_within(&self, from: &[f64], to: &[f64]) -> f64;

    /// Returns a closed line along the rim in the plane of the first two axes (m).
    fn trace(&self) -> Vec<(f64, f64)>;

    /// Returns the names of all parts of the rim, for messages.
    fn rims(&self) -> Vec<String>;

    /// Returns a random point on a part of the rim, and the outward normal at that point.
    fn on_rim(&self, rim: usize, random: &mut Random) -> (Vec<f64>, [f64; 3]);

    /// Returns a random point in the body, with uniform distribution.
    fn point(&self, random: &mut Random) -> Vec<f64>;

    /// Returns centre and half-lengths of a random box inside the body.
    fn patch(&self, random: &mut Random) -> (Vec<f64>, Vec<f64>);

    /// Returns the coordinate ranges of the charts, which map boxes to parts that cover the body.
    fn charts(&self) -> Vec<Vec<(f64, f64)>>;

    /// Returns the point of a chart at `coordinates`, and the body's volume per unit of them.
    fn place(&self, chart: usize, coordinates: &[f64]) -> (Vec<f64>, f64);
}
