//! Every condition that a problem puts on its motion.

pub(crate) mod boundary;
pub(crate) mod differences;
pub(crate) mod friction;
pub(crate) mod interface;
pub(crate) mod loading;
pub(crate) mod pointwise;
pub(crate) mod rims;
pub(crate) mod weak;

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
}
