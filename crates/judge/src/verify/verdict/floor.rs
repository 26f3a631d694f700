//! Determines the cause of an error floor by refining another axis.
//!
//! The finest level is repeated with half the spacing of one other axis at a time, which does not
//! change the error terms of other spacings (Roy 2005, J. Comput. Phys. 205, 131).

use crate::verify::{Axis, format_number};
use mpm_subject::named;

/// Minimum relative decrease of the error, due to half the spacing of an axis, for which this axis
/// is the cause. A decrease by a quarter means that the axis causes half of the error if its order
/// is one, and a third if its order is two.
const LEAST_FALL: f64 = 0.25;

named! {
    /// Cause of an error floor.
    pub enum FloorCause {
        /// Error of the time step.
        Time = "time",
        /// Error of the cell size.
        Space = "space",
        /// Error of the particle spacing.
        Particles = "particles",
        /// None of the refined axes: an error of the model, the method or the reference, or
        /// round-off.
        Nothing = "none",
    }
}

/// Result of repeating the finest level with half the spacing of one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Axis whose spacing is halved.
    pub axis: Axis,
    /// Error with half the spacing, or the reason why there is none.
    pub error: Result<f64, String>,
}

/// Errors of the finest level with half the spacing of other axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Floor {
    /// Error of the finest level.
    pub error: f64,
    /// One probe for each refined axis.
    pub probes: Vec<Probe>,
}

impl Floor {
    /// Returns the cause of the floor: of the axes that lower the error enough, the one with the
    /// largest effect. [`FloorCause::Nothing`] requires that every probe reached its end.
    pub fn cause(&self) -> Option<FloorCause> {
        let errors =
            self.probes.iter().filter_map(|probe| Some((probe, *probe.error.as_ref().ok()?)));
        let falls = |error: f64| self.error > 0.0 && error <= (1.0 - LEAST_FALL) * self.error;
        let most =
            errors.filter(|(_, error)| falls(*error)).min_by(|(_, a), (_, b)| a.total_cmp(b));
        match most {
            Some((probe, _)) => Some(match probe.axis {
                Axis::Time => FloorCause::Time,
                Axis::Space => FloorCause::Space,
                Axis::Particles => FloorCause::Particles,
            }),
            None => self.told().then_some(FloorCause::Nothing),
        }
    }

    fn told(&self) -> bool {
        let told = |probe: &Probe| probe.error.as_ref().is_ok_and(|error| error.is_finite());
        !self.probes.is_empty() && self.probes.iter().all(told)
    }

    /// Returns a sentence with the cause and the measured errors.
    pub fn sentence(&self) -> String {
        let of = |axis: Axis| format!("the main cause of the error is the {}", axis.noun());
        let finding = match self.cause() {
            Some(FloorCause::Time) => of(Axis::Time),
            Some(FloorCause::Space) => of(Axis::Space),
            Some(FloorCause::Particles) => of(Axis::Particles),
            Some(FloorCause::Nothing) => {
                "no refinement tested here lowers the error by a quarter".to_owned()
            }
            None => "the cause of the error is unknown".to_owned(),
        };
        let probe = |probe: &Probe| {
            let axis = probe.axis.noun();
            match &probe.error {
                Ok(error) => format!("with half the {axis} it is {}", format_number(*error)),
                Err(reason) => format!("with half the {axis} it is not available ({reason})"),
            }
        };
        let (told, failed): (Vec<_>, Vec<_>) =
            self.probes.iter().partition(|probe| probe.error.is_ok());
        let probes: Vec<String> = told.into_iter().chain(failed).map(probe).collect();
        let error = format_number(self.error);
        format!("on the finest level {finding}; the error is {error}; {}", probes.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Axis::{Particles, Space, Time};
    use rstest::rstest;

    fn floor(error: f64, probes: &[(Axis, Result<f64, &str>)]) -> Floor {
        let probe = |(axis, error): &(Axis, Result<f64, &str>)| Probe {
            axis: *axis,
            error: error.map_err(str::to_owned),
        };
        Floor { error, probes: probes.iter().map(probe).collect() }
    }

    #[rstest]
    #[case::first_order(1.0, &[(Time, Ok(0.5)), (Particles, Ok(1.0))], Some(FloorCause::Time))]
    #[case::the_larger_fall(1.0, &[(Time, Ok(0.7)), (Space, Ok(0.3))], Some(FloorCause::Space))]
    #[case::no_fall(1.0, &[(Time, Ok(0.8)), (Particles, Ok(1.2))], Some(FloorCause::Nothing))]
    #[case::one_broke(1.0, &[(Time, Ok(0.9)), (Particles, Err("J"))], None)]
    #[case::one_broke_the_other_tells(1.0, &[(Time, Err("J")), (Particles, Ok(0.1))], Some(FloorCause::Particles))]
    #[case::not_a_number(1.0, &[(Time, Ok(f64::NAN))], None)]
    #[case::from_nan(f64::NAN, &[(Time, Ok(0.1))], Some(FloorCause::Nothing))]
    #[case::nothing_to_lower(0.0, &[(Time, Ok(0.0))], Some(FloorCause::Nothing))]
    #[case::nothing_tried(1.0, &[], None)]
    fn causes(
        #[case] error: f64,
        #[case] probes: &[(Axis, Result<f64, &str>)],
        #[case] cause: Option<FloorCause>,
    ) {
        assert_eq!(floor(error, probes).cause(), cause);
    }

    #[test]
    fn sentences() {
        assert_eq!(
            floor(1.0, &[(Time, Ok(0.5)), (Particles, Ok(1.0))]).sentence(),
            "on the finest level the main cause of the error is the time step; the error is 1; \
             with half the time step it is 0.5, with half the particle spacing it is 1"
        );
        assert_eq!(
            floor(1.0, &[(Space, Err("J"))]).sentence(),
            "on the finest level the cause of the error is unknown; the error is 1; with half \
             the cell size it is not available (J)"
        );
    }
}
