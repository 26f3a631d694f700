//! Compares the stress of one particle of soil after every step with closed forms, along paths of
//! deformation.

use super::MaterialPlan;
use super::specimen::{SLOW, Specimen, isotropic};
use crate::mpm::foundation::algebra::{Matrix, Vector, in_body};
use rstest::rstest;

const STEPS: u32 = 40;

/// Maximum error of a stress component, as a fraction of the largest stress of the path.
const TOLERANCE: f64 = 1e-10;

/// A path of principal logarithmic strains, with the closed form of the principal Kirchhoff
/// stresses (Pa) at each point.
struct SoilPath {
    strains: Vec<[f64; 3]>,
    stresses: Vec<[f64; 3]>,
}

impl SoilPath {
    /// Creates the path through the isochoric strains `(e, -e, 0)` for each parameter e. `stress`
    /// returns the stress at a parameter.
    fn through(parameters: impl Iterator<Item = f64>, stress: impl Fn(f64) -> [f64; 3]) -> Self {
        let (strains, stresses) = parameters.map(|e| ([e, -e, 0.0], stress(e))).unzip();
        Self { strains, stresses }
    }

    /// Asserts the stresses of a material along the path in the plane and in space, while the axes
    /// rotate by a total of `angle` about the third axis.
    fn assert(&self, plan: MaterialPlan, angle: f64) {
        self.assert_in::<2>(plan, angle);
        self.assert_in::<3>(plan, angle);
    }

    fn assert_in<const D: usize>(&self, plan: MaterialPlan, angle: f64) {
        let mut soil = Specimen::<D>::new(plan);
        let largest = self.stresses.iter().flatten().fold(0.0, |m: f64, tau| m.max(tau.abs()));
        let diagonal =
            |values: [f64; 3]| in_body::<D>(&Matrix::from_diagonal(&Vector::from(values)));
        let mut before = Matrix::<D>::identity();
        for (step, (strain, stress)) in self.strains.iter().zip(&self.stresses).enumerate() {
            let angle = angle * (step + 1) as f64 / self.strains.len() as f64;
            let turn = in_body::<D>(&about_third(angle));
            let f = turn * diagonal(strain.map(libm::exp));
            let sigma = soil.deform(&(f * before.try_inverse().unwrap()), SLOW);
            before = f;
            let tau = turn.transpose() * sigma * turn * libm::exp(strain.iter().sum());
            let error = (tau - diagonal(*stress)).abs().max();
            assert!(error <= TOLERANCE * largest, "{plan:?} at {strain:?}: {tau} for {stress:?}");
        }
    }
}

