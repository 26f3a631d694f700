//! A law with an initial stress in the reference configuration.
//!
//! If the law is a function of F, the initial stress S0 is an additional second Piola-Kirchhoff
//! stress, `sigma = sigma_law(F) + F S0 F^T/J`. This stress rotates with the body, and derives from
//! the energy `W_law + S0 : E`, `E = (F^T F - I)/2` (Merodio, Ogden & Rodriguez 2013, Int. J.
//! Non-Linear Mech. 56). A law in rate form starts from the Cauchy stress S0. A law with a yield
//! surface starts from the elastic strain of S0 ([`Material::start_stressed`]).

use super::contract::Material;
use super::stress_update::StressUpdate;
use super::tangent::StressResponse;
use crate::mpm::foundation::algebra::{Matrix, identity, in_body, in_space, product};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::{Column, Failure};
use std::any::Any;

/// A law with an initial stress.
pub struct Prestressed<const D: usize> {
    law: Box<dyn Material<D>>,
    /// Initial stress S0 of each particle (Pa); empty if the law stores it or is in rate form.
    stress: Vec<Matrix<D>>,
}

impl<const D: usize> Prestressed<D> {
    /// Adds the initial `stress` (Pa), one entry per particle, to `law` and to `particles`, which
    /// must be in their reference configuration.
    ///
    /// # Errors
    /// [`Failure::OutsideYieldSurface`] for a stress that violates the yield condition of the law.
    pub fn new(
        mut law: Box<dyn Material<D>>,
        stress: &[Matrix<3>],
        particles: &mut Particles<D>,
    ) -> Result<Self, Failure> {
        let keeps = !law.start_stressed(stress)? && law.reads_deformation();
        let stress = stress.iter().map(in_body).collect();
        particles.sigma.clone_from(&stress);
        Ok(Self { law, stress: if keeps { stress } else { Vec::new() } })
    }

