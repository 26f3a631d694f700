//! Dispersion and damping of one MPM step in closed form.
//!
//! The analysis assumes a periodic row of cells, a linear elastic law and particles at fixed
//! positions. On the grid, two numbers describe each Fourier mode: the nodal velocity `w` before
//! the update and the acceleration `f`. The symbols s (mass) and kappa (stiffness) are the
//! eigenvalues of maps between particles and grid for this mode ([`WaveSymbols`]). With these
//! symbols, a FLIP step with a lumped mass matrix is
//!
//! ```text
//! w_new = w + s dt f
//! f_new = f - kappa (c/h)^2 dt g,   g = w + dt f (USL) or g = w_new (MUSL, USF)
//! ```
//!
//! The eigenvalues of this 2 x 2 matrix satisfy `l^2 - tr l + det = 0`. For every transfer,
//! `tr = 1 + b - p C^2` and `det = b - q C^2` with the Courant number `C = c dt/h` and coefficients
//! b, p and q ([`WaveStep`]). While the eigenvalues are complex, each step multiplies the amplitude
//! by `sqrt(det)`.
//!
//! Sources: von Neumann's analysis of the schemes of Bardenhagen (2002, J. Comput. Phys. 180), of
//! APIC (Jiang, Schroeder & Teran 2017, J. Comput. Phys. 338), XPIC (Hammerquist & Nairn 2017,
//! CMAME 318) and FMPM (Nairn & Hammerquist 2021, CMAME 374).

use super::wave_symbols::{Spline, WaveSymbols};
use crate::mpm::mass::MassName;
use crate::mpm::scheme::SchemeName;
use crate::mpm::transfer::{TransferChoice, TransferName, WithParameter};
use std::f64::consts::{PI, TAU};

/// Number of wave numbers in the search for the minimum of the stability limit.
const WAVES: u32 = 720;

/// Number of iterations of a golden-section search or a bisection.
const ROUNDS: u32 = 60;

/// Maximum wavelength in the search of [`WaveMethod::cells_for_phase_error`] (cells).
const LONGEST: f64 = 1e4;

/// Ratio of consecutive wavelengths in the search of [`WaveMethod::cells_for_phase_error`].
const RATIO: f64 = 1.002;

/// Amount by which the amplitude factor of a step may exceed one because of rounding.
const ROUNDING: f64 = 1e-12;

/// Transfers with a closed form of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WaveTransfer {
    /// FLIP with a lumped mass matrix.
    Flip,
    /// FLIP with a consistent mass matrix.
    FlipConsistent,
    /// PIC.
    Pic,
    /// APIC.
    Apic,
    /// MLS-MPM: APIC with velocity gradients from the fitted affine field.
    Mls,
    /// TPIC: PIC with the gradient of the basis as affine field. The particles must be placed
    /// symmetrically in each cell; otherwise the coefficients of the step are complex.
    Tpic,
    /// A blend of FLIP and PIC with this fraction of FLIP, from 0 to 1.
    Blend(f64),
    /// XPIC with this number of terms.
    Xpic(u32),
    /// FMPM with this number of terms.
    Fmpm(u32),
}

impl WaveTransfer {
    /// Returns the transfer with this name and mass matrix; `None` if the step has no closed form.
    pub fn of(transfer: TransferChoice, mass: MassName) -> Option<Self> {
        use TransferChoice::{Named, With};
        Some(match (transfer, mass) {
            (Named(TransferName::Flip), MassName::Consistent) => Self::FlipConsistent,
            (_, MassName::Consistent) => return None,
            (With(WithParameter::Xpic, terms), _) => Self::Xpic(terms),
            (With(WithParameter::Fmpm, terms), _) => Self::Fmpm(terms),
            (Named(name), _) => match name {
                TransferName::Flip => Self::Flip,
                TransferName::Flip99 => Self::Blend(0.99),
                TransferName::Flip95 => Self::Blend(0.95),
                TransferName::Pic => Self::Pic,
                TransferName::Apic => Self::Apic,
                TransferName::Mls => Self::Mls,
                TransferName::Tpic => Self::Tpic,
                TransferName::Xpic2 => Self::Xpic(2),
                TransferName::Xpic5 => Self::Xpic(5),
                TransferName::Fmpm2 => Self::Fmpm(2),
                TransferName::Fmpm4 => Self::Fmpm(4),
                // TLS has no closed form, because it maps between particles and grid through
                // quadrature points.
                TransferName::Tls => return None,
            },
        })
    }
}

