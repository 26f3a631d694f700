//! Checks of an exact temperature: heat equation, boundary conditions and initial conditions.
//!
//! The weak form detects heat sources on surfaces, where the temperature has a kink.
//!
//! For any smooth `phi` that vanishes on the boundary of a patch,
//! `int int (rho0 c T phi_t - k J C^-1 Grad T . Grad phi + rho0 s phi) dX dt = 0`.

use super::field;
use super::field::TemperatureDerivatives;
use super::problem::{Conduction, HeatFace, HeatFacePoint};
use crate::exact::check::differences::{DIFFERENCE_TOLERANCE, away_from_kinks, step};
use crate::exact::check::event::{
    EVENTS, Event, FACE_EVENTS, OnFace, SpaceTimeBox, greatest, largest,
};
use crate::exact::check::space_time_patch::{Densities, Raster, SpaceTimePatch, bump, labels};
use crate::exact::check::weak::{Sums, balances, patches};
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, Motion};
use crate::exact::random::Random;
use crate::exact::violation::{LargestViolation, Violation};

impl Conduction {
    /// Checks the temperature at reproducible random points: the heat equation (pointwise and in
    /// weak form), the boundary conditions and the initial conditions.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check(&self) -> Result<(), Violation> {
        let points = interior(self);
        let largest = HeatMagnitudes::from_points(self, &points);
        presence(&points, &largest)?;
        initial(self, &largest)?;
        boundary(self, &largest)?;
        away_from_kinks(points.iter().map(|point| &point.0), |event| {
            differences(self, event, &largest)
        })?;
        equation(self, &points, largest.terms)?;
        balance(self, &largest)
    }
}

/// Checks that the temperature is finite in the whole body and not identically zero.
fn presence(points: &[HeatPoint], largest: &HeatMagnitudes) -> Result<(), Violation> {
    let wrong = |(event, _, now): &HeatPoint, what: &str| {
        event.violation(format!("the temperature is {what}"), None, now.value, None, "K")
    };
    if let Some(point) = points.iter().find(|(_, _, now)| !now.value.is_finite()) {
        return Err(wrong(point, "not finite"));
    }
    match points.first() {
        Some(point) if !(largest.value > 0.0) => Err(wrong(point, "zero everywhere, for example")),
        _ => Ok(()),
    }
}

/// Checks `T(X, 0) = T0(X)`.
fn initial(problem: &Conduction, largest: &HeatMagnitudes) -> Result<(), Violation> {
    let start = SpaceTimeBox { end: 0.0, ..extent(problem) };
    let mut worst = LargestViolation::default();
    for event in start.spread(FACE_EVENTS, |_| true, &mut Random::new(2)) {
        let found = problem.temperature.at(&event.label, 0.0);
        // An initial temperature that is not prescribed is the exact one, which must be finite.
        let start = problem.initial.as_ref().map_or(found, |start| start.at(&event.label, 0.0));
        let name = "initial condition T(X, 0) = T0(X)".to_owned();
        let allowed = problem.tolerance * largest.value;
        worst.add(event.judge_condition(allowed, name, (start, found), "K"));
    }
    worst.into_result()
}

fn boundary(problem: &Conduction, sizes: &HeatMagnitudes) -> Result<(), Violation> {
    let mut random = Random::new(3);
    for face in &problem.faces {
        let mut found = LargestViolation::default();
        let on_face = OnFace::new(&problem.from, &problem.to, face.axis, face.high);
        for event in on_face.extent(&extent(problem)).spread(FACE_EVENTS, |_| true, &mut random) {
            let (motion, now) = problem.now(&event.label, event.t);
            let inflow = inflow_at(problem, face, &motion, &now);
            let point = HeatedPoint { problem, face, event, now, inflow, sizes };
            found.add(face.condition.check(&point));
        }
        found.into_result()?;
    }
    Ok(())
}

struct HeatedPoint<'a> {
    problem: &'a Conduction,
    face: &'a HeatFace,
    event: Event,
    now: TemperatureDerivatives,
    /// Heat inflow (W/m^(D-1)).
    inflow: f64,
    sizes: &'a HeatMagnitudes,
}

impl HeatedPoint<'_> {
    fn condition(&self, what: &str) -> String {
        format!("boundary condition: {} {what}", self.face.name)
    }
}