    fn add(&self, particles: &mut Particles<D>) {
        let Particles { sigma, def_grad, vol, vol0, .. } = particles;
        let states = def_grad.iter().zip(vol.iter().zip(vol0.iter()));
        for ((sigma, s0), (f, (vol, vol0))) in sigma.iter_mut().zip(&self.stress).zip(states) {
            *sigma += product(&product(f, s0), &f.transpose()) * (vol0 / vol);
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

    fn state(&self) -> Option<Box<dyn Any>> {
        self.law.state()
    }

    fn set_state(&mut self, state: &dyn Any) {
        self.law.set_state(state);
    }

    /// Returns the energy `W_law + S0 : E`. A law in rate form has no energy, because its stress
    /// includes S0.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        if !self.law.reads_deformation() {
            return None;
        }
        let stored = |((f, s0), vol0): ((&Matrix<D>, &Matrix<D>), &f64)| {
            // E is computed from H = F - I to avoid cancellation for small strains.
            let h = f - identity();
            vol0 * 0.5 * s0.dot(&(h + h.transpose() + product(&h.transpose(), &h)))
        };
        let all = particles.def_grad.iter().zip(&self.stress).zip(&particles.vol0);
        Some(self.law.energy(particles)? + all.map(stored).sum::<f64>())
    }

    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.law.start_deformed(particles)?;
        self.add(particles);
        Ok(())
    }

    fn response(&self, p: usize, f: &Matrix<3>) -> Option<StressResponse> {
        let response = self.law.response(p, f)?;
        Some(match self.stress.get(p) {
            Some(s0) => {
                response.with_initial(product(&product(f, &in_space(s0, 0.0)), &f.transpose()))
            }
            None => response,
        })
    }

    /// Returns the out-of-plane stress of the law: without a yield surface, S0 has no component out
    /// of the plane.
    fn stress_across(&self, p: usize, particles: &Particles<D>) -> Option<f64> {
        self.law.stress_across(p, particles)
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
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use mpm_subject::PlaneState;
    use rstest::rstest;

    /// Returns a symmetric stress (Pa) with shear, as large as the moduli.
    fn initial<const D: usize>() -> Matrix<D> {
        let all = scattered::<D>(20.0, 0.8);
        all + all.transpose()
    }

    /// Returns one particle of each material that may start with any stress, and of the
    /// corresponding plates.
    fn bodies<const D: usize>() -> Vec<(MaterialPlan, Prestressed<D>, Particles<D>)> {
        let admitted = every().into_iter().filter(|plan| {
            let properties = plan.properties();
            properties.starts_stressed().is_ok()
                && properties.yield_function(&Matrix::zeros()).is_none()
        });
        let body = |plan: MaterialPlan, law: Box<dyn Material<D>>| {
            let mut body = Particles::cubes([1; D]);
            let stress = in_space(&initial::<D>(), 0.0);
            let law = Prestressed::new(law, &[stress], &mut body).unwrap();
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

    /// Tests `P : dF = d(W_law + S0 : E)`. The energy of a law in rate form would require the
    /// stress without S0.
    #[test]
    fn stress_is_the_derivative_of_the_energy() {
        fn hold<const D: usize>() {
            let f = Matrix::<D>::identity() + scattered(0.25, 1.7);
            let step = scattered::<D>(1e-6, 2.2);
            let (low, high) = (at(&(f - step)), at(&(f + step)));
            for (i, (plan, piola, energy)) in at(&f).into_iter().enumerate() {
                let is_function_of_f = plan.properties().depends_on_deformation_alone().is_ok();
                assert_eq!(energy.is_some(), is_function_of_f, "{plan:?}");
                let Some((low, high)) = low[i].2.zip(high[i].2) else { continue };
                let work = 2.0 * piola.dot(&step);
                assert_relative_eq!(work, high - low, max_relative = 1e-7);
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

    /// Load steps use this stress and this tangent.
    #[test]
    fn response_agrees_with_the_update_and_its_derivative() {
        let f = Matrix::<3>::identity() + scattered(0.25, 1.7);
        let mut laws = 0;
        for ((plan, law, _), (_, piola, _)) in bodies::<3>().into_iter().zip(at(&f)) {
            let Some(response) = law.response(0, &f) else { continue };
            let expected = piola * f.transpose();
            assert_relative_eq!(response.kirchhoff, expected, max_relative = 1e-12);
            let (dh, step) = (scattered::<3>(1.0, 0.3), 1e-6);
            let stress = |step: f64| {
                law.response(0, &((Matrix::identity() + dh * step) * f)).unwrap().kirchhoff
            };
            let difference = (stress(step) - stress(-step)) / (2.0 * step);
            let size = difference.amax();
            let name = plan.name();
            assert!((response.tangent(&dh) - difference).amax() <= 1e-7 * size, "{name}");
            laws += 1;
        }
        assert_eq!(laws, 2, "neo-Hookean and Hencky laws have a tangent");
    }

    /// Each law yields when the largest compression reaches its strength. In the initial stress, f
    /// is zero on the surface.
    #[rstest]
    #[case::j2(MaterialPlan::J2 { young: 1e4, poisson: 0.25, r#yield: 30.0, hardening: 0.0 }, 30.0)]
    // q/sqrt(3) - 0.3 q/3 = 10
    #[case::drucker_prager(
        MaterialPlan::DruckerPrager {
            young: 1e4, poisson: 0.25, friction: 0.3, dilation: 0.1, strength: 10.0
        },
        10.0 / (1.0 / 3.0_f64.sqrt() - 0.1)
    )]
    // q = 2 c cos(phi)/(1 - sin(phi))
    #[case::mohr_coulomb(
        MaterialPlan::MohrCoulomb {
            young: 1e4, poisson: 0.25, friction_angle: 30.0, dilation_angle: 10.0, cohesion: 8.0
        },
        2.0 * 8.0 * 0.75_f64.sqrt() / 0.5
    )]
    fn initial_stress_outside_the_yield_surface_is_refused(
        #[case] plan: MaterialPlan,
        #[case] strength: f64,
    ) {
        for (share, admitted) in [(0.999, true), (1.0, true), (1.001, false)] {
            let mut s0 = Matrix::<3>::zeros();
            s0[(1, 1)] = -share * strength;
            let law = Prestressed::new(plan.build::<3>(), &[s0], &mut Particles::cubes([1; 3]));
            let refused = matches!(law, Err(Failure::OutsideYieldSurface { .. }));
            assert_eq!(refused, !admitted, "{share}");
        }
    }
}
