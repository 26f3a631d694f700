//! Passes of a scalar, such as a temperature, between particles and nodes.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;

/// Passes of P2G and G2P for scalars, of one basis.
pub trait Scalars<const D: usize> {
    /// `column_i = sum_p m_p (s_p + slope_p . (x_i - x_p)) N_i(x_p)`: a scalar s with its slope.
    fn p2g_scalar(
        &self,
        particles: &Particles<D>,
        shown: (&[f64], &[Vector<D>]),
        grid: &Grid<D>,
        column: &mut [f64],
    );

    /// `column_i = factor sum_p V_p slope_p . grad N_i(x_p)`: flow to the nodes along a slope.
    fn p2g_flow(
        &self,
        particles: &Particles<D>,
        slope_and_factor: (&[Vector<D>], f64),
        grid: &Grid<D>,
        column: &mut [f64],
    );

    /// Adds `amount N_i(x_p)` of particle `p` to its nodes.
    fn p2g_amount(
        &self,
        particles: &Particles<D>,
        p: usize,
        amount: f64,
        grid: &Grid<D>,
        column: &mut [f64],
    );

    /// `s_p += factor sum_i field_i N_i(x_p)`.
    fn g2p_scalar(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        factor: f64,
        value: &mut [f64],
    );

    /// `slope_p = sum_i field_i grad N_i(x_p)`.
    fn g2p_slope(
        &self,
        grid: &Grid<D>,
        field: &[f64],
        particles: &Particles<D>,
        slope: &mut [Vector<D>],
    );
}
