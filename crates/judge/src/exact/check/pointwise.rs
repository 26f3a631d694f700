//! Checks of a motion at points: initial conditions, equation of motion, rims and loading path.
//!
//! A rim is the boundary of a body that is not a box. There `P n = -p J F^-T n` for a pressure p.
//!
//! For laws with history, exact solutions are valid only under monotonic loading.

use super::event::{AXES, Event, greatest, share};
use super::survey;
use super::survey::{Magnitudes, Survey, SurveyPoint};
use crate::exact::formula::Formula;
use crate::exact::law::strained_axis;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::tensor::tensor;
use crate::exact::violation::{LargestViolation, Violation};
use mpm_subject::PlaneState;

/// Checks that the displacement is finite everywhere and, without initial stress or heat, not zero.
pub(crate) fn presence(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    let Some(first) = survey.points.first() else { return Ok(()) };
    for SurveyPoint { event, now, .. } in &survey.points {
        if let Some(u) = now.u.iter().find(|u| !u.is_finite()) {
            let condition = "the displacement is not finite".to_owned();
            return Err(event.violation(condition, None, *u, None, "m"));
        }
    }
    let first = &first.event;
    let stressed =
        !problem.initial_stress.is_none() || problem.swelling(&first.label, first.t).is_some();
    if survey.largest.displacement > 0.0 || stressed {
        return Ok(());
    }
    let condition = "the displacement is zero everywhere, for example".to_owned();
    Err(first.violation(condition, None, 0.0, None, "m"))
}

/// Checks u(X, 0) = u0(X) and u_t(X, 0) = v0(X).
pub(crate) fn initial(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    if problem.at_rest {
        return Ok(());
    }
    let Magnitudes { displacement, velocity, .. } = survey.largest;
    let mut found = [LargestViolation::default(), LargestViolation::default()];
    for event in survey::events(problem, survey.face_events, &mut Random::new(2)) {
        let event = Event { t: 0.0, ..event };
        let now = problem.derivatives(&event.label, 0.0);
        for i in 0..problem.dimension() {
            let zero = if problem.initial_displacement.is_empty() { "0" } else { "u0(X)" };
            let name = format!("initial condition u_{}(X, 0) = {zero}", AXES[i]);
            let start = start(problem, &problem.initial_displacement, i, &event, now.u[i]);
            let allowed = problem.tolerance * displacement;
            found[0].add(event.judge_condition(allowed, name, (start, now.u[i]), "m"));
            let name = format!("initial condition on the velocity in {}", AXES[i]);
            let start = self::start(problem, &problem.initial_velocity, i, &event, now.velocity[i]);
            let allowed = problem.tolerance * velocity.max(start.abs());
            found[1].add(event.judge_condition(allowed, name, (start, now.velocity[i]), "m/s"));
        }
    }
    found.into_iter().try_for_each(LargestViolation::into_result)
}

/// Returns component i of an initial condition: the value of the formulas `stated`, if there are
/// any; otherwise the value `motion` if the problem starts with the exact motion, and zero if not.
fn start(problem: &Problem, stated: &[Formula], i: usize, event: &Event, motion: f64) -> f64 {
    if stated.is_empty() && problem.follows_motion {
        return motion;
    }
    stated.get(i).map_or(0.0, |formula| formula.at(&event.label, event.t))
}

