//! Continuum problems that a formula can claim to solve.

/// The equation of motion `rho0 u_tt = Div P(grad u) + rho0 b`, by its stress P.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Equation {
    /// Small-strain elasticity, `P = lambda tr(eps) I + 2 mu eps`, `eps = sym(grad u)` (Pa).
    SmallStrain {
        /// First Lame parameter (Pa).
        lambda: f64,
        /// Shear modulus (Pa).
        mu: f64,
    },
}

impl Equation {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn small_strain(young: f64, poisson: f64) -> Self {
        Self::SmallStrain {
            lambda: young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
            mu: young / (2.0 * (1.0 + poisson)),
        }
    }

    /// Component P_ij (Pa) for the displacement gradient `grad[i][j] = du_i/dX_j`.
    pub fn piola(&self, grad: &[[f64; 3]; 3], i: usize, j: usize) -> f64 {
        let Self::SmallStrain { lambda, mu } = *self;
        let trace = grad[0][0] + grad[1][1] + grad[2][2];
        let volumetric = if i == j { lambda * trace } else { 0.0 };
        volumetric + mu * (grad[i][j] + grad[j][i])
    }

    /// Component i of Div P (N/m3) for second derivatives `second[k][a][b] = d2 u_k/dX_a dX_b`.
    pub fn divergence(&self, second: &[[[f64; 3]; 3]; 3], i: usize) -> f64 {
        let Self::SmallStrain { lambda, mu } = *self;
        let along: f64 = (0..3).map(|k| second[k][k][i]).sum();
        let laplacian: f64 = (0..3).map(|k| second[i][k][k]).sum();
        (lambda + mu) * along + mu * laplacian
    }

    /// Stiffest modulus, `lambda + 2 mu` (Pa): a bound for stresses of a given strain.
    pub fn modulus(&self) -> f64 {
        let Self::SmallStrain { lambda, mu } = *self;
        lambda + 2.0 * mu
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_bar_without_poisson_effect_has_youngs_modulus() {
        let bar = Equation::small_strain(100.0, 0.0);
        let mut grad = [[0.0; 3]; 3];
        grad[0][0] = 0.01;
        assert_relative_eq!(bar.piola(&grad, 0, 0), 1.0);
        assert_relative_eq!(bar.modulus(), 100.0);
    }

    /// u = (x^2 y, x y^2, 0): Div P by hand.
    #[test]
    fn the_divergence_agrees_with_a_hand_calculation() {
        let (x, y) = (0.3, 0.7);
        let solid = Equation::SmallStrain { lambda: 2.0, mu: 3.0 };
        let mut second = [[[0.0; 3]; 3]; 3];
        second[0][0][0] = 2.0 * y;
        second[0][0][1] = 2.0 * x;
        second[0][1][0] = 2.0 * x;
        second[1][1][1] = 2.0 * x;
        second[1][0][1] = 2.0 * y;
        second[1][1][0] = 2.0 * y;
        assert_relative_eq!(solid.divergence(&second, 0), 5.0 * 4.0 * y + 3.0 * 2.0 * y);
        assert_relative_eq!(solid.divergence(&second, 1), 5.0 * 4.0 * x + 3.0 * 2.0 * x);
    }
}