fn about_third(angle: f64) -> Matrix<3> {
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

fn up_to(end: f64) -> impl Iterator<Item = f64> {
    (1..=STEPS).map(move |step| end * f64::from(step) / f64::from(STEPS))
}

/// Drucker-Prager soil: K and mu (Pa); friction, dilation and strength k (Pa).
#[derive(Clone, Copy)]
struct ConePaths([f64; 2], [f64; 3]);

impl ConePaths {
    const SOIL: Self = Self([1e4, 6e3], [0.3, 0.1, 10.0]);

    fn plan(self) -> MaterialPlan {
        let Self([bulk, mu], [friction, dilation, strength]) = self;
        let (young, poisson) = isotropic(bulk, mu);
        MaterialPlan::DruckerPrager { young, poisson, friction, dilation, strength }
    }

    fn isochoric(self, e: f64) -> [f64; 3] {
        let Self([bulk, mu], [eta, etab, k]) = self;
        let beyond = (e - k / (2.0 * mu)).max(0.0);
        let flow = 2.0 * mu / (mu + bulk * eta * etab) * beyond;
        let (mean, shear) = (-bulk * etab * flow, 2.0 * mu * e - mu * flow);
        [mean + shear, mean - shear, mean]
    }
}

/// Mohr-Coulomb soil: lambda and mu (Pa); friction and dilation angles (degrees), and cohesion
/// (Pa).
#[derive(Clone, Copy)]
struct PyramidPaths([f64; 2], [f64; 3]);

impl PyramidPaths {
    const fn soil(angles: [f64; 2]) -> Self {
        Self([5e3, 7.5e3], [angles[0], angles[1], 10.0])
    }

    fn plan(self) -> MaterialPlan {
        let Self([lambda, mu], [friction_angle, dilation_angle, cohesion]) = self;
        let (young, poisson) = isotropic(lambda + 2.0 / 3.0 * mu, mu);
        MaterialPlan::MohrCoulomb { young, poisson, friction_angle, dilation_angle, cohesion }
    }

    /// Returns `sin(phi)`, `sin(psi)` and `2 c cos(phi)`.
    fn surface(self) -> [f64; 3] {
        let [phi, psi, cohesion] = self.1;
        let sine = |angle: f64| libm::sin(angle.to_radians());
        [sine(phi), sine(psi), 2.0 * cohesion * libm::cos(phi.to_radians())]
    }

    /// Returns the stress at the strain (e, -e, 0), as long as the third stress is between the
    /// others.
    fn isochoric(self, e: f64) -> [f64; 3] {
        let (Self([l, mu], _), [s, sp, strength]) = (self, self.surface());
        let high = 2.0 * mu * (1.0 + sp) + 2.0 * l * sp;
        let low = 2.0 * mu * (1.0 - sp) - 2.0 * l * sp;
        let flow = 4.0 * mu / ((1.0 + s) * high + (1.0 - s) * low);
        let flow = flow * (e - strength / (4.0 * mu)).max(0.0);
        [2.0 * mu * e - flow * high, -2.0 * mu * e + flow * low, -2.0 * l * sp * flow]
    }
}

/// Tests fixed axes, and axes that rotate by two radians.
#[rstest]
fn drucker_prager_matches_closed_forms_along_a_path(
    #[values(0.0012, 0.05)] end: f64,
    #[values(0.0, 2.0)] angle: f64,
    #[values([0.3, 0.1, 10.0], [0.3, 0.3, 10.0], [0.3, 0.0, 10.0], [0.2, 0.1, 0.0])] soil: [f64; 3],
) {
    let soil = ConePaths([1e4, 6e3], soil);
    SoilPath::through(up_to(end), |e| soil.isochoric(e)).assert(soil.plan(), angle);
}

/// Without friction, the cone is the von Mises surface with `Y = sqrt(3) k`.
#[rstest]
fn j2_matches_closed_forms_along_a_path(#[values(0.0, 2.0)] angle: f64) {
    let soil = ConePaths([1e4, 6e3], [0.0, 0.0, 10.0]);
    let (young, poisson) = isotropic(1e4, 6e3);
    let plan = MaterialPlan::J2 { young, poisson, r#yield: 10.0 * 3.0_f64.sqrt(), hardening: 0.0 };
    SoilPath::through(up_to(0.02), |e| soil.isochoric(e)).assert(plan, angle);
}

/// At larger strains the stress is on an edge, where the closed form is not valid.
#[rstest]
fn mohr_coulomb_matches_closed_forms_along_a_path(
    #[values(0.001, 0.01)] end: f64,
    #[values(0.0, 2.0)] angle: f64,
    #[values([30.0, 10.0], [30.0, 30.0], [20.0, 0.0], [0.0, 0.0])] angles: [f64; 2],
) {
    let soil = PyramidPaths::soil(angles);
    SoilPath::through(up_to(end), |e| soil.isochoric(e)).assert(soil.plan(), angle);
}

/// Tests loading, unloading inside the yield surface and reloading, twice. A closed cycle of strain
/// does not change the stress, and further loading has the stress of a path without unloading.
#[rstest]
fn unloading_cycles_do_not_change_the_stress(#[values(0.0, 2.0)] angle: f64) {
    let (cone, pyramid) = (ConePaths::SOIL, PyramidPaths::soil([30.0, 10.0]));
    unload(cone.plan(), |e| cone.isochoric(e), cone.0[1], angle);
    unload(pyramid.plan(), |e| pyramid.isochoric(e), pyramid.0[1], angle);
}

/// Tests a path with two cycles of unloading and reloading, with the shear modulus `mu` (Pa).
fn unload(plan: MaterialPlan, loading: impl Fn(f64) -> [f64; 3], mu: f64, angle: f64) {
    let (turning, back) = (0.005, -0.0005);
    let elastic = |e: f64| {
        let ([first, second, third], change) = (loading(turning), 2.0 * mu * (e - turning));
        [first + change, second - change, third]
    };
    let cycle = [0.5, 1.0, 0.5, 0.0].map(|share| turning + share * back);
    let mut path = SoilPath::through(up_to(turning), &loading);
    for part in [
        SoilPath::through(cycle.into_iter().chain(cycle), elastic),
        SoilPath::through(up_to(1.0).map(|share| turning * (1.0 + share)), &loading),
    ] {
        path.strains.extend(part.strains);
        path.stresses.extend(part.stresses);
    }
    path.assert(plan, angle);
}

/// The strain paths are straight, so one step gives the same stress as many steps.
#[test]
fn one_step_gives_the_stress_of_many_steps() {
    let (cone, pyramid) = (ConePaths::SOIL, PyramidPaths::soil([30.0, 10.0]));
    for e in [0.003, 0.01] {
        let once = std::iter::once(e);
        SoilPath::through(once.clone(), |e| cone.isochoric(e)).assert(cone.plan(), 0.0);
        SoilPath::through(once, |e| pyramid.isochoric(e)).assert(pyramid.plan(), 0.0);
    }
}
