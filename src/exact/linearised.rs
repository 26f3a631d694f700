//! Motions that solve only the linearised problem.

/// The residual that a linearised motion may have in the conditions that involve the law: the
/// equation of motion and tractions. Conditions that are linear in u are still checked with the
/// tolerance of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    /// Maximum residual, relative to the terms of the condition.
    pub tolerance: f64,
    /// Reason for accepting a linearised motion.
    pub because: String,
}

/// Returns the magnitude of a residual `left`, divided by `size` of the same unit; 0 if `left` is
/// 0.
pub(super) fn share(left: f64, size: f64) -> f64 {
    if left == 0.0 { 0.0 } else { left.abs() / size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::check::boundary::boundary;
    use crate::exact::law::TaitLaw;
    use crate::exact::tests::{bar, fixed, free};
    use crate::exact::{Problem, Survey};
    use rstest::rstest;

    /// A small-amplitude wave in Tait's fluid between walls. The residual is K u_XX times 8 u_X,
    /// compared with a sum of inertia and stress of 2 K u_XX. The product of sine and cosine is at
    /// most 1/2.
    #[rstest]
    #[case(1e-3)]
    #[case(1e-6)]
    fn a_linearised_wave_leaves_twice_its_strain(#[case] strain: f64) {
        let wave = format!("{strain}/pi*sin(pi*X)*cos(pi*t)");
        let linear = Problem { equation: TaitLaw::new(2.0, 0.0).into(), ..bar(&wave, fixed()) };
        let left = linear.residual();
        assert!((1.9 * strain..2.1 * strain).contains(&left), "{left}");
        let to = |tolerance| Problem {
            linearised: Some(Linearised { tolerance, because: "strains are small".to_owned() }),
            ..linear.clone()
        };
        to(1.01 * left).check().unwrap();
        for refused in [linear.clone(), to(0.99 * left)] {
            let found = refused.check().unwrap_err();
            assert!(found.condition.starts_with("equation of motion"), "{found}");
        }
    }

    /// A linear law leaves only rounding errors. A violated condition that does not involve the law
    /// gives NaN.
    #[test]
    fn the_residual_is_that_of_the_law() {
        let wave = "sin(pi*X)*cos(pi*t)/50";
        assert!(bar(wave, fixed()).residual() < 1e-12);
        assert!(bar(wave, free()).residual() > 0.1, "a traction at the right end");
        let shifted = bar("0.01 + sin(pi*X)*cos(pi*t)/50", fixed());
        assert!(shifted.residual().is_nan(), "the left end is fixed");
    }

    #[test]
    fn a_residual_is_a_share_of_what_it_is_compared_with() {
        assert_eq!(share(-2.0, 4.0), 0.5);
        assert_eq!(share(0.0, 0.0), 0.0);
        assert_eq!(share(1.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn a_traction_that_presses_is_left_over_too() {
        let left = |u| {
            let linearised = Some(Linearised { tolerance: f64::INFINITY, because: String::new() });
            let problem = Problem { linearised, ..bar(u, free()) };
            boundary(&problem, &Survey::new(&problem)).unwrap()
        };
        assert!(left("X/50") > 0.1 && left("X/50") == left("-X/50"), "{}", left("-X/50"));
    }
}
