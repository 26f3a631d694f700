//! Modified Cam-clay in uniaxial compression under monotonic loading.
//!
//! The mean stress p and the compaction `eps = -ln(stretch)` are positive in compression. With
//! `q = tau22 - tau11`, `-tau11 = p + 2/3 q`. The clay starts at p0 without shear and is initially
//! elastic: `p = p0 exp(eps/kappa)` and `q = 2 r (p - p0)` with `r = G/K`. With the ratio
//! `eta = q/p`, `a = kappa/(3 r)` and `D = lambda - kappa`, associated flow after yield satisfies
//!
//! ```text
//! d ln p/d eta = -N/(C (M^2 + eta^2))
//! N = a (M^4 - eta^4) + 2 D eta (2 eta - 2/3 (M^2 - eta^2))
//! C = a eta (M^2 - eta^2) + 2 D eta - 2/3 lambda (M^2 - eta^2)
//! eps = eps_y + lambda ln(p/p_y) + D ln((M^2 + eta^2)/(M^2 + eta_y^2))
//! ```
//!
//! C has one root below -M, one above M, and one in between, which is the constant ratio of the K0
//! line. The path approaches this line. Partial fractions give `ln p`.

use super::contract::ConstitutiveLaw;
use super::uniaxial_flow::uniaxial_piola;
use crate::exact::bisection::bisect;
use crate::exact::formula::Number;
use crate::exact::tensor::Tensor;

/// Modified Cam-clay in uniaxial compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CamClayLaw {
    /// Slope M of the critical-state line.
    slope: f64,
    /// Slope kappa of the swelling line.
    swelling: f64,
    /// Slope lambda of the compression line.
    compression: f64,
    /// Ratio of moduli `G/K`.
    ratio: f64,
    initial_pressure: f64,
    /// Mean stress at yield (Pa) in compression and in extension.
    yields: [f64; 2],
    /// Roots of C, the K0 ratio first, each with the coefficient of `ln|eta - root|` in `ln p`.
    poles: [[f64; 2]; 3],
    /// Coefficients of `ln(M^2 + eta^2)` and of `atan(eta/M)` in `ln p`.
    conjugate: [f64; 2],
}

impl CamClayLaw {
    /// Creates the law from the slope M of the critical-state line, the slopes of swelling and
    /// compression, Poisson's ratio, initial mean stress and preconsolidation pressure (Pa).
    pub fn new(
        critical_state_slope: f64,
        swelling_slope: f64,
        compression_slope: f64,
        poisson: f64,
        initial_pressure: f64,
        preconsolidation: f64,
    ) -> Self {
        let slope = critical_state_slope;
        let ratio = 3.0 * (1.0 - 2.0 * poisson) / (2.0 * (1.0 + poisson));
        // The clay yields at the intersection of q = 2 r (p - p0) and q^2 = M^2 p (pc - p).
        let square = 4.0 * ratio * ratio / (slope * slope);
        let half = square * initial_pressure + 0.5 * preconsolidation;
        let constant = square * initial_pressure * initial_pressure;
        let width = libm::sqrt((half * half - (1.0 + square) * constant).max(0.0));
        let far = (half + width) / (1.0 + square);
        let mut law = Self {
            slope,
            swelling: swelling_slope,
            compression: compression_slope,
            ratio,
            initial_pressure,
            yields: [far, constant / ((1.0 + square) * far)],
            poles: [[0.0; 2]; 3],
            conjugate: [0.0; 2],
        };
        law.poles = [[0.0, slope], [-bound(&law), -slope], [slope, bound(&law)]].map(|between| {
            let root = law.root(between);
            let near = slope * slope + root * root;
            [root, -law.numerator(root) / (near * law.slope_of_cubic(root))]
        });
        law.conjugate = law.at_the_imaginary_slope();
        law
    }

    /// Returns the ratio `q/p` of the K0 line: compression without lateral strain keeps this ratio.
    pub fn k0_ratio(&self) -> f64 {
        self.poles[0][0]
    }