/// Rounding error of Div P, relative to the modulus times the largest second derivative. The check
/// allows this error, because the terms of Div P may cancel everywhere, as in Lame's tube at rest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Checks `rho0 u_tt = Div P + rho0 b`. If the problem prescribes b, the equation is solved for b.
/// Returns the largest residual, relative to the largest sum of the terms.
pub(crate) fn equation(problem: &Problem, survey: &Survey) -> Result<f64, Violation> {
    let (size, mut left) = (survey.largest.terms, 0.0);
    let rounding = ROUNDING * problem.modulus() * survey.largest.curvature;
    let mut found = LargestViolation::default();
    for SurveyPoint { event, now, divergence, force, .. } in &survey.points {
        let rho0 = problem.density.at(&event.label);
        // At a uniform stretch, second derivatives give no scale of the hoop term (P_rR - P_tT)/R.
        let is_ring = problem.plane == PlaneState::Axisymmetric;
        let hoop = if is_ring { ROUNDING * survey.largest.stress / event.label[0] } else { 0.0 };
        let rounding = rounding.max(hoop);
        for i in 0..problem.dimension() {
            let inertia = rho0 * now.acceleration[i];
            let (stress, force) = (divergence[i], rho0 * force[i]);
            let name = format!("equation of motion in {}, rho0 u_tt = Div P + rho0 b,", AXES[i]);
            let allowed = (problem.law_tolerance() * size).max(rounding);
            let residual = stress + force - inertia;
            if !(residual.abs() <= rounding) {
                left = f64::max(left, share(residual, size));
            }
            if problem.terms.iter().any(|term| term.is_body_force()) {
                let (name, forces) =
                    (name + " solved for b,", ((inertia - stress) / rho0, force / rho0));
                found.add(event.judge_condition(allowed / rho0, name, forces, "m/s2"));
            } else {
                found.add(event.judge_condition(allowed, name, (stress + force, inertia), "N/m3"));
            }
        }
    }
    found.into_result().map(|()| left)
}

/// Returns the largest imbalance of traction and pressure on the rims, relative to the stress.
pub(crate) fn tractions_on_rims(problem: &Problem, survey: &Survey) -> Result<f64, Violation> {
    let Some(outline) = &problem.outline else { return Ok(0.0) };
    let mut left = 0.0;
    let mut random = Random::new(7);
    for (number, rim) in outline.rims().into_iter().enumerate() {
        let pressed = problem.terms.iter().filter_map(|term| term.pressed_rim());
        let pressed: Vec<&Formula> =
            pressed.filter(|(rim, _)| *rim == number).map(|(_, pressure)| pressure).collect();
        let what = if pressed.is_empty() { "free" } else { "under pressure" };
        let mut found = LargestViolation::default();
        for sample in 0..survey.face_events {
            let (label, normal) = outline.on_rim(number, &mut random);
            let t = (sample as f64 + random.unit()) / survey.face_events as f64 * problem.until;
            let event = Event { label, t: problem.loaded(t) };
            let now = problem.derivatives(&event.label, event.t);
            let piola = problem.piola(&event.label, event.t, &now);
            let pressure: f64 =
                pressed.iter().map(|formula| formula.at(&event.label, event.t)).sum();
            let size = survey.largest.stress.max(pressure.abs());
            // The area vector J F^-T n is linear in n, so the vectors of the axes determine it.
            let areas: Vec<[f64; 3]> = (0..problem.dimension())
                .map(|axis| problem.equation.present_area(&now.grad, axis, true))
                .collect();
            for i in 0..problem.dimension() {
                let along = |column: &dyn Fn(usize) -> f64| -> f64 {
                    (0..areas.len()).map(|axis| column(axis) * normal[axis]).sum()
                };
                let traction = along(&|axis| piola[i][axis]);
                let given = 0.0 - pressure * along(&|axis| areas[axis][i]);
                let name = format!("boundary condition: {rim} is {what}, traction in {}", AXES[i]);
                let allowed = problem.law_tolerance() * size;
                found.add(event.judge_condition(allowed, name, (given, traction), "Pa"));
                left = f64::max(left, share(traction - given, size));
            }
        }
        found.into_result()?;
    }
    Ok(left)
}

/// Checks for uniaxial strain that the stretch does not reverse during plastic flow.
pub(crate) fn monotone_loading(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    if !problem.equation.has_history() {
        return Ok(());
    }
    for SurveyPoint { event, now, .. } in &survey.points {
        let (initial, axis) = (problem.initial_stress.at(&event.label), strained_axis(&now.grad));
        let k = axis.unwrap_or(0);
        let (grad, rate) = (now.grad[k][k], now.grad_rate[k][k]);
        let along_first = tensor(|i, j| initial[(i + k) % 3][(j + k) % 3]);
        if !problem.equation.flows(grad, &along_first) {
            continue;
        }
        let outwards = if grad < 0.0 { -1.0 } else { 1.0 };
        let back = (outwards * rate).min(0.0);
        let allowed = problem.tolerance * grad.abs() / problem.until;
        let name = format!(
            "loading reverses where the body flows plastically: the rate of du_{0}/d{0} changes its sign",
            AXES[k]
        );
        event.judge(allowed, name, (0.0, back), "1/s")?;
    }
    Ok(())
}

