//! Conditions checked point by point.

use crate::exact::formula::Formula;
use crate::exact::linearised::share;
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Points per condition: a formula that is wrong on one part in twenty of the body is found with
/// a probability above 0.96.
pub(crate) const POINTS: usize = 64;

/// Component names for messages.
pub(crate) const AXES: [&str; 3] = ["X", "Y", "Z"];

/// One place and time of a check.
pub(crate) struct Event {
    pub(crate) label: Vec<f64>,
    pub(crate) t: f64,
}

impl Event {
    pub(crate) fn judge(
        &self,
        allowed: f64,
        condition: String,
        values: (f64, f64),
        unit: &'static str,
    ) -> Result<(), Violation> {
        let (expected, found) = values;
        if (found - expected).abs() <= allowed {
            return Ok(());
        }
        Err(self.violation(condition, Some(expected), found, unit))
    }

    /// Whether `found` is at most `most`, but for what is allowed.
    pub(crate) fn judge_most(
        &self,
        allowed: f64,
        condition: String,
        (most, found): (f64, f64),
        unit: &'static str,
    ) -> Result<(), Violation> {
        if found - most <= allowed {
            return Ok(());
        }
        Err(self.violation(condition + " at most", Some(most), found, unit))
    }

    fn violation(
        &self,
        condition: String,
        expected: Option<f64>,
        found: f64,
        unit: &'static str,
    ) -> Violation {
        Violation { condition, label: self.label.clone(), t: self.t, expected, found, unit }
    }
}

/// Draws [`POINTS`] points from the sequence of `seed`.
pub(crate) fn drawn<T>(seed: u64, mut point: impl FnMut(&mut Random) -> T) -> Vec<T> {
    let mut random = Random::new(seed);
    (0..POINTS).map(|_| point(&mut random)).collect()
}

fn interior(problem: &Problem, seed: u64) -> Vec<(Event, Derivatives)> {
    drawn(seed, |random| {
        let label = problem.point(random);
        let t = problem.moment(random);
        let all = problem.derivatives(&label, t);
        (Event { label, t }, all)
    })
}

/// Largest of magnitudes; NaN if any is NaN, so that every comparison with it fails.
pub(crate) fn greatest(magnitudes: impl Iterator<Item = f64>) -> f64 {
    magnitudes.fold(0.0, |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { f64::max(a, b) })
}

/// Largest value of a quantity over the interior points; NaN if any is.
pub(crate) fn scale(problem: &Problem, quantity: impl Fn(&Event, &Derivatives) -> f64) -> f64 {
    greatest(interior(problem, 1).iter().map(|(e, d)| quantity(e, d)))
}

pub(crate) fn largest(values: &[f64; 3]) -> f64 {
    values.iter().fold(0.0, |a, b| if f64::is_nan(a + b) { f64::NAN } else { f64::max(a, b.abs()) })
}

/// Largest displacement gradient.
pub(crate) fn strain(problem: &Problem) -> f64 {
    scale(problem, |_, d| d.grad.iter().map(largest).fold(0.0, f64::max))
}

/// Magnitude of stresses (Pa): that of the largest strain and that of the reference.
pub(crate) fn stress(problem: &Problem) -> f64 {
    let initial = scale(problem, |event, _| {
        greatest(problem.initial_stress.at(&event.label).iter().map(largest))
    });
    problem.equation.modulus() * strain(problem) + initial
}

/// The displacement is a number everywhere inside, and not zero everywhere, unless the body has a
/// stress without it.
pub(crate) fn presence(problem: &Problem) -> Result<(), Violation> {
    let points = interior(problem, 1);
    for (event, now) in &points {
        if let Some(u) = now.u.iter().find(|u| !u.is_finite()) {
            let condition = "the demand that the displacement is finite".to_owned();
            return Err(event.violation(condition, None, *u, "m"));
        }
    }
    let stressed = |event: &Event| {
        !problem.initial_stress.is_none() || problem.swelling(&event.label, event.t).is_some()
    };
    if points.iter().any(|(event, now)| largest(&now.u) > 0.0 || stressed(event)) {
        return Ok(());
    }
    let condition = "the demand that the displacement is not zero everywhere".to_owned();
    Err(points[0].0.violation(condition, None, 0.0, "m"))
}

