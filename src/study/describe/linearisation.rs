//! The residual of a linearised solution, and the error of the displacement that comes of it.

use crate::exact::Problem;
use crate::study::preflight::extremes::Extremes;
use crate::suite::NormName;
use crate::suite::compile::wording::shown;
use crate::suite::model::{ConvergencePlan, Suite};

/// Radians of a motion in which a wave runs through the body, below which the body follows a force
/// as if it were at rest: the second harmonic of the motion is then a fifth of its lowest mode.
const SLOW: f64 = 0.3;

/// The residual of a linearised solution, and its error.
#[derive(Debug, Clone, Copy)]
pub struct Linearisation {
    /// Residual of the equation of motion and of tractions, relative to their terms.
    pub residual: f64,
    /// Estimated error (m) of the displacement at the end, or the largest of the run if the suite
    /// judges the largest over the instants.
    pub error: f64,
}

impl Linearisation {
    /// The linearisation of `problem` after a time `t` (s), if it is linearised; `motion` are its
    /// extremes.
    ///
    /// The error is the root mean square of the first correction where that is computed
    /// ([`Problem::first_correction`]), for motions along one axis. For others it is estimated from
    /// the residual, to about a factor of ten:
    ///
    /// Inertia and stress are of the size of the acceleration a = omega^2 u each, so that a
    /// residual r is a force 2 r a per unit mass. It comes to r a t^2; later, where it swings with
    /// a mode as the second harmonic of a wave without dispersion does, to r a t/omega. A body so
    /// stiff that it follows at once is moved by no more than a held bar of its length L,
    /// r a L^2/c^2. At rest the error is about a share r of u.
    pub(crate) fn of(problem: &Problem, motion: &Extremes, t: f64, norm: NormName) -> Option<Self> {
        problem.linearised.as_ref()?;
        let (residual, u) = (problem.residual(), motion.largest_displacement());
        let omega = if u > 0.0 { (motion.acceleration / u).sqrt() } else { 0.0 };
        let lengths = problem.from.iter().zip(&problem.to).map(|(from, to)| to - from);
        let crossing =
            lengths.fold(0.0, f64::max) / (problem.equation.modulus() / problem.density).sqrt();
        let (turned, waved) = (omega * t, omega * crossing);
        let growth = turned * turned.min(1.0);
        let growth = if waved < SLOW { growth.min(waved * waved) } else { growth };
        let growth = if problem.at_rest { 1.0 } else { growth };
        let computed = problem.first_correction(t).map(|correction| {
            if norm.is_over_instants() { correction.largest } else { correction.at_end }
        });
        let error = computed.unwrap_or(residual * u * growth);
        Some(Self { residual, error })
    }
}

/// That of the solution of a suite after its run, if it is linearised.
pub fn linearisation(suite: &Suite) -> Option<Linearisation> {
    let plan = suite.plan::<ConvergencePlan>()?;
    let problem = plan.exact.as_ref()?;
    Linearisation::of(problem, &Extremes::of(problem), problem.until, plan.norm)
}

/// The row of a report: residual, tolerance, error and reason.
pub(crate) fn row(problem: &Problem, norm: NormName) -> String {
    let Some(stated) = &problem.linearised else { return String::new() };
    let left = Linearisation::of(problem, &Extremes::of(problem), problem.until, norm);
    let when = if norm.is_over_instants() { "during the run" } else { "at the end" };
    let (residual, error) = left.map_or((f64::NAN, f64::NAN), |left| (left.residual, left.error));
    let allowed = shown(stated.tolerance);
    format!(
        "{residual:.1e} of the terms of its equations is left ({allowed} allowed), an error of about \
         {error:.0e} m {when}, because {}",
        stated.because
    )
}
