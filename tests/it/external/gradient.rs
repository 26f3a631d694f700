//! Derivatives of differentiable solvers. A library solver with a known error produces every state.

use crate::common::solver::{NewSubject, Solver, prescribed, solver};
use crate::common::valid_suite;
use approx::assert_relative_eq;
use mpm_verify::external::{
    Capabilities, Gradient, GradientError, GradientRequest, HandedNumber, LevelProblem,
    ProblemNeeds, SolverFactory,
};
use mpm_verify::study::{Runner, under, under_on};
use mpm_verify::subject::{Functional, GradientParameter, Precision, Samples};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{GateTerms, Suite};
use mpm_verify::verify::{CaseOutcome, GradientEntry, GradientState, GradientStudy};
use rstest::rstest;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

pub(super) const SUITE: &str = include_str!("../../../verification/gradients/gradient-bar.yaml");

/// The exact motion of the bar with a relative error of h^2, as a function of E, rho and a factor
/// on the initial velocity.
#[derive(Clone, Copy)]
struct Bar {
    young: f64,
    density: f64,
    factor: f64,
    h: f64,
    t: f64,
}

impl Bar {
    fn of(problem: &LevelProblem, t: f64) -> Self {
        let material = &problem.materials[0];
        let (x, v) = (problem.particles.reference_position[0], problem.particles.velocity[0]);
        let factor = v / libm::sin(std::f64::consts::FRAC_PI_2 * x);
        let (young, density) = (material.parameter("young"), material.density);
        Self { young, density, factor, h: problem.grid.h, t }
    }

    /// Returns the amplitude of the displacement, and its derivative with respect to a parameter.
    fn amplitude(self, with_respect_to: GradientParameter) -> (f64, f64) {
        let Self { young, density, factor, h, t } = self;
        let w = std::f64::consts::FRAC_PI_2 * (young / density).sqrt();
        let scale = factor * (1.0 + h * h);
        let by_w = scale * (t * libm::cos(w * t) / w - libm::sin(w * t) / (w * w));
        let slope = match with_respect_to {
            GradientParameter::Young => by_w * w / (2.0 * young),
            GradientParameter::Density => -by_w * w / (2.0 * density),
            _ => scale * libm::sin(w * t) / w,
        };
        (scale * libm::sin(w * t) / w, slope)
    }
}

type Edit = fn(&mut Vec<f64>);

/// A solver with gradients of the mean displacement.
#[derive(Clone)]
struct Differentiable {
    names: Vec<&'static str>,
    /// Modifies the gradient before it is reported.
    edit: Edit,
    precision: Precision,
    error: Option<GradientError>,
}

impl Differentiable {
    fn sound() -> Self {
        Self {
            names: vec!["young", "density", "initial_velocity"],
            edit: |_| (),
            precision: Precision::Double,
            error: None,
        }
    }

    fn displacement(&self, problem: &LevelProblem, steps: u64) -> Vec<f64> {
        let bar = Bar::of(problem, steps as f64 * problem.dt);
        let (amplitude, _) = bar.amplitude(GradientParameter::Young);
        let at = |x: &f64| {
            let u = amplitude * libm::sin(std::f64::consts::FRAC_PI_2 * x);
            match self.precision {
                Precision::Double => u,
                // In single precision, positions are rounded.
                Precision::Single => f64::from((x + u) as f32) - x,
            }
        };
        problem.particles.reference_position.iter().map(at).collect()
    }
}

