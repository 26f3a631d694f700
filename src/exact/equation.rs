//! Continuum problems that a motion can claim to solve.
//!
//! `rho0 u_tt = Div P(grad u) + rho0 b`, with the stress P by one of five laws. Written over any
//! [`Number`]: over slopes, the divergence of P follows from its formula by automatic
//! differentiation.

use super::{
    formula::{Number, Slope},
    law::plastic::{Yield, kirchhoff},
    tensor::{Tensor, cofactor, det, log_strain, product, sum, tensor, unit},
};

/// Lame parameters and the law that uses them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    law: Law,
    lambda: f64,
    mu: f64,
}

/// A law between stress and strain.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Law {
    SmallStrain,
    NeoHookean,
    Hencky,
    J2(Yield),
    Tait,
}

impl Equation {
    /// Small-strain elasticity, `P = lambda tr(eps) I + 2 mu eps`, `eps = sym(grad u)`, from
    /// Young's modulus (Pa) and Poisson's ratio.
    pub fn small_strain(young: f64, poisson: f64) -> Self {
        Self::new(Law::SmallStrain, young, poisson)
    }

    /// Neo-Hookean elasticity, `P = lambda ln(J) F^-T + mu (F - F^-T)`, `F = I + grad u`
    /// (Wallstedt & Guilkey 2008; Kamojjala et al. 2015), from Young's modulus (Pa) and Poisson's
    /// ratio.
    pub fn neo_hookean(young: f64, poisson: f64) -> Self {
        Self::new(Law::NeoHookean, young, poisson)
    }

    /// Hencky elasticity, `P = tau F^-T`, `tau = lambda tr(eps) I + 2 mu eps`, `eps = ln(F F^T)/2`
    /// (Hencky 1928; along the axes `P_ii = (lambda ln J + 2 mu ln F_ii)/F_ii`), from Young's modulus
    /// (Pa) and Poisson's ratio.
    pub fn hencky(young: f64, poisson: f64) -> Self {
        Self::new(Law::Hencky, young, poisson)
    }

    /// J2 plasticity with Hencky elasticity in uniaxial strain, under loading that never reverses: see
    /// `exact::plastic`. From Young's modulus (Pa), Poisson's ratio, the yield stress in
    /// tension and the hardening modulus (Pa).
    pub fn j2(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        Self::new(Law::J2(Yield { stress: yield_stress, hardening }), young, poisson)
    }

    /// A fluid at rest, `P = -p J F^-T` with Tait's equation of state in Cole's form,
    /// `p = K/7 (J^-7 - 1)` (Cole 1948), from the bulk modulus at rest (Pa).
    pub fn tait(bulk: f64) -> Self {
        Self { law: Law::Tait, lambda: bulk, mu: 0.0 }
    }

    /// Whether the stress depends on the history of the motion, unless loading never reverses.
    pub(super) fn has_history(&self) -> bool {
        matches!(self.law, Law::J2(_))
    }

    /// Whether a body in uniaxial strain flows at the displacement gradient `grad`.
    pub(super) fn flows(&self, grad: f64) -> bool {
        let Law::J2(limit) = self.law else { return false };
        2.0 * self.mu * libm::log(1.0 + grad).abs() > limit.stress
    }

    fn new(law: Law, young: f64, poisson: f64) -> Self {
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        Self { law, lambda, mu: young / (2.0 * (1.0 + poisson)) }
    }

