//! Taylor least squares: integrals over reconstructed fields instead of sums over particles.
//!
//! In each cell a linear Taylor polynomial is fitted to the particle data. Nodal mass, momentum and
//! internal force are integrated from the polynomial by Gauss quadrature (Wobbes, Moeller, Galavi &
//! Vuik 2019, IJNME 117). For a uniform stress, the internal force at a node between two full cells
//! is zero, for any number of particles in each cell. The fits of mass and momentum density
//! conserve the sums in every cell; the fit of the stress is unconstrained. Velocities are
//! transferred back as in FLIP.

mod quadrature_points;

use self::quadrature_points::{QuadraturePoint, QuadraturePoints};
use super::contract::{Transfer, TransferKind};
use crate::mpm::foundation::algebra::{Matrix, Vector, dyad, inverse};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::{G2pRequest, Kernel, ParticleField};
use crate::mpm::scheme::Stage;
use mpm_subject::Column;
use std::ops::{Add, Mul, Sub};

/// FLIP with fields reconstructed in cells.
#[derive(Debug, Clone, Default)]
pub struct Tls<const D: usize> {
    quadrature: QuadraturePoints<D>,
    /// The quadrature points, stored as particles, which the kernel requires.
    points: Option<Particles<D>>,
}

/// Fills a column of the quadrature points. Points that are particles get the value of the
/// particle, and Gauss points get the value of the fit.
fn fill<const D: usize, T>(
    quadrature: &QuadraturePoints<D>,
    column: &mut Vec<T>,
    own: impl Fn(usize) -> T,
    fitted: impl Fn(usize, &QuadraturePoint<D>, &Fit<'_, D>) -> T,
) {
    column.clear();
    for (k, point) in quadrature.all.iter().enumerate() {
        column.push(if let Some(p) = point.particle {
            own(p)
        } else {
            fitted(k, point, &Fit { x: &quadrature.x, members: quadrature.members(point) })
        });
    }
}

impl<const D: usize> Tls<D> {
    /// Updates the quadrature points with their volumes and masses.
    fn place(&mut self, grid: &Grid<D>, particles: &Particles<D>) {
        let Some(points) = &mut self.points else { return };
        self.quadrature.place(grid, particles);
        points.x.clear();
        points.x.extend(self.quadrature.all.iter().map(|point| point.x));
        points.vol.clear();
        points.vol.extend(self.quadrature.all.iter().map(|point| point.volume));
        let own = |p: usize| particles.mass[p];
        fill(&self.quadrature, &mut points.mass, own, |_, point, fit| {
            let sum = fit.members.iter().map(|&p| own(p)).sum();
            fit.conserved(point, sum, grid, |p| own(p) / particles.vol[p]) * point.volume
        });
    }
}

impl<const D: usize> Transfer<D> for Tls<D> {
    fn kind(&self) -> TransferKind {
        TransferKind::Cells
    }

    fn start(&mut self, _: &dyn Kernel<D>, grid: &Grid<D>, particles: &Particles<D>) {
        let most = self.quadrature.start(grid, particles);
        let mut points = particles.clone();
        points.x.reserve(most);
        points.vol.reserve(most);
        points.mass.reserve(most);
        points.v.reserve(most);
        points.sigma.reserve(most);
        self.points = Some(points);
        self.place(grid, particles);
    }

    fn columns(&self) -> Vec<Column<'_>> {
        let points = self.points.iter().flat_map(Particles::columns);
        self.quadrature.columns().into_iter().chain(points).collect()
    }

    /// Performs a separate P2G pass for each stage, because each stage integrates a different
    /// field.
    fn p2g(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &mut Grid<D>,
        stages: &[Stage],
    ) -> u64 {
        if stages.contains(&Stage::Mass) {
            self.place(grid, particles);
        }
        let Some(points) = &mut self.points else { return 0 };
        if stages.contains(&Stage::Mass) {
            kernel.p2g_mass(points, grid);
        }
        if stages.contains(&Stage::Momentum) {
            p2g_momentum(&self.quadrature, points, kernel, particles, grid);
        }
        if stages.contains(&Stage::Force) {
            let own = |p: usize| particles.sigma[p];
            fill(&self.quadrature, &mut points.sigma, own, |_, point, fit| fit.free(point, own));
            kernel.p2g_internal_force(points, grid);
        }
        2 * stages.len() as u64
    }

    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        G2pRequest { change: Some(dt), ..G2pRequest::default() }
    }
}