impl SolverFactory for Differentiable {
    fn name(&self) -> &'static str {
        "closed-form"
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let gradients = self.names.iter().map(|name| (*name).to_owned()).collect();
        let of = Capabilities::of(&[1], &["corotated"], &["free", "fixed"], &[]);
        Capabilities { gradients, ..of }.lacking(needs)
    }

    fn subject(&self, problem: LevelProblem) -> NewSubject {
        let solver = self.clone();
        Ok(prescribed(problem, move |problem, steps, samples| {
            samples.displacement = solver.displacement(problem, steps);
        }))
    }

    fn gradient(
        &self,
        problem: LevelProblem,
        request: &GradientRequest,
    ) -> Result<Gradient, GradientError> {
        if let Some(error) = &self.error {
            return Err(error.clone());
        }
        assert_eq!(request.of, Functional::MeanDisplacement { axis: 0 });
        let steps = problem.steps;
        let bar = Bar::of(&problem, steps as f64 * problem.dt);
        let mut samples = Samples::default();
        samples.restart(1);
        samples.label.clone_from(&problem.particles.reference_position);
        samples.weight.clone_from(&problem.particles.reference_volume);
        samples.displacement = self.displacement(&problem, steps);
        let value = request.of.value(&problem.particles.mass, &samples).value;
        let shape = value / bar.amplitude(GradientParameter::Young).0;
        let slope = |parameter: &GradientParameter| shape * bar.amplitude(*parameter).1;
        let mut gradient = request.with_respect_to.iter().map(slope).collect();
        (self.edit)(&mut gradient);
        Ok(Gradient { value, gradient })
    }
}

/// Runs the suite with `solver`, gated or not, and returns the cases.
fn run(suite: &Suite, solver: &Differentiable, gate: bool) -> Vec<CaseOutcome> {
    let judged = under(suite, solver, gate).expect("a study of solvers");
    Runner::new(&judged).judging(solver).run(&|| ()).cases
}

fn cases(solver: &Differentiable) -> Vec<CaseOutcome> {
    // The displacement is far above its rounding error.
    run(&valid_suite(&SUITE.replace("v0: 1e-5", "v0: 0.03")), solver, true)
}

fn states(cases: &[CaseOutcome]) -> Vec<GradientState> {
    let state = |case: &CaseOutcome| case.gradient().expect("results").state().0;
    cases.iter().map(state).collect()
}

#[test]
fn correct_solver_meets_the_gate() {
    let cases = cases(&Differentiable::sound());
    let names: Vec<&str> = cases.iter().map(|case| case.case.as_str()).collect();
    assert_eq!(names, ["closed-form-young", "closed-form-density", "closed-form-initial-velocity"]);
    for case in &cases {
        assert_eq!(case.failure(), "", "{}", case.case);
        assert_eq!(case.result().name(), "pass");
        let study = case.gradient().expect("results");
        assert!((study.order() - 2.0).abs() < 0.02, "{}", study.order());
    }
    let (smooth, linear) = (GradientState::Smooth, GradientState::Linear);
    assert_eq!(states(&cases), [smooth, smooth, linear]);
    let young = cases[0].gradient().expect("results");
    let sweep = young.sweep.as_ref().expect("a sweep");
    assert!((sweep.share - 1.0).abs() < 1e-6 && sweep.jumps.is_empty(), "{sweep:?}");
}

/// In the derivative of v0/w*w cos(w t) with respect to E or rho, the derivatives of w cancel up to
/// rounding.
#[test]
fn rounding_of_the_initial_velocity_is_no_dependence() {
    for young in [1.0, 2.0, 3.0, 7.0, 30.0, 2.1e11] {
        for density in [0.7, 1.0, 1.3, 2.5, 3.0, 5.0, 10.0, 27.0, 1000.0, 7850.0] {
            let text = SUITE.replace("E: 1  ", &format!("E: {young:e}  "));
            let text = text.replace("rho: 1  ", &format!("rho: {density:e}  "));
            assert!(text.contains(&format!("rho: {density:e}")), "{text}");
            valid_suite(&text);
        }
    }
    let suite = valid_suite(&SUITE.replace("E: 1  ", "E: 3  ").replace("v0: 1e-5", "v0: 0.03"));
    for case in run(&suite, &Differentiable::sound(), true) {
        assert_eq!(case.failure(), "", "{}", case.case);
    }
}