impl HeatFacePoint for HeatedPoint<'_> {
    fn value(&self, formula: &Formula) -> f64 {
        formula.at(&self.event.label, self.event.t)
    }

    fn temperature(&self) -> f64 {
        self.now.value
    }

    fn largest_temperature(&self) -> f64 {
        self.sizes.value
    }

    fn has_temperature(&self, given: f64) -> Result<(), Violation> {
        let allowed = self.problem.tolerance * self.sizes.value.max(given.abs());
        let name = self.condition("has a given temperature, but the solution has another one");
        self.event.judge(allowed, name, (given, self.now.value), "K")
    }

    fn lets_in(&self, what: &str, given: f64, size: f64) -> Result<(), Violation> {
        let allowed = self.problem.tolerance * greatest([self.sizes.inflow, size].into_iter());
        self.event.judge(
            allowed,
            self.condition(&format!("{what}, but the heat inflow is another one")),
            (given, self.inflow),
            "W/m2",
        )
    }

    fn continues_on_opposite_face(&self) -> Result<(), Violation> {
        let Self { problem, face, event, now, inflow, sizes } = self;
        let opposite = event.opposite(&problem.from, &problem.to, face.axis, face.high);
        let (there, warm) = problem.now(&opposite, event.t);
        let title = self
            .condition("is periodic, but the temperature differs from that on the opposite face");
        event.judge(problem.tolerance * sizes.value, title, (warm.value, now.value), "K")?;
        let across = inflow_at(problem, face, &there, &warm);
        let title =
            self.condition("is periodic, but the heat flux differs from that on the opposite face");
        event.judge(problem.tolerance * sizes.inflow, title, (across, *inflow), "W/m2")
    }
}

/// Computes the heat inflow through `face` from outside (W/m^(D-1)).
fn inflow_at(
    problem: &Conduction,
    face: &HeatFace,
    motion: &Derivatives,
    now: &TemperatureDerivatives,
) -> f64 {
    let normal = if face.high { 1.0 } else { -1.0 };
    normal * problem.inflow(motion, now)[face.axis]
}

/// Compares T_t and Div Q from automatic differentiation with central differences.
fn differences(
    problem: &Conduction,
    event: &Event,
    largest: &HeatMagnitudes,
) -> Result<(), Violation> {
    let (motion, now) = problem.now(&event.label, event.t);
    let over_time = step(problem.until, &[largest.value, largest.rate]);
    let scales = [largest.value, largest.gradient, largest.curvature];
    let value = |t: f64| problem.temperature.at(&event.label, t);
    let (low, high) = (value(event.t - over_time), value(event.t + over_time));
    let rounding = 1e-13 * (low.abs() + high.abs()) / over_time;
    let name = "two differentiations of T in time disagree".to_owned();
    let slope = (high - low) / (2.0 * over_time);
    event.judge(DIFFERENCE_TOLERANCE * largest.rate + rounding, name, (slope, now.rate), "K/s")?;
    let (mut divergence, mut size) = (0.0, 0.0);
    for axis in 0..problem.dimension() {
        let step = step(problem.to[axis] - problem.from[axis], &scales);
        let inflow = |sign: f64| {
            let mut label = event.label.clone();
            label[axis] += sign * step;
            let (motion, now) = problem.now(&label, event.t);
            problem.inflow(&motion, &now)[axis]
        };
        let (low, high) = (inflow(-1.0), inflow(1.0));
        divergence += (high - low) / (2.0 * step);
        size += (high.abs() + low.abs()) / step;
    }
    let exact = problem.conductivity * field::divergence(problem.dimension(), &motion, &now);
    let name = "two computations of Div Q disagree".to_owned();
    let allowed = DIFFERENCE_TOLERANCE * largest.divergence + 1e-9 * size;
    event.judge(allowed, name, (divergence, exact), "W/m3")
}

/// Compares the source s that `rho0 c T_t = Div (k J C^-1 Grad T) + rho0 s` requires with the
/// prescribed source.
fn equation(problem: &Conduction, points: &[HeatPoint], size: f64) -> Result<(), Violation> {
    let mut found = LargestViolation::default();
    for point in points {
        let (needed, stated) = needed_and_stated(problem, point);
        let name = "heat equation, rho0 c T_t = Div(k Grad T) + rho0 s, solved for s,".to_owned();
        let allowed = problem.tolerance * size;
        found.add(point.0.judge_condition(allowed, name, (needed, stated), "W/kg"));
    }
    found.into_result()
}

