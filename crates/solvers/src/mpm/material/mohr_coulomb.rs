//! Mohr-Coulomb plasticity: a pyramid of six planes in principal stresses.
//!
//! The material yields if `(t1 - t3) + (t1 + t3) sin(phi) > 2 c cos(phi)`, with the principal
//! Kirchhoff stresses `t1 >= t2 >= t3`, tension positive. The flow rule uses the dilation angle psi
//! instead of phi. The return goes to a plane, to one of the two edges of this plane, or to the
//! apex `p = c cot(phi)` (de Souza Neto, Peric & Owen 2008, section 8.2). With phi = 0 this is
//! Tresca's law, which has no apex. [`plastic_flow`](super::plastic_flow) integrates the law.
//!
//! Without dilation, plastic flow does not change the mean stress. A return from a mean stress
//! above the apex is then a tension cut-off that is not part of the flow rule.

use super::contract::{Contradiction, YieldFunction};
use super::hyperelastic::linear;
use super::plastic_flow::{
    ElastoPlastic, LogElasticity, MARGIN, PrincipalStrain, YieldSurface, length_squared,
};
use crate::mpm::foundation::algebra::{Matrix, Vector, det, dyad, product, zeros};
use std::ops::{Div, Mul, Sub};

/// Mohr-Coulomb elastoplasticity at finite strain, without hardening.
pub type MohrCoulomb = ElastoPlastic<Pyramid>;

/// The pyramid of Mohr and Coulomb.
#[derive(Debug, Clone, PartialEq)]
pub struct Pyramid {
    elasticity: LogElasticity,
    /// `sin(phi)` and `sin(psi)`.
    sines: [f64; 2],
    /// `2 c cos(phi)` (Pa).
    strength: f64,
}

/// A negative flow on an edge up to this relative size counts as a rounding error.
const ROUNDING: f64 = 1e-9;

/// A plane of the pyramid: the indices of the largest and the smallest principal stress.
type YieldPlane = [usize; 2];

/// Part of the pyramid on which a return ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Landing {
    Plane(YieldPlane),
    Edge([YieldPlane; 2]),
    Apex,
}

impl MohrCoulomb {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the angles of friction and of
    /// dilation (degrees), and the cohesion (Pa).
    pub fn new(
        young: f64,
        poisson: f64,
        friction_angle: f64,
        dilation_angle: f64,
        cohesion: f64,
    ) -> Self {
        let elasticity = LogElasticity::new(young, poisson);
        let sines = [friction_angle, dilation_angle].map(|angle| libm::sin(angle.to_radians()));
        let strength = 2.0 * cohesion * libm::cos(friction_angle.to_radians());
        Self::with_surface(Pyramid { elasticity, sines, strength })
    }
}

impl Pyramid {
    /// Returns the yield function of a plane (Pa).
    #[inline(always)]
    fn excess(&self, [high, low]: YieldPlane, stress: &Vector<3>) -> f64 {
        let sine = self.sines[0];
        (1.0 + sine) * stress[high] - (1.0 - sine) * stress[low] - self.strength
    }

    /// Returns the stress reduction per unit of flow on a plane (Pa).
    #[inline(always)]
    fn relief(&self, [high, low]: YieldPlane) -> Vector<3> {
        let (LogElasticity { lambda, mu, .. }, sine) = (&self.elasticity, self.sines[1]);
        let mut relief = Vector::from([2.0 * lambda * sine; 3]);
        relief[high] += 2.0 * mu * (1.0 + sine);
        relief[low] -= 2.0 * mu * (1.0 - sine);
        relief
    }

    /// Returns the reduction of the yield function of one `plane` per unit of flow on another
    /// plane, the argument `of` (Pa).
    #[inline(always)]
    fn slope(&self, plane: YieldPlane, of: YieldPlane) -> f64 {
        self.excess(plane, &self.relief(of)) + self.strength
    }

    /// Returns the stress after a return to the plane (Pa).
    #[inline]
    fn on_plane(&self, plane: YieldPlane, trial: &Vector<3>) -> Vector<3> {
        let flow = self.excess(plane, trial) / self.slope(plane, plane);
        trial - self.relief(plane) * flow
    }

    /// Returns the flows on two planes that reduce the yield functions by `f_a` and `f_b`. If `f_a`
    /// and `f_b` are derivatives, the results are derivatives of the flows.
    fn flows<T>(&self, [a, b]: [YieldPlane; 2], [f_a, f_b]: [T; 2]) -> [T; 2]
    where
        T: Copy + Mul<f64, Output = T> + Sub<Output = T> + Div<f64, Output = T>,
    {
        let (aa, ab) = (self.slope(a, a), self.slope(a, b));
        let (ba, bb) = (self.slope(b, a), self.slope(b, b));
        let determinant = aa * bb - ab * ba;
        [(f_a * bb - f_b * ab) / determinant, (f_b * aa - f_a * ba) / determinant]
    }