#[rstest]
#[case::factor(|g: &mut Vec<f64>| g.iter_mut().for_each(|g| *g *= 2.0), [true, true, true])]
#[case::order_of_entries(|g: &mut Vec<f64>| g.swap(0, 1), [true, true, false])]
#[case::detached(|g: &mut Vec<f64>| g[1] *= 0.9, [false, true, false])]
#[case::velocity_only(|g: &mut Vec<f64>| g[..2].fill(0.0), [true, true, false])]
#[case::not_a_number(|g: &mut Vec<f64>| g[0] = f64::NAN, [true, false, false])]
fn a_wrong_gradient_is_wrong_for_its_parameters(#[case] edit: Edit, #[case] wrong: [bool; 3]) {
    let cases = cases(&Differentiable { edit, ..Differentiable::sound() });
    for ((case, state), wrong) in cases.iter().zip(states(&cases)).zip(wrong) {
        assert_eq!(state == GradientState::Wrong, wrong, "{}: {}", case.case, case.reason);
        assert_eq!(case.passed(), !wrong, "{}: {:?}", case.case, case.unmet);
    }
}

#[test]
fn single_precision_is_at_rounding_and_not_wrong() {
    let single = Differentiable { precision: Precision::Single, ..Differentiable::sound() };
    let suite = valid_suite(SUITE);
    let cases = run(&suite, &single, false);
    for (case, state) in cases.iter().zip(states(&cases)) {
        assert_eq!(state, GradientState::AtRounding, "{}: {}", case.case, case.reason);
    }
}

#[test]
fn a_parameter_without_a_gradient_is_not_applicable() {
    let cases = cases(&Differentiable { names: vec!["young"], ..Differentiable::sound() });
    let lacks: Vec<&[String]> = cases.iter().map(|case| case.lacks.as_slice()).collect();
    assert_eq!(cases[0].result().name(), "pass");
    assert_eq!(lacks[1], ["gradients: density"]);
    assert_eq!(lacks[2], ["gradients: initial_velocity"]);
}

/// Derivatives are compared with those of the built-in law in rate form.
#[test]
fn small_strain_does_not_replace_the_law_of_a_gradient() {
    let suite = SUITE.replace("  equation: corotated", "  equation: small_strain");
    let suite = valid_suite(&suite.replace("corotated", "linear_elastic"));
    let gradients = ["young", "density", "initial_velocity"].map(ToOwned::to_owned).to_vec();
    let able = Capabilities::of(&[1], &["small_strain"], &["free", "fixed"], &[]);
    let able = Some(Capabilities { gradients, ..able });
    let solver = Solver { able, ..solver("linear", |_| Err("nothing runs here".into())) };
    let case = Runner::new(&suite).judging(&solver).case(0, &|| ());
    assert_eq!(case.lacks, ["laws: linear_elastic"]);
}

#[test]
fn a_refusal_is_not_applicable_and_a_failure_fails() {
    let with = |error| cases(&Differentiable { error: Some(error), ..Differentiable::sound() });
    let refused = &with(GradientError::Cannot("no adjoint".to_owned()))[0];
    assert_eq!(refused.result().name(), "not applicable");
    assert_eq!(refused.lacks, ["no adjoint"]);
    let failed = &with(GradientError::Failed("says: NaN at step 17".to_owned()))[0];
    assert_eq!((failed.result().name(), failed.verdict.as_str()), ("FAIL", "failed"));
    assert!(failed.reason.contains("NaN at step 17"), "{}", failed.reason);
}

#[test]
fn a_suite_without_a_solver_needs_one() {
    let outcome = Runner::new(&valid_suite(SUITE)).run(&|| ());
    assert!(outcome.passed());
    for case in &outcome.cases {
        let result = (case.result().name(), case.reason.as_str());
        assert_eq!(result, ("not applicable", "needs a solver with gradients"));
    }
}

