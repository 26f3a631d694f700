//! Every condition that a heat problem puts on its temperature.

use super::condition::HeatFacePoint;
use super::field::TemperatureDerivatives;
use super::problem::{Conduction, HeatFace};
use super::{equation, weak};
use crate::exact::check::differences::{DIFFERENCE_TOLERANCE, away_from_kinks};
use crate::exact::check::pointwise::{Event, POINTS, drawn, greatest, largest};
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, variables};
use crate::exact::random::Random;
use crate::exact::violation::Violation;

impl Conduction {
    /// Holds the temperature against the heat equation (point by point and in weak form), the
    /// boundary and the initial conditions, at reproducible random points.
    ///
    /// # Errors
    /// The first [`Violation`].
    pub fn check(&self) -> Result<(), Violation> {
        presence(self)?;
        initial(self)?;
        boundary(self)?;
        differentiation(self)?;
        equation(self)?;
        weak::balance(self)
    }
}

impl Conduction {
    /// A random place in the body, and a time of the run.
    fn event(&self, random: &mut Random) -> Event {
        Event { label: random.point(&self.from, &self.to), t: self.moment(random) }
    }
}

type HeatPoint = (Event, Derivatives, TemperatureDerivatives);

fn interior(problem: &Conduction, seed: u64) -> Vec<HeatPoint> {
    drawn(seed, |random| {
        let event = problem.event(random);
        let (motion, now) = problem.now(&event.label, event.t);
        (event, motion, now)
    })
}

/// Largest value of a quantity over the interior points; NaN if any is.
fn scale(problem: &Conduction, quantity: impl Fn(&HeatPoint) -> f64) -> f64 {
    greatest(interior(problem, 1).iter().map(|point| quantity(point).abs()))
}

/// The temperature is a number everywhere inside, and not zero everywhere.
fn presence(problem: &Conduction) -> Result<(), Violation> {
    let points = interior(problem, 1);
    let wrong = |(event, _, now): &HeatPoint, what: &str| Violation {
        condition: format!("the demand that the temperature is {what}"),
        label: event.label.clone(),
        t: event.t,
        expected: None,
        found: now.value,
        unit: "K",
    };
    if let Some(point) = points.iter().find(|(_, _, now)| !now.value.is_finite()) {
        return Err(wrong(point, "finite"));
    }
    if points.iter().any(|(_, _, now)| now.value != 0.0) {
        return Ok(());
    }
    Err(wrong(&points[0], "not zero everywhere"))
}

/// `T(X, 0) = T0(X)`.
fn initial(problem: &Conduction) -> Result<(), Violation> {
    let size = scale(problem, |(_, _, now)| now.value);
    for (event, _, _) in interior(problem, 2) {
        let event = Event { t: 0.0, ..event };
        let found = problem.temperature.at(&event.label, 0.0);
        // Where nothing is stated, the start must be a number: nothing is near to NaN.
        let start = problem.initial.as_ref().map_or(found, |formula| at(formula, &event));
        let name = "initial condition T(X, 0) = T0(X)".to_owned();
        event.judge(problem.tolerance * size, name, (start, found), "K")?;
    }
    Ok(())
}

fn at(formula: &Formula, event: &Event) -> f64 {
    formula.eval(&variables(&event.label, event.t)[..=event.label.len()])
}

/// Magnitudes that residuals of boundary conditions are compared with.
struct HeatMagnitudes {
    value: f64,
    inflow: f64,
}

/// Every face of the body, at random points and times.
fn boundary(problem: &Conduction) -> Result<(), Violation> {
    let sizes = HeatMagnitudes {
        value: scale(problem, |(_, _, now)| now.value),
        inflow: scale(problem, |(_, motion, now)| largest(&problem.inflow(motion, now))),
    };
    let mut random = Random::new(3);
    for face in &problem.faces {
        for _ in 0..POINTS {
            let label = random.on_face(&problem.from, &problem.to, face.axis, face.high);
            let event = Event { label, t: problem.moment(&mut random) };
            let (motion, now) = problem.now(&event.label, event.t);
            let inflow = inflow_at(problem, face, &motion, &now);
            let point = HeatedPoint { problem, face, event, now, inflow, sizes: &sizes };
            face.condition.check(&point)?;
        }
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
fn differentiation(problem: &Conduction) -> Result<(), Violation> {
    let rate = scale(problem, |(_, _, now)| now.rate);
    away_from_kinks(|random| problem.event(random), |event| differences(problem, event, rate))
}

fn differences(problem: &Conduction, event: &Event, rate: f64) -> Result<(), Violation> {
    let (motion, now) = problem.now(&event.label, event.t);
    let step = 1e-5 * problem.until;
    let value = |t: f64| problem.temperature.at(&event.label, t);
    let (low, high) = (value(event.t - step), value(event.t + step));
    let rounding = 1e-13 * (low.abs() + high.abs()) / step;
    let name = "agreement of two differentiations of T in time".to_owned();
    let slope = (high - low) / (2.0 * step);
    event.judge(DIFFERENCE_TOLERANCE * rate + rounding, name, (slope, now.rate), "K/s")?;
    let (mut divergence, mut size) = (0.0, 0.0);
    for axis in 0..problem.dimension() {
        let step = 1e-5 * (problem.to[axis] - problem.from[axis]);
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
    let allowed = DIFFERENCE_TOLERANCE * exact.abs() + 1e-9 * size;
    event.judge(allowed, name, (divergence, exact), "W/m3")
}

/// `rho0 c T_t = Div (k J C^-1 Grad T) + rho0 s`, as powers per unit of mass: that which the
/// temperature needs, and that which is stated.
fn equation(problem: &Conduction) -> Result<(), Violation> {
    let terms = |(event, motion, now): &HeatPoint| {
        let needed = problem.balance(motion, now);
        (needed, problem.source(&event.label, event.t, motion, now))
    };
    let size = scale(problem, |point| {
        let (needed, stated) = terms(point);
        let stored = problem.capacity * point.2.rate;
        stored.abs() + (needed - stored).abs() + stated.abs()
    });
    for point in &interior(problem, 4) {
        let (needed, stated) = terms(point);
        let name = "heat equation, rho0 c T_t = Div(k Grad T) + rho0 s, solved for s,".to_owned();
        point.0.judge(problem.tolerance * size, name, (needed, stated), "W/kg")?;
    }
    Ok(())
}
