//! Initial stress in the reference configuration.
//!
//! For a finite-strain law, the initial stress is a second Piola-Kirchhoff stress S0. Then
//! `P = P_law(F) + F S0` is the derivative of the energy `W_law(F) + S0 : E`, `E = (F^T F - I)/2`
//! (Merodio, Ogden & Rodriguez 2013, Int. J. Non-Linear Mech. 56). Small waves along S0 satisfy
//! `rho0 c^2 = M + S0`. For a small-strain law, `P = C : eps + S0` neglects `grad u S0`, so S0 must
//! be much smaller than the moduli.
//!
//! For a law with a yield surface, S0 is the stress of the elastic strain at the start. It is not
//! added to the stress of the law.

use super::formula::{Formula, Number, Slope};
use super::tensor::{Tensor, pushed_forward, sum, tensor};

/// Initial stress S0 (Pa), a symmetric tensor field on the reference body.
#[derive(Debug, Clone, Default)]
pub struct InitialStress {
    /// Row, column and formula of the coordinates, with row <= column. Other components are zero.
    components: Vec<(usize, usize, Formula)>,
}

impl InitialStress {
    /// Creates a field from its components: row, column and formula of the coordinates. Each
    /// component is given on one side of the diagonal only.
    pub fn new(components: Vec<(usize, usize, Formula)>) -> Self {
        Self { components }
    }

    /// Whether there is no initial stress.
    pub fn is_none(&self) -> bool {
        self.components.is_empty()
    }

    /// Returns row, column and formula of each given component.
    pub fn components(&self) -> &[(usize, usize, Formula)] {
        &self.components
    }

    /// Returns S0 (Pa) at `label`.
    pub fn at(&self, label: &[f64]) -> [[f64; 3]; 3] {
        self.over(label)
    }

    fn over<T: Number>(&self, label: &[T]) -> Tensor<T> {
        let mut stress = tensor(|_, _| T::from(0.0));
        for (i, j, formula) in &self.components {
            let value = formula.eval(label);
            (stress[*i][*j], stress[*j][*i]) = (value, value);
        }
        stress
    }

    /// Computes the contribution of S0 to P (Pa), for finite or small strains.
    pub(super) fn piola(&self, label: &[f64], grad: &Tensor<f64>, is_finite: bool) -> Tensor<f64> {
        let stress = self.at(label);
        if is_finite { pulled(grad, &stress) } else { stress }
    }

    /// Computes the contribution of S0 to the Cauchy stress (Pa), `F S0 F^T/J`.
    pub fn cauchy(&self, label: &[f64], grad: &[[f64; 3]; 3], is_finite: bool) -> [[f64; 3]; 3] {
        let piola = self.piola(label, grad, is_finite);
        if !is_finite {
            return piola;
        }
        pushed_forward(&piola, grad)
    }

    /// Returns S0 (Pa) at `label` with its derivatives.
    pub(super) fn varying(&self, label: &[f64]) -> Tensor<Slope<3>> {
        self.over(&Slope::place(label)[..label.len()])
    }

    /// Computes the contribution of S0 to Div P (N/m3), with `second[k][a][b] = d2 u_k/dX_a dX_b`.
    pub(super) fn divergence(
        &self,
        label: &[f64],
        grad: &Tensor<f64>,
        second: &[Tensor<f64>; 3],
        is_finite: bool,
    ) -> [f64; 3] {
        let stress = self.varying(label);
        let piola = if is_finite {
            let varying: Tensor<Slope<3>> = tensor(|i, j| Slope::new(grad[i][j], second[i][j]));
            pulled(&varying, &stress)
        } else {
            stress
        };
        std::array::from_fn(|i| sum::<f64, 3>(|j| piola[i][j].d(j)))
    }
}

