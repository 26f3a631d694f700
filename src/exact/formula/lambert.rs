//! Lambert's W function.

use libm::{exp, fabs, log1p};

/// Halley's iteration converges cubically, from the start used here in at most five steps.
const MAX_STEPS: usize = 16;

/// The principal branch of W, the solution of w*exp(w) = x, for x >= 0; NaN otherwise.
pub(super) fn lambert_w(x: f64) -> f64 {
    if x.is_nan() || x < 0.0 {
        return f64::NAN;
    }
    if x.is_infinite() {
        return x;
    }
    let mut w = log1p(x);
    for _ in 0..MAX_STEPS {
        let step = halley(w, x);
        w -= step;
        if fabs(step) <= f64::EPSILON * w {
            break;
        }
    }
    w
}

/// Halley's step for w*exp(w) - x. The equation is divided by exp(w), lest large `x` overflow.
fn halley(w: f64, x: f64) -> f64 {
    let residual = w - x * exp(-w);
    residual / (w + 1.0 - 0.5 * residual * (w + 2.0) / (w + 1.0))
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::lambert_w;

    #[rstest]
    #[case(0.0, 0.0)]
    #[case(1e-300, 1e-300)]
    #[case(1e-9, 9.999_999_99e-10)]
    #[case(1.0, 0.567_143_290_409_783_8)]
    #[case(std::f64::consts::E, 1.0)]
    #[case(1e3, 5.249_602_852_401_596)]
    #[case(1e300, 684.247_208_629_760_8)]
    #[case(f64::INFINITY, f64::INFINITY)]
    fn agrees_with_known_values(#[case] x: f64, #[case] w: f64) {
        approx::assert_relative_eq!(lambert_w(x), w, max_relative = 4.0 * f64::EPSILON);
    }

    #[rstest]
    #[case(-0.1)]
    #[case(f64::NAN)]
    fn is_not_defined_below_zero(#[case] x: f64) {
        assert!(lambert_w(x).is_nan());
    }
}