    /// Returns `a` and `D`.
    fn weights(&self) -> [f64; 2] {
        [self.swelling / (3.0 * self.ratio), self.compression - self.swelling]
    }

    /// Returns N at the ratio `eta`.
    fn numerator(&self, eta: f64) -> f64 {
        let ([a, d], m2, e2) = (self.weights(), self.slope * self.slope, eta * eta);
        a * (m2 - e2) * (m2 + e2) + 2.0 * d * eta * (2.0 * eta - 2.0 / 3.0 * (m2 - e2))
    }

    /// Returns C at the ratio `eta`.
    fn cubic(&self, eta: f64) -> f64 {
        let ([a, d], inside) = (self.weights(), self.slope * self.slope - eta * eta);
        a * eta * inside + 2.0 * d * eta - 2.0 / 3.0 * self.compression * inside
    }

    /// Returns `dC/d eta`.
    fn slope_of_cubic(&self, eta: f64) -> f64 {
        let ([a, d], m2) = (self.weights(), self.slope * self.slope);
        a * (m2 - 3.0 * eta * eta) + 2.0 * d + 4.0 / 3.0 * self.compression * eta
    }

    /// Finds the root of C between two ratios at which C has opposite signs.
    fn root(&self, [low, high]: [f64; 2]) -> f64 {
        let rises = self.cubic(high) > 0.0;
        bisect(low, high, |eta| (self.cubic(eta) > 0.0) == rises)
    }

    /// Returns `b/2` and `e` of `(b eta + e M)/(M^2 + eta^2)`, which equals `-N/C` at `eta = i M`.
    fn at_the_imaginary_slope(&self) -> [f64; 2] {
        let ([a, d], m) = (self.weights(), self.slope);
        let numerator = [4.0 * d * m * m, 8.0 / 3.0 * d * m * m * m];
        let cubic = [-4.0 / 3.0 * self.compression * m * m, 2.0 * a * m * m * m + 2.0 * d * m];
        let norm = cubic[0] * cubic[0] + cubic[1] * cubic[1];
        let real = (numerator[0] * cubic[0] + numerator[1] * cubic[1]) / norm;
        let imaginary = (numerator[1] * cubic[0] - numerator[0] * cubic[1]) / norm;
        [0.5 * imaginary / m, real / m]
    }

    fn ratio_at_yield(&self) -> f64 {
        2.0 * self.ratio * (1.0 - self.initial_pressure / self.yields[0])
    }

    /// Returns `ln(p/p_y)`, the compaction after yield, and `eta`. The distance of `eta` from the
    /// ratio of the K0 line is `exp(-u)` times the distance at yield.
    fn beyond_yield(&self, u: f64) -> [f64; 3] {
        let (start, m2, [limit, weight]) =
            (self.ratio_at_yield(), self.slope * self.slope, self.poles[0]);
        let eta = limit + (start - limit) * libm::exp(-u);
        let growth = libm::log((m2 + eta * eta) / (m2 + start * start));
        let turn = libm::atan(eta / self.slope) - libm::atan(start / self.slope);
        let far: f64 = self.poles[1..]
            .iter()
            .map(|[root, weight]| weight * libm::log((eta - root) / (start - root)))
            .sum();
        let pressure = far - weight * u + self.conjugate[0] * growth + self.conjugate[1] * turn;
        let [_, hardening] = self.weights();
        [pressure, self.compression * pressure + hardening * growth, eta]
    }

    /// Computes `ln(p/p_y)` and `eta` at the compaction `beyond` after yield; NaN for softening.
    fn flowed(&self, beyond: f64) -> [f64; 2] {
        let start = self.ratio_at_yield();
        if !(start < self.slope) {
            return [f64::NAN; 2];
        }
        if start == self.poles[0][0] {
            return [beyond / self.compression, start];
        }
        let reaches = |u: f64| !(self.beyond_yield(u)[1] < beyond);
        let mut high = 1.0;
        while !reaches(high) {
            high *= 2.0;
        }
        let [pressure, _, eta] = self.beyond_yield(bisect(0.0, high, reaches));
        [pressure, eta]
    }

