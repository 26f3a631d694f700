//! Functions of one argument: name, value, first and second derivative, one line each.

use libm::{cos, cosh, exp, fabs, hypot, log1p, sin, sinh, sqrt};

/// Declares [`Unary`] and its tables. In each line, `x` is the argument and `f` the value at `x`.
macro_rules! functions {
    ($x:ident, $f:ident; $($doc:literal $name:ident $variant:ident = $value:expr,
        $first:expr, $second:expr;)*) => {
        /// A function of one argument.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Unary {
            $(#[doc = $doc] $variant,)*
        }

        impl Unary {
            /// All functions with their names in formulas.
            pub const ALL: &'static [(&'static str, Self)] =
                &[$((stringify!($name), Self::$variant),)*];

            /// Returns the value at `x`.
            pub fn value(self, $x: f64) -> f64 {
                match self {
                    $(Self::$variant => $value,)*
                }
            }

            /// Returns first and second derivative at `x`; `f` is the value at `x`.
            pub fn derivatives(self, $x: f64, $f: f64) -> (f64, f64) {
                match self {
                    $(Self::$variant => ($first, $second),)*
                }
            }
        }
    };
}

functions! { x, f;
    "Sine."
    sin Sin = sin(x), cos(x), -f;
    "Cosine."
    cos Cos = cos(x), -sin(x), -f;
    "Tangent."
    tan Tan = libm::tan(x), 1.0 + f * f, 2.0 * f * (1.0 + f * f);
    "Inverse sine."
    asin Asin = libm::asin(x), 1.0 / root(x), x / cube(root(x));
    "Inverse cosine."
    acos Acos = libm::acos(x), -1.0 / root(x), -x / cube(root(x));
    "Inverse tangent."
    atan Atan = libm::atan(x), 1.0 / (1.0 + x * x), -2.0 * x / square(1.0 + x * x);
    "Hyperbolic sine."
    sinh Sinh = sinh(x), cosh(x), f;
    "Hyperbolic cosine."
    cosh Cosh = cosh(x), sinh(x), f;
    "Hyperbolic tangent."
    tanh Tanh = libm::tanh(x), 1.0 / square(cosh(x)), -2.0 * f / square(cosh(x));
    "Inverse hyperbolic sine."
    asinh Asinh = libm::asinh(x), 1.0 / hypot(1.0, x), -x / cube(hypot(1.0, x));
    "Exponential."
    exp Exp = exp(x), f, f;
    "Natural logarithm."
    ln Ln = libm::log(x), 1.0 / x, -1.0 / (x * x);
    "Square root."
    sqrt Sqrt = sqrt(x), 0.5 / f, -0.25 / (f * x);
    "Absolute value; its derivative at 0 is that from the right."
    abs Abs = libm::fabs(x), if x < 0.0 { -1.0 } else { 1.0 }, 0.0;
    "-1, 0 or 1; its derivative is 0 everywhere."
    sign Sign = sign(x), 0.0, 0.0;
    "0 for x < 0, 1 for x >= 0; its derivative is 0 everywhere."
    step Step = step(x), 0.0, 0.0;
    "Largest whole number not above x; its derivative is 0 everywhere."
    floor Floor = libm::floor(x), 0.0, 0.0;
    "Bessel function of the first kind, of order 0."
    bessel_j0 BesselJ0 = libm::j0(x), -libm::j1(x), 0.5 * (libm::jn(2, x) - f);
    "Bessel function of the first kind, of order 1."
    bessel_j1 BesselJ1 = libm::j1(x), 0.5 * (libm::j0(x) - libm::jn(2, x)), bessel_j1_curvature(x, f);
    "Principal branch of Lambert's W for x >= -1/e, the solution w >= -1 of w*exp(w) = x."
    lambert_w LambertW = lambert_w(x), lambert_slope(f), lambert_curvature(f);
}

impl Unary {
    pub(super) fn find(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
    }
}

fn square(x: f64) -> f64 {
    x * x
}

fn cube(x: f64) -> f64 {
    x * x * x
}

/// Computes sqrt(1 - x^2) without loss of accuracy near 1 and -1.
fn root(x: f64) -> f64 {
    sqrt((1.0 - x) * (1.0 + x))
}

/// Computes the second derivative of J1 at `x`, `J2/x - J1`; `j1` is the value of J1 at `x`.
fn bessel_j1_curvature(x: f64, j1: f64) -> f64 {
    if x == 0.0 { 0.0 } else { libm::jn(2, x) / x - j1 }
}

fn lambert_slope(w: f64) -> f64 {
    exp(-w) / (1.0 + w)
}

fn lambert_curvature(w: f64) -> f64 {
    -square(lambert_slope(w)) * (2.0 + w) / (1.0 + w)
}

fn sign(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() { x } else { x.signum() }
}

