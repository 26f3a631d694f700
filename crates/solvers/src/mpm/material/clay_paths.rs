//! Compares modified Cam-clay with closed forms along paths of deformation with fixed axes.

use super::CamClay;
use super::specimen::{SLOW, Specimen, richardson};
use crate::mpm::foundation::algebra::{Matrix, Vector};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use rstest::rstest;

/// Creates a specimen in the initial state of the law. The first axis is the axial one.
fn specimen(law: CamClay) -> Specimen<3> {
    Specimen::with(Box::new(law))
}

/// Applies `steps` equal steps that add these axial and lateral logarithmic strains (positive in
/// compression). Returns p and q of the Kirchhoff stress.
fn squeeze(specimen: &mut Specimen<3>, [axial, lateral]: [f64; 2], steps: u32) -> [f64; 2] {
    let stretch = |strain: f64| libm::exp(-strain / f64::from(steps));
    let [along, across] = [axial, lateral].map(stretch);
    let step = Matrix::from_diagonal(&Vector::<3>::new(along, across, across));
    let mut sigma = Matrix::zeros();
    for _ in 0..steps {
        sigma = specimen.deform(&step, SLOW);
    }
    let tau = sigma * specimen.j();
    assert_eq!(tau[(1, 1)], tau[(2, 2)]);
    [-tau.trace() / 3.0, tau[(1, 1)] - tau[(0, 0)]]
}

/// Returns the axial and lateral strains of a shear at constant volume with the deviatoric strain
/// `strain`.
fn undrained(strain: f64) -> [f64; 2] {
    [strain, -0.5 * strain]
}

fn limit(run: impl Fn(u32) -> [f64; 2]) -> (Vector<2>, f64) {
    richardson((4..=10).map(|k| Vector::from(run(1 << k))).collect(), 2)
}

/// The expected p and q are closed forms, evaluated by an independent program. The return mapping
/// is of first order in the step size.
#[rstest]
#[case::low([95.265_762_753, 28.579_728_826], 0.003_504_455_447)]
#[case::middle([83.651_164_207, 50.190_698_524], 0.008_175_376_601)]
#[case::high([69.975_172_732, 62.977_655_459], 0.016_513_462_741)]
#[case::near_the_critical_state([61.389_386_681, 67.528_325_350], 0.030_516_204_116)]
fn undrained_shear_matches_the_closed_form(#[case] expected: [f64; 2], #[case] strain: f64) {
    let run = |steps| squeeze(&mut specimen(CamClay::example(100.0)), undrained(strain), steps);
    let (found, order) = limit(run);
    for i in 0..2 {
        assert_relative_eq!(found[i], expected[i], max_relative = 2e-9);
    }
    assert!((0.97..1.03).contains(&order), "order {order}");
}

/// The clay is elastic at constant p up to `q_y = M sqrt(p0 (pc - p0))`. After yield, the expected
/// p and q are closed forms.
#[test]
fn undrained_shear_of_overconsolidated_clay_matches_the_closed_form() {
    let at_yield = 84.852_813_742 * 0.02 / (3.0 * 0.6 * 100.0);
    let run = |steps| {
        let mut clay = specimen(CamClay::example(150.0));
        let [p, q] = squeeze(&mut clay, undrained(at_yield), 3);
        assert_relative_eq!(p, 100.0, max_relative = 1e-12);
        assert_relative_eq!(q, 84.852_813_742, max_relative = 1e-10);
        squeeze(&mut clay, undrained(0.016_464_206_955 - at_yield), steps)
    };
    let (limit, order) = limit(run);
    let [p, q] = limit.into();
    assert_relative_eq!(p, 90.709_158_875, max_relative = 2e-9);
    assert_relative_eq!(q, 90.709_158_875, max_relative = 2e-9);
    assert!((0.97..1.03).contains(&order), "order {order}");
}

/// The final state is `p = p0/2^(1 - kappa/lambda)` and `q = M p`, for any number of steps.
#[rstest]
fn undrained_shear_ends_at_a_critical_state(#[values(4, 300)] steps: u32) {
    let mut clay = specimen(CamClay::example(100.0));
    let [p, q] = squeeze(&mut clay, undrained(30.0), steps);
    assert_relative_eq!(p, 57.434_917_749_9, max_relative = 1e-10);
    assert_relative_eq!(q, 68.921_901_299_8, max_relative = 1e-10);
}

/// Isotropic compression follows the swelling line below `pc` and the compression line above it.
/// Expansion follows a swelling line again. The result is exact in any number of steps.
#[rstest]
fn isotropic_compression_follows_swelling_and_compression_lines(#[values(1, 7)] steps: u32) {
    let mut clay = specimen(CamClay::example(150.0));
    let to_yield = 0.02 * libm::log(1.5);
    let [p, q] = squeeze(&mut clay, [0.5 * to_yield / 3.0; 2], steps);
    assert_relative_eq!(p, 100.0 * 1.5_f64.sqrt(), max_relative = 1e-12);
    assert_abs_diff_eq!(q, 0.0, epsilon = 1e-10);
    let [p, _] = squeeze(&mut clay, [(0.5 * to_yield + 0.1) / 3.0; 2], steps);
    assert_relative_eq!(p, 150.0 * libm::exp(1.0), max_relative = 1e-12);
    let [p, q] = squeeze(&mut clay, [-0.02 / 3.0; 2], steps);
    assert_relative_eq!(p, 150.0, max_relative = 1e-12);
    assert_abs_diff_eq!(q, 0.0, epsilon = 1e-10);
}

/// A cycle of volume and shear inside the yield surface is not reversible:
/// `q = 3 r (p - p0)/kappa eps_q` remains.
#[test]
fn elastic_cycle_leaves_a_shear_stress() {
    let mut soil = specimen(CamClay::example(1000.0));
    for strain in [[0.01 / 3.0; 2], undrained(0.003), [-0.01 / 3.0; 2], undrained(-0.003)] {
        squeeze(&mut soil, strain, 2);
    }
    let [p, q] = squeeze(&mut soil, [0.0; 2], 1);
    assert_relative_eq!(p, 100.0, max_relative = 1e-12);
    let high = 100.0 * libm::exp(0.5);
    assert_relative_eq!(q, 1.8 / 0.02 * (high - 100.0) * 0.003, max_relative = 1e-10);
}