/// Performs P2G of the momentum (kg m/s), integrated over the `points`, into `grid.velocity`.
fn p2g_momentum<const D: usize>(
    quadrature: &QuadraturePoints<D>,
    points: &mut Particles<D>,
    kernel: &dyn Kernel<D>,
    particles: &Particles<D>,
    grid: &mut Grid<D>,
) {
    let Particles { v, mass, .. } = points;
    let own = |p: usize| particles.v[p] * particles.mass[p];
    fill(
        quadrature,
        v,
        |p| particles.v[p],
        |k, point, fit| {
            let sum = fit.members.iter().map(|&p| own(p)).sum::<Vector<D>>();
            let density = fit.conserved(point, sum, grid, |p| own(p) / particles.vol[p]);
            density * (point.volume / mass[k])
        },
    );
    let mut momentum = std::mem::take(&mut grid.velocity);
    let field = ParticleField { v: &points.v, affine: None };
    kernel.p2g_momentum(points, field, grid, &mut momentum);
    grid.velocity = momentum;
}

/// Linear fits to the particles in a cell.
struct Fit<'a, const D: usize> {
    /// Positions of all particles (m), wrapped into the grid on periodic axes.
    x: &'a [Vector<D>],
    /// Indices of the particles in the cell, at least one.
    members: &'a [usize],
}

impl<const D: usize> Fit<'_, D> {
    /// Returns the value at `point` of the polynomial `f(x) = mean + g . (x - centre)`. The
    /// integral of f over the cell is `sum`, and g is fitted to the particle densities by least
    /// squares (Wobbes et al. 2019, with the Taylor basis of degree one).
    fn conserved<T>(
        &self,
        point: &QuadraturePoint<D>,
        sum: T,
        grid: &Grid<D>,
        density: impl Fn(usize) -> T,
    ) -> T
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let mean = sum * (1.0 / grid.cell_volume());
        self.sloped(point, &point.centre, mean, density)
    }

    /// Returns the value at `point` of the linear least-squares fit.
    fn free<T>(&self, point: &QuadraturePoint<D>, value: impl Fn(usize) -> T) -> T
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let share = 1.0 / self.members.len() as f64;
        let nothing = value(self.members[0]) * 0.0;
        let mean = self.members.iter().fold(nothing, |sum, &p| sum + value(p) * share);
        self.sloped(point, &self.middle(), mean, value)
    }

    fn middle(&self) -> Vector<D> {
        let share = 1.0 / self.members.len() as f64;
        self.members.iter().map(|&p| self.x[p] * share).sum()
    }

    fn second(&self, about: &Vector<D>) -> Matrix<D> {
        let arm = |p: usize| self.x[p] - about;
        self.members.iter().map(|&p| dyad(&arm(p), &arm(p))).sum()
    }

    /// Returns `mean + g . (x - about)` with the slope g of best fit. The slope is zero unless the
    /// particles span all axes, because a line fitted to a single row of particles could be steep
    /// and give negative nodal masses.
    fn sloped<T>(
        &self,
        point: &QuadraturePoint<D>,
        about: &Vector<D>,
        mean: T,
        value: impl Fn(usize) -> T,
    ) -> T
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let inverse = spanned(&self.second(&self.middle()), point.smallest)
            .and_then(|_| spanned(&self.second(about), point.smallest));
        let Some(inverse) = inverse else { return mean };
        let reach = inverse * (point.x - about);
        self.members
            .iter()
            .fold(mean, |sum, &p| sum + (value(p) - mean) * (self.x[p] - about).dot(&reach))
    }
}

