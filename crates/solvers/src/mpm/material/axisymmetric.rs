//! Bodies of revolution: a three-dimensional law whose third axis is the hoop direction, with the
//! stretch `F_33 = r/R`.
//!
//! The law is evaluated in three dimensions, where the shears between the meridian plane and the
//! hoop direction are zero. Any law can therefore be used.

use super::contract::Material;
use super::stress_update::StressUpdate;
use super::tangent::StressResponse;
use crate::mpm::foundation::algebra::{Matrix, Vector, zeros};
use crate::mpm::foundation::particles::{Block, Particles};
use mpm_subject::{Column, Failure};
use std::any::Any;

/// A three-dimensional law, applied to a body of revolution in its meridian plane.
pub(super) struct Axisymmetric {
    law: Box<dyn Material<3>>,
    /// Particle columns in three dimensions, which the law reads and writes.
    space: Particles<3>,
}

impl Axisymmetric {
    pub(super) fn new(law: Box<dyn Material<3>>) -> Self {
        Self { law, space: none() }
    }

    /// Calls `act` with the law and the three-dimensional state of the body, and copies volumes and
    /// stresses back.
    fn in_space<const D: usize, T>(
        &mut self,
        particles: &mut Particles<D>,
        act: impl FnOnce(&mut dyn Material<3>, &mut Particles<3>) -> T,
    ) -> T {
        enter(particles, &mut self.space);
        let acted = act(self.law.as_mut(), &mut self.space);
        particles.vol.copy_from_slice(&self.space.vol);
        let stresses = particles.sigma.iter_mut().zip(&mut particles.stress_across);
        for ((sigma, across), of_space) in stresses.zip(&self.space.sigma) {
            *sigma = of_space.fixed_view::<D, D>(0, 0).into_owned();
            *across = of_space[(2, 2)];
        }
        acted
    }
}

fn none() -> Particles<3> {
    let (from, to) = (zeros(), Vector::from_element(1.0));
    Particles::fill_where(&Block { from, to, density: 1.0 }, 1.0, 1, |_| false)
}

/// Copies the state of a body to `space`. Allocates only the first time.
fn enter<const D: usize>(particles: &Particles<D>, space: &mut Particles<3>) {
    let Particles { def_grad, grad_v, sigma, across, rate_across, stress_across, .. } = particles;
    space.x.resize(particles.len(), zeros());
    space.mass.clone_from(&particles.mass);
    space.vol0.clone_from(&particles.vol0);
    space.vol.clone_from(&particles.vol);
    for (column, across, into) in [
        (def_grad, across, &mut space.def_grad),
        (grad_v, rate_across, &mut space.grad_v),
        (sigma, stress_across, &mut space.sigma),
    ] {
        into.resize(column.len(), zeros());
        for ((block, across), into) in column.iter().zip(across).zip(into) {
            into.fixed_view_mut::<D, D>(0, 0).copy_from(block);
            into[(2, 2)] = *across;
        }
    }
}

impl<const D: usize> Material<D> for Axisymmetric {
    fn reads_deformation(&self) -> bool {
        self.law.reads_deformation()
    }

    fn keeps_stretch_across(&self) -> bool {
        true
    }

    fn reads_rate(&self) -> bool {
        self.law.reads_rate()
    }

    fn is_stressed_at_rest(&self) -> bool {
        self.law.is_stressed_at_rest()
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let Particles { x, mass, vol0, vol, sigma, def_grad, grad_v, .. } = &self.space;
        let mut columns = self.law.columns();
        columns.extend([
            Column::of_particles("x in space", x),
            Column::of_particles("mass in space", mass),
            Column::of_particles("V0 in space", vol0),
            Column::of_particles("V in space", vol),
            Column::of_particles("sigma in space", sigma),
            Column::of_particles("F in space", def_grad),
            Column::of_particles("grad v in space", grad_v),
        ]);
        columns
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        self.law.state()
    }

    fn set_state(&mut self, state: &dyn Any) {
        self.law.set_state(state);
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let mut space = none();
        enter(particles, &mut space);
        self.law.energy(&space)
    }

    /// Computes the hoop stretch from the positions, and its rate from the velocities.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        for p in 0..particles.len() {
            let r = particles.position(p)[0];
            particles.across[p] = r / particles.x0[p][0];
            particles.rate_across[p] = particles.v[p][0] / r;
            particles.vol[p] *= particles.across[p];
        }
        self.in_space(particles, |law, space| law.start_deformed(space))
    }

    fn response(&self, p: usize, f: &Matrix<3>) -> Option<StressResponse> {
        self.law.response(p, f)
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        self.in_space(body.particles(), |law, space| law.update(&mut StressUpdate::new(dt, space)));
    }
}

#[cfg(test)]
mod tests {
    use super::super::specimen::{SLOW, Specimen, every, scattered};
    use crate::mpm::foundation::algebra::in_space;
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use mpm_subject::PlaneState;

    /// For every law, compares stress (with the hoop stress), volume and energy over several steps
    /// with the results of the 3-D law.
    #[test]
    fn body_of_revolution_agrees_with_the_3d_law() {
        for plan in every() {
            let mut body = Specimen::<2>::in_plane(plan, PlaneState::Axisymmetric).unwrap();
            let mut space = Specimen::<3>::new(plan);
            for (seed, hoop) in [(0.3, 0.1), (1.1, -0.2), (2.6, 0.05)] {
                let grad_v = scattered::<2>(0.2 / SLOW, seed);
                let sigma = body.flow_in_hoops(&grad_v, hoop / SLOW, SLOW);
                let found = space.flow(&in_space(&grad_v, hoop / SLOW), SLOW);
                assert_abs_diff_eq!(found, in_space(&sigma, body.stress_across()), epsilon = 1e-11);
                assert_relative_eq!(body.j(), space.j(), max_relative = 1e-14);
                assert_eq!(body.energy().is_some(), space.energy().is_some());
                let energies = body.energy().zip(space.energy());
                let (found, expected) = energies.unwrap_or_default();
                assert_relative_eq!(found, expected, max_relative = 1e-13, epsilon = 1e-13);
            }
        }
    }
}
