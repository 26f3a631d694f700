//! Thermal expansion in the equation of motion.
//!
//! Temperature stretches every axis by `theta = 1 + alpha (T - T0)`. Then
//! `P = theta^(D-1) P_e(F/theta)`, the derivative of the energy `theta^D W(F/theta)`. In
//! small-strain theory, `P = C : eps - (3 lambda + 2 mu)(theta - 1) I`.

use super::formula::Number;
use super::heat::TemperatureDerivatives;
use super::law::Equation;
use super::tensor::{Tensor, tensor, unit};
use mpm_subject::with_dimension;

/// Thermal expansion, linear in the temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expansion {
    /// Coefficient of thermal expansion alpha (1/K).
    pub coefficient: f64,
    /// Reference temperature T0 (K), at which an undeformed body is stress-free.
    pub reference: f64,
}

/// Thermal stretch theta and its gradient (1/m).
#[derive(Debug, Clone, Copy)]
pub(super) struct Swelling {
    pub(super) theta: f64,
    pub(super) grad: [f64; 3],
}

impl Expansion {
    pub(super) fn swelling(&self, now: &TemperatureDerivatives) -> Swelling {
        Swelling {
            theta: 1.0 + self.coefficient * (now.value - self.reference),
            grad: now.grad.map(|slope| self.coefficient * slope),
        }
    }
}

/// Computes P (Pa) in D dimensions at the thermal stretch `theta`.
pub(super) fn piola<T: Number, const D: usize>(
    equation: &Equation,
    grad: &Tensor<T, D>,
    theta: T,
) -> Tensor<T, D> {
    if let Some(modulus) = equation.small_strain_modulus() {
        let pressure = T::from(modulus) * (theta - T::from(1.0));
        let strained = equation.piola(grad);
        return tensor(|i, j| strained[i][j] - pressure * unit(i, j));
    }
    let elastic: Tensor<T, D> = tensor(|i, j| (grad[i][j] + unit(i, j)) / theta - unit(i, j));
    let area = (1..D).fold(T::from(1.0), |area, _| area * theta);
    let stress = equation.piola(&elastic);
    tensor(|i, j| area * stress[i][j])
}

/// Computes P (Pa) of a body in `dimension` dimensions; the other components are zero.
pub(super) fn swollen_piola(
    equation: &Equation,
    dimension: usize,
    grad: &Tensor<f64>,
    theta: f64,
) -> Tensor<f64> {
    with_dimension!(dimension, D => {
        let inside: Tensor<f64, D> = tensor(|i, j| grad[i][j]);
        let piola = piola(equation, &inside, theta);
        tensor(|i, j| if i.max(j) < D { piola[i][j] } else { 0.0 })
    })
}

/// Computes the Cauchy stress (Pa) at F/theta. For small strains, this is P.
pub(super) fn swollen_cauchy(
    equation: &Equation,
    dimension: usize,
    grad: &Tensor<f64>,
    theta: f64,
) -> Tensor<f64> {
    if equation.small_strain_modulus().is_some() {
        return swollen_piola(equation, dimension, grad, theta);
    }
    let elastic: Tensor<f64> = tensor(|i, j| {
        if i.max(j) < dimension {
            (grad[i][j] + unit::<f64>(i, j)) / theta - unit::<f64>(i, j)
        } else {
            0.0
        }
    });
    equation.cauchy(&elastic)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{HenckyLaw, NeoHookeanLaw, SmallStrainLaw};
    use approx::assert_relative_eq;
    use rstest::rstest;

    const GRAD: Tensor<f64> = [[0.1, 0.2, 0.0], [-0.05, 0.03, 0.0], [0.0; 3]];

    /// A freely expanding body, `grad u = (theta - 1) I`, has no stress or force.
    #[rstest]
    #[case(SmallStrainLaw::new(50.0, 0.3).into())]
    #[case(NeoHookeanLaw::new(50.0, 0.3).into())]
    #[case(HenckyLaw::new(50.0, 0.3).into())]
    fn only_a_held_expansion_has_a_stress(#[case] equation: Equation) {
        let (found, plain) = (swollen_piola(&equation, 2, &GRAD, 1.0), equation.piola(&GRAD));
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            assert_relative_eq!(found[i][j], plain[i][j], max_relative = 1e-12);
        }
        let grad = [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]];
        let found = swollen_piola(&equation, 3, &grad, 1.2);
        assert!(found.iter().flatten().all(|p| p.abs() < 1e-13), "{found:?}");
        let bar = [[0.2, 0.0, 0.0], [0.0; 3], [0.0; 3]];
        let mut second = [[[0.0; 3]; 3]; 3];
        second[0][0][0] = 0.7;
        let swelling = Swelling { theta: 1.2, grad: [0.7, 0.0, 0.0] };
        let uniaxial: Equation = match equation.small_strain_modulus() {
            Some(_) => SmallStrainLaw::new(50.0, 0.0).into(),
            None => HenckyLaw::new(50.0, 0.0).into(),
        };
        let force = uniaxial.divergence(1, &bar, &second, Some(&swelling));
        assert!(force[0].abs() < 1e-12, "{force:?}");
    }

    /// P is the derivative of the energy `theta^D W(F/theta)`, and `sigma = P F^T/J`.
    #[test]
    fn cauchy_stress_agrees_with_first_piola_kirchhoff_stress() {
        let (equation, theta) = (Equation::from(NeoHookeanLaw::new(50.0, 0.0)), 1.1);
        let piola = swollen_piola(&equation, 2, &GRAD, theta);
        let sigma = swollen_cauchy(&equation, 2, &GRAD, theta);
        let f: Tensor<f64> = tensor(|i, j| GRAD[i][j] + unit::<f64>(i, j));
        let det = f[0][0] * f[1][1] - f[0][1] * f[1][0];
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let expected: f64 = (0..2).map(|k| piola[i][k] * f[j][k]).sum::<f64>() / det;
            assert_relative_eq!(sigma[i][j], expected, max_relative = 1e-12);
        }
    }
}
