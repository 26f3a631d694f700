//! Compares a sum over the body, such as its energy or momentum, with the exact value.

use super::declaration::{ComputedSum, SumDeclaration, moments};
use crate::exact::{BodySum, Problem, SumRegion};
use crate::verify::{Norms, Quantity};
use mpm_subject::Subject;

/// A sum over the body, such as its energy or momentum, that is compared with the exact value.
#[derive(Debug)]
pub struct JudgedSum {
    computed: ComputedSum,
    exact: BodySum,
    /// Exact second moments (kg m2) of the reference body, the divisor of a ratio of moments.
    reference: [f64; 3],
    /// Axis of the face whose reaction is judged, and whether it is high; `None` for all faces.
    face: Option<(usize, bool)>,
}

impl JudgedSum {
    /// Prepares the comparison of a sum over the body of `problem`, or of the force on `walls`.
    ///
    /// # Errors
    /// Reason why the exact value is unknown, as a phrase that follows the name of the quantity.
    pub fn new(of: Quantity, problem: &Problem, walls: &[usize]) -> Result<Self, String> {
        let SumDeclaration { computed, density, .. } = of.sum().ok_or("is a field")?;
        let region = match computed {
            ComputedSum::OfTotals(_) | ComputedSum::OfMoments(_) => SumRegion::Body,
            ComputedSum::Reaction => SumRegion::Faces(walls.to_vec()),
        };
        let sum =
            |density| BodySum::new(problem, &region, density).map_err(|error| error.to_string());
        let exact = sum(density)?;
        let reference = match computed {
            ComputedSum::OfMoments(_) => {
                sum(|point| moments(point.reference_second_moment()))?.at(problem.until)
            }
            ComputedSum::OfTotals(_) | ComputedSum::Reaction => [0.0; 3],
        };
        let face = match walls {
            [one] => problem.faces.get(*one).map(|face| (face.axis, face.high)),
            _ => None,
        };
        Ok(Self { computed, exact, reference, face })
    }

    /// Returns the scale of errors: the largest size of the exact sum during the run.
    pub fn size(&self) -> f64 {
        let size = self.exact.size();
        match self.computed {
            ComputedSum::OfMoments(_) => (size / self.reference.iter().sum::<f64>()).sqrt(),
            _ => size,
        }
    }

    /// Returns the difference from the exact sum at time `t` (s); NaN if the solver does not report
    /// the sum.
    pub(super) fn error(&self, subject: &dyn Subject, t: f64) -> [f64; 3] {
        let found = match self.computed {
            ComputedSum::OfTotals(value) => {
                subject.totals().and_then(|totals| value(&totals)).map(|value| (t, value))
            }
            ComputedSum::OfMoments(value) => subject
                .totals()
                .map(|totals| (t, value(totals.second_moment, totals.reference_second_moment))),
            ComputedSum::Reaction => {
                subject.reaction(self.face).map(|reaction| (reaction.time, reaction.force))
            }
        };
        let Some((t, value)) = found else { return [f64::NAN; 3] };
        let exact = match self.computed {
            ComputedSum::OfMoments(value) => value(self.exact.at(t), self.reference),
            _ => self.exact.at(t),
        };
        std::array::from_fn(|i| value[i] - exact[i])
    }
}

pub(super) fn over_instants(errors: &[[f64; 3]]) -> Norms {
    Norms::of(errors.as_flattened(), 3, &vec![1.0; errors.len()])
}
