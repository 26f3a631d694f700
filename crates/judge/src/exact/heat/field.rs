//! A temperature T(X, t) given by a formula, its derivatives, and the heat flux in a deformed body.
//!
//! The heat flux refers to the reference configuration. Fourier's law holds in the current
//! configuration, `q = -k grad T` per current area. Per reference area it is
//! `Q = -k J C^-1 Grad T`, `C = F^T F` (Holzapfel 2000, *Nonlinear Solid Mechanics*, section 7.1),
//! and the balance is `rho0 c T_t = -Div Q + rho0 s`. Without a motion, F = I.

use crate::exact::formula::{Formula, Hoisted, Jet, Number, Slope};
use crate::exact::motion::{Derivatives, seeds};
use crate::exact::tensor::{Tensor, cofactor, det, sum, tensor, unit, vector};
use mpm_subject::with_dimension;

/// A temperature field (K), given by a formula whose variables are the reference coordinates and t.
#[derive(Debug, Clone)]
pub struct Temperature {
    formula: Formula,
    dimension: usize,
}

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
        Self { formula, dimension }
    }

    /// Returns the text of the formula.
    pub fn source(&self) -> &str {
        self.formula.source()
    }

    /// Whether the field has no kink anywhere ([`Formula::is_smooth`]).
    pub fn is_smooth(&self) -> bool {
        self.formula.is_smooth()
    }

    /// Evaluates T (K).
    pub fn at(&self, label: &[f64], t: f64) -> f64 {
        self.formula.at(label, t)
    }

    /// Computes the temperature and its derivatives, by automatic differentiation.
    pub fn derivatives(&self, label: &[f64], t: f64) -> TemperatureDerivatives {
        with_dimension!(self.dimension, D => {
            gather(&self.formula.eval(&seeds::<{ D + 1 }>(label, t)))
        })
    }

    /// Prepares the evaluation of the field at the reference positions `labels` (m). This call
    /// computes the terms that do not depend on time.
    pub(super) fn at_places<'a>(
        &self,
        labels: impl Iterator<Item = &'a [f64]>,
    ) -> Box<dyn TemperaturePlaces> {
        with_dimension!(self.dimension, D => {
            let mut places = Hoisted::new(std::slice::from_ref(&self.formula), D + 1);
            for label in labels {
                places.add(&Jet::<{ D + 1 }>::place(label)[..D]);
            }
            Box::new(places)
        })
    }
}

/// A temperature at fixed positions, for many times.
pub(super) trait TemperaturePlaces: Send {
    fn set_time(&mut self, t: f64);

    /// Returns temperature and derivatives at the position with index `place`, in the order of the
    /// positions in [`Temperature::at_places`]. Does not allocate.
    fn derivatives(&mut self, place: usize) -> TemperatureDerivatives;
}

impl<const N: usize> TemperaturePlaces for Hoisted<Jet<N>> {
    fn set_time(&mut self, t: f64) {
        self.set_time(Jet::variable(t, N - 1));
    }

    fn derivatives(&mut self, place: usize) -> TemperatureDerivatives {
        self.eval(place).next().map_or_else(TemperatureDerivatives::default, |jet| gather(&jet))
    }
}

/// Collects the derivatives from a jet, whose last variable is the time.
#[inline]
fn gather<const N: usize>(jet: &Jet<N>) -> TemperatureDerivatives {
    let time = N - 1;
    let mut all = TemperatureDerivatives {
        value: jet.value(),
        rate: jet.d(time),
        ..TemperatureDerivatives::default()
    };
    for a in 0..time {
        all.grad[a] = jet.d(a);
        for b in 0..time {
            all.second[a][b] = jet.dd(a, b);
        }
    }
    all
}

/// Computes `J C^-1 Grad T`, from the gradients of displacement and temperature.
fn pulled_back<T: Number, const D: usize>(grad_u: &Tensor<T, D>, grad: &[T; D]) -> [T; D] {
    let f: Tensor<T, D> = tensor(|i, j| grad_u[i][j] + unit(i, j));
    // F^-T = cof(F)/J.
    let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
    let j = det(&f, &cofactor);
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