/// Checks that the law has a stress for each strain. Cam-clay has none where it yields in extension
/// or softens, and most laws have none for a body that is turned inside out.
pub(crate) fn known_stress(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    for SurveyPoint { event, now, .. } in &survey.points {
        let piola = problem.piola(&event.label, event.t, now);
        let Some(found) = piola.iter().flatten().find(|component| !component.is_finite()) else {
            continue;
        };
        let strain = strained_axis(&now.grad).map(|axis| (AXES[axis], now.grad[axis][axis]));
        let what = strain.map_or("this deformation".to_owned(), |(axis, grad)| {
            let kind = if grad > 0.0 { "extension" } else { "compression" };
            format!("the {kind} du_{axis}/d{axis} = {grad:.3e}")
        });
        let condition = format!("`{}` has no stress for {what},", problem.equation.name());
        return Err(event.violation(condition, None, *found, None, "Pa"));
    }
    Ok(())
}

/// A law with history requires uniaxial strain, and equal lateral initial stresses without shear.
pub(crate) fn uniaxial_strain(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    if !problem.equation.has_history() {
        return Ok(());
    }
    for SurveyPoint { event, now, .. } in &survey.points {
        let Some(axis) = strained_axis(&now.grad) else {
            let is_axial = |i: usize| now.grad[i][i] != 0.0;
            let axial = (0..3).find(|i| is_axial(*i)).unwrap_or(0);
            let mut others = (0..9).map(|k| (k / 3, k % 3)).filter(|at| *at != (axial, axial));
            let (i, j) = others.find(|(i, j)| now.grad[*i][*j] != 0.0).unwrap_or((axial, axial));
            let name = format!(
                "the stress of `{}` is known in uniaxial strain only, but du_{}/d{} is not zero",
                problem.equation.name(),
                AXES[i],
                AXES[j]
            );
            return Err(event.violation(name, None, now.grad[i][j], None, ""));
        };
        if !problem.starts_strained() || now.grad == [[0.0; 3]; 3] {
            continue;
        }
        let (stress, [a, b]) = (problem.initial_stress.at(&event.label), ACROSS[axis]);
        let allowed = problem.tolerance * survey.largest.stress;
        let name = format!("the lateral initial stresses {0}{0} and {1}{1} differ", XYZ[a], XYZ[b]);
        event.judge(allowed, name, (stress[a][a], stress[b][b]), "Pa")?;
        let shear = greatest([stress[0][1], stress[0][2], stress[1][2]].map(f64::abs).into_iter());
        let name = "a body in uniaxial strain has an initial shear stress".to_owned();
        event.judge(allowed, name, (0.0, shear), "Pa")?;
    }
    Ok(())
}

/// Names of the axes in stress components, and the other two axes for each axis.
const XYZ: [&str; 3] = ["x", "y", "z"];
const ACROSS: [[usize; 2]; 3] = [[1, 2], [0, 2], [0, 1]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::J2Law;
    use crate::exact::tests::{bar, free};
    use rstest::rstest;

    /// The bar yields at a strain of 0.01. The last two motions reverse halfway through the run.
    #[rstest]
    #[case::pulled("0.05*X*t", true)]
    #[case::pressed("-0.05*X*t", true)]
    #[case::swings_elastically("0.004*X*sin(20*t)", true)]
    #[case::pulled_and_let_go("0.1*X*(0.1 + t*(1 - t))", false)]
    #[case::pressed_and_let_go("-0.1*X*(0.1 + t*(1 - t))", false)]
    fn what_flows_does_not_turn_back(#[case] displacement: &str, #[case] passes: bool) {
        let equation = J2Law::new(2.0, 0.0, 0.02, 0.1).into();
        let problem = Problem { equation, ..bar(displacement, free()) };
        assert_eq!(monotone_loading(&problem, &Survey::new(&problem)).is_ok(), passes);
    }
}
