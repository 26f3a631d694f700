//! Kirchhoff stress of an isotropic law with its consistent tangent, for implicit solvers.
//!
//! The stress of such a law is a function of `b = F G F^T` and has the axes of `b`. `G` is constant
//! within a load step: it is the identity for an elastic law, and the inverse plastic metric
//! `Cp^-1` for an elastic-plastic law. With the principal values `b_A`, the logarithmic strains
//! `ln(b_A)/2` and the stresses `tau_A`, a change of the deformation gradient by `dF = dh F`
//! changes the stress by these components along the axes:
//!
//! ```text
//! d tau_AA = sum_B (d tau_A / d eps_B) dh_BB
//! d tau_AB = (tau_A - tau_B)/(b_A - b_B) (dh_AB b_B + b_A dh_BA)                      A /= B
//! ```
//!
//! (de Souza Neto, Peric & Owen 2008, appendix A.5). For equal `b_A` and `b_B` the quotient has the
//! limit `(d tau_A / d eps_A - d tau_A / d eps_B)/(2 b_A)`.

use super::spectral::{assembled, half_log, spectral};
use crate::mpm::foundation::algebra::{Matrix, Vector, product, times, zeros};

/// Relative difference of two principal values below which the limit replaces the quotient. The
/// error of the limit is the square of this difference. The relative rounding error of the quotient
/// is inversely proportional to the difference.
const EQUAL: f64 = 1e-5;

/// Kirchhoff stress of a particle, with its derivative with respect to the deformation. Both are
/// 3-D for a body of any dimension.
#[derive(Debug, Clone, PartialEq)]
pub struct StressResponse {
    /// Kirchhoff stress `tau = J sigma` (Pa).
    pub kirchhoff: Matrix<3>,
    /// Part of this stress from an initial stress (Pa), `F S0 F^T`.
    initial: Matrix<3>,
    /// Principal values of the tensor `b`.
    squares: Vector<3>,
    /// Axes of the tensor `b`, as columns.
    axes: Matrix<3>,
    /// Principal Kirchhoff stresses (Pa).
    stresses: Vector<3>,
    /// Derivatives of the principal stresses (rows) with respect to the principal logarithmic
    /// strains (Pa).
    modulus: Matrix<3>,
}

impl StressResponse {
    /// Computes stress and tangent of a law at `F` for the tensor `G`. `principal` returns the
    /// principal stresses (Pa) and their derivatives for given principal logarithmic strains.
    pub(super) fn new(
        f: &Matrix<3>,
        metric: &Matrix<3>,
        principal: impl FnOnce(&Vector<3>) -> (Vector<3>, Matrix<3>),
    ) -> Self {
        let (squares, axes) = spectral(&product(&product(f, metric), &f.transpose()));
        let (stresses, modulus) = principal(&half_log(&squares));
        let kirchhoff = assembled(&stresses, &axes);
        Self { kirchhoff, initial: zeros(), squares, axes, stresses, modulus }
    }

    /// Adds the stress `initial = F S0 F^T` (Pa). A change `dF = dh F` changes this stress by
    /// `dh initial + initial dh^T`.
    pub(super) fn with_initial(self, initial: Matrix<3>) -> Self {
        Self { kirchhoff: self.kirchhoff + initial, initial, ..self }
    }

    /// Returns the largest derivative of a principal Kirchhoff stress with respect to a principal
    /// logarithmic strain (Pa).
    pub(crate) fn largest_modulus(&self) -> f64 {
        self.modulus.amax()
    }

    /// Returns the change of the Kirchhoff stress (Pa) due to a change `dF = dh F` of the
    /// deformation gradient.
    pub fn tangent(&self, dh: &Matrix<3>) -> Matrix<3> {
        let in_axes = product(&product(&self.axes.transpose(), dh), &self.axes);
        let along = times(&self.modulus, &in_axes.diagonal());
        let change = Matrix::<3>::from_fn(|a, b| {
            if a == b {
                return along[a];
            }
            let shear = in_axes[(a, b)] * self.squares[b] + self.squares[a] * in_axes[(b, a)];
            self.slope(a, b) * shear
        });
        let initial = product(dh, &self.initial);
        product(&product(&self.axes, &change), &self.axes.transpose())
            + initial
            + initial.transpose()
    }

    /// Returns `(tau_a - tau_b)/(b_a - b_b)` (Pa), or its limit for nearly equal values.
    fn slope(&self, a: usize, b: usize) -> f64 {
        let difference = self.squares[a] - self.squares[b];
        if difference.abs() > EQUAL * self.squares[a].max(self.squares[b]) {
            return (self.stresses[a] - self.stresses[b]) / difference;
        }
        // The mean of both limits has an error of second order in the difference of the values.
        let limit = |a, b| (self.modulus[(a, a)] - self.modulus[(a, b)]) / (2.0 * self.squares[a]);
        0.5 * (limit(a, b) + limit(b, a))
    }
}

/// Returns the matrix `spherical 1 (x) 1 + 2 mu I` of moduli (Pa). In linear elasticity,
/// `spherical` is the first Lamé parameter.
pub(super) fn isotropic_modulus(spherical: f64, mu: f64) -> Matrix<3> {
    Matrix::from_fn(|a, b| if a == b { spherical + 2.0 * mu } else { spherical })
}