/// A plate of 3 m x 2 m away from the origin, with parameters of different size and sign. Its
/// solution is not checked, because the values below are those of the stated formulas.
const PLATE: &str = r#"suite: plate
study: gradient
title: Plate
source: a test
parameters: {E: 4e6, mu: 0.25, rho: 2.5e-3, v0: -3e-4}
functions:
  g(t): "v0*sqrt(E)*t + 1e-4*E*rho*t^2"
scene:
  dimension: 2
  body: {box: {from: [1, 5], to: [4, 7]}}
  material: {corotated: {young: E, poisson: 0.25, density: rho}}
  boundary: {bottom: {friction: mu}}
  initial_velocity: ["v0*sqrt(E)*(X + 2*Y)", "-3*v0*sqrt(E)*(X + 2*Y)"]
exact:
  equation: corotated
  displacement: ["g(t)*(X + 2*Y)", "-3*g(t)*(X + 2*Y)"]
gradient:
  of: {mean_displacement: {axis: 1}}
  with_respect_to: {young: E, friction: mu, density: rho, initial_velocity: v0}
  cells: 3
  sweep: {parameter: density, within: 0.25, points: 5}
run: {until: 0.5, dt: "0.1*h"}
refine: {cells: [3, 6], ppc: 4}
methods: [{external: {name: plate}}]
"#;

/// A solver whose particles move by 1/2 m along x and by -3 s along y, where s = (E/1e6)^3 + 5 mu +
/// 2 rho + f + steps/1000, and f is the factor on the initial velocity. The derivative with respect
/// to E is too large by f/100 of it.
struct Plate {
    /// Reference positions (m) on the finest level.
    labels: Mutex<Vec<f64>>,
}

/// Returns the sum s, and the terms of E and of the initial velocity.
fn sum(problem: &LevelProblem, steps: u64) -> (f64, f64, f64) {
    let (material, particles) = (&problem.materials[0], &problem.particles);
    let (x, v) = (&particles.reference_position, &particles.velocity);
    let factor = v[0] / (-0.6 * (x[0] + 2.0 * x[1]));
    let friction = problem.faces.iter().find_map(|face| match face.numbers.values.first() {
        Some((_, HandedNumber::Scalar(value))) if face.name == "bottom" => Some(*value),
        _ => None,
    });
    let young = 1e-6 * material.parameter("young");
    let of_rest = 5.0 * friction.expect("a coefficient") + 2.0 * material.density;
    let sum = young.powi(3) + of_rest + factor + 1e-3 * steps as f64;
    (sum, young, factor)
}

impl SolverFactory for Plate {
    fn name(&self) -> &'static str {
        "plate"
    }

    fn subject(&self, problem: LevelProblem) -> NewSubject {
        assert_eq!(problem.instants, [problem.steps]);
        Ok(prescribed(problem, |problem, steps, samples| {
            let displacement = [0.5, -3.0 * sum(problem, steps).0];
            samples.displacement = displacement.repeat(problem.particles.len());
            samples.velocity.clone_from(&problem.particles.velocity);
        }))
    }

    fn gradient(
        &self,
        problem: LevelProblem,
        request: &GradientRequest,
    ) -> Result<Gradient, GradientError> {
        let names: Vec<&str> = request.with_respect_to.iter().map(|one| one.name()).collect();
        assert_eq!(names, ["young", "friction", "density", "initial_velocity"]);
        if problem.grid.h < 1.0 {
            self.labels.lock().unwrap().clone_from(&problem.particles.reference_position);
        }
        let (sum, young, factor) = sum(&problem, problem.steps);
        let by_young = -9e-6 * young * young * (1.0 + 0.01 * factor);
        Ok(Gradient { value: -3.0 * sum, gradient: vec![by_young, -15.0, -6.0, -3.0] })
    }
}