    /// Computes `tau11` and `tau22` (Pa) at the logarithmic strain `strain`; NaN for softening.
    fn kirchhoff<T: Number>(&self, strain: T) -> [T; 2] {
        // Multiples of q in `-tau11` and `-tau22`.
        let shares = [2.0 / 3.0, -1.0 / 3.0];
        let elastic = Number::exp(T::from(-1.0 / self.swelling) * strain);
        let pressure = self.initial_pressure * elastic.value();
        if self.yields[1] <= pressure && pressure <= self.yields[0] {
            return shares.map(|share| {
                let growth = T::from(1.0 + 2.0 * share * self.ratio) * (elastic - T::from(1.0));
                T::from(-self.initial_pressure) * (growth + T::from(1.0))
            });
        }
        if !(pressure > self.yields[0]) {
            return [T::from(f64::NAN); 2];
        }
        let at_yield = self.swelling * libm::log(self.yields[0] / self.initial_pressure);
        let [growth, eta] = self.flowed(-strain.value() - at_yield);
        let pressure = self.yields[0] * libm::exp(growth);
        let ([_, hardening], m2) = (self.weights(), self.slope * self.slope + eta * eta);
        // d ln p and d eta, multiplied by a common factor.
        let [log, ratio] = [-self.numerator(eta) / m2, self.cubic(eta)];
        let compaction = self.compression * log + 2.0 * hardening * eta / m2 * ratio;
        shares.map(|share| {
            let slope = pressure * ((1.0 + share * eta) * log + share * ratio) / compaction;
            let value = -pressure * (1.0 + share * eta);
            T::from(value) + T::from(slope) * (strain - T::from(strain.value()))
        })
    }
}

/// Returns a ratio larger than all roots of C, from Cauchy's bound.
fn bound(law: &CamClayLaw) -> f64 {
    let ([a, d], m2) = (law.weights(), law.slope * law.slope);
    let largest = (2.0 / 3.0 * law.compression * m2.max(1.0)).max(a * m2 + 2.0 * d);
    (1.0 + largest / a).max(2.0 * law.slope)
}

impl ConstitutiveLaw for CamClayLaw {
    const NAME: &'static str = "cam_clay";
    const EQUATION: &'static str = "modified Cam-clay in monotonic uniaxial compression, \
                                    rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                                    q^2/M^2 + p (p - pc) <= 0 for the mean stress p (positive in \
                                    compression) and q = sqrt(3 J2), d eps_e = kappa dp/p";
    const HAS_HISTORY: bool = true;

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        uniaxial_piola(grad, |strain, _| self.kirchhoff(strain))
    }

    fn modulus(&self) -> f64 {
        self.initial_pressure / self.swelling * (1.0 + 4.0 / 3.0 * self.ratio)
    }

    fn flows(&self, grad: f64, _: &Tensor<f64>) -> bool {
        let growth = -libm::log1p(grad) / self.swelling;
        let [far, near] = self.yields.map(|pressure| libm::log(pressure / self.initial_pressure));
        !(near <= growth && growth <= far)
    }
}

#[cfg(test)]
mod tests {
    use super::super::contract::ConstitutiveLaw;
    use super::*;
    use crate::exact::formula::Slope;
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn clay(preconsolidation: f64) -> CamClayLaw {
        CamClayLaw::new(1.2, 0.02, 0.1, 0.25, 100.0, preconsolidation)
    }

    fn tau(law: &CamClayLaw, strain: f64) -> f64 {
        let [[piola]] = law.piola(&[[libm::expm1(strain)]]);
        piola * libm::exp(strain)
    }