fn step(x: f64) -> f64 {
    if x.is_nan() { x } else { f64::from(u8::from(x >= 0.0)) }
}

/// Maximum number of iterations. Halley's method converges cubically, here in at most five steps.
const MAX_STEPS: usize = 16;

/// Difference between Euler's number e and its nearest `f64`.
const E_REST: f64 = 1.445_646_891_729_250_2e-16;

/// Below this argument, [`lambert_w`] is computed from its distance to the branch point.
const NEAR_BRANCH: f64 = -0.25;

/// Computes the principal branch of W, `w >= -1` with w*exp(w) = x; NaN for x < -1/e.
pub(super) fn lambert_w(x: f64) -> f64 {
    if x < NEAR_BRANCH {
        return above_branch_point(x) - 1.0;
    }
    if x.is_nan() || x.is_infinite() {
        return x;
    }
    let mut w = log1p(x);
    for _ in 0..MAX_STEPS {
        let step = halley(w, x);
        w -= step;
        if fabs(step) <= f64::EPSILON * fabs(w) {
            break;
        }
    }
    w
}

/// Computes d = W + 1 for x from -1/e to -1/4 from (d - 1) exp(d) + 1 = e x + 1. The left side is
/// the sum of (n - 1) d^n / n! from n = 2, so no digits cancel. NaN for x < -1/e.
fn above_branch_point(x: f64) -> f64 {
    let (product, error) = product_with_error(std::f64::consts::E, x);
    let offset = (product + 1.0) + (error + E_REST * x);
    // The `f64` next to -1/e is less than -1/e by 1.2e-17.
    if fabs(offset) <= f64::EPSILON {
        return sqrt(2.0 * offset.max(0.0));
    }
    let mut d = sqrt(2.0 * offset);
    for _ in 0..MAX_STEPS {
        let (mut term, mut sum) = (d, 0.0);
        for n in 2..24 {
            term *= d / f64::from(n);
            sum += f64::from(n - 1) * term;
        }
        d -= (sum - offset) / (d * exp(d));
    }
    d
}

/// Returns the rounded product of two numbers and its rounding error (Dekker 1971, Mul12).
fn product_with_error(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let scaled = 134_217_729.0 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let (product, (a_high, a_low), (b_high, b_low)) = (a * b, halves(a), halves(b));
    let rest = ((a_high * b_high - product) + a_high * b_low) + a_low * b_high;
    (product, rest + a_low * b_low)
}

/// Returns the step of Halley's method for w*exp(w) - x, divided by exp(w) to avoid overflow.
fn halley(w: f64, x: f64) -> f64 {
    let residual = w - x * exp(-w);
    residual / (w + 1.0 - 0.5 * residual * (w + 2.0) / (w + 1.0))
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::lambert_w;

    /// Below zero, the values are solutions of w*exp(w) = x, computed with 60 digits.
    #[rstest]
    #[case(0.0, 0.0)]
    #[case(1e-300, 1e-300)]
    #[case(1e-9, 9.999_999_99e-10)]
    #[case(1.0, 0.567_143_290_409_783_8)]
    #[case(std::f64::consts::E, 1.0)]
    #[case(1e3, 5.249_602_852_401_596)]
    #[case(1e300, 684.247_208_629_760_8)]
    #[case(f64::INFINITY, f64::INFINITY)]
    #[case(-1e-300, -1e-300)]
    #[case(-1e-09, -1.000_000_001e-09)]
    #[case(-0.003_9, -0.003_915_299_600_155_102)]
    #[case(-0.1, -0.111_832_559_158_962_97)]
    #[case(-0.2, -0.259_171_101_819_073_77)]
    #[case(-0.25, -0.357_402_956_181_388_9)]
    #[case(-0.250_000_1, -0.357_403_178_655_526_45)]
    #[case(-0.3, -0.489_402_227_180_214_9)]
    #[case(-0.35, -0.716_638_816_456_073_6)]
    #[case(-0.367, -0.932_399_184_747_928_3)]
    #[case(-0.367_87, -0.992_852_729_821_527_7)]
    #[case(-0.367_879_441, -0.999_969_470_698_208_6)]
    #[case(-0.367_879_441_17, -0.999_997_199_763_411_1)]
    #[case(-1.0 / std::f64::consts::E, -1.0)]
    fn agrees_with_known_values(#[case] x: f64, #[case] w: f64) {
        let max_relative = 4.0 * f64::EPSILON;
        approx::assert_relative_eq!(lambert_w(x), w, epsilon = 0.0, max_relative = max_relative);
    }

    #[test]
    fn is_not_defined_below_the_branch_point() {
        for x in [-0.367_879_442, -0.5, f64::NEG_INFINITY, f64::NAN] {
            assert!(lambert_w(x).is_nan(), "{x}");
        }
    }
}
