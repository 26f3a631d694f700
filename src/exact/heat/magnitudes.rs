//! The temperature at many places and times, and the largest terms of its equation.

use super::equation;
use super::field::TemperatureDerivatives;
use super::problem::Conduction;
use crate::exact::check::event::{EVENTS, Event, SpaceTimeBox, greatest, largest};
use crate::exact::motion::Derivatives;
use crate::exact::random::Random;

/// A place and time, with the motion and the temperature there.
pub(super) type HeatPoint = (Event, Derivatives, TemperatureDerivatives);

/// The box of the body, and the times of the run.
pub(super) fn extent(problem: &Conduction) -> SpaceTimeBox<'_> {
    SpaceTimeBox { from: &problem.from, to: &problem.to, start: 0.0, end: problem.until }
}

/// Events spread over the body and the run.
pub(super) fn interior(problem: &Conduction) -> Vec<HeatPoint> {
    let events = extent(problem).spread(EVENTS, |_| true, &mut Random::new(1));
    let point = |event: Event| {
        let (motion, now) = problem.now(&event.label, event.t);
        (event, motion, now)
    };
    events.into_iter().map(point).collect()
}

/// The largest magnitudes of a temperature and of the terms of its equation; NaN if any is NaN.
pub(super) struct HeatMagnitudes {
    /// Temperature (K).
    pub(super) value: f64,
    /// Difference of the highest and the lowest temperature (K).
    pub(super) range: f64,
    /// Rate (K/s).
    pub(super) rate: f64,
    /// Gradient (K/m).
    pub(super) gradient: f64,
    /// Second derivatives (K/m2).
    pub(super) curvature: f64,
    /// Flow of heat (W/m^(D-1)).
    pub(super) inflow: f64,
    /// Divergence of the flow (W/m^D).
    pub(super) divergence: f64,
    /// Sum of all terms of the heat equation (W/kg).
    pub(super) terms: f64,
}

impl HeatMagnitudes {
    pub(super) fn of(problem: &Conduction, points: &[HeatPoint]) -> Self {
        let of = |quantity: &dyn Fn(&HeatPoint) -> f64| {
            greatest(points.iter().map(|point| quantity(point).abs()))
        };
        let d = problem.dimension();
        let lowest = points.iter().fold(f64::INFINITY, |low, point| low.min(point.2.value));
        Self {
            range: of(&|(_, _, now)| now.value - lowest),
            value: of(&|(_, _, now)| now.value),
            rate: of(&|(_, _, now)| now.rate),
            gradient: of(&|(_, _, now)| largest(&now.grad)),
            curvature: of(&|(_, _, now)| greatest(now.second.iter().map(largest))),
            inflow: of(&|(_, motion, now)| largest(&problem.inflow(motion, now))),
            divergence: of(&|(_, motion, now)| {
                problem.conductivity * equation::divergence(d, motion, now)
            }),
            terms: of(&|point| {
                let (needed, stated) = needed_and_stated(problem, point);
                let stored = problem.capacity * point.2.rate;
                stored.abs() + (needed - stored).abs() + stated.abs()
            }),
        }
    }
}

/// The heat source (W/kg) that the temperature needs, and the stated one.
pub(super) fn needed_and_stated(
    problem: &Conduction,
    (event, motion, now): &HeatPoint,
) -> (f64, f64) {
    (problem.balance(motion, now), problem.source(&event.label, event.t, motion, now))
}