/// u(X, 0) = u0(X) and u_t(X, 0) = v0(X).
pub(crate) fn initial(problem: &Problem) -> Result<(), Violation> {
    if problem.at_rest {
        return Ok(());
    }
    let size = scale(problem, |_, d| largest(&d.u));
    let speed = scale(problem, |_, d| largest(&d.velocity));
    for (event, _) in interior(problem, 2) {
        let event = Event { t: 0.0, ..event };
        let now = problem.derivatives(&event.label, 0.0);
        for i in 0..problem.dimension() {
            let zero = if problem.initial_displacement.is_empty() { "0" } else { "u0(X)" };
            let name = format!("initial condition u_{}(X, 0) = {zero}", AXES[i]);
            let start = start(problem, &problem.initial_displacement, i, &event, now.u[i]);
            event.judge(problem.tolerance * size, name, (start, now.u[i]), "m")?;
            let name = format!("initial condition on the velocity in {}", AXES[i]);
            let start = self::start(problem, &problem.initial_velocity, i, &event, now.velocity[i]);
            let allowed = problem.tolerance * speed.max(start.abs());
            event.judge(allowed, name, (start, now.velocity[i]), "m/s")?;
        }
    }
    Ok(())
}

/// Component i of an initial condition: what is `stated`, or else that of the motion (which must
/// be a number: nothing is near to NaN or infinity) or zero.
fn start(problem: &Problem, stated: &[Formula], i: usize, event: &Event, motion: f64) -> f64 {
    if stated.is_empty() && problem.follows_motion {
        return motion;
    }
    formula_at(stated, i, event)
}

fn formula_at(formulas: &[Formula], i: usize, event: &Event) -> f64 {
    let variables = crate::exact::motion::variables(&event.label, event.t);
    formulas.get(i).map_or(0.0, |f| f.eval(&variables[..=event.label.len()]))
}

/// `rho0 u_tt = Div P + rho0 b`, with derivatives by automatic differentiation. Where the problem
/// declares a force, the two sides are put as forces: that which the motion needs, and that which
/// is declared. Returns the largest residual, relative to the largest sum of the terms.
pub(crate) fn equation(problem: &Problem) -> Result<f64, Violation> {
    let points = interior(problem, 4);
    let terms = |event: &Event, d: &Derivatives, i: usize| {
        let inertia = problem.density * d.acceleration[i];
        let stress = problem.divergence(&event.label, event.t, d)[i];
        (inertia, stress, problem.density * problem.force(&event.label, event.t, d)[i])
    };
    let size = scale(problem, |event, d| {
        // In a tube at rest the hoops balance the rest of Div P.
        let hoops = largest(&problem.hoop_force(&event.label, event.t, d));
        (0..problem.dimension())
            .map(|i| terms(event, d, i))
            .map(|(a, b, c)| a.abs() + b.abs() + c.abs() + hoops)
            .sum()
    });
    let mut left = 0.0;
    for (event, d) in &points {
        for i in 0..problem.dimension() {
            let (inertia, stress, force) = terms(event, d, i);
            let name = format!("equation of motion in {}, rho0 u_tt = Div P + rho0 b,", AXES[i]);
            let (allowed, rho0) = (problem.law_tolerance() * size, problem.density);
            left = f64::max(left, share(stress + force - inertia, size));
            if problem.terms.iter().any(|term| term.is_body_force()) {
                let (name, forces) =
                    (name + " solved for b,", ((inertia - stress) / rho0, force / rho0));
                event.judge(allowed / rho0, name, forces, "m/s2")?;
            } else {
                event.judge(allowed, name, (stress + force, inertia), "N/m3")?;
            }
        }
    }
    Ok(left)
}
