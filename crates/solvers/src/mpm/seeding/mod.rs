//! Seeding: filling bodies with particles.

use super::foundation::algebra::{Matrix, Vector, det};
use super::foundation::particles::{Block, Particles};

pub(crate) mod quadrilateral;

/// A part of a body that one particle represents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment<const D: usize> {
    /// Centroid (m).
    pub place: Vector<D>,
    /// Volume (m^D).
    pub volume: f64,
    /// Half-edge vectors of a parallelepiped with this volume, as columns (m).
    pub domain: Matrix<D>,
}

impl<const D: usize> Particles<D> {
    /// Adds `fragments` with density `density` (kg/m3) to a lattice of particles, at rest and free
    /// of stress. The particles of the lattice retain their boxes as domains.
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

    /// Fills a mapped box of density `density` (kg/m3) with `counts` particles along its axes, at
    /// rest and free of stress. `map` returns the position (m) of a point of the unit box and the
    /// derivative of the map there (m).
    pub fn fill_mapped(
        counts: [usize; D],
        density: f64,
        map: impl Fn(&Vector<D>) -> (Vector<D>, Matrix<D>),
    ) -> Self {
        let lengths = Vector::from_fn(|axis, _| counts[axis] as f64);
        let unit = Block { from: Vector::zeros(), to: lengths, density };
        let mut particles = Self::fill(&unit, 1.0, 1);
        let share = lengths.map(|count| 1.0 / count);
        let parts: Vec<_> = particles.x0.iter().map(|s| map(&s.component_mul(&share))).collect();
        for (p, (place, slope)) in parts.iter().enumerate() {
            let domain = slope * Matrix::from_diagonal(&(share * 0.5));
            let volume = det(&(domain * 2.0));
            (particles.x0[p], particles.x[p]) = (*place, *place);
            (particles.vol0[p], particles.vol[p]) = (volume, volume);
            particles.mass[p] = density * volume;
            particles.domain0.push(domain);
        }
        particles.domain0.shrink_to_fit();
        let each = 2.0 / particles.len() as f64;
        particles.spacing = Vector::from_fn(|axis, _| {
            each * particles.domain0.iter().map(|r| r.row(axis).amax()).sum::<f64>()
        });
        particles
    }

    /// Converts particles in the meridian plane with the axes r and z to a body of revolution.
    /// Masses (kg/rad) and volumes (m^3/rad) become values per radian.
    pub fn revolve(&mut self) {
        for (p, x0) in self.x0.iter().enumerate() {
            for column in [&mut self.mass, &mut self.vol0, &mut self.vol] {
                column[p] *= x0[0];
            }
        }
        self.across = vec![1.0; self.len()];
        (self.rate_across, self.stress_across) = (vec![0.0; self.len()], vec![0.0; self.len()]);
    }

    /// Whether this is a body of revolution in which the initial radius of a particle is NaN or
    /// differs from the reference radius.
    pub(in crate::mpm) fn is_widened(&self) -> bool {
        let is_own = |(x, x0): (&Vector<D>, &Vector<D>)| x[0] == x0[0];
        !self.stress_across.is_empty() && !self.x.iter().zip(&self.x0).all(is_own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Block;
    use approx::assert_relative_eq;

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

    /// The integral `int r dr dz` over a box is exact if the radius is taken at the middle of each
    /// part.
    #[test]
    fn hollow_cylinder_has_its_exact_mass_per_radian() {
        let (from, to) = (Vector::<2>::new(0.5, 0.0), Vector::<2>::new(2.0, 3.0));
        let mut ring = Particles::fill(&Block { from, to, density: 2.0 }, 0.25, 2);
        ring.revolve();
        let volume = 0.5 * (2.0 * 2.0 - 0.5 * 0.5) * 3.0;
        assert_relative_eq!(ring.vol0.iter().sum::<f64>(), volume, max_relative = 1e-13);
        assert_relative_eq!(ring.mass.iter().sum::<f64>(), 2.0 * volume, max_relative = 1e-13);
        assert_eq!((ring.vol.as_slice(), ring.across[0]), (ring.vol0.as_slice(), 1.0));
    }
}
