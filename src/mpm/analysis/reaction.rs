//! Reaction of walls on which the body stands still.
//!
//! The weak form with the functions of held nodes: their force would accelerate them,
//! `m_i a_i = f_i` with a lumped mass, and the wall takes it away. So the reaction is `-sum f_i`
//! over the held components, internal and external forces together. The functions of those nodes
//! are the only ones that do not vanish on the wall, and their sum there is one: in the limit of
//! small cells the reaction is the integral of the traction.

use crate::mpm::boundary::Side;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::step::solver::Solver;
use crate::subject::Reaction;

impl<const D: usize> Solver<D> {
    /// Reaction at the beginning of the last step, of all walls on which the body stands still, or
    /// of that on one face of the grid (axis of the normal, and its end).
    pub fn reaction(&self, of: Option<(usize, Side)>) -> Reaction {
        let force = &self.setup.grid.force;
        let mut unheld = force.clone();
        for wall in &self.setup.boundary {
            if wall.standing_face().is_some_and(|face| of.is_none_or(|of| of == face)) {
                wall.clear(&mut unheld);
            }
        }
        let differences = unheld.iter().zip(force).map(|(unheld, force)| unheld - force);
        let sum = differences.fold(Vector::<D>::zeros(), |sum, each| sum + each);
        let mut reaction = [0.0; 3];
        reaction[..D].copy_from_slice(sum.as_slice());
        Reaction { time: self.advance.to - 0.5 * self.advance.dt, force: reaction }
    }
}
