//! Tests of the check, mainly with a manufactured wave in a body that is fixed on all faces.

use super::formula::{Expr, Formula, Scope};
use super::random::Random;
use super::truth::Truth;
use super::{
    Condition, Equation, Face, FacePoint, Forcing, HenckyLaw, InitialStress, Linearised, Motion,
    NeoHookeanLaw, Problem, Round, SmallStrainLaw, Survey, Term, Violation,
};
use mpm_subject::PlaneState;
use rstest::rstest;
use std::sync::Arc;

fn momentum(problem: &Problem) -> Result<(), Violation> {
    super::check::weak::momentum(problem, &Survey::new(problem))
}

/// Asserts that a condition is violated whose name starts with `condition`.
pub(super) fn assert_violated<T: std::fmt::Debug>(found: Result<T, Violation>, condition: &str) {
    let found = found.unwrap_err();
    assert!(found.condition.starts_with(condition), "{found}");
}

/// Asserts that the condition with `violated` in its name is violated; none, if this is empty.
pub(super) fn assert_outcome(found: Result<(), Violation>, violated: &str) {
    match found {
        Ok(()) => assert!(violated.is_empty(), "`{violated}` was not seen"),
        Err(found) if violated.is_empty() => panic!("{found}"),
        Err(found) => assert!(found.condition.contains(violated), "{found}"),
    }
}

const NAMES: [&str; 4] = ["X", "Y", "Z", "t"];

pub(super) fn bind(source: &str, variables: &[&str]) -> Formula {
    Formula::bind(&Expr::parse(source).unwrap(), &Scope::new(), variables).unwrap()
}

/// Gravity (m/s2), formulas of t.
#[derive(Debug)]
struct Weight(Vec<Formula>);

impl Term for Weight {
    fn stated(&self, i: usize, _: &[f64], t: f64, _: &[f64; 3]) -> f64 {
        self.0.get(i).map_or(0.0, |formula| formula.eval(&[t]))
    }

    fn is_uniform(&self) -> bool {
        true
    }
}

pub(super) fn weight(sources: &[&str]) -> Vec<Arc<dyn Term>> {
    vec![Arc::new(Weight(sources.iter().map(|source| bind(source, &["t"])).collect()))]
}

/// Mass-proportional damping (1/s).
#[derive(Debug)]
struct Damped(f64);

impl Term for Damped {
    fn resistance(&self, _: f64, velocity: f64, _: &dyn Fn() -> f64) -> f64 {
        -self.0 * velocity
    }
}

pub(super) struct Demands(Box<Requirement>);

type Requirement = dyn Fn(&dyn FacePoint) -> Result<(), Violation> + Send + Sync;

impl Demands {
    pub(super) fn condition(
        demands: impl Fn(&dyn FacePoint) -> Result<(), Violation> + Send + Sync + 'static,
    ) -> Arc<dyn Condition> {
        Arc::new(Self(Box::new(demands)))
    }
}

impl std::fmt::Debug for Demands {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Demands")
    }
}

impl Condition for Demands {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        (self.0)(point)
    }
}

pub(super) fn fixed() -> Arc<dyn Condition> {
    Demands::condition(|point| (0..point.dimension()).try_for_each(|i| point.held(i, "fixed")))
}

pub(super) fn free() -> Arc<dyn Condition> {
    Demands::condition(|point| {
        (0..point.dimension()).try_for_each(|i| point.traction(i, "free", 0.0))
    })
}

pub(super) fn face(
    name: &'static str,
    axis: usize,
    high: bool,
    condition: Arc<dyn Condition>,
) -> Face {
    Face { name, axis, high, period: 1.0, condition }
}

pub(super) fn held(dimension: usize) -> Problem {
    let names: Vec<&str> = NAMES[..dimension].iter().chain(&["t"]).copied().collect();
    let shape: Vec<String> = NAMES[..dimension].iter().map(|x| format!("sin(pi*{x})")).collect();
    let component = |i: usize| {
        let source = format!("{}/50*{}*sin(3*pi*t)", i + 1, shape.join("*"));
        bind(&source, &names)
    };
    let ends = |axis| [face("low", axis, false, fixed()), face("high", axis, true, fixed())];
    Problem {
        from: vec![0.0; dimension],
        to: vec![1.0; dimension],
        plane: PlaneState::Strain,
        density: 2.0.into(),
        equation: NeoHookeanLaw::new(10.0, 0.3).into(),
        terms: weight(&["-9.81*t"]),
        outline: None,
        heat: None,
        at_rest: false,
        follows_motion: true,
        bodies: Vec::new(),
        initial_stress: InitialStress::default(),
        initial_displacement: Vec::new(),
        manufactured: true,
        faces: (0..dimension).flat_map(ends).collect(),
        initial_velocity: Vec::new(),
        until: 1.0,
        motion: Motion::new((0..dimension).map(component).collect()),
        tolerance: 1e-8,
        linearised: None,
        shared: None,
    }
}

