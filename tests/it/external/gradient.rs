//! Derivatives of differentiable solvers. A library solver with a known error produces every state.

use crate::common::valid_suite;
use mpm_verify::external::{
    Capabilities, Gradient, GradientError, GradientRequest, LevelProblem, ProblemNeeds,
    SolverFactory,
};
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{
    Failure, Functional, GradientParameter, Precision, RunCounters, Samples, Subject, SubjectError,
};
use mpm_verify::suite::Suite;
use mpm_verify::verify::{CaseOutcome, GradientState};
use rstest::rstest;

const SUITE: &str = include_str!("../../../verification/gradients/gradient-bar.yaml");

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

struct Moving {
    problem: LevelProblem,
    steps: u64,
    solver: Differentiable,
}

impl Moving {
    fn displacement(&self) -> Vec<f64> {
        let bar = Bar::of(&self.problem, self.steps as f64 * self.problem.dt);
        let (mut amplitude, _) = bar.amplitude(GradientParameter::Young);
        if self.solver.jump.is_some_and(|at| bar.young > at) {
            amplitude *= 1.0 + 1e-4;
        }
        let at = |x: &f64| amplitude * libm::sin(std::f64::consts::FRAC_PI_2 * x);
        let u: Vec<f64> = self.problem.particles.reference_position.iter().map(at).collect();
        match self.solver.precision {
            Precision::Double => u,
            // In single precision, positions are rounded.
            Precision::Single => {
                let x = self.problem.particles.reference_position.iter();
                x.zip(u).map(|(x, u)| f64::from((x + u) as f32) - x).collect()
            }
        }
    }
}

impl Subject for Moving {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        self.steps += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.restart(1);
        samples.label.clone_from(&self.problem.particles.reference_position);
        samples.weight.clone_from(&self.problem.particles.reference_volume);
        samples.displacement = self.displacement();
        samples.velocity = vec![0.0; samples.label.len()];
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

type Edit = fn(&mut Vec<f64>);

/// A solver with gradients of the mean displacement.
#[derive(Clone)]
struct Differentiable {
    names: Vec<&'static str>,
    /// Modifies the gradient before it is reported.
    edit: Edit,
    /// Young's modulus above which the displacement jumps, if any.
    jump: Option<f64>,
    /// Number of steps that are omitted before the value is reported.
    short: u64,
    precision: Precision,
    error: Option<GradientError>,
}

impl Differentiable {
    fn sound() -> Self {
        Self {
            names: vec!["young", "density", "initial_velocity"],
            edit: |_| (),
            jump: None,
            short: 0,
            precision: Precision::Double,
            error: None,
        }
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

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        Ok(Box::new(Moving { problem, steps: 0, solver: self.clone() }))
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
        let steps = problem.steps - self.short;
        let bar = Bar::of(&problem, steps as f64 * problem.dt);
        let mass = problem.particles.mass.clone();
        let moving = Moving { problem, steps, solver: self.clone() };
        let mut samples = Samples::default();
        moving.sample(&mut samples);
        let value = request.of.value(&mass, &samples).value;
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

/// The values are closed forms of the specification, computed to 40 digits.
#[test]
fn exact_sensitivities_match_the_closed_form() {
    for (until, displacement, by_young) in [
        (1.3, 3.611_113_426_6e-6, -3.684_182_349_2e-6),
        (0.5, 2.865_795_841_3e-6, -3.075_025_254_3e-7),
        (2.0, 0.0, -6.366_197_723_7e-6),
    ] {
        let suite = valid_suite(&SUITE.replace("until: 1.3", &format!("until: {until}")));
        let cases = run(&suite, &Differentiable::sound(), false);
        let exact = |case: &CaseOutcome| {
            let study = case.gradient().expect("results");
            study.levels[0].exact
        };
        let expected = [by_young, -by_young, displacement];
        for (case, expected) in cases.iter().zip(expected) {
            let error = (exact(case) - expected).abs();
            assert!(error < 1e-15, "{until} {}: {}", case.case, exact(case));
        }
    }
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
fn a_value_of_another_step_is_wrong() {
    let cases = cases(&Differentiable { short: 1, ..Differentiable::sound() });
    assert_eq!(states(&cases), [GradientState::Wrong; 3]);
    assert!(
        cases[0].reason.contains("is not that of a run without derivatives"),
        "{}",
        cases[0].reason
    );
}

#[rstest]
#[case::in_the_sweep(1.0013)]
#[case::between_perturbations(1.001)]
fn a_jump_of_the_function_is_named(#[case] at: f64) {
    let cases = cases(&Differentiable { jump: Some(at), ..Differentiable::sound() });
    assert_eq!(states(&cases)[0], GradientState::Jumps, "{}", cases[0].reason);
    let study = cases[0].gradient().expect("results");
    assert_eq!(study.sweep.as_ref().expect("a sweep").jumps.len(), 1);
}

#[test]
fn single_precision_is_at_rounding_and_not_wrong() {
    let single = Differentiable { precision: Precision::Single, ..Differentiable::sound() };
    let suite = valid_suite(SUITE);
    for (case, state) in
        run(&suite, &single, false).iter().zip(states(&run(&suite, &single, false)))
    {
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

#[test]
fn a_refusal_is_not_applicable_and_a_failure_fails() {
    let with = |error| cases(&Differentiable { error: Some(error), ..Differentiable::sound() });
    let refused = &with(GradientError::Cannot("no adjoint".to_owned()))[0];
    assert_eq!(
        (refused.result().name(), refused.lacks.as_slice()),
        ("not applicable", &["no adjoint".to_owned()][..])
    );
    let failed = &with(GradientError::Failed("says: NaN at step 17".to_owned()))[0];
    assert_eq!((failed.result().name(), failed.verdict.as_str()), ("FAIL", "failed"));
    assert!(failed.reason.contains("NaN at step 17"), "{}", failed.reason);
}

#[test]
fn a_suite_without_a_solver_needs_one() {
    let outcome = Runner::new(&valid_suite(SUITE)).run(&|| ());
    assert!(outcome.passed());
    for case in &outcome.cases {
        assert_eq!(
            (case.result().name(), case.reason.as_str()),
            ("not applicable", "needs a solver with gradients")
        );
    }
}
