//! Neo-Hookean elasticity, `P = lambda ln(J) F^-T + mu (F - F^-T)` (Wallstedt & Guilkey 2008;
//! Kamojjala et al. 2015).

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, area, deformation, dilation, sum, tensor};

/// Compressible neo-Hookean elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookeanLaw(Lame);

impl NeoHookeanLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

/// Maximum number of Newton steps for the thickness of a plate; strains of 100 % need about five.
const MOST_STEPS: usize = 100;

/// Performs one Newton step from the logarithmic thickness strain `eps` of a plate whose
/// logarithmic area strain is `log`.
fn newton<T: Number>(Lame { lambda, mu }: Lame, log: T, eps: T) -> T {
    let (lambda, mu, square) = (T::from(lambda), T::from(mu), Number::exp(eps + eps));
    let force = lambda * (log + eps) + mu * (square - T::from(1.0));
    eps - force / (lambda + (mu + mu) * square)
}

impl ConstitutiveLaw for NeoHookeanLaw {
    const NAME: &'static str = "neo_hookean";
    const EQUATION: &'static str =
        "neo-Hookean, rho0 u_tt = Div P + rho0 b, P = lambda ln(J) F^-T + mu (F - F^-T)";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, mu) = (T::from(self.0.lambda), T::from(self.0.mu));
        let (f, cofactor, det) = deformation(grad);
        let pressure = lambda * Number::ln(det) - mu;
        tensor(|i, j| pressure * cofactor[i][j] / det + mu * f[i][j])
    }

    /// Computes `W = lambda/2 ln(J)^2 + mu/2 (F : F - 3) - mu ln J`, with `F : F - 3` from grad u.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let Lame { lambda, mu } = self.0;
        let log = libm::log1p(dilation(grad));
        let square: f64 = grad.iter().flatten().map(|slope| slope * slope).sum();
        let stretch = sum::<f64, 3>(|i| grad[i][i]) + 0.5 * square;
        Some(0.5 * lambda * log * log + mu * (stretch - log))
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    /// Solves `lambda (ln J + eps) + mu (exp(2 eps) - 1) = 0` by Newton's method for the in-plane
    /// J. The iterates decrease to the root `eps = ln F_33`. Two more steps give the derivatives.
    fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
        let log = Number::ln(area(grad));
        let mut eps = -self.0.thinning() * log.value();
        let arrived = (0..MOST_STEPS).any(|_| {
            let next = newton(self.0, log.value(), eps);
            let arrived = next >= eps;
            eps = if arrived { eps } else { next };
            arrived
        });
        let start = T::from(if arrived { eps } else { f64::NAN });
        let strain = newton(self.0, log, newton(self.0, log, start));
        Some(Number::exp(strain) - T::from(1.0))
    }
}
