//! Compares closed forms with values that were computed independently from the definitions.

use approx::assert_abs_diff_eq;
use mpm_solvers::mpm::{SchemeName, Spline, WaveMethod, WaveSymbols, WaveTransfer};
use rstest::rstest;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

const SPLINES: [Spline; 3] = [Spline::Linear, Spline::Quadratic, Spline::Cubic];

const FLIP_MUSL: (WaveTransfer, SchemeName) = (WaveTransfer::Flip, SchemeName::Musl);
const FLIP_USL: (WaveTransfer, SchemeName) = (WaveTransfer::Flip, SchemeName::Usl);
const PIC_MUSL: (WaveTransfer, SchemeName) = (WaveTransfer::Pic, SchemeName::Musl);
const APIC_USL: (WaveTransfer, SchemeName) = (WaveTransfer::Apic, SchemeName::Usl);
const FLIP_CONSISTENT: (WaveTransfer, SchemeName) = (WaveTransfer::FlipConsistent, SchemeName::Usl);

/// Creates a method with two particles per cell.
fn method(spline: Spline, (transfer, scheme): (WaveTransfer, SchemeName)) -> WaveMethod {
    WaveMethod { spline, ppc: 2, shift: 0.0, transfer, scheme }
}

#[rstest]
#[case::flip_musl(FLIP_MUSL, [[-0.077_351, 1.0], [-0.146_511, 1.0], [-0.184_441, 1.0],
    [-0.019_729, 1.0], [-0.038_499, 1.0], [-0.049_281, 1.0]])]
#[case::flip_usl(FLIP_USL, [[-0.075_093, 0.901_697], [-0.144_140, 0.886_576], [-0.181_694, 0.859_778],
    [-0.019_560, 0.986_185], [-0.038_287, 0.982_235], [-0.049_009, 0.976_744]])]
#[case::pic_musl(PIC_MUSL, [[-0.068_415, 0.312_396], [-0.147_975, 0.212_630], [-0.207_269, 0.126_509],
    [-0.016_921, 0.560_341], [-0.036_993, 0.462_165], [-0.051_039, 0.357_192]])]
#[case::apic_usl(APIC_USL, [[-0.021_658, 1.0], [-0.075_511, 0.920_090], [-0.091_765, 0.852_401],
    [-0.005_402, 1.0], [-0.019_593, 0.988_856], [-0.024_189, 0.978_614]])]
#[case::flip_consistent(FLIP_CONSISTENT, [[0.037_453, 1.0], [-0.002_501, 1.0], [0.004_287, 1.0],
    [0.009_135, 1.0], [-0.000_591, 1.0], [0.001_038, 1.0]])]
fn phase_error_and_amplitude_per_period(
    #[case] named: (WaveTransfer, SchemeName),
    #[case] expected: [[f64; 2]; 6],
) {
    let waves = [8.0, 16.0].into_iter().flat_map(|cells| SPLINES.map(|spline| (cells, spline)));
    for ((cells, spline), [error, kept]) in waves.zip(expected) {
        let step = method(spline, named).step(TAU / cells);
        let found = step.phase_error(0.4).expect("a wave with a phase");
        assert_abs_diff_eq!(found, error, epsilon = 5.01e-7);
        assert_abs_diff_eq!(step.kept_per_period(0.4), kept, epsilon = 5.01e-7);
    }
}

#[rstest]
#[case::flip_musl(FLIP_MUSL, [22.51, 31.58, 35.83])]
#[case::apic_usl(APIC_USL, [11.76, 22.47, 25.03])]
#[case::flip_consistent(FLIP_CONSISTENT, [15.30, 4.22, 5.39])]
fn cells_for_a_phase_error_of_one_percent(
    #[case] named: (WaveTransfer, SchemeName),
    #[case] expected: [f64; 3],
) {
    for (spline, expected) in SPLINES.into_iter().zip(expected) {
        let cells = method(spline, named).cells_for_phase_error(0.4, 0.01).expect("a wavelength");
        assert_abs_diff_eq!(cells, expected, epsilon = 5.01e-3);
        let error = method(spline, named).step(TAU / cells).phase_error(0.4).expect("a phase");
        assert_abs_diff_eq!(error.abs(), 0.01, epsilon = 1e-10);
    }
}

