//! A law with an initial stress in the reference configuration.
//!
//! If the law is a function of F, the initial stress S0 is an additional second Piola-Kirchhoff
//! stress, `sigma = sigma_law(F) + F S0 F^T/J`. This stress rotates with the body, and derives from
//! the energy `W_law + S0 : E`, `E = (F^T F - I)/2` (Merodio, Ogden & Rodriguez 2013, Int. J.
//! Non-Linear Mech. 56). A law in rate form starts from the Cauchy stress S0.

use super::contract::Material;
use super::stress_update::StressUpdate;
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::particles::Particles;
use crate::subject::{Checkpoint, Column, Failure};

/// A law with an initial stress.
pub struct Prestressed<const D: usize> {
    law: Box<dyn Material<D>>,
    /// Initial stress S0 of each particle (Pa); empty for a law in rate form.
    stress: Vec<Matrix<D>>,
}

impl<const D: usize> Prestressed<D> {
    /// Adds the initial `stress` (Pa), one entry per particle, to `law` and to `particles`, which
    /// must be in their reference configuration.
    pub fn new(
        law: Box<dyn Material<D>>,
        stress: Vec<Matrix<D>>,
        particles: &mut Particles<D>,
    ) -> Self {
        particles.sigma.copy_from_slice(&stress);
        let keeps = law.reads_deformation();
        Self { law, stress: if keeps { stress } else { Vec::new() } }
    }

    fn add(&self, particles: &mut Particles<D>) {
        let Particles { sigma, def_grad, vol, vol0, .. } = particles;
        let states = def_grad.iter().zip(vol.iter().zip(vol0.iter()));
        for ((sigma, s0), (f, (vol, vol0))) in sigma.iter_mut().zip(&self.stress).zip(states) {
            *sigma += f * s0 * f.transpose() * (vol0 / vol);
        }
    }
}

impl<const D: usize> Material<D> for Prestressed<D> {
    fn reads_deformation(&self) -> bool {
        self.law.reads_deformation()
    }

    fn keeps_stretch_across(&self) -> bool {
        self.law.keeps_stretch_across()
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let mut columns = self.law.columns();
        if !self.stress.is_empty() {
            columns.push(Column::of_particles("S0", &self.stress));
        }
        columns
    }

    fn checkpoint(&mut self, checkpoint: &mut Checkpoint<'_>) {
        self.law.checkpoint(checkpoint);
    }

    /// Returns the energy `W_law + S0 : E`. A law in rate form has no energy, because its stress
    /// includes S0.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        if !self.law.reads_deformation() {
            return None;
        }
        let stored = |((f, s0), vol0): ((&Matrix<D>, &Matrix<D>), &f64)| {
            // E is computed from H = F - I to avoid cancellation for small strains.
            let h = f - Matrix::identity();
            vol0 * 0.5 * s0.dot(&(h + h.transpose() + h.transpose() * h))
        };
        let all = particles.def_grad.iter().zip(&self.stress).zip(&particles.vol0);
        Some(self.law.energy(particles)? + all.map(stored).sum::<f64>())
    }

    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.law.start_deformed(particles)?;
        self.add(particles);
        Ok(())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        self.law.update(body);
        self.add(body.particles());
    }
}

#[cfg(test)]
mod tests {
    use super::super::MaterialPlan;
    use super::super::specimen::{every, scattered};
    use super::*;
    use crate::mpm::foundation::algebra::Vector;
    use crate::mpm::foundation::particles::Block;
    use crate::subject::PlaneState;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    /// Returns a symmetric stress (Pa) with shear, as large as the moduli.
    fn initial<const D: usize>() -> Matrix<D> {
        let all = scattered::<D>(20.0, 0.8);
        all + all.transpose()
    }

