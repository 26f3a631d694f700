//! Bodies that are a mapped box: particles at equal distances in the unit square or cube, and their
//! places, volumes and domains by the map.
//!
//! A share of the unit box, `1/n_a` long on each axis, is mapped onto the particle's part of the
//! body. Its domain is the parallelogram of the map's slope at its middle, its volume that of the
//! slope: exactly the part's where the Jacobian is linear in each coordinate, as that of a bilinear
//! map is. The volumes then add up to that of the body, and middles of outer faces of domains lie
//! on those of the body.

use crate::mpm::foundation::algebra::{Matrix, Vector, det};
use crate::mpm::foundation::particles::{Block, Particles};

impl<const D: usize> Particles<D> {
    /// Fills a mapped box of density `density` (kg/m3) with `counts` particles along its axes.
    /// `map` gives the place (m) of a point of the unit box, and the slope there (m). At rest and
    /// free of stress.
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
}