/// Returns the studies with respect to E, mu, rho and v0, and the labels on the finest level.
fn plate(of: &str) -> (Vec<GradientStudy>, Vec<f64>) {
    let text = PLATE.replace("{mean_displacement: {axis: 1}}", of);
    let source = Source::from_text("plate.yaml", text).expect("a text").trusted();
    let suite = Suite::load(&source).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    let solver = Plate { labels: Mutex::default() };
    let runner = Runner::new(&suite).judging(&solver);
    let done = AtomicU64::new(0);
    let outcome = runner.run(&|| {
        done.fetch_add(1, Ordering::Relaxed);
    });
    // Two levels and 13 perturbations for each parameter, and five points of the sweep.
    assert_eq!([runner.units(), done.into_inner()], [4 * 15 + 5; 2]);
    let studies = outcome.cases.iter().map(|case| case.gradient().expect(&case.reason).clone());
    (studies.collect(), solver.labels.lock().unwrap().clone())
}

/// With g = -0.05, g' = 0.4 and s = X + 2 Y, whose mean is 14.5 and whose mean square is 637/3, and
/// the derivatives 2.5e-8, 0, 100 and v0 1000 of g, and 1.75e-7, 0, 400 and v0 2000 of g'.
#[rstest]
#[case::mean_displacement("{mean_displacement: {axis: 1}}", [-1.0875e-6, -4350.0, 13.05])]
#[case::mean_square("mean_square_displacement", [-637e-8 / 1.2, -63_700.0 / 3.0, 63.7])]
#[case::kinetic_energy("kinetic_energy", [2.2295e-6, 6115.2, -7.644])]
#[case::position("{position_of: {particle: 5, axis: 0}}", [2.5e-8, 100.0, -0.3])]
fn exact_derivatives_by_hand(#[case] of: &str, #[case] expected: [f64; 3]) {
    let (studies, labels) = plate(of);
    let factor = if of.contains("position") { labels[10] + 2.0 * labels[11] } else { 1.0 };
    let exact: Vec<f64> = studies.iter().map(|study| study.levels[1].exact).collect();
    for (exact, expected) in [exact[0], exact[2], exact[3]].into_iter().zip(expected) {
        assert_relative_eq!(exact, factor * expected, max_relative = 1e-12);
    }
    assert_eq!(exact[1], 0.0);
}

