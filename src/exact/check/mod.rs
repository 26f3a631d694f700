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
use super::linearised::Linearised;
use super::problem::Problem;
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

    /// Like [`check`](Self::check), with a `survey` whose magnitudes are maxima over all bodies.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check_with(&self, survey: &Survey) -> Result<(), Violation> {
        pointwise::presence(self, survey)?;
        pointwise::initial(self, survey)?;
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
        let faces = self.faces.get(face).into_iter().cloned().collect();
        boundary::boundary(&Self { faces, ..self.clone() }, survey).err()
    }

    /// Returns the largest relative residual of the conditions that involve the law: the equation
    /// of motion, and tractions on faces and rims. NaN if another condition is violated, or if the
    /// residual is not finite.
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
