//! A linear Taylor polynomial through the data of the particles in one cell.

use super::quadrature_points::QuadraturePoint;
use crate::mpm::foundation::algebra::{Matrix, Vector, dyad};
use crate::mpm::foundation::grid::Grid;
use std::ops::{Add, Mul, Sub};

/// The particles that a cell holds.
pub(super) struct Fit<'a, const D: usize> {
    /// Positions of all particles (m), inside the grid on periodic axes.
    pub(super) x: &'a [Vector<D>],
    /// Those in the cell, at least one.
    pub(super) members: &'a [usize],
}

impl<const D: usize> Fit<'_, D> {
    /// Value at `point` of the polynomial whose integral over the cell is `sum`, and whose slope
    /// fits the densities that particles have: `f(x) = mean + g . (x - centre)`, g by least squares
    /// (Wobbes et al. 2019, with the Taylor basis of degree one).
    pub(super) fn conserved<T>(
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

    /// Value at `point` of the linear least-squares fit.
    pub(super) fn free<T>(&self, point: &QuadraturePoint<D>, value: impl Fn(usize) -> T) -> T
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

    /// Second moments of the particles (m^2).
    fn second(&self, about: &Vector<D>) -> Matrix<D> {
        let arm = |p: usize| self.x[p] - about;
        self.members.iter().map(|&p| dyad(&arm(p), &arm(p))).sum()
    }

    /// `mean + g . (x - about)` with the slope g that fits best; no slope where the particles do
    /// not span all axes among themselves. Through the mean of a cell and a row of particles there
    /// would be one too, as steep as the row is near to the centre, and masses of nodes below zero.
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

/// The inverse of second moments, if every axis has one.
fn spanned<const D: usize>(second: &Matrix<D>, smallest: f64) -> Option<Matrix<D>> {
    let spans = |axis: usize| second[(axis, axis)] > smallest;
    (0..D).all(spans).then(|| second.try_inverse()).flatten()
}
