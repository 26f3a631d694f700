//! Symbols (eigenvalues for one Fourier mode) of the maps between particles and grid: stiffness,
//! mass, APIC, MLS-MPM and TPIC.
//!
//! A periodic row of cells with the same particles in each cell is invariant under translation by a
//! cell. A nodal field `exp(i theta x_i)` is therefore an eigenvector of every map from the grid to
//! the particles and back. The *symbol* of the map is the eigenvalue (von Neumann's analysis;
//! Strang 2007, Computational Science and Engineering, section 4.1). Lengths are in units of the
//! cell size h, so symbols are dimensionless.
//!
//! The B-splines are implemented here (de Boor 2001, A Practical Guide to Splines, chapter 9),
//! independently of the basis functions of the solver. Tests compare both.

use crate::mpm::basis::BasisName;

/// Largest APIC inertia (squared cell sizes) that counts as zero: the particle has no affine part.
const SMALLEST_INERTIA: f64 = 1e-12;

/// Basis functions of one axis: uniform B-splines, or averages of linear functions over the domain
/// of a particle. The knots are at the cell corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spline {
    /// Piecewise linear functions, centred at cell corners.
    Linear,
    /// Quadratic B-splines, centred at cell centres.
    Quadratic,
    /// Cubic B-splines, centred at cell corners.
    Cubic,
    /// GIMP with this number of particles per cell: linear functions averaged over the domain of a
    /// particle (Bardenhagen & Kober 2004, CMES 5).
    Gimp(u32),
    /// CPDI with this number of particles per cell: mean of the linear functions at both ends of
    /// the domain of a particle (Sadeghirad, Brannon & Burghardt 2011, IJNME 86).
    Cpdi(u32),
}

impl Spline {
    /// Returns the positions, in cells, of the functions that are non-zero in the cell from 0 to 1.
    fn places(self) -> &'static [f64] {
        match self {
            Self::Linear => &[0.0, 1.0],
            Self::Quadratic => &[-0.5, 0.5, 1.5],
            Self::Cubic | Self::Gimp(_) | Self::Cpdi(_) => &[-1.0, 0.0, 1.0, 2.0],
        }
    }

    /// Returns the functions of the solver basis with this name, for `ppc` particles per cell.
    /// Small motions do not change the domains of particles, so contiguous and uniform GIMP are
    /// identical.
    pub fn of(basis: BasisName, ppc: u32) -> Self {
        match basis {
            BasisName::Linear => Self::Linear,
            BasisName::UniformGimp | BasisName::ContiguousGimp => Self::Gimp(ppc),
            BasisName::Cpdi => Self::Cpdi(ppc),
            BasisName::QuadraticBSpline => Self::Quadratic,
            BasisName::CubicBSpline => Self::Cubic,
        }
    }

    /// Returns value and derivative (per cell) at the distance `x` (in cells) from the centre of
    /// the function. At a knot, returns the derivative from the right.
    fn at(self, x: f64) -> (f64, f64) {
        let (r, sign) = (x.abs(), if x < 0.0 { -1.0 } else { 1.0 });
        let (value, slope) = match self {
            Self::Gimp(ppc) | Self::Cpdi(ppc) => {
                let half = 0.5 / f64::from(ppc);
                let (low, high) = (x - half, x + half);
                let mean = match self {
                    Self::Gimp(_) => (hat_integral(high) - hat_integral(low)) / (2.0 * half),
                    _ => 0.5 * (hat(high) + hat(low)),
                };
                return (mean, (hat(high) - hat(low)) / (2.0 * half));
            }
            Self::Linear => (1.0 - r, -1.0),
            Self::Quadratic if r < 0.5 => (0.75 - r * r, -2.0 * r),
            Self::Quadratic => (0.5 * (1.5 - r) * (1.5 - r), r - 1.5),
            Self::Cubic if r < 1.0 => (2.0 / 3.0 - r * r + 0.5 * r * r * r, 1.5 * r * r - 2.0 * r),
            Self::Cubic => {
                let rest = 2.0 - r;
                (rest * rest * rest / 6.0, -0.5 * rest * rest)
            }
        };
        (value, sign * slope)
    }
}