/// Computes `F S0`.
fn pulled<T: Number>(grad: &Tensor<T>, stress: &Tensor<T>) -> Tensor<T> {
    tensor(|i, j| stress[i][j] + sum::<T, 3>(|k| grad[i][k] * stress[k][j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Forcing;
    use crate::exact::Problem;
    use crate::exact::tests::{bind, held};
    use approx::assert_relative_eq;
    use rstest::rstest;

    const GRAD: Tensor<f64> = [[0.1, 0.2, 0.0], [-0.3, 0.05, 0.0], [0.0; 3]];

    fn stress(components: &[(usize, usize, &str)], variables: &[&str]) -> InitialStress {
        let one = |(i, j, text): &(usize, usize, &str)| (*i, *j, bind(text, variables));
        InitialStress::new(components.iter().map(one).collect())
    }

    fn plane() -> InitialStress {
        stress(&[(0, 0, "2*X"), (1, 1, "3 + Y"), (0, 1, "X*Y")], &["X", "Y"])
    }

    /// The initial stress at (2, 5) is S0 = ((4, 10), (10, 8)), with Div S0 = (2 + 2, 5 + 1).
    #[test]
    fn divergence_agrees_with_a_hand_calculation() {
        let (s0, mut second) = (plane(), [[[0.0; 3]; 3]; 3]);
        assert_eq!(s0.at(&[2.0, 5.0])[0], [4.0, 10.0, 0.0]);
        assert_eq!(s0.piola(&[2.0, 5.0], &GRAD, true)[0][1], 10.0 + 0.1 * 10.0 + 0.2 * 8.0);
        assert_eq!(s0.piola(&[2.0, 5.0], &GRAD, false)[1], [10.0, 8.0, 0.0]);
        // u_x,xx = 7 and u_x,xy = u_x,yx = 11.
        (second[0][0][0], second[0][0][1], second[0][1][0]) = (7.0, 11.0, 11.0);
        let force = s0.divergence(&[2.0, 5.0], &GRAD, &second, true);
        assert_relative_eq!(force[0], 1.1 * 4.0 + 0.2 * 6.0 + 7.0 * 4.0 + 2.0 * 11.0 * 10.0);
        assert_relative_eq!(force[1], -0.3 * 4.0 + 1.05 * 6.0);
        assert_eq!(s0.divergence(&[2.0, 5.0], &GRAD, &second, false), [4.0, 6.0, 0.0]);
    }

    #[test]
    fn cauchy_stress_agrees_with_first_piola_kirchhoff_stress() {
        let (s0, det) = (plane(), 1.1 * 1.05 + 0.3 * 0.2);
        let found = s0.cauchy(&[2.0, 5.0], &GRAD, true);
        // Row X of F S0 F^T, computed by hand with F = ((1.1, 0.2), (-0.3, 1.05)).
        let row = [1.1 * 4.0 + 0.2 * 10.0, 1.1 * 10.0 + 0.2 * 8.0];
        assert_relative_eq!(found[0][0], (row[0] * 1.1 + row[1] * 0.2) / det, max_relative = 1e-14);
        assert_relative_eq!(
            found[1][0],
            (row[1] * 1.05 - row[0] * 0.3) / det,
            max_relative = 1e-14
        );
        assert_eq!(s0.cauchy(&[2.0, 5.0], &GRAD, false), s0.at(&[2.0, 5.0]));
    }

    fn prestressed(dimension: usize) -> Problem {
        let components = [(0, 0, "3*sin(X)"), (1, 1, "X - Y"), (0, 1, "Y^2"), (2, 2, "X*Z")];
        let inside = components.into_iter().filter(|(_, j, _)| *j < dimension);
        let inside: Vec<(usize, usize, &str)> = inside.collect();
        let initial_stress = stress(&inside, &["X", "Y", "Z"][..dimension]);
        Problem { initial_stress, ..held(dimension) }
    }

    /// The manufactured force contains Div(F S0). The weak form checks this term independently.
    #[rstest]
    fn a_manufactured_force_balances_it(#[values(1, 2, 3)] dimension: usize) {
        let (problem, bare) = (prestressed(dimension), held(dimension));
        problem.check().unwrap();
        let label = vec![0.3; dimension];
        let force = problem.manufactured_force(&label, 0.2);
        assert!((force[0] - bare.manufactured_force(&label, 0.2)[0]).abs() > 0.1);
        let mut found = [[0.0; 3]];
        Forcing::new(&problem, [label.as_slice()].into_iter()).at(0.2, &mut found);
        assert_eq!(found[0], force);
    }
}
