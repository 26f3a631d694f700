//! Checks of an exact motion: equation of motion, boundary conditions and initial conditions.

pub(crate) mod boundary;
pub(crate) mod differences;
pub(crate) mod event;
pub(crate) mod friction;
pub(crate) mod interface;
pub(crate) mod pointwise;
pub(crate) mod space_time_patch;
pub(crate) mod survey;
pub(crate) mod weak;

use self::event::greatest;
use self::survey::Survey;
use super::problem::{Linearised, Problem};
use super::violation::Violation;

impl Problem {
    /// Checks the motion at reproducible random points: the equation (pointwise and in weak form),
    /// the boundary conditions and the initial conditions.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check(&self) -> Result<(), Violation> {
        self.check_with(&Survey::new(self))
    }

    /// Checks the motion like [`check`](Self::check), relative to the magnitudes in `survey`. For
    /// several bodies, these must be the maxima over all bodies.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check_with(&self, survey: &Survey) -> Result<(), Violation> {
        pointwise::presence(self, survey)?;
        pointwise::uniaxial_strain(self, survey)?;
        pointwise::initial(self, survey)?;
        pointwise::known_stress(self, survey)?;
        boundary::boundary(self, survey)?;
        boundary::driven(self, survey)?;
        pointwise::tractions_on_rims(self, survey)?;
        pointwise::monotone_loading(self, survey)?;
        differences::differentiation(self, survey)?;
        pointwise::equation(self, survey)?;
        weak::momentum(self, survey)
    }

    /// Returns the violation of the condition on face number `face`, or `None` if there is none.
    pub fn violation_on_face(&self, face: usize, survey: &Survey) -> Option<Violation> {
        let face = self.faces.get(face)?;
        boundary::conditions(self, std::slice::from_ref(face), survey).err()
    }

    /// Returns the largest relative residual of the equation of motion and of tractions; NaN if it
    /// is not finite, or if a condition that does not involve the law is violated.
    pub fn residual(&self) -> f64 {
        let problems =
            if self.bodies.is_empty() { std::slice::from_ref(self) } else { &self.bodies };
        let surveys = Survey::of_each(problems);
        let each = problems.iter().zip(&surveys).map(|(problem, survey)| {
            let any = Linearised { tolerance: f64::INFINITY, because: String::new() };
            let loose = Self { linearised: Some(any), ..problem.clone() };
            let left = [boundary::boundary, pointwise::tractions_on_rims, pointwise::equation]
                .map(|left| left(&loose, survey));
            greatest(left.into_iter().map(|left| left.unwrap_or(f64::NAN)))
        });
        greatest(each)
    }
}

#[cfg(test)]
mod tests {
    use super::boundary::boundary;
    use super::event::share;
    use super::*;
    use crate::exact::law::TaitLaw;
    use crate::exact::tests::{assert_violated, bar, fixed, free};
    use rstest::rstest;

    /// A wave of small amplitude in Tait's fluid between walls. The residual is K u_XX times 8 u_X.
    /// The inertia and stress terms, by which the residual is divided, have the sum 2 K u_XX.
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
            assert_violated(refused.check(), "equation of motion");
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