    /// P (Pa) for the displacement gradient `grad[i][j] = du_i/dX_j`.
    pub fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, mu) = (T::from(self.lambda), T::from(self.mu));
        match self.law {
            Law::SmallStrain => {
                let pressure = lambda * sum::<T, D>(|i| grad[i][i]);
                tensor(|i, j| {
                    let shear = mu * (grad[i][j] + grad[j][i]);
                    if i == j { pressure + shear } else { shear }
                })
            }
            Law::NeoHookean => {
                let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
                let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
                let det = det(&f, &cofactor);
                let pressure = lambda * Number::ln(det) - mu;
                tensor(|i, j| pressure * cofactor[i][j] / det + mu * f[i][j])
            }
            Law::Hencky => {
                let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
                let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
                let det = det(&f, &cofactor);
                let (strain, pressure) = (log_strain(&f), lambda * Number::ln(det));
                let tau = tensor(|i, j| pressure * unit(i, j) + (mu + mu) * strain[i][j]);
                product(&tau, &tensor(|i, j| cofactor[i][j] / det))
            }
            Law::J2(limit) => {
                let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
                let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
                let det = det(&f, &cofactor);
                let strain = (&log_strain(&f), Number::ln(det));
                let tau = kirchhoff(strain, (self.lambda, self.mu), limit);
                product(&tau, &tensor(|i, j| cofactor[i][j] / det))
            }
            Law::Tait => {
                let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
                let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
                let excess = Number::powi(det(&f, &cofactor), -7) - T::from(1.0);
                let pressure = lambda * excess * T::from(1.0 / 7.0);
                tensor(|i, j| -(pressure * cofactor[i][j]))
            }
        }
    }

    /// Cauchy stress (Pa), `sigma = P F^T / J`. Theory of small strains does not tell it from P,
    /// which is what it is there.
    pub fn cauchy(&self, grad: &Tensor<f64>) -> Tensor<f64> {
        let piola = self.piola(grad);
        if self.law == Law::SmallStrain {
            return piola;
        }
        let f: Tensor<f64> = tensor(|i, j| grad[i][j] + f64::from(u8::from(i == j)));
        let det: f64 = (0..3).map(|b| f[0][b] * cofactor(&f, 0, b)).sum();
        tensor(|i, j| (0..3).map(|k| piola[i][k] * f[j][k]).sum::<f64>() / det)
    }

    /// What becomes of a unit of area on a face of the reference body, normal to `axis`, outwards on
    /// its `high` or low side: `J F^-T N` (Nanson's formula). Where strains are small, N.
    pub fn present_area(&self, grad: &Tensor<f64>, axis: usize, high: bool) -> [f64; 3] {
        let outwards = if high { 1.0 } else { -1.0 };
        let f: Tensor<f64> = match self.law {
            Law::SmallStrain => tensor(unit),
            _ => tensor(|i, j| grad[i][j] + unit::<f64>(i, j)),
        };
        std::array::from_fn(|i| outwards * cofactor(&f, i, axis))
    }

    /// Div P (N/m3) from the gradient and its derivatives, `second[k][a][b] = d2 u_k/dX_a dX_b`,
    /// where nothing varies beyond the first `dimension` axes.
    pub fn divergence(
        &self,
        dimension: usize,
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
    ) -> [f64; 3] {
        match dimension {
            1 => {
                let [x] = self.divergence_in(grad, second);
                [x, 0.0, 0.0]
            }
            2 => {
                let [x, y] = self.divergence_in(grad, second);
                [x, y, 0.0]
            }
            _ => self.divergence_in(grad, second),
        }
    }

    /// Div P in D dimensions: P once, with its slopes along all axes.
    fn divergence_in<const D: usize>(
        &self,
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
    ) -> [f64; D] {
        let slopes = |i: usize, j: usize| std::array::from_fn(|axis| second[i][j][axis]);
        let varying: Tensor<Slope<D>, D> = tensor(|i, j| Slope::new(grad[i][j], slopes(i, j)));
        let stress = self.piola(&varying);
        std::array::from_fn(|i| sum::<f64, D>(|j| stress[i][j].d(j)))
    }

    /// `3 lambda + 2 mu` (Pa), what a small strain on all axes is resisted with; none of a law of finite
    /// strains.
    pub(super) fn swelling_modulus(&self) -> Option<f64> {
        (self.law == Law::SmallStrain).then_some(3.0 * self.lambda + 2.0 * self.mu)
    }

    /// Stiffest modulus, `lambda + 2 mu` (Pa): a bound for stresses of a given strain.
    pub fn modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    #[test]
    fn a_bar_without_poisson_effect_has_youngs_modulus() {
        let bar = Equation::small_strain(100.0, 0.0);
        let mut grad = [[0.0; 3]; 3];
        grad[0][0] = 0.01;
        assert_relative_eq!(bar.piola(&grad)[0][0], 1.0);
        assert_relative_eq!(bar.modulus(), 100.0);
    }

    /// u = (x^2 y, x y^2, 0): Div P by hand.
    #[test]
    fn the_divergence_agrees_with_a_hand_calculation() {
        let (x, y) = (0.3, 0.7);
        let solid = Equation { law: Law::SmallStrain, lambda: 2.0, mu: 3.0 };
        let mut second = [[[0.0; 3]; 3]; 3];
        second[0] = [[2.0 * y, 2.0 * x, 0.0], [2.0 * x, 0.0, 0.0], [0.0; 3]];
        second[1] = [[0.0, 2.0 * y, 0.0], [2.0 * y, 2.0 * x, 0.0], [0.0; 3]];
        let found = solid.divergence(2, &[[0.0; 3]; 3], &second);
        assert_relative_eq!(found[0], 5.0 * 4.0 * y + 3.0 * 2.0 * y);
        assert_relative_eq!(found[1], 5.0 * 4.0 * x + 3.0 * 2.0 * x);
    }

    /// Simple shear by gamma, and a uniform stretch: closed forms of the Cauchy stress.
    #[test]
    fn cauchy_stress_has_its_closed_forms() {
        let solid = Equation::neo_hookean(100.0, 0.3);
        let (gamma, mu) = (0.4, solid.mu);
        let shear = solid.cauchy(&[[0.0, gamma, 0.0], [0.0; 3], [0.0; 3]]);
        assert_relative_eq!(shear[0][1], mu * gamma, max_relative = 1e-14);
        assert_relative_eq!(shear[1][0], mu * gamma, max_relative = 1e-14);
        assert_relative_eq!(shear[0][0], mu * gamma * gamma, max_relative = 1e-13);
        assert_relative_eq!(shear[1][1], 0.0, epsilon = 1e-13);
        let lateral = solid.cauchy(&[[0.2, 0.0, 0.0], [0.0; 3], [0.0; 3]])[1][1];
        assert_relative_eq!(lateral, solid.lambda * libm::log(1.2) / 1.2, max_relative = 1e-14);
    }

    #[test]
    fn small_strains_do_not_tell_cauchy_stress_from_p() {
        let solid = Equation::small_strain(100.0, 0.3);
        let grad = [[0.01, 0.02, 0.0], [0.0, -0.01, 0.0], [0.0; 3]];
        assert_eq!(solid.cauchy(&grad), solid.piola(&grad));
    }

    /// Fewer dimensions are three with zeros.
    #[rstest]
    fn plane_and_uniaxial_strain_are_special_cases(
        #[values(Law::SmallStrain, Law::NeoHookean, Law::Hencky)] law: Law,
        #[values(1, 2)] dimension: usize,
    ) {
        let solid = Equation { law, lambda: 2.0, mu: 3.0 };
        let inside = |i: usize, j: usize, value| if i.max(j) < dimension { value } else { 0.0 };
        let grad: Tensor<f64> =
            tensor(|i, j| inside(i, j, [[0.2, -0.1], [0.3, -0.2]][i % 2][j % 2]));
        let second =
            std::array::from_fn(|k| tensor(|a, b| inside(k, a.max(b), 0.1 + (k + a + b) as f64)));
        let whole = solid.divergence(3, &grad, &second);
        assert!(whole[0] != 0.0, "something varies");
        assert_eq!(solid.divergence(dimension, &grad, &second), whole);
    }

    /// P is the derivative of `W = lambda/2 ln(J)^2 + mu/2 (tr(F^T F) - 3) - mu ln J` and of
    /// `W = lambda/2 ln(J)^2 + mu eps : eps`.
    #[rstest]
    fn stress_is_the_derivative_of_an_energy(
        #[values(Law::NeoHookean, Law::Hencky)] law: Law,
        #[values(0, 1, 2)] i: usize,
        #[values(0, 1, 2)] j: usize,
    ) {
        let solid = Equation::new(law, 50.0, 0.3);
        let grad = [[0.2, -0.1, 0.05], [0.3, -0.2, 0.1], [0.0, 0.15, 0.1]];
        let square = |t: &Tensor<f64>| t.iter().flatten().map(|c| c * c).sum::<f64>();
        let energy = |step: f64| {
            let mut f: Tensor<f64> = tensor(|a, b| grad[a][b] + f64::from(u8::from(a == b)));
            f[i][j] += step;
            let log = libm::log(det(&f, &tensor(|a, b| cofactor(&f, a, b))));
            let shear = match law {
                Law::Hencky => solid.mu * square(&log_strain(&f)),
                _ => 0.5 * solid.mu * (square(&f) - 3.0) - solid.mu * log,
            };
            0.5 * solid.lambda * log * log + shear
        };
        let slope = (energy(1e-6) - energy(-1e-6)) / 2e-6;
        assert_relative_eq!(solid.piola(&grad)[i][j], slope, max_relative = 1e-7, epsilon = 1e-7);
    }

    /// Along the axes, also where stretches coincide, and turned: `P(Q F) = Q P(F)`.
    #[rstest]
    fn hencky_stress_has_its_closed_form_along_the_axes(
        #[values([1.3, 0.6, 1.0], [1.2; 3], [4.0, 0.2, 1.0], [1.0 + 1e-9, 1.0, 1.0])]
        stretches: [f64; 3],
        #[values(0.0, 0.7)] angle: f64,
    ) {
        let solid = Equation::hencky(50.0, 0.3);
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        let turn = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        let log: f64 = stretches.iter().map(|stretch| libm::log(*stretch)).sum();
        let along = |i: usize| {
            (solid.lambda * log + 2.0 * solid.mu * libm::log(stretches[i])) / stretches[i]
        };
        let grad: Tensor<f64> = tensor(|i, j| turn[i][j] * stretches[j] - unit::<f64>(i, j));
        let found = solid.piola(&grad);
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)] {
            let wanted = turn[i][j] * along(j);
            assert_relative_eq!(found[i][j], wanted, max_relative = 1e-11, epsilon = 1e-13);
        }
    }

    /// Nothing shears at this point, but it does beside it: the derivative must not be lost.
    #[test]
    fn shear_that_vanishes_at_a_point_still_has_its_derivative() {
        let mut second = [[[0.0; 3]; 3]; 3];
        second[0][1][1] = 1.0;
        let solid = Equation::hencky(50.0, 0.3);
        let found = solid.divergence(2, &[[0.0; 3]; 3], &second);
        assert_relative_eq!(found[0], solid.mu, max_relative = 1e-12);
    }

    /// A stretch that the series does not reach is no number, rather than a wrong one.
    #[test]
    fn an_extreme_stretch_with_shear_has_no_hencky_stress() {
        let mut grad = [[0.0; 3]; 3];
        grad[0] = [100.0, 1.0, 0.0];
        assert!(Equation::hencky(50.0, 0.3).piola(&grad)[0][0].is_nan());
    }
}