/// The weak-form raster must be fine enough for plane stress and for bodies of revolution.
#[rstest]
fn correct_motion_passes_in_any_plane_state(
    #[values(
        SmallStrainLaw::new(10.0, 0.3).into(),
        NeoHookeanLaw::new(10.0, 0.3).into(),
        HenckyLaw::new(10.0, 0.3).into()
    )]
    equation: Equation,
    #[values(PlaneState::Stress, PlaneState::Axisymmetric)] plane: PlaneState,
) {
    Problem { plane, equation, ..ring() }.check().unwrap();
}

/// Creates the wave of [`held`], with the first coordinate from 1 to 2.
fn ring() -> Problem {
    Problem { from: vec![1.0, 0.0], to: vec![2.0, 1.0], ..held(2) }
}

#[rstest]
fn weak_form_detects_a_missing_force(#[values(1, 2, 3)] dimension: usize) {
    let unforced = Problem { manufactured: false, ..held(dimension) };
    assert_violated(momentum(&unforced), "momentum balance");
}

#[rstest]
fn weak_form_detects_a_force_for_another_plane_state(
    #[values(PlaneState::Strain, PlaneState::Stress, PlaneState::Axisymmetric)] plane: PlaneState,
) {
    let given = Problem { terms: Vec::new(), ..ring() };
    let terms: Vec<Arc<dyn Term>> = vec![Arc::new(Given(given))];
    let found = momentum(&Problem { plane, terms, manufactured: false, ..ring() });
    if plane == PlaneState::Strain {
        found.unwrap();
    } else {
        assert_violated(found, "momentum balance");
    }
}

/// The body force (m/s2) that another problem requires.
#[derive(Debug)]
struct Given(Problem);

impl Term for Given {
    fn stated(&self, i: usize, label: &[f64], t: f64, _: &[f64; 3]) -> f64 {
        self.0.manufactured_force(label, t)[i]
    }
}

#[rstest]
fn the_force_of_a_run_is_the_force(
    #[values(1, 2, 3)] dimension: usize,
    #[values(PlaneState::Strain, PlaneState::Stress, PlaneState::Axisymmetric)] plane: PlaneState,
) {
    let plane = if dimension == 2 { plane } else { PlaneState::Strain };
    let mut problem = Problem { plane, ..held(dimension) };
    problem.terms.push(Arc::new(Damped(0.7)));
    let mut random = Random::new(1);
    let labels: Vec<Vec<f64>> = (0..5).map(|_| random.point(&problem.from, &problem.to)).collect();
    let mut forcing = Forcing::new(&problem, labels.iter().map(Vec::as_slice));
    let mut found = [[0.0; 3]; 5];
    for t in [0.0, 0.3, 0.7] {
        forcing.at(t, &mut found);
        for (label, found) in labels.iter().zip(found) {
            assert_eq!(found, problem.manufactured_force(label, t), "{label:?}, {t}");
        }
    }
}

/// The second run reuses values of the first, and computes them for its own positions.
#[rstest]
fn shared_values_are_bit_identical(#[values(1, 2, 3)] dimension: usize) {
    let alone = held(dimension);
    let problem = Problem { shared: Some(Arc::default()), ..alone.clone() };
    let mut random = Random::new(2);
    let mut some = || (0..5).map(|_| random.point(&alone.from, &alone.to)).collect::<Vec<_>>();
    let (first, second) = (some(), some());
    for (labels, times) in [(&first, [0.0, 0.3]), (&first, [0.3, 0.7]), (&second, [0.3, 0.7])] {
        let mut forcing = Forcing::new(&problem, labels.iter().map(Vec::as_slice));
        let (mut found, mut moved) = ([[0.0; 3]; 5], vec![f64::NAN; 5 * dimension]);
        for t in times {
            forcing.at(t, &mut found);
            problem.displacements(dimension, &labels.concat(), t, &mut moved);
            for ((label, found), moved) in labels.iter().zip(found).zip(moved.chunks(dimension)) {
                let expected = alone.manufactured_force(label, t);
                assert_eq!(found[..dimension], expected[..dimension], "{label:?}, {t}");
                assert_eq!(*moved, alone.motion.derivatives(label, t).u[..dimension]);
            }
            if t == 0.7 {
                problem.shared.as_ref().unwrap().clear();
            }
        }
    }
}

/// Creates a bar from 0 to 1 with c = 1 and a fixed left end.
pub(super) fn bar(displacement: &str, right: Arc<dyn Condition>) -> Problem {
    Problem {
        equation: SmallStrainLaw::new(2.0, 0.0).into(),
        terms: Vec::new(),
        manufactured: false,
        faces: vec![face("left", 0, false, fixed()), face("right", 0, true, right)],
        motion: Motion::new(vec![bind(displacement, &["X", "t"])]),
        ..held(1)
    }
}

/// Automatic differentiation ignores the steps of a staircase.
#[test]
fn two_differentiations_that_disagree_are_refused() {
    let stairs = bar("X*floor(1e9*t)/1e9", free());
    let survey = Survey::new(&stairs);
    let found = super::check::differences::differentiation(&stairs, &survey);
    assert_violated(found, "two differentiations");
}

