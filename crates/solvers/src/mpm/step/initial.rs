//! Initial state of the particles: columns, stresses and domains before the first step.
//!
//! A body may start deformed ([`Particles::deform`]). The material then computes the stress from F
//! ([`Material::start_deformed`]), and the basis computes the domains from F. A viscous fluid that
//! starts in motion also has viscous stress.

use crate::mpm::basis::Domain;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::Material;
use mpm_subject::{Failure, Site};

/// Adds the columns that are read by `material` or by a basis with this `domain`, and completes the
/// initial state. Returns the smallest J.
///
/// # Errors
/// [`Failure::NotOfDeformation`] if F does not determine the stress of a deformed body.
/// [`Failure::NonFinite`] and [`Failure::Inverted`] name the first invalid particle.
pub(in crate::mpm) fn complete<const D: usize>(
    particles: &mut Particles<D>,
    domain: Domain,
    material: &mut dyn Material<D>,
) -> Result<f64, Failure> {
    particles.all_finite()?;
    let deformed = particles.is_deformed() || particles.is_widened();
    if domain == Domain::Follows {
        particles.track_domains();
    }
    if material.reads_deformation() {
        particles.track_deformation();
    }
    if material.keeps_stretch_across() {
        particles.across.resize(particles.len(), 1.0);
    }
    if deformed || material.reads_rate() || material.is_stressed_at_rest() {
        material.start_deformed(particles)?;
    }
    let mut min_j = f64::INFINITY;
    for (p, (vol, vol0)) in particles.vol.iter().zip(&particles.vol0).enumerate() {
        let j = vol / vol0;
        // The stress of an inverted particle is NaN, so this check must precede the check of the
        // stress.
        if deformed && j <= 0.0 {
            return Err(Failure::Inverted { site: Site::Particle(p), j });
        }
        min_j = min_j.min(j);
    }
    particles.all_finite()?;
    Ok(if particles.is_empty() { 1.0 } else { min_j })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::material::Rigid;
    use crate::mpm::{Block, LinearElastic, Matrix, NeoHookean, Newtonian, Vector};
    use approx::assert_relative_eq;

    /// Creates a square of four particles with u = (0.1 X + 0.2 Y, -0.25 Y) and uniform F.
    fn deformed(f: Matrix<2>) -> Particles<2> {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut body = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
        let labels = body.x0.clone();
        body.deform(|p| ((f - Matrix::identity()) * labels[p], f));
        body
    }

    /// The initial stress of a shear flow is sigma = 2 eta D.
    #[test]
    fn moving_fluid_starts_with_viscous_stress() {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut body = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
        body.grad_v.fill(Matrix::<2>::new(0.0, 3.0, 0.0, 0.0));
        complete(&mut body, Domain::Point, &mut Newtonian::new(50.0, 0.7)).unwrap();
        assert_relative_eq!(body.sigma[3], Matrix::<2>::new(0.0, 2.1, 2.1, 0.0), epsilon = 1e-12);
    }

    #[test]
    fn invalid_initial_deformation_is_refused() {
        let mut neo = NeoHookean::new(100.0, 0.3);
        let start = |f, material: &mut dyn Material<2>| {
            complete(&mut deformed(f), Domain::Point, material).map(|_| ())
        };
        let inside_out = Matrix::<2>::new(1.0, 0.0, 0.0, -0.5);
        let site = Site::Particle(0);
        assert_eq!(start(inside_out, &mut neo), Err(Failure::Inverted { site, j: -0.5 }));
        let torn = Matrix::<2>::new(f64::NAN, 0.0, 0.0, 1.0);
        assert!(matches!(start(torn, &mut neo), Err(Failure::NonFinite { .. })));
        let stretched = Matrix::<2>::new(1.1, 0.0, 0.0, 1.0);
        assert_eq!(start(stretched, &mut Rigid::new()), Err(Failure::NotOfDeformation));
        assert_eq!(start(Matrix::identity(), &mut Rigid::new()), Ok(()));
        let half_a_turn = Matrix::<2>::new(-1.0, 0.0, 0.0, -1.0);
        let turned = start(half_a_turn, &mut LinearElastic::new(100.0, 0.3));
        assert!(matches!(turned, Err(Failure::NonFinite { quantity: "stress", .. })));
    }
}