/// The 2 x 2 matrix of a step for one wave, described by its trace and determinant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveStep {
    theta: f64,
    /// Determinant b of a step without stress: the fraction of the grid velocity that a step
    /// retains.
    kept: f64,
    /// Coefficient p of `-C^2` in the trace.
    stiffness: f64,
    /// Coefficient q of `-C^2` in the determinant.
    loss: f64,
}

impl WaveStep {
    /// Creates the step of a wave with these symbols.
    pub fn new(transfer: WaveTransfer, scheme: SchemeName, symbols: &WaveSymbols) -> Self {
        let WaveSymbols { theta, stiffness: kappa, mass: s, affine: a, .. } = *symbols;
        let uses_grid_velocity = scheme == SchemeName::Usl;
        // Transfers that add the interpolated velocity increment to the particle velocities.
        let adding = |kept: f64| {
            if uses_grid_velocity {
                Self { theta, kept, stiffness: kappa, loss: kappa * (kept - s) }
            } else {
                Self { theta, kept, stiffness: kappa * s, loss: 0.0 }
            }
        };
        // Transfers that replace the particle velocities by interpolated grid velocities.
        let replacing = |kept: f64, stiffness: f64| {
            let passed = if uses_grid_velocity { 1.0 } else { kept };
            Self { theta, kept, stiffness: stiffness * passed, loss: 0.0 }
        };
        match transfer {
            WaveTransfer::Flip => adding(1.0),
            WaveTransfer::FlipConsistent => {
                Self { theta, kept: 1.0, stiffness: kappa / s, loss: 0.0 }
            }
            WaveTransfer::Pic => replacing(s, kappa),
            WaveTransfer::Apic => replacing(a, kappa),
            WaveTransfer::Mls => replacing(a, symbols.fitted_stiffness),
            WaveTransfer::Tpic => replacing(symbols.taylor[0], kappa),
            WaveTransfer::Blend(flip) => adding(flip + (1.0 - flip) * s),
            WaveTransfer::Xpic(terms) => adding(s * neumann(s, terms)),
            WaveTransfer::Fmpm(terms) => {
                let series = neumann(s, terms);
                replacing(s * series, kappa * series)
            }
        }
    }

    /// Returns the trace of the step at this Courant number.
    pub fn trace(&self, courant: f64) -> f64 {
        1.0 + self.kept - self.stiffness * courant * courant
    }

    /// Returns the determinant of the step at this Courant number.
    pub fn determinant(&self, courant: f64) -> f64 {
        self.kept - self.loss * courant * courant
    }

    fn discriminant(&self, courant: f64) -> f64 {
        let x = courant * courant;
        let lost = 1.0 - self.kept;
        let slope = 2.0 * (1.0 + self.kept) * self.stiffness - 4.0 * self.loss;
        -lost * lost + (slope - self.stiffness * self.stiffness * x) * x
    }

    /// Returns the relative error of the phase speed, `c_h/c - 1` with `c_h/c = arg(l)/(theta C)`,
    /// for an eigenvalue l and the Courant number C. `None` if the eigenvalues are real.
    pub fn phase_error(&self, courant: f64) -> Option<f64> {
        let discriminant = self.discriminant(courant);
        let angle = libm::atan2(discriminant.max(0.0).sqrt(), self.trace(courant));
        (discriminant > 0.0).then(|| angle / (self.theta * courant) - 1.0)
    }

    /// Returns the largest modulus of the eigenvalues, which is the amplitude factor of one step.
    pub fn largest_modulus(&self, courant: f64) -> f64 {
        let discriminant = self.discriminant(courant);
        if discriminant > 0.0 {
            return self.determinant(courant).sqrt();
        }
        0.5 * (self.trace(courant).abs() + (-discriminant).sqrt())
    }

    /// Returns the amplitude factor over one period of the exact wave, `2 pi h/(theta c)`.
    pub fn kept_per_period(&self, courant: f64) -> f64 {
        libm::pow(self.largest_modulus(courant), TAU / (self.theta * courant))
    }