/// The strain is 1/50 in the first half of the bar, and 1/100 in the stiffer second half.
#[test]
fn the_stress_of_several_bodies_is_that_of_each() {
    let whole = bar("(X - max(0, X - 0.5)/2)/50", free());
    let half = |from, to, young| Problem {
        from: vec![from],
        to: vec![to],
        equation: SmallStrainLaw::new(young, 0.0).into(),
        ..whole.clone()
    };
    let both = Problem { bodies: vec![half(0.0, 0.5, 2.0), half(0.5, 1.0, 4.0)], ..whole };
    for x in [0.0, 0.3, 0.7, 1.0] {
        let mut sigma = [f64::NAN];
        assert!(Truth::stress(&both, &[x], 0.0, &mut sigma));
        assert!((sigma[0] - 0.04).abs() < 1e-15, "{sigma:?} at {x}");
    }
}

/// Creates a plate with nu = 0 and F = ((1, 0.2 t), (0, 1 + 0.3 t)), so P = mu (F - F^-T).
fn sheared(top: Arc<dyn Condition>) -> Problem {
    let names = ["X", "Y", "t"];
    let speed = ["0.2*Y", "0.3*Y"].map(|v| bind(v, &names));
    let driven = Demands::condition(move |point| {
        (0..2).try_for_each(|i| point.velocity(i, point.value(&speed[i])))
    });
    Problem {
        equation: NeoHookeanLaw::new(10.0, 0.0).into(),
        terms: Vec::new(),
        faces: vec![face("bottom", 1, false, driven), face("top", 1, true, top)],
        motion: Motion::new(vec![bind("0.2*Y*t", &names), bind("0.3*Y*t", &names)]),
        ..held(2)
    }
}

#[test]
fn a_traction_may_depend_on_the_place() {
    let pull = |x: &str| {
        let normal = "5*(1 + 0.3*t - 1/(1 + 0.3*t))";
        let value = [format!("{x} - t*X"), format!("{normal} + 0*X")];
        let value = value.map(|v| bind(&v, &["X", "Y", "t"]));
        Demands::condition(move |point| {
            (0..2).try_for_each(|i| point.traction(i, "loaded", point.value(&value[i])))
        })
    };
    sheared(pull("t + t*X")).check().unwrap();
    let found = sheared(pull("t + 1.01*t*X")).check();
    assert_violated(found, "boundary condition: top is loaded, traction in X");
}

/// The bar satisfies `u_tt + 2 u_t = u_XX`.
#[test]
fn damping_is_a_force_in_the_equation_of_motion() {
    let wave = "sin(pi*X)*exp(-t)*sin(sqrt(pi^2 - 1)*t)";
    let damped = Problem { terms: vec![Arc::new(Damped(2.0))], ..bar(wave, fixed()) };
    damped.check().unwrap();
    let undamped = Problem { terms: Vec::new(), ..damped.clone() };
    assert_violated(undamped.check(), "equation of motion");
    let made = Problem { manufactured: true, ..damped };
    assert!(made.manufactured_force(&[0.3], 0.2)[0].abs() < 1e-12);
}

/// A pipe under internal pressure, `sigma_rr = 2 (lambda + mu) A - 2 mu B/r^2`, is free outside.
#[test]
fn what_is_left_is_the_largest_of_all_rims() {
    let names = ["X", "Y", "t"];
    let (lambda, mu) = (10.0 * 0.3 / (1.3 * 0.4), 10.0 / 2.6);
    let b = 0.01;
    let a = mu * b / (4.0 * (lambda + mu));
    let along = |x: &str| bind(&format!("{x}*({a} + {b}/(X^2 + Y^2))"), &names);
    let outline = Round { centre: vec![0.0; 2], inner: 1.0, outer: 2.0 };
    let pipe = Problem {
        from: vec![-2.0; 2],
        to: vec![2.0; 2],
        outline: Some(Arc::new(outline)),
        equation: SmallStrainLaw::new(10.0, 0.3).into(),
        terms: Vec::new(),
        manufactured: false,
        at_rest: true,
        follows_motion: false,
        faces: Vec::new(),
        motion: Motion::new(vec![along("X"), along("Y")]),
        ..held(2)
    };
    let any = Linearised { tolerance: f64::INFINITY, because: String::new() };
    let pipe = Problem { linearised: Some(any), ..pipe };
    let left = super::check::pointwise::tractions_on_rims(&pipe, &Survey::new(&pipe)).unwrap();
    assert!(left > 0.1, "{left}");
}

/// The hoop terms of the pointwise equation and of the weak form agree for `P_zR != P_Rz`.
#[test]
fn large_shear_about_an_axis_balances_in_weak_form() {
    let names = ["X", "Y", "t"];
    let motion = Motion::new(vec![
        bind("0.1*sin(pi*(X - 1))*sin(pi*Y)*sin(3*pi*t)", &names),
        bind("0.6*(X - 1)*(2 - X)*Y*sin(3*pi*t)", &names),
    ]);
    let column = Problem { plane: PlaneState::Axisymmetric, motion, ..ring() };
    momentum(&column).unwrap();
}
