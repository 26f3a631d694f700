//! Every condition that a problem puts on its motion.

use super::{
    boundary, differences, loading, pointwise, problem::Problem, rims, violation::Violation, weak,
};

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
