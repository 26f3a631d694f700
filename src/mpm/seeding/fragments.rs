//! Particles that stand for pieces of any shape, beside those of a lattice.

use crate::mpm::foundation::algebra::{Matrix, Vector};
use crate::mpm::foundation::particles::Particles;

/// A part of a body, for one particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment<const D: usize> {
    /// Centroid (m).
    pub place: Vector<D>,
    /// Volume (m^D).
    pub volume: f64,
    /// Half-lengths of a parallelepiped of this volume, the columns its vectors (m).
    pub domain: Matrix<D>,
}

impl<const D: usize> Particles<D> {
    /// Adds `fragments` of density `density` (kg/m3) to a lattice, at rest and free of stress.
    /// The particles of the lattice keep their boxes as domains.
    pub fn add_fragments(&mut self, fragments: &[Fragment<D>], density: f64) {
        if fragments.is_empty() {
            return;
        }
        let own = Matrix::from_diagonal(&(self.spacing * 0.5));
        self.domain0.resize(self.len(), own);
        for Fragment { place, volume, domain } in fragments {
            self.x0.push(*place);
            self.vol0.push(*volume);
            self.mass.push(density * volume);
            self.domain0.push(*domain);
        }
        self.x.clone_from(&self.x0);
        self.vol.clone_from(&self.vol0);
        self.v.resize(self.x0.len(), Vector::zeros());
        self.sigma.resize(self.x0.len(), Matrix::zeros());
        self.grad_v.resize(self.x0.len(), Matrix::zeros());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Block;

    #[test]
    fn every_column_gets_an_entry() {
        let (from, to) = (Vector::zeros(), Vector::<2>::new(2.0, 1.0));
        let mut particles = Particles::fill(&Block { from, to, density: 3.0 }, 1.0, 1);
        let domain = Matrix::<2>::new(0.25, 0.0, 0.1, 0.5);
        let place = Vector::<2>::new(2.25, 0.5);
        particles.add_fragments(&[Fragment { place, volume: 0.5, domain }], 3.0);
        particles.track_domains();
        assert_eq!((particles.len(), particles.x[2], particles.x0[2]), (3, place, place));
        assert_eq!((particles.mass[2], particles.vol0[2], particles.vol[2]), (1.5, 0.5, 0.5));
        assert_eq!((particles.v.len(), particles.sigma.len(), particles.grad_v.len()), (3, 3, 3));
        assert_eq!(particles.domain, [Matrix::identity() * 0.5, Matrix::identity() * 0.5, domain]);
    }
}