#[rstest]
#[case::linear_1(Spline::Linear, 1, [2.0, FRAC_1_SQRT_2, 1.0, 0.0])]
#[case::linear_2(Spline::Linear, 2, [1.732_051, 0.755_929, 1.0, 0.5])]
#[case::quadratic_2(Spline::Quadratic, 2, [2.395_252, 1.349_986, 1.647_768, 0.75])]
#[case::cubic_2(Spline::Cubic, 2, [2.707_912, 1.485_857, 1.787_707, 0.611_111])]
fn stability_limits(#[case] spline: Spline, #[case] ppc: u32, #[case] expected: [f64; 4]) {
    let methods = [FLIP_MUSL, FLIP_USL, APIC_USL, FLIP_CONSISTENT];
    for (named, expected) in methods.into_iter().zip(expected) {
        let method = WaveMethod { ppc, ..method(spline, named) };
        assert_abs_diff_eq!(method.stability_limit(), expected, epsilon = 5.01e-7);
    }
}

/// Stability limits of one wave are `2/sqrt(kappa s)` and similar closed forms.
#[rstest]
fn limits_of_a_wave_have_closed_forms(
    #[values(Spline::Linear, Spline::Quadratic, Spline::Cubic)] spline: Spline,
    #[values(0.5, 2.0)] theta: f64,
) {
    let positions = WaveSymbols::shifted_positions(2, 0.0);
    let WaveSymbols { stiffness: kappa, mass: s, affine: a, .. } =
        WaveSymbols::new(spline, theta, &positions);
    for (named, square) in [
        (FLIP_MUSL, 4.0 / (kappa * s)),
        (FLIP_USL, 4.0 / (kappa * (2.0 - s))),
        (APIC_USL, 2.0 * (1.0 + a) / kappa),
        ((WaveTransfer::Apic, SchemeName::Musl), 2.0 * (1.0 + a) / (kappa * a)),
        (PIC_MUSL, 2.0 * (1.0 + s) / (kappa * s)),
        ((WaveTransfer::Pic, SchemeName::Usl), 2.0 * (1.0 + s) / kappa),
        (FLIP_CONSISTENT, 4.0 * s / kappa),
    ] {
        let step = method(spline, named).step(theta);
        assert_abs_diff_eq!(step.limit(), square.sqrt(), epsilon = 1e-12);
        // At this limit an eigenvalue leaves the unit circle.
        assert!(step.largest_modulus(0.999 * step.limit()) <= 1.0 + 1e-12);
        assert!(step.largest_modulus(1.001 * step.limit()) > 1.0 + 1e-4);
    }
}

#[rstest]
#[case::linear(Spline::Linear, 0.0783)]
#[case::quadratic(Spline::Quadratic, 0.1115)]
#[case::cubic(Spline::Cubic, 0.1537)]
fn pic_is_overdamped_at_short_time_steps(#[case] spline: Spline, #[case] expected: f64) {
    let step = method(spline, PIC_MUSL).step(PI / 4.0);
    assert!(step.phase_error(expected - 5.01e-5).is_none());
    assert!(step.phase_error(expected + 5.01e-5).is_some());
    // The larger of two real eigenvalues exceeds the geometric mean of both.
    let courant = 0.5 * expected;
    assert!(step.largest_modulus(courant) > step.determinant(courant).sqrt());
}

#[test]
fn a_row_without_particles_has_no_wave() {
    let method = WaveMethod { ppc: 0, ..method(Spline::Cubic, FLIP_USL) };
    let step = method.step(1.0);
    assert!(step.phase_error(0.4).is_none());
    assert!(method.cells_for_phase_error(0.4, 0.01).is_none());
    assert!(step.limit().is_nan() && method.stability_limit().is_nan());
}