fn hat(x: f64) -> f64 {
    (1.0 - x.abs()).max(0.0)
}

/// Integrates [`hat`] from minus infinity to `x`.
fn hat_integral(x: f64) -> f64 {
    let rest = hat(x);
    let tail = 0.5 * rest * rest;
    if x < 0.0 { tail } else { 1.0 - tail }
}

/// Symbols of one wave number, for lengths in units of the cell size. In the formulas, `xi` is a
/// particle position, and `mean` the mean over the particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveSymbols {
    /// Wave number times cell size, theta = k h (rad). A wave of n cells has theta = 2 pi/n.
    pub theta: f64,
    /// Stiffness, `kappa = mean |sum N_i' exp(i theta x_i)|^2`: the nodal acceleration of a wave
    /// is `-kappa c^2/h^2` times its displacement.
    pub stiffness: f64,
    /// Mass, `s = mean |sum N_i exp(i theta x_i)|^2`: the part of a nodal velocity that remains
    /// after the map to the particles and back with a lumped mass matrix.
    pub mass: f64,
    /// APIC, `a = s + mean |sum N_i (x_i - xi) exp(i theta x_i)|^2/D` with
    /// `D = sum N_i (x_i - xi)^2`: the part of a nodal velocity that remains if particles have an
    /// affine field.
    pub affine: f64,
    /// Stiffness with gradients from the fit of the affine field, as in MLS-MPM:
    /// `mean |sum N_i (x_i - xi) exp(i theta x_i)|^2/D^2`.
    pub fitted_stiffness: f64,
    /// TPIC, `t = s + mean conj(sum N_i (x_i - xi) exp(i theta x_i)) sum N_i' exp(i theta x_i)`:
    /// the real and imaginary parts of the fraction of a nodal velocity that remains if the affine
    /// field is the gradient of the basis. The imaginary part is zero for particles that are
    /// symmetric in their cell.
    pub taylor: [f64; 2],
}

impl WaveSymbols {
    /// Computes the symbols of a wave with `theta` (rad) for particles of equal mass and volume at
    /// `positions`, from 0 to 1 in each cell. A particle with D = 0 has no affine part. The symbols
    /// are NaN if `positions` is empty.
    pub fn new(spline: Spline, theta: f64, positions: &[f64]) -> Self {
        let [mut stiffness, mut mass, mut affine, mut fitted_stiffness] = [0.0; 4];
        let mut taylor = [0.0; 2];
        for xi in positions {
            let mut inertia = 0.0;
            let [mut slopes, mut values, mut moments] = [[0.0; 2]; 3];
            for place in spline.places() {
                let offset = place - xi;
                let (value, slope) = spline.at(-offset);
                let wave = [libm::cos(theta * place), libm::sin(theta * place)];
                for part in 0..2 {
                    slopes[part] += slope * wave[part];
                    values[part] += value * wave[part];
                    moments[part] += value * offset * wave[part];
                }
                inertia += value * offset * offset;
            }
            stiffness += square(slopes);
            mass += square(values);
            if inertia > SMALLEST_INERTIA {
                affine += square(moments) / inertia;
                fitted_stiffness += square(moments) / (inertia * inertia);
            }
            taylor[0] += moments[0] * slopes[0] + moments[1] * slopes[1];
            taylor[1] += moments[0] * slopes[1] - moments[1] * slopes[0];
        }
        let count = positions.len() as f64;
        let mass = mass / count;
        Self {
            theta,
            stiffness: stiffness / count,
            mass,
            affine: mass + affine / count,
            fitted_stiffness: fitted_stiffness / count,
            taylor: [mass + taylor[0] / count, taylor[1] / count],
        }
    }

    /// Returns the positions `(j + 1/2)/ppc` of `ppc` regular particles in a cell (cells),
    /// translated by `shift` cells and wrapped to 0 to 1.
    pub fn shifted_positions(ppc: u32, shift: f64) -> Vec<f64> {
        let all = (0..ppc).map(|j| (f64::from(j) + 0.5) / f64::from(ppc) + shift);
        all.map(|xi| xi - libm::floor(xi)).collect()
    }
}

fn square([re, im]: [f64; 2]) -> f64 {
    re * re + im * im
}
