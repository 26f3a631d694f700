//! A temperature T(X, t) given by a formula, its derivatives, and the heat flux in a deformed body.
//!
//! The heat flux refers to the reference configuration. Fourier's law holds in the current
//! configuration, `q = -k grad T` per current area. Per reference area it is
//! `Q = -k J C^-1 Grad T`, `C = F^T F` (Holzapfel 2000, *Nonlinear Solid Mechanics*, section 7.1),
//! and the balance is `rho0 c T_t = -Div Q + rho0 s`. Without a motion, F = I.

use crate::exact::formula::{Formula, Number, Slope};
use crate::exact::motion::{Derivatives, Motion, Places};
use crate::exact::tensor::{Tensor, deformation, sum, tensor, vector};
use mpm_subject::with_dimension;

/// A temperature field (K), given by a formula whose variables are the reference coordinates and t.
#[derive(Debug, Clone)]
pub struct Temperature(Motion);

/// Temperature and its derivatives at one point and time; zero on axes that the body does not have.
#[derive(Debug, Clone, Copy, Default)]
pub struct TemperatureDerivatives {
    /// T (K).
    pub value: f64,
    /// T_t (K/s).
    pub rate: f64,
    /// `grad[a] = dT/dX_a` (K/m).
    pub grad: [f64; 3],
    /// `second[a][b] = d2 T/dX_a dX_b` (K/m2).
    pub second: [[f64; 3]; 3],
}

impl Temperature {
    /// Creates a field in `dimension` dimensions.
    pub fn new(formula: Formula, dimension: usize) -> Self {
        Self(Motion { components: vec![formula], dimension })
    }

    /// Returns the text of the formula.
    pub fn source(&self) -> String {
        self.0.source()
    }

    /// Whether the field has no kink anywhere ([`Formula::is_smooth`]).
    pub fn is_smooth(&self) -> bool {
        self.0.is_smooth()
    }

    /// Evaluates T (K).
    pub fn at(&self, label: &[f64], t: f64) -> f64 {
        self.0.component(0, label, t)
    }

    /// Computes the temperature and its derivatives, by automatic differentiation.
    pub fn derivatives(&self, label: &[f64], t: f64) -> TemperatureDerivatives {
        self.0.derivatives(label, t).into()
    }

    /// Prepares the evaluation of the field, like [`Motion::at_places`].
    pub(super) fn at_places(&self, labels: &[&[f64]]) -> Box<dyn Places> {
        self.0.at_places(labels)
    }
}

impl From<Derivatives> for TemperatureDerivatives {
    /// Takes the derivatives of the first component.
    fn from(Derivatives { u, velocity, grad, second, .. }: Derivatives) -> Self {
        Self { value: u[0], rate: velocity[0], grad: grad[0], second: second[0] }
    }
}

/// Computes `J C^-1 Grad T`, from the gradients of displacement and temperature.
fn pulled_back<T: Number, const D: usize>(grad_u: &Tensor<T, D>, grad: &[T; D]) -> [T; D] {
    // F^-T = cof(F)/J.
    let (_, cofactor, j) = deformation(grad_u);
    let metric = |a: usize, b: usize| sum::<T, D>(|i| cofactor[i][a] * cofactor[i][b]) / j;
    vector(|a| sum::<T, D>(|b| metric(a, b) * grad[b]))
}

/// Computes `J C^-1 Grad T` (K/m). The inflow per reference area is k times its normal component.
pub(super) fn slope(motion: &Derivatives, now: &TemperatureDerivatives) -> [f64; 3] {
    pulled_back::<f64, 3>(&motion.grad, &now.grad)
}

/// Computes `Div (J C^-1 Grad T)` (K/m2), for fields that vary along the first `dimension` axes.
pub(super) fn divergence(
    dimension: usize,
    motion: &Derivatives,
    now: &TemperatureDerivatives,
) -> f64 {
    with_dimension!(dimension, D => {
        let bent = |i: usize, j: usize| vector(|axis| motion.second[i][j][axis]);
        let grad_u: Tensor<Slope<D>, D> = tensor(|i, j| Slope::new(motion.grad[i][j], bent(i, j)));
        let curved = |a: usize| vector(|axis| now.second[a][axis]);
        let grad: [Slope<D>; D] = std::array::from_fn(|a| Slope::new(now.grad[a], curved(a)));
        let flow = pulled_back(&grad_u, &grad);
        sum::<f64, D>(|a| flow[a].d(a))
    })
}
