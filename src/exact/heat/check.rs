//! Every condition that a heat problem puts on its temperature.

use super::condition::HeatFacePoint;
use super::field::TemperatureDerivatives;
use super::magnitudes::{HeatMagnitudes, HeatPoint, extent, interior, needed_and_stated};
use super::problem::{Conduction, HeatFace};
use super::{equation, weak};
use crate::exact::check::differences::{DIFFERENCE_TOLERANCE, away_from_kinks, step};
use crate::exact::check::event::{Event, FACE_EVENTS, OnFace, SpaceTimeBox, greatest};
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, variables};
use crate::exact::random::Random;
use crate::exact::violation::{LargestViolation, Violation};

impl Conduction {
    /// Holds the temperature against the heat equation (point by point and in weak form), the
    /// boundary and the initial conditions, at reproducible random points.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check(&self) -> Result<(), Violation> {
        let points = interior(self);
        let largest = HeatMagnitudes::of(self, &points);
        presence(&points, &largest)?;
        initial(self, &largest)?;
        boundary(self, &largest)?;
        away_from_kinks(points.iter().map(|point| &point.0), |event| {
            differences(self, event, &largest)
        })?;
        equation(self, &points, largest.terms)?;
        weak::balance(self, &largest)
    }
}

/// The temperature is a number everywhere inside, and not zero everywhere.
fn presence(points: &[HeatPoint], largest: &HeatMagnitudes) -> Result<(), Violation> {
    let wrong = |(event, _, now): &HeatPoint, what: &str| Violation {
        condition: format!("the demand that the temperature is {what}"),
        label: event.label.clone(),
        t: event.t,
        expected: None,
        found: now.value,
        allowed: None,
        unit: "K",
    };
    if let Some(point) = points.iter().find(|(_, _, now)| !now.value.is_finite()) {
        return Err(wrong(point, "finite"));
    }
    match points.first() {
        Some(point) if !(largest.value > 0.0) => Err(wrong(point, "not zero everywhere")),
        _ => Ok(()),
    }
}

/// `T(X, 0) = T0(X)`.
fn initial(problem: &Conduction, largest: &HeatMagnitudes) -> Result<(), Violation> {
    let start = SpaceTimeBox { end: 0.0, ..extent(problem) };
    let mut worst = LargestViolation::default();
    for event in start.spread(FACE_EVENTS, |_| true, &mut Random::new(2)) {
        let found = problem.temperature.at(&event.label, 0.0);
        // Where nothing is stated, the start must be a number: nothing is near to NaN.
        let start = problem.initial.as_ref().map_or(found, |formula| at(formula, &event));
        let name = "initial condition T(X, 0) = T0(X)".to_owned();
        worst.add(event.judge(problem.tolerance * largest.value, name, (start, found), "K"));
    }
    worst.into_result()
}

fn at(formula: &Formula, event: &Event) -> f64 {
    formula.eval(&variables(&event.label, event.t)[..=event.label.len()])
}

/// Every face of the body, at random points and times.
fn boundary(problem: &Conduction, sizes: &HeatMagnitudes) -> Result<(), Violation> {
    let mut random = Random::new(3);
    for face in &problem.faces {
        let mut found = LargestViolation::default();
        let on_face = OnFace::of((&problem.from, &problem.to), face.axis, face.high);
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

/// A point of a face, with the motion and the temperature there.
struct HeatedPoint<'a> {
    problem: &'a Conduction,
    face: &'a HeatFace,
    event: Event,
    now: TemperatureDerivatives,
    /// Heat that enters (W/m^(D-1)).
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
        at(formula, &self.event)
    }

    fn temperature(&self) -> f64 {
        self.now.value
    }

    fn largest_temperature(&self) -> f64 {
        self.sizes.value
    }

    fn has_temperature(&self, given: f64) -> Result<(), Violation> {
        let allowed = self.problem.tolerance * self.sizes.value.max(given.abs());
        let name = self.condition("has a given temperature");
        self.event.judge(allowed, name, (given, self.now.value), "K")
    }

    fn lets_in(&self, what: &str, given: f64, size: f64) -> Result<(), Violation> {
        let allowed = self.problem.tolerance * greatest([self.sizes.inflow, size].into_iter());
        self.event.judge(allowed, self.condition(what), (given, self.inflow), "W/m2")
    }

    fn continues_on_opposite_face(&self) -> Result<(), Violation> {
        let Self { problem, face, event, now, inflow, sizes } = self;
        let mut opposite = event.label.clone();
        opposite[face.axis] =
            if face.high { problem.from[face.axis] } else { problem.to[face.axis] };
        let (there, warm) = problem.now(&opposite, event.t);
        let title = self.condition("is periodic, the temperature");
        event.judge(problem.tolerance * sizes.value, title, (warm.value, now.value), "K")?;
        let across = inflow_at(problem, face, &there, &warm);
        let title = self.condition("is periodic, the flow of heat");
        event.judge(problem.tolerance * sizes.inflow, title, (across, *inflow), "W/m2")
    }
}

/// Heat that flows along the outward normal of `face` from outside (W/m^(D-1)).
fn inflow_at(
    problem: &Conduction,
    face: &HeatFace,
    motion: &Derivatives,
    now: &TemperatureDerivatives,
) -> f64 {
    let normal = if face.high { 1.0 } else { -1.0 };
    normal * problem.inflow(motion, now)[face.axis]
}

/// T_t and Div Q, once by automatic differentiation and once by central differences.
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
    let name = "agreement of two differentiations of T in time".to_owned();
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
    let exact = problem.conductivity * equation::divergence(problem.dimension(), &motion, &now);
    let name = "agreement of two differentiations of Div Q".to_owned();
    let allowed = DIFFERENCE_TOLERANCE * largest.divergence + 1e-9 * size;
    event.judge(allowed, name, (divergence, exact), "W/m3")
}

/// `rho0 c T_t = Div (k J C^-1 Grad T) + rho0 s`, as powers per unit of mass: that which the
/// temperature needs, and that which is stated.
fn equation(problem: &Conduction, points: &[HeatPoint], size: f64) -> Result<(), Violation> {
    let mut found = LargestViolation::default();
    for point in points {
        let (needed, stated) = needed_and_stated(problem, point);
        let name = "heat equation, rho0 c T_t = Div(k Grad T) + rho0 s, solved for s,".to_owned();
        found.add(point.0.judge(problem.tolerance * size, name, (needed, stated), "W/kg"));
    }
    found.into_result()
}