    /// Returns the stress after a return to the edge of two planes (Pa). `None` if a flow is
    /// negative: the return does not end on this edge.
    fn on_edge(&self, [a, b]: [YieldPlane; 2], trial: &Vector<3>) -> Option<Vector<3>> {
        let excess = [self.excess(a, trial), self.excess(b, trial)];
        let [flow_a, flow_b] = self.flows([a, b], excess);
        let least = -ROUNDING * (flow_a.abs() + flow_b.abs());
        (flow_a >= least && flow_b >= least)
            .then(|| trial - self.relief(a) * flow_a - self.relief(b) * flow_b)
    }

    /// Returns the stress (Pa) after the return of a trial stress outside the pyramid, and the part
    /// of the pyramid on which the return ends. The first argument is the order from
    /// [`Self::outside`].
    fn returned(&self, [high, middle, low]: [usize; 3], trial: &Vector<3>) -> (Vector<3>, Landing) {
        let plane = [high, low];
        let stress = self.on_plane(plane, trial);
        if stress[high] >= stress[middle] && stress[middle] >= stress[low] {
            return (stress, Landing::Plane(plane));
        }
        // On an edge two stresses are equal, so only the order of the third stress is checked.
        let high_edge = || {
            let stress = self.on_edge([plane, [middle, low]], trial)?;
            let landing = Landing::Edge([plane, [middle, low]]);
            (stress[middle] >= stress[low]).then_some((stress, landing))
        };
        let low_edge = || {
            let stress = self.on_edge([plane, [high, middle]], trial)?;
            let landing = Landing::Edge([plane, [high, middle]]);
            (stress[high] >= stress[middle]).then_some((stress, landing))
        };
        let edge = if stress[middle] > stress[high] {
            high_edge().or_else(low_edge)
        } else {
            low_edge().or_else(high_edge)
        };
        // Tresca's prism has no apex, so the sine is above zero here.
        let apex = || Vector::<3>::from_element(self.strength / (2.0 * self.sines[0]));
        edge.unwrap_or_else(|| (apex(), Landing::Apex))
    }

    /// Returns the trial stress (Pa), and the indices of its largest, middle and smallest value.
    /// `None` if the stress is inside the pyramid.
    fn outside(&self, trial: &PrincipalStrain) -> Option<(Vector<3>, [usize; 3])> {
        let stress = self.elasticity.stress(trial);
        let mut order = [0, 1, 2];
        order.sort_by(|i, j| stress[*j].total_cmp(&stress[*i]));
        (self.excess([order[0], order[2]], &stress) > 0.0).then_some((stress, order))
    }

    /// Returns the derivatives of a plane's yield function (Pa) with respect to the principal trial
    /// strains.
    fn excess_slope(&self, [high, low]: YieldPlane) -> Vector<3> {
        let sine = self.sines[0];
        let mut normal = zeros();
        normal[high] += 1.0 + sine;
        normal[low] -= 1.0 - sine;
        self.elasticity.modulus() * normal
    }
}

impl YieldSurface for Pyramid {
    fn elasticity(&self) -> &LogElasticity {
        &self.elasticity
    }

    fn contradiction(&self) -> Option<Contradiction> {
        (self.sines[1] > self.sines[0]).then_some(Contradiction {
            key: "dilation_angle",
            reason: "the dilation angle is above the friction angle",
            explanation: "a flow that dilates more than friction allows does negative work",
        })
    }

    fn yield_function(&self, stress: &Vector<3>) -> YieldFunction {
        let (high, low, sine) = (stress.max(), stress.min(), self.sines[0]);
        let terms = [(1.0 + sine) * high, -(1.0 - sine) * low, -self.strength];
        YieldFunction {
            value: terms[0] + terms[1] + terms[2],
            size: terms.map(f64::abs).iter().sum(),
        }
    }

    #[inline]
    fn return_from(&self, trial: &PrincipalStrain, _: f64) -> Option<(PrincipalStrain, f64)> {
        let LogElasticity { bulk, mu, .. } = self.elasticity;
        let (stress, order) = self.outside(trial)?;
        let (stress, _) = self.returned(order, &stress);
        let pressure = stress.sum() / 3.0;
        let after = PrincipalStrain {
            mean: pressure / (3.0 * bulk),
            deviator: stress.add_scalar(-pressure) / (2.0 * mu),
        };
        Some((after, trial.distance(&after)))
    }