    /// Returns the largest Courant number at which the wave does not grow. The conditions are
    /// `det <= 1` and `1 + tr + det >= 0` (Jury's criterion; `1 - tr + det = (p - q) C^2` is never
    /// negative). NaN if the symbols are NaN.
    pub fn limit(&self) -> f64 {
        if self.kept > 1.0 + ROUNDING {
            return 0.0;
        }
        (2.0 * (1.0 + self.kept) / (self.stiffness + self.loss)).sqrt()
    }
}

/// Sums `(1 - s)^j` for j below `terms`. The limit of the series is 1/s.
fn neumann(s: f64, terms: u32) -> f64 {
    (0..terms).fold(0.0, |sum, _| 1.0 + (1.0 - s) * sum)
}

/// A method with regularly spaced particles. [`WaveStep`] describes each wave of the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveMethod {
    /// Basis functions.
    pub spline: Spline,
    /// Particles per cell, at [`WaveSymbols::shifted_positions`].
    pub ppc: u32,
    /// Translation of all particles (cells).
    pub shift: f64,
    /// Transfer and mass matrix.
    pub transfer: WaveTransfer,
    /// Time scheme. USF has the eigenvalues of MUSL, because only the first stage of the step
    /// differs.
    pub scheme: SchemeName,
}

impl WaveMethod {
    /// Returns the step of a wave with `theta = k h` (rad).
    pub fn step(&self, theta: f64) -> WaveStep {
        WaveStep::new(self.transfer, self.scheme, &self.symbols(theta))
    }

    /// Returns the symbols of a wave with `theta = k h` (rad).
    pub fn symbols(&self, theta: f64) -> WaveSymbols {
        let positions = WaveSymbols::shifted_positions(self.ppc, self.shift);
        WaveSymbols::new(self.spline, theta, &positions)
    }

    /// Returns the number of cells per wavelength above which the phase error stays below
    /// `tolerance`. Waves without a phase ([`WaveStep::phase_error`]) count as exceeding the
    /// tolerance. `None` if the error exceeds the tolerance at 1e4 cells, or is within the
    /// tolerance for all waves of two cells or more.
    pub fn cells_for_phase_error(&self, courant: f64, tolerance: f64) -> Option<f64> {
        let is_within = |cells: f64| {
            let error = self.step(TAU / cells).phase_error(courant);
            error.is_some_and(|error| error.abs() < tolerance)
        };
        if !is_within(LONGEST) {
            return None;
        }
        let mut within = LONGEST;
        let mut beyond = loop {
            let cells = within / RATIO;
            if cells < 2.0 {
                return None;
            }
            if !is_within(cells) {
                break cells;
            }
            within = cells;
        };
        for _ in 0..ROUNDS {
            let middle = 0.5 * (beyond + within);
            let end = if is_within(middle) { &mut within } else { &mut beyond };
            *end = middle;
        }
        Some(0.5 * (beyond + within))
    }

    /// Returns the largest Courant number at which no wave grows: the minimum of the limits over
    /// `0 < theta <= pi`. NaN if there are no particles.
    pub fn stability_limit(&self) -> f64 {
        let limit = |theta: f64| self.step(theta).limit();
        let spacing = PI / f64::from(WAVES);
        let mut least = (f64::INFINITY, PI);
        for k in 1..=WAVES {
            let theta = if k == WAVES { PI } else { f64::from(k) * spacing };
            let value = limit(theta);
            // The negated comparison is true for NaN, so NaN replaces the minimum.
            if !(value >= least.0) {
                least = (value, theta);
            }
        }
        // Golden-section search between the neighbours of the minimum.
        let share = 0.5 * (5.0_f64.sqrt() - 1.0);
        let (mut low, mut high) =
            ((least.1 - spacing).max(0.5 * spacing), (least.1 + spacing).min(PI));
        for _ in 0..ROUNDS {
            let (left, right) = (high - share * (high - low), low + share * (high - low));
            if limit(left) < limit(right) {
                high = right;
            } else {
                low = left;
            }
        }
        let refined = limit(0.5 * (low + high));
        if refined < least.0 { refined } else { least.0 }
    }
}