    /// Compares with values of an independent program.
    #[test]
    fn a_path_from_an_isotropic_state_approaches_the_k0_line() {
        let law = clay(100.0);
        assert_relative_eq!(law.poles[0][0], 0.468_732_574_577, max_relative = 1e-11);
        let [growth, eta] = law.flowed(0.1);
        assert_relative_eq!(100.0 * libm::exp(growth), 242.638_169, max_relative = 1e-8);
        assert!(eta > 0.46 && eta < law.poles[0][0]);
    }

    #[test]
    fn modulus_is_the_slope_of_the_stress_at_the_start() {
        let (law, strain) = (clay(150.0), 1e-6);
        let slope = (tau(&law, strain) - tau(&law, -strain)) / (2.0 * strain);
        assert_relative_eq!(law.modulus(), slope, max_relative = 1e-6);
    }

    /// The plastic strain rates satisfy flow, elastic and hardening rules, without lateral strain.
    #[rstest]
    fn path_satisfies_the_rate_equations(
        #[values(100.0, 150.0, 400.0)] preconsolidation: f64,
        #[values(0.001, 0.02, 0.1, 0.3)] beyond: f64,
    ) {
        let law = clay(preconsolidation);
        let step = 1e-5;
        let at = |beyond: f64| {
            let [growth, eta] = law.flowed(beyond);
            let p = law.yields[0] * libm::exp(growth);
            [libm::log(p), eta * p, libm::log(p * (1.0 + eta * eta / 1.44))]
        };
        let ([_, q, _], [low, high]) = (at(beyond), [at(beyond - step), at(beyond + step)]);
        let rate = |i: usize| (high[i] - low[i]) / (2.0 * step);
        let p = libm::exp(at(beyond)[0]);
        let (volume, shear) = (0.02 * rate(0), 0.02 / (1.8 * p) * rate(1));
        let eta = q / p;
        let [plastic_volume, plastic_shear] = [1.0 - volume, 2.0 / 3.0 - shear];
        assert_relative_eq!(plastic_volume, 0.08 * rate(2), max_relative = 1e-5);
        let flow = 2.0 * eta / (1.44 - eta * eta);
        assert_relative_eq!(plastic_shear, flow * plastic_volume, max_relative = 1e-5);
    }

    /// The stress is elastic up to yield, continuous at yield, and undefined for softening clay.
    #[test]
    fn yield_point_lies_on_the_elastic_path() {
        let law = clay(150.0);
        let p = law.yields[0];
        let q = 1.2 * (p - 100.0);
        assert_relative_eq!(q * q / 1.44, p * (150.0 - p), max_relative = 1e-13);
        let strain = -0.02 * libm::log(p / 100.0);
        assert_relative_eq!(
            tau(&law, strain * (1.0 - 1e-12)),
            -p - 2.0 / 3.0 * q,
            max_relative = 1e-9
        );
        assert_relative_eq!(
            tau(&law, strain * (1.0 + 1e-9)),
            -p - 2.0 / 3.0 * q,
            max_relative = 1e-7
        );
        let flows = |strain| law.flows(libm::expm1(strain), &[[0.0; 3]; 3]);
        assert!(!flows(0.99 * strain) && flows(1.01 * strain));
        assert!(tau(&law, 0.1).is_nan() && law.flows(0.1, &[[0.0; 3]; 3]));
    }

    #[rstest]
    fn stress_slope_agrees_with_differences(#[values(-0.005, -0.05, -0.2)] strain: f64) {
        let (law, step) = (clay(150.0), 1e-6);
        let grad = Slope::<1>::variable(libm::expm1(strain), 0);
        let [[piola]] = law.piola(&[[grad]]);
        let along = |change: f64| law.piola(&[[libm::expm1(strain) + change]])[0][0];
        let slope = (along(step) - along(-step)) / (2.0 * step);
        assert_relative_eq!(piola.d(0), slope, max_relative = 1e-5);
    }
}