/// Checks the heat balance on random patches; terms far below the `largest` ones are ignored.
pub(super) fn balance(problem: &Conduction, largest: &HeatMagnitudes) -> Result<(), Violation> {
    let densities = Densities {
        stored: problem.density * problem.capacity * largest.range,
        flow: largest.inflow,
        supply: problem.density * largest.terms,
    };
    let mut random = Random::new(6);
    let smooth =
        problem.temperature.is_smooth() && problem.motion.as_ref().is_none_or(Motion::is_smooth);
    for _ in 0..patches(smooth) {
        let (from, to) = (&problem.from[..], &problem.to[..]);
        let patch = SpaceTimePatch::in_box(&mut random, from, to, problem.until, f64::INFINITY);
        let d = problem.dimension();
        // A constant temperature is subtracted: it would increase the scale of the imbalance.
        let middle = problem.temperature.at(&patch.centre[..d], patch.centre[d]);
        let condition = "heat balance across kinks (the heat equation";
        balances(patch, condition, &densities, |raster, smallest| {
            [sums(problem, raster, smallest, middle)]
        })?;
    }
    Ok(())
}

/// Computes the balance on a raster of a patch, for the temperature relative to `middle` (K).
fn sums(problem: &Conduction, raster: &Raster, smallest: f64, middle: f64) -> Sums {
    let d = problem.dimension();
    let Raster { points, times } = raster;
    let labels = labels(points);
    let labels: Vec<&[f64]> = labels.iter().map(Vec::as_slice).collect();
    let mut warm = problem.temperature.at_places(&labels);
    let mut places = problem.motion.as_ref().map(|motion| motion.at_places(&labels));
    let (mut all, [mut motion, mut now]) = (Sums::new(smallest), [Derivatives::default(); 2]);
    for time in times {
        warm.set_time(time.at);
        if let Some(places) = &mut places {
            places.set_time(time.at);
        }
        for (place, point) in points.iter().enumerate() {
            if let Some(places) = &mut places {
                places.derivatives(place, &mut motion);
            }
            warm.derivatives(place, &mut now);
            let now = TemperatureDerivatives::from(now);
            let mut event = [*time; 4];
            event[..d].copy_from_slice(point);
            let (phi, slope) = bump(&event[..=d]);
            let stored = problem.density * problem.capacity * (now.value - middle) * slope[d];
            let inflow = problem.inflow(&motion, &now);
            let flow: f64 = (0..d).map(|a| inflow[a] * slope[a]).sum();
            let source = problem.source(labels[place], time.at, &motion, &now);
            let source = problem.density * source * phi;
            let size = stored.abs() + flow.abs() + source.abs();
            all.add(-stored, source - flow, size, &event[..=d]);
        }
    }
    all
}

pub(super) type HeatPoint = (Event, Derivatives, TemperatureDerivatives);

pub(super) fn extent(problem: &Conduction) -> SpaceTimeBox<'_> {
    SpaceTimeBox { from: &problem.from, to: &problem.to, start: 0.0, end: problem.until }
}

pub(super) fn interior(problem: &Conduction) -> Vec<HeatPoint> {
    let events = extent(problem).spread(EVENTS, |_| true, &mut Random::new(1));
    let point = |event: Event| {
        let (motion, now) = problem.now(&event.label, event.t);
        (event, motion, now)
    };
    events.into_iter().map(point).collect()
}

/// The largest magnitudes of a temperature and of the heat equation's terms; NaN if any is NaN.
pub(super) struct HeatMagnitudes {
    pub(super) value: f64,
    /// Difference between highest and lowest temperature (K).
    pub(super) range: f64,
    pub(super) rate: f64,
    pub(super) gradient: f64,
    pub(super) curvature: f64,
    /// Heat flow (W/m^(D-1)).
    pub(super) inflow: f64,
    /// Divergence of the heat flow (W/m^D).
    pub(super) divergence: f64,
    /// Sum of the magnitudes of all terms of the heat equation (W/kg).
    pub(super) terms: f64,
}

impl HeatMagnitudes {
    pub(super) fn from_points(problem: &Conduction, points: &[HeatPoint]) -> Self {
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
                problem.conductivity * field::divergence(d, motion, now)
            }),
            terms: of(&|point| {
                let (needed, stated) = needed_and_stated(problem, point);
                let stored = problem.capacity * point.2.rate;
                stored.abs() + (needed - stored).abs() + stated.abs()
            }),
        }
    }
}

/// Returns the heat source (W/kg) that the exact temperature requires, and the prescribed source.
pub(super) fn needed_and_stated(
    problem: &Conduction,
    (event, motion, now): &HeatPoint,
) -> (f64, f64) {
    (problem.balance(motion, now), problem.source(&event.label, event.t, motion, now))
}
