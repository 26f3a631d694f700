//! Hoop strain and hoop stress of a body of revolution, in its meridian plane.
//!
//! The hoop strain rate is `D_tt = sum_i v_i,r N_i(x_p)/r_p`. The hoop stress acts towards the
//! axis: `f_i,r -= sum_p V_p sigma_tt N_i(x_p)/r_p` (Sulsky & Schreyer 1996, Comput. Methods Appl.
//! Mech. Engrg. 139; Nairn & Guilkey 2015, Int. J. Numer. Meth. Engng 101). Masses and volumes are
//! per radian, `V_p = r_p A_p`, so the in-plane equations of motion need no change. Force and rate
//! use equal weights, so the power of the force equals the stress power.

use super::contract::{BodyOnGrid, Effect};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use mpm_subject::Column;

/// Hoop strain rates and hoop forces of all particles.
#[derive(Debug, Clone, Default)]
pub struct Hoop<const D: usize> {
    /// Grid velocities interpolated to the particles (m/s).
    velocity: Vec<Vector<D>>,
}

impl<const D: usize> Effect<D> for Hoop<D> {
    fn name(&self) -> &'static str {
        "hoop"
    }

    fn makes_stress(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("grid v", &self.velocity)]
    }

    fn map_velocity(
        &mut self,
        dt: f64,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &mut Particles<D>,
    ) -> u64 {
        self.velocity.resize(particles.len(), zeros());
        kernel.g2p(grid, &grid.velocity, particles, (0.0, 1.0), &mut self.velocity);
        for (p, velocity) in self.velocity.iter().enumerate() {
            let rate = velocity[0] / particles.position(p)[0];
            particles.rate_across[p] = rate;
            particles.across[p] *= 1.0 + rate * dt;
        }
        particles.len() as u64 * kernel.support()
    }

    fn add_force(&mut self, _: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let particles = body.particles;
        for (p, x) in particles.positions().iter().enumerate() {
            let mut force = zeros();
            force[0] = -particles.vol[p] * particles.stress_across[p] / x[0];
            body.add_point_force(p, &force);
        }
        body.pairs(particles.len())
    }
}