/// Inverts the second moments; `None` unless the particles span every axis.
fn spanned<const D: usize>(second: &Matrix<D>, smallest: f64) -> Option<Matrix<D>> {
    let spans = |axis: usize| second[(axis, axis)] > smallest;
    (0..D).all(spans).then(|| inverse(second)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::kernel::kernel;
    use crate::mpm::{BasisName, Block};
    use approx::assert_abs_diff_eq;
    use rstest::rstest;

    /// Creates eight cells with three particles each under a uniform stress. The last particle of
    /// the fourth cell has moved to the fifth cell.
    fn uneven() -> (Grid<1>, Particles<1>) {
        let grid = Grid::new(Vector::zeros(), 1.0, [8], [true], [8]);
        let block = Block { from: Vector::<1>::new(0.0), to: Vector::<1>::new(8.0), density: 2.0 };
        let mut particles = Particles::fill(&block, 1.0, 3);
        particles.x[11][0] = 4.02;
        particles.sigma.fill(Matrix::<1>::new(5.0));
        (grid, particles)
    }

    /// The fit reproduces a linear field, and conserves the sum of a density.
    #[rstest]
    fn linear_fields_are_exact(#[values(0.1, 0.5, 0.93)] at: f64) {
        let (grid, particles) = uneven();
        let mut quadrature = QuadraturePoints::default();
        quadrature.start(&grid, &particles);
        quadrature.place(&grid, &particles);
        for point in &quadrature.all {
            let point = quadrature_points::QuadraturePoint {
                x: point.centre.add_scalar(at - 0.5),
                ..point.clone()
            };
            let fit = Fit { x: &quadrature.x, members: quadrature.members(&point) };
            let linear = |x: f64| 3.0 - 0.7 * x;
            let free = fit.free(&point, |p| linear(particles.x[p][0]));
            assert_abs_diff_eq!(free, linear(point.x[0]), epsilon = 1e-12);
            let sum = linear(point.centre[0]);
            let kept = fit.conserved(&point, sum, &grid, |p| linear(particles.x[p][0]));
            assert_abs_diff_eq!(kept, linear(point.x[0]), epsilon = 1e-12);
        }
    }

    #[test]
    fn uniform_stress_exerts_no_force_for_any_particle_counts() {
        let (mut grid, particles) = uneven();
        let kernel = kernel::<1>(BasisName::Linear);
        kernel.p2g_internal_force(&particles, &mut grid);
        assert!(grid.force[4].norm() > 1.0, "the sum over particles does: {}", grid.force[4]);
        let mut tls = Tls::default();
        tls.start(&*kernel, &grid, &particles);
        tls.p2g(&*kernel, &particles, &mut grid, &[Stage::Force]);
        for force in &grid.force {
            assert_abs_diff_eq!(force.norm(), 0.0, epsilon = 1e-13);
        }
    }

    /// Returns masses and velocities of nodes for a uniform velocity of 3 m/s. One particle is
    /// alone in its cell, near the centre; the body is displaced by `beyond` at the start.
    fn lone(beyond: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut grid, mut particles) = uneven();
        particles.x[4][0] = 1.51;
        (particles.x[3][0], particles.x[5][0]) = (0.9, 2.1);
        particles.x.iter_mut().for_each(|x| x[0] += beyond);
        particles.v.fill(Vector::<1>::new(3.0));
        let kernel = kernel::<1>(BasisName::Linear);
        let mut tls = Tls::default();
        tls.start(&*kernel, &grid, &particles);
        tls.p2g(&*kernel, &particles, &mut grid, &[Stage::Mass, Stage::Momentum]);
        let momenta = grid.velocity.iter().zip(&grid.mass);
        let velocity = momenta.map(|(momentum, mass)| momentum[0] / mass);
        (grid.mass.clone(), velocity.collect())
    }

    #[test]
    fn single_particle_causes_no_negative_mass() {
        let (mass, velocity) = lone(0.0);
        assert!(mass.iter().all(|mass| *mass > 0.0), "{mass:?}");
        assert_abs_diff_eq!(mass.iter().sum::<f64>(), 16.0, epsilon = 1e-13);
        for v in velocity {
            assert_abs_diff_eq!(v, 3.0, epsilon = 1e-13);
        }
    }

    #[rstest]
    fn result_does_not_depend_on_the_period(#[values(8.0, -16.0)] beyond: f64) {
        for (here, there) in lone(0.0).0.iter().zip(lone(beyond).0) {
            assert_abs_diff_eq!(*here, there, epsilon = 1e-12);
        }
    }
}