#[cfg(test)]
mod tests {
    use super::super::specimen::{SLOW, Specimen, every, scattered};
    use super::super::{Material, MaterialPlan};
    use super::*;
    use crate::mpm::foundation::algebra::{det, in_space};
    use approx::assert_relative_eq;

    fn has_tangent(plan: &MaterialPlan) -> bool {
        plan.properties().has_tangent().is_ok()
    }

    /// Returns the largest difference between the tangent and central differences, relative to the
    /// tangent, at `f` after the deformation `before`.
    fn difference<const D: usize>(plan: MaterialPlan, before: &Matrix<D>, f: &Matrix<3>) -> f64 {
        let mut specimen = Specimen::<D>::new(plan);
        specimen.deform(before, SLOW);
        let response = |f: &Matrix<3>| specimen.response(f).expect("a law with a tangent");
        let (at, step) = (response(f), 1e-5);
        // The minimum size avoids a division by zero at the apex of a cone, where the tangent is
        // zero.
        let (mut largest, mut size) = (0.0_f64, 1e-3 * plan.properties().wave_modulus(1.0));
        for k in 0..9 {
            let mut dh = Matrix::<3>::zeros();
            dh[(k / 3, k % 3)] = 1.0;
            let stress = |step: f64| response(&((Matrix::identity() + dh * step) * f)).kirchhoff;
            // A difference of fourth order is used, because the error of a second-order difference
            // would be 1e-10 of the modulus.
            let wide = (stress(2.0 * step) - stress(-2.0 * step)) / (4.0 * step);
            let narrow = (stress(step) - stress(-step)) / (2.0 * step);
            let expected = (narrow * 4.0 - wide) / 3.0;
            let tangent = at.tangent(&dh);
            largest = largest.max((tangent - expected).amax());
            size = size.max(expected.amax());
        }
        largest / size
    }

    fn tangent_is_the_derivative<const D: usize>(plan: MaterialPlan) {
        let identity = Matrix::<D>::identity();
        for (size, seed) in [(0.0, 0.1), (1e-3, 0.4), (0.02, 1.3), (0.15, 2.9), (0.15, 4.2)] {
            // With the first size, which is zero, the deformation is a pure compression with equal
            // principal values.
            let f = identity * 0.97 + scattered::<D>(size, seed);
            let before = identity + scattered::<D>(0.5 * size, seed + 0.7);
            let error = difference(plan, &before, &in_space(&f, 1.0));
            assert!(error <= 1e-7, "{} in {D}-D, size {size}: {error:.1e}", plan.name());
        }
    }

    /// A law without a tangent has no response.
    #[test]
    fn tangent_agrees_with_central_differences() {
        let mut names = Vec::new();
        for plan in every() {
            if !has_tangent(&plan) {
                let law: Box<dyn Material<2>> = plan.build();
                assert!(law.response(0, &Matrix::identity()).is_none(), "{}", plan.name());
                continue;
            }
            tangent_is_the_derivative::<1>(plan);
            tangent_is_the_derivative::<2>(plan);
            tangent_is_the_derivative::<3>(plan);
            names.push(plan.name());
        }
        let expected = ["neo_hookean", "hencky", "j2", "drucker_prager", "mohr_coulomb"];
        assert_eq!(names, expected);
    }

    /// Tests states before yield, on a face, on edges and at the apex, with and without dilation.
    #[test]
    fn tangent_of_mohr_coulomb_agrees_with_its_return() {
        let strains = [
            [-0.03, 0.0, 0.0],
            [0.003, 0.0, 0.0],
            [0.02, -0.02, 0.0],
            [0.03, -0.03, 0.0],
            [-0.002, 0.0, 0.0],
            [0.03, 0.02, 0.025],
        ];
        for (friction_angle, dilation_angle) in [(30.0, 10.0), (20.0, 0.0), (30.0, 30.0)] {
            let (young, poisson, cohesion) = (18e3, 0.2, 10.0);
            let plan = MaterialPlan::MohrCoulomb {
                young,
                poisson,
                friction_angle,
                dilation_angle,
                cohesion,
            };
            for strain in strains {
                let stretch = Vector::<3>::from(strain).map(libm::exp);
                let f = Matrix::<3>::from_diagonal(&stretch) + scattered::<3>(1e-3, 0.3);
                let error = difference(plan, &Matrix::<3>::identity(), &f);
                assert!(error <= 1e-7, "{strain:?}, {friction_angle}: {error:.1e}");
            }
        }
    }

    /// The response has the same stress as the update, and does not change the state of the law.
    #[test]
    fn response_has_the_stress_of_the_update() {
        let plans = || every().into_iter().filter(has_tangent);
        for (plan, size) in plans().flat_map(|plan| [0.1, 1e-3].map(|size| (plan, size))) {
            let mut specimen = Specimen::<3>::new(plan);
            let before = Matrix::identity() + scattered::<3>(size, 0.3);
            specimen.deform(&before, SLOW);
            let step = Matrix::identity() + scattered::<3>(size, 1.9);
            let f = step * before;
            let response = specimen.response(&f).expect("a law with a tangent");
            assert_eq!(Some(&response), specimen.response(&f).as_ref(), "{}", plan.name());
            let sigma = specimen.deform(&step, SLOW);
            assert_relative_eq!(sigma * det(&f), response.kirchhoff, epsilon = 1e-11);
        }
    }
}
