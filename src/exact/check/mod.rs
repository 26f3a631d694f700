//! Every condition that a problem puts on its motion.

pub(crate) mod boundary;
pub(crate) mod differences;
mod distinct;
pub(crate) mod friction;
pub(crate) mod interface;
pub(crate) mod loading;
pub(crate) mod pointwise;
pub(crate) mod rims;
pub(crate) mod space_time_patch;
pub(crate) mod weak;

use super::linearised::Linearised;
use super::problem::Problem;
use super::violation::Violation;

impl Problem {
    /// Holds the motion against the equation (point by point and in weak form), the boundary and
    /// the initial conditions, at reproducible random points.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check(&self) -> Result<(), Violation> {
        pointwise::presence(self)?;
        pointwise::initial(self)?;
        boundary::boundary(self)?;
        boundary::driven(self)?;
        rims::free(self)?;
        loading::monotone(self)?;
        differences::differentiation(self)?;
        pointwise::equation(self)?;
        weak::momentum(self)
    }

    /// Residual of the conditions that the law enters, relative to their terms: the equation of
    /// motion, tractions on faces and rims. NaN where another condition is violated, or this is no
    /// number.
    pub fn residual(&self) -> f64 {
        if !self.bodies.is_empty() {
            return pointwise::greatest(self.bodies.iter().map(Self::residual));
        }
        let any = Linearised { tolerance: f64::INFINITY, because: String::new() };
        let loose = Self { linearised: Some(any), ..self.clone() };
        let left = [boundary::boundary, rims::free, pointwise::equation].map(|left| left(&loose));
        pointwise::greatest(left.into_iter().map(|left| left.unwrap_or(f64::NAN)))
    }
}