    /// Returns one particle of each material that may start with a stress, and of the corresponding
    /// plates.
    fn bodies<const D: usize>() -> Vec<(MaterialPlan, Prestressed<D>, Particles<D>)> {
        let admitted =
            every().into_iter().filter(|plan| plan.properties().starts_stressed().is_ok());
        let body = |plan: MaterialPlan, law: Box<dyn Material<D>>| {
            let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
            let mut body = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 1);
            let law = Prestressed::new(law, vec![initial()], &mut body);
            if law.keeps_stretch_across() {
                body.across = vec![1.0];
            }
            (plan, law, body)
        };
        let both = |plan: MaterialPlan| {
            let plate = plan.in_plane(PlaneState::Stress).filter(|_| D == 2);
            let laws = [Some(plan.build()), plate].into_iter().flatten();
            laws.map(|law| body(plan, law)).collect::<Vec<_>>()
        };
        admitted.flat_map(both).collect()
    }

    /// Returns the first Piola-Kirchhoff stress P (Pa), `J sigma F^-T`, and the stored energy of
    /// each body that starts at F.
    fn at<const D: usize>(f: &Matrix<D>) -> Vec<(MaterialPlan, Matrix<D>, Option<f64>)> {
        let started = |(plan, mut law, mut body): (MaterialPlan, Prestressed<D>, Particles<D>)| {
            body.deform(|_| (Vector::zeros(), *f));
            law.start_deformed(&mut body).unwrap();
            let energy = law.energy(&body);
            let back = f.try_inverse().unwrap().transpose();
            (plan, body.sigma[0] * back * body.vol[0], energy)
        };
        bodies().into_iter().map(started).collect()
    }

    #[test]
    fn initial_stress_remains_at_rest() {
        fn hold<const D: usize>() {
            for (plan, mut law, mut body) in bodies::<D>() {
                assert_eq!(body.sigma[0], initial::<D>(), "{plan:?}");
                body.track_deformation();
                law.update(&mut StressUpdate::new(0.1, &mut body));
                assert_abs_diff_eq!(body.sigma[0], initial::<D>(), epsilon = 1e-13);
            }
        }
        hold::<1>();
        hold::<2>();
        hold::<3>();
    }

    /// Tests `P : dF = d(W_law + S0 : E)`.
    #[test]
    fn stress_is_the_derivative_of_the_energy() {
        fn hold<const D: usize>() {
            let f = Matrix::<D>::identity() + scattered(0.25, 1.7);
            let step = scattered::<D>(1e-6, 2.2);
            let (low, high) = (at(&(f - step)), at(&(f + step)));
            for (i, (plan, piola, _)) in at(&f).into_iter().enumerate() {
                let Some((low, high)) = low[i].2.zip(high[i].2) else { continue };
                let work = 2.0 * piola.dot(&step);
                assert_relative_eq!(work, high - low, max_relative = 1e-7);
                assert!(plan.properties().depends_on_deformation_alone().is_ok(), "{plan:?}");
            }
        }
        hold::<1>();
        hold::<2>();
        hold::<3>();
    }

    #[test]
    fn rotation_rotates_the_initial_stress_if_the_law_depends_on_f() {
        let (c, s) = (libm::cos(2.0), libm::sin(2.0));
        let (f, q) = (Matrix::<2>::new(1.2, 0.3, -0.1, 0.8), Matrix::<2>::new(c, -s, s, c));
        for ((plan, before, _), (_, after, _)) in at(&f).into_iter().zip(at(&(q * f))) {
            if plan.properties().depends_on_deformation_alone().is_ok() {
                assert_abs_diff_eq!(after, q * before, epsilon = 1e-11);
            }
        }
    }

    /// Along S0, `dP/dF` is `M + S0` for a law that depends only on F, and the wave modulus M for a
    /// law in rate form.
    #[test]
    fn small_waves_along_the_stress_have_the_increased_modulus() {
        let [low, high] = [-1e-6, 1e-6].map(|eps| at(&Matrix::<1>::new(1.0 + eps)));
        for ((plan, low, _), (_, high, _)) in low.into_iter().zip(high) {
            let properties = plan.properties();
            let extra = match properties.depends_on_deformation_alone() {
                Ok(()) => initial::<1>()[(0, 0)],
                Err(_) => 0.0,
            };
            let slope = (high[(0, 0)] - low[(0, 0)]) / 2e-6;
            assert_relative_eq!(slope, properties.wave_modulus(1.0) + extra, max_relative = 1e-8);
        }
    }

    /// The energy of a law in rate form would require the stress without S0.
    #[test]
    fn a_law_in_rate_form_has_no_energy() {
        let rate = at(&Matrix::<1>::new(1.1));
        let of_rate = rate
            .into_iter()
            .filter(|(plan, ..)| plan.properties().depends_on_deformation_alone().is_err());
        assert!(of_rate.map(|(_, _, energy)| energy).eq([None]));
    }
}