/// The initial velocity is proportional to sqrt(E), so the derivative with respect to E includes
/// that with respect to the velocity, -3, times 1/(2 E).
#[test]
fn derivatives_of_a_plate_are_compared_with_its_own_values() {
    let (studies, _) = plate("{mean_displacement: {axis: 1}}");
    let [young, friction, density, velocity] = &studies[..] else { panic!("four studies") };
    let sum = |steps: f64| -3.0 * (64.0 + 1.25 + 0.005 + 1.0 + 1e-3 * steps);
    for (study, partial, q) in [
        (young, -1.454_4e-4, 4e6),
        (friction, -15.0, 0.25),
        (density, -6.0, 2.5e-3),
        (velocity, -3.0, 1.0),
    ] {
        assert_relative_eq!(study.value.computed, sum(5.0), max_relative = 1e-14);
        assert_relative_eq!(study.value.reported, sum(5.0), max_relative = 1e-14);
        assert_relative_eq!(study.value.tolerance, -1e-12 * sum(5.0), max_relative = 1e-12);
        // The largest coordinate is that of the lowest particles, 5.25 m and their displacement.
        let rounding = 2.0 * f64::EPSILON * -(5.25 + sum(5.0));
        assert_relative_eq!(study.taylor.rounding, rounding, max_relative = 1e-12);
        assert_relative_eq!(study.taylor.gradient, partial, max_relative = 1e-12);
        let ks: Vec<u32> = study.taylor.perturbed.iter().map(|one| one.level).collect();
        assert_eq!(ks, (4..=16).collect::<Vec<u32>>());
        for one in &study.taylor.perturbed {
            assert_relative_eq!(one.by, q * libm::exp2(-f64::from(one.level)));
            let slope = if study.parameter == "young" {
                -9e-6 * (16.0 + libm::pow(1e-6 * one.by, 2.0) / 3.0)
            } else {
                partial
            };
            assert_relative_eq!(one.difference(), slope, max_relative = 1e-5);
            assert!((one.above < one.below) && (one.below > sum(5.0)), "{one:?}");
        }
        let level = study.levels[1];
        assert_eq!((level.cells, level.h, study.levels[0].cells), (6, 0.5, 3));
        assert_relative_eq!(level.dt, 0.05, max_relative = 1e-12);
        let of_velocity = if study.parameter == "young" { -3.0 / 8e6 } else { 0.0 };
        assert_relative_eq!(level.gradient, partial + of_velocity, max_relative = 1e-12);
    }
    let points: Vec<[f64; 3]> =
        density.points.iter().map(|p| [p.at, p.value, p.gradient]).collect();
    for (point, share) in points.iter().zip([0.75, 0.875, 1.0, 1.125, 1.25]) {
        assert_relative_eq!(point[0], 2.5e-3 * share, max_relative = 1e-14);
        assert_relative_eq!(point[1], sum(5.0) - 0.015 * (share - 1.0), max_relative = 1e-14);
        assert_eq!(point[2], -6.0);
    }
    assert!(points.len() == 5 && young.points.is_empty() && friction.evidence.is_none());
    assert_relative_eq!(density.sweep.as_ref().expect("a sweep").share, 1.0, max_relative = 1e-9);
    let evidence = young.evidence.as_ref().expect("the derivative is wrong");
    assert_relative_eq!(evidence.one_step_less, sum(4.0), max_relative = 1e-14);
    assert_relative_eq!(evidence.without_stress, sum(5.0) + 192.0, max_relative = 1e-12);
    for (error, expected) in evidence.errors.into_iter().zip([0.01, 0.02]) {
        assert_relative_eq!(error, expected, max_relative = 1e-6);
    }
    let entries = &evidence.entries;
    let names: Vec<&str> = entries.iter().map(|entry| entry.parameter).collect();
    assert_eq!(names, ["young", "friction", "density", "initial_velocity"]);
    let differences = [-1.44e-4 * (1.0 + libm::exp2(-16.0) / 3.0), -15.0, -6.0, -3.0];
    for (GradientEntry { reported, difference, .. }, (partial, expected)) in
        entries.iter().zip([-1.454_4e-4, -15.0, -6.0, -3.0].into_iter().zip(differences))
    {
        assert_relative_eq!(*reported, partial, max_relative = 1e-12);
        assert_relative_eq!(*difference, expected, max_relative = 1e-8);
    }
}

/// The order of the suite precedes the formal order of the configuration and that of the solver.
#[rstest]
#[case::of_the_solver(None, None, "1.85 to 2.15")]
#[case::of_the_configuration(Some(1.0), None, "0.85 to 1.15")]
#[case::of_the_suite(Some(1.0), Some(3.0), "2.85 to 3.15")]
fn required_order_of_a_gradient_is(
    #[case] formal_order: Option<f64>,
    #[case] order: Option<f64>,
    #[case] range: &str,
) {
    let terms =
        GateTerms { formal_order, order, because: "a test".to_owned(), ..GateTerms::default() };
    let suite = under_on(&valid_suite(SUITE), &Differentiable::sound(), Some(&terms));
    let suite = suite.expect("a study of solvers");
    let case = Runner::new(&suite).judging(&Differentiable::sound()).case(0, &|| ());
    let expected = case.expected.as_deref().unwrap_or_default();
    assert!(expected.starts_with(&format!("not wrong, order {range}, order of the")), "{expected}");
    assert_eq!(case.because, "a test");
    let skipped = GateTerms { skip: Some("its walls".to_owned()), ..GateTerms::default() };
    let suite = under_on(&valid_suite(SUITE), &Differentiable::sound(), Some(&skipped));
    let case = Runner::new(&suite.unwrap()).judging(&Differentiable::sound()).case(0, &|| ());
    assert_eq!((case.result().name(), case.reason.as_str()), ("known limit", "its walls"));
}
