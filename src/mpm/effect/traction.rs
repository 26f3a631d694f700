//! A surface traction on the layer of particles at the surface.
//!
//! `f_ext_i += sum_p p0 A_p N_i(x_p)` over that layer, with A_p the particle's reference share of
//! the surface: a dead load, `P N = p0(X, t)`. The body need not end on a node: the force follows
//! the particles (Wobbes & Tielen 2015, Steffen's bar), and with them faces that turn and bend. It
//! acts half a particle spacing inside the surface unless it is put there ([`Placement`]).

use super::contract::Effect;
use super::surface::{Placement, Surface};
use crate::mpm::algebra::Vector;
use crate::mpm::boundary::Side;
use crate::mpm::grid::Grid;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::particles::Particles;
use crate::subject::Column;

/// A traction (Pa, per reference area) as a function of the place in the reference configuration
/// and of time.
pub type TractionField<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> Vector<D> + Send>;

/// Traction p0(X, t) (Pa, per reference area) on one face of the body.
pub struct Traction<const D: usize> {
    value: TractionField<D>,
    surface: Surface,
}

impl<const D: usize> Traction<D> {
    /// A traction p0(t) at the outermost layer of `particles` on `side` of `axis`.
    pub fn on(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        value: Box<dyn Fn(f64) -> Vector<D> + Send>,
    ) -> Self {
        Self::at(particles, axis, side, Placement::Particles, Box::new(move |_, t| value(t)))
    }

    /// A traction p0(X, t), X on the surface, at `placement`.
    pub fn at(
        particles: &Particles<D>,
        axis: usize,
        side: Side,
        placement: Placement,
        value: TractionField<D>,
    ) -> Self {
        Self { value, surface: Surface::new(particles, axis, side, placement) }
    }
}

impl<const D: usize> Effect<D> for Traction<D> {
    fn name(&self) -> &'static str {
        "traction"
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_particles("layer", &self.surface.layer)]
    }

    fn reads_deformation(&self) -> bool {
        self.surface.placement == Placement::Surface
    }

    fn add_force(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        let Self { value, surface } = self;
        surface.pull(particles, kernel, grid, |p| value(&surface.label(particles, p), t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::kernel::kernel;
    use crate::mpm::{BasisName, Block, Matrix};
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn plate() -> Particles<2> {
        let (from, to) = (Vector::<2>::new(0.0, 0.0), Vector::<2>::new(1.0, 2.0));
        Particles::fill(&Block { from, to, density: 1.0 }, 0.25, 2)
    }

    #[test]
    fn the_whole_force_reaches_the_grid() {
        let particles = plate();
        let kernel = kernel::<2>(BasisName::Linear);
        let mut grid = kernel.grid(Vector::zeros(), 0.25, [6, 8], [false; 2]);
        let value = Box::new(|t| Vector::<2>::new(3.0 * t, 0.5));
        let mut pull = Traction::on(&particles, 0, Side::High, value);
        assert_eq!(pull.add_force(2.0, &particles, kernel.as_ref(), &mut grid), 16 * 4);
        let total = grid.force.iter().fold(Vector::zeros(), |sum, f| sum + f);
        assert_relative_eq!(total, Vector::<2>::new(12.0, 1.0), max_relative = 1e-14);
    }

    /// A shear traction `Y` along the right face of a plate, which has been stretched to twice its
    /// length: force 2, moment about the origin `2 int Y dY = 4`, for the face is at x = 2.
    #[rstest]
    fn at_the_surface_the_moment_is_right_too(
        #[values(
            BasisName::Linear,
            BasisName::ContiguousGimp,
            BasisName::Cpdi,
            BasisName::QuadraticBSpline
        )]
        basis: BasisName,
        #[values(Placement::Particles, Placement::Surface)] placement: Placement,
    ) {
        let mut particles = plate();
        let labels = particles.x0.clone();
        let f = Matrix::<2>::new(2.0, 0.0, 0.0, 1.0);
        let origin = Vector::<2>::new(0.1, 0.1);
        particles.deform(|p| (origin + (f - Matrix::identity()) * labels[p], f));
        particles.track_domains();
        let kernel = kernel::<2>(basis);
        let mut grid = kernel.grid(Vector::zeros(), 0.25, [12, 12], [false; 2]);
        let shear = Box::new(|x: &Vector<2>, _| Vector::<2>::new(0.0, x[1]));
        let mut pull = Traction::at(&particles, 0, Side::High, placement, shear);
        pull.add_force(0.0, &particles, kernel.as_ref(), &mut grid);
        let total = grid.force.iter().fold(Vector::zeros(), |sum, f| sum + f);
        assert_relative_eq!(total, Vector::<2>::new(0.0, 2.0), epsilon = 1e-13);
        let moment = |i: usize| grid.force[i][1] * (basis.place(&grid, i)[0] - origin[0]);
        let moment: f64 = (0..grid.nodes()).map(moment).sum();
        let arm = if placement == Placement::Surface { 2.0 } else { 2.0 - 2.0 * 0.0625 };
        assert_relative_eq!(moment, 2.0 * arm, max_relative = 1e-13);
    }
}