    /// Uses a condition on the stress deviator S without its axes. With the mean stress p, the
    /// principal values s1, s2 and s3 of S and `A = 2 c cos(phi) - 2 p sin(phi)`, the stress is
    /// inside if `|si - sj| <= A + sk sin(phi)` for all permutations (i, j, k). The sum of the si
    /// is zero, so `(si - sj)^2 = 4 J2 - 3 sk^2`. If no `A + sk sin(phi)` is negative, the
    /// condition is that no eigenvalue of
    ///
    /// ```text
    /// Q = (A I + sin(phi) S)^2 + 3 S^2 - 4 J2 I
    /// ```
    ///
    /// is negative. By Sylvester's criterion, the leading minors of a positive definite Q are
    /// positive. The largest magnitude of sk is `2 sqrt(J2/3)`.
    #[inline(always)]
    #[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch")]
    fn encloses(&self, mean: f64, deviator: &Matrix<3>, _: f64) -> bool {
        let (LogElasticity { bulk, mu, .. }, sine) = (&self.elasticity, self.sines[0]);
        let pressure = 2.0 * sine * 3.0 * bulk * mean;
        let (a, four_j2) = (self.strength - pressure, 8.0 * mu * mu * length_squared(deviator));
        let square = product(deviator, deviator);
        let [first, second] = [4.0 * mu * sine * a, 4.0 * mu * mu * (3.0 + sine * sine)];
        let mut q = linear(a * a - four_j2, first, deviator);
        for j in 0..3 {
            for i in 0..3 {
                q[(i, j)] += second * square[(i, j)];
            }
        }
        let size = self.strength * self.strength + pressure * pressure + four_j2;
        let minors = [q[(0, 0)], q[(0, 0)] * q[(1, 1)] - q[(0, 1)] * q[(1, 0)], det(&q)];
        (a >= 0.0)
            & (a * a >= sine * sine * four_j2 / 3.0)
            & (minors[0] >= MARGIN * size)
            & (minors[1] >= MARGIN * size * size)
            & (minors[2] >= MARGIN * size * size * size)
    }

    /// Returns the consistent tangent. On each part of the pyramid, the return is linear in the
    /// trial stress.
    fn modulus_of_return(&self, trial: &PrincipalStrain, _: f64) -> Option<Matrix<3>> {
        let (stress, order) = self.outside(trial)?;
        let elastic = self.elasticity.modulus();
        Some(match self.returned(order, &stress).1 {
            Landing::Plane(plane) => {
                let flow = self.excess_slope(plane) / self.slope(plane, plane);
                elastic - dyad(&self.relief(plane), &flow)
            }
            Landing::Edge([a, b]) => {
                let slopes = [self.excess_slope(a), self.excess_slope(b)];
                let [flow_a, flow_b] = self.flows([a, b], slopes);
                elastic - dyad(&self.relief(a), &flow_a) - dyad(&self.relief(b), &flow_b)
            }
            Landing::Apex => zeros(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;
    use proptest::prelude::*;

    proptest! {
        /// After a return, no yield function is positive, and at least one is zero. A return to the
        /// wrong edge would leave a positive value.
        #[test]
        fn a_return_ends_on_the_pyramid(
            strain in proptest::array::uniform3(-0.05..0.05_f64),
            friction in 0.0..50.0_f64,
            share in 0.0..1.0_f64,
            cohesion in 0.0..50.0_f64,
        ) {
            let law = MohrCoulomb::new(2e4, 0.2, friction, share * friction, cohesion).surface;
            let trial = PrincipalStrain::new(&Vector::<3>::from(strain));
            if let Some((after, flow)) = law.return_from(&trial, 0.0) {
                let stress = law.elasticity.stress(&after);
                let planes = [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]];
                let largest = planes.map(|plane| law.excess(plane, &stress)).into_iter().fold(f64::MIN, f64::max);
                assert_abs_diff_eq!(largest, 0.0, epsilon = 1e-10);
                prop_assert!(flow > 0.0);
            }
        }

        /// The trial stress returns to the edge of a plane, up to rounding. On this edge the flow
        /// on the other plane is zero, and rounding can make it negative.
        #[test]
        fn return_to_the_edge_of_a_plane_ends_on_the_edge(
            friction in prop_oneof![Just(0.0), 0.0..50.0_f64],
            share in 0.0..1.0_f64,
            low in -100.0..-20.0_f64,
            flow in 1e-6..1e-2_f64,
            is_high in any::<bool>(),
        ) {
            let law = MohrCoulomb::new(2e4, 0.2, friction, share * friction, 10.0).surface;
            let sine = law.sines[0];
            let high = (law.strength + (1.0 - sine) * low) / (1.0 + sine);
            let edge = Vector::<3>::new(high, if is_high { high } else { low }, low);
            let trial = edge + law.relief([0, 2]) * flow;
            let (back, _) = law.returned([0, 1, 2], &trial);
            assert_abs_diff_eq!(back, edge, epsilon = 1e-9);
        }
    }
}
