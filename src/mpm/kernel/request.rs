//! The parts of one pass over particles and nodes.
//!
//! A pass computes the weights of a particle anew, so that all parts for the same particles and
//! nodes share one pass; each part has the bits that it would have alone.

use crate::mpm::foundation::algebra::{Matrix, Vector};

/// Slope of the velocity field around each particle. `mean_p` is the weighted mean of the nodes:
/// the position of the particle, except for domains cut off by a wall. Relative to it,
/// the affine part has no momentum.
#[derive(Debug, Clone, Copy)]
pub enum Affine<'a, const D: usize> {
    /// `C_p` (1/s).
    Slope(&'a [Matrix<D>]),
    /// `C_p = B_p D_p^-1` by the first moment B_p (m^2/s); D_p is that of the weights at the
    /// particle's position.
    Moment(&'a [Matrix<D>]),
}

impl<'a, const D: usize> Affine<'a, D> {
    /// C_p or B_p of each particle.
    pub fn state(self) -> &'a [Matrix<D>] {
        let (Self::Slope(state) | Self::Moment(state)) = self;
        state
    }

    /// Natural size of the state for velocities of the size `speed` (m/s) and cells of the size
    /// `h` (m).
    pub fn size(self, speed: f64, h: f64) -> f64 {
        match self {
            Self::Slope(_) => speed / h,
            Self::Moment(_) => speed * h,
        }
    }
}

/// Velocity field around each particle, `v_p + C_p (x - mean_p)`.
#[derive(Debug, Clone, Copy)]
pub struct ParticleField<'a, const D: usize> {
    /// v_p (m/s).
    pub v: &'a [Vector<D>],
    /// C_p; none for a constant field.
    pub affine: Option<Affine<'a, D>>,
}

/// Discrete divergence of the stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Divergence {
    /// `f_int_i = - sum_p V_p sigma_p grad N_i(x_p)` (N).
    Gradient,
    /// `f_int_i = - sum_p V_p sigma_p D_p^-1 (x_i - mean_p) N_i(x_p)` (N): the gradient of a
    /// least-squares fit in place of that of the basis (Hu et al. 2018, eq. 18).
    Fit,
}

/// Parts of one pass of P2G.
#[derive(Debug, Clone, Copy, Default)]
pub struct P2gRequest<'a, const D: usize> {
    /// `m_i = sum_p m_p N_i(x_p)` (kg) into `grid.mass`.
    pub mass: bool,
    /// Momentum `sum_p m_p (v_p + C_p (x_i - mean_p)) N_i(x_p)` (kg m/s) into `grid.velocity`.
    pub momentum: Option<ParticleField<'a, D>>,
    /// Internal force (N) into `grid.force`.
    pub force: Option<Divergence>,
}

impl<const D: usize> P2gRequest<'_, D> {
    /// Names of the parts, as reports list them. The moments of the weights count as a part, once
    /// for each position of the particles.
    pub fn parts(&self) -> impl Iterator<Item = &'static str> + use<D> {
        let affine = self.momentum.and_then(|field| field.affine);
        let has_moments = self.mass && matches!(affine, Some(Affine::Moment(_)));
        named_parts([
            ("p2g mass", self.mass),
            ("p2g momentum", self.momentum.is_some()),
            ("p2g internal force", self.force == Some(Divergence::Gradient)),
            ("p2g force by fit", self.force == Some(Divergence::Fit)),
            ("weight moments", has_moments),
        ])
    }
}

fn named_parts(parts: [(&'static str, bool); 5]) -> impl Iterator<Item = &'static str> {
    parts.into_iter().filter_map(|(name, is_requested)| is_requested.then_some(name))
}

/// Parts of one pass of G2P, from nodal velocities except where stated.
#[derive(Debug, Default)]
pub struct G2pRequest<'a, const D: usize> {
    /// `value_p += dt sum_i a_i N_i(x_p)` with `dt` (s), from nodal accelerations.
    pub change: Option<f64>,
    /// Then `value_p <- keep value_p + factor sum_i v_i N_i(x_p)` with `keep` and `factor`.
    pub mix: Option<(f64, f64)>,
    /// Target of `change` and `mix` (m/s).
    pub value: Option<&'a mut [Vector<D>]>,
    /// `moment_p = sum_i v_i (x) (x_i - mean_p) N_i(x_p)` (m^2/s).
    pub moment: Option<&'a mut [Matrix<D>]>,
    /// `moment_p D_p^-1` (1/s): the gradient of a least-squares fit (Hu et al. 2018, eq. 17), by
    /// the visit to the nodes that gives the moment.
    pub fit: Option<&'a mut [Matrix<D>]>,
    /// `gradient_p = sum_i v_i (x) grad N_i(x_p)` (1/s).
    pub gradient: Option<&'a mut [Matrix<D>]>,
    /// Position after `dt` (s), `advected_p = x_p + dt sum_i v_i N_i(x_p)` (m).
    pub advected: Option<(f64, &'a mut [Vector<D>])>,
}

impl<const D: usize> G2pRequest<'_, D> {
    /// Names of the parts, as reports list them.
    pub fn parts(&self) -> impl Iterator<Item = &'static str> + use<D> {
        named_parts([
            ("g2p velocity", self.change.is_some()),
            ("g2p velocity", self.mix.is_some()),
            ("g2p moment", self.moment.is_some() || self.fit.is_some()),
            ("g2p gradient", self.gradient.is_some()),
            ("g2p position", self.advected.is_some()),
        ])
    }
}
