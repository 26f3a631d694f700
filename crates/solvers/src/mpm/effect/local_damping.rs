//! Local damping: a force opposite to the velocity, proportional to the unbalanced force.
//!
//! `f_i <- f_i - zeta |f_i| sign(v_i)` for each component of each node, after all other forces have
//! been added (Cundall 1987, in Analytical and Computational Methods in Engineering Rock Mechanics,
//! ch. 4). In equilibrium there is no unbalanced force and hence no damping force, under any load.
//! Each mode decays by the same factor per half period, `sqrt((1 - zeta)/(1 + zeta))`, if all
//! velocities change sign at the same time.
//!
//! The sign is taken from the velocity at the start of the step, half a step behind the forces. The
//! damping force therefore changes sign up to one step late, and is of first order in time. The
//! part of the FLIP velocities that gives no momentum to any node is not damped.

use super::contract::Effect;
use crate::mpm::foundation::grid::Grid;

/// Local damping with the fraction zeta of the unbalanced force, 0 <= zeta < 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalDamping(pub f64);

impl<const D: usize> Effect<D> for LocalDamping {
    fn name(&self) -> &'static str {
        "local_damping"
    }

    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn modify_force(&self, grid: &mut Grid<D>) {
        for (force, velocity) in grid.force.iter_mut().zip(&grid.velocity) {
            for (f, v) in force.iter_mut().zip(velocity) {
                // A node with zero velocity is not damped. A velocity of NaN is ignored here,
                // because the check of the particles reports it.
                if *v > 0.0 {
                    *f -= self.0 * f.abs();
                } else if *v < 0.0 {
                    *f += self.0 * f.abs();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Vector;

    #[test]
    fn each_component_is_damped_by_a_share_of_its_own_force() {
        let mut grid = Grid::new(Vector::zeros(), 1.0, [1; 2], [false; 2], [2; 2]);
        grid.velocity[0] = Vector::<2>::new(1.0, -1e-9);
        grid.velocity[1] = Vector::<2>::new(-2.0, 0.0);
        grid.force[0] = Vector::<2>::new(8.0, 4.0);
        grid.force[1] = Vector::<2>::new(-8.0, 4.0);
        Effect::<2>::modify_force(&LocalDamping(0.25), &mut grid);
        assert_eq!(grid.force[0], Vector::<2>::new(6.0, 5.0));
        assert_eq!(grid.force[1], Vector::<2>::new(-6.0, 4.0));
    }
}
