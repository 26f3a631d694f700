//! Motions of benchmark problems in several dimensions, stated by formulas: body forces compared
//! with published values, a wave without force, and a start with a deformation.

use crate::common::valid_suite;
use approx::{assert_abs_diff_eq, assert_relative_eq};
use mpm_verify::exact::formula::{Expr, Formula, Scope};
use mpm_verify::exact::{InitialStress, Motion, NeoHookeanLaw, Problem, Truth};
use mpm_verify::study::Runner;
use mpm_verify::subject::PlaneState;
use rstest::rstest;

const NAMES: [&str; 3] = ["X", "Y", "Z"];

/// Creates a neo-Hookean body without faces with the motion `displacement`, which uses `functions`.
fn problem(
    (young, poisson, density): (f64, f64, f64),
    functions: &[(&str, &[&str], &str)],
    displacement: &[&str],
    until: f64,
) -> Problem {
    let mut scope = Scope::new();
    for (name, parameters, body) in functions {
        let parameters: Vec<String> = parameters.iter().map(|p| (*p).to_owned()).collect();
        let body = Expr::parse(body).expect("a sound body");
        scope.function(name, &parameters, body).expect("a sound function");
    }
    let d = displacement.len();
    let variables: Vec<&str> = NAMES[..d].iter().copied().chain(["t"]).collect();
    let formula = |text: &&str| {
        let expr = Expr::parse(text).expect("a sound formula");
        Formula::bind(&expr, &scope, &variables).expect("known names")
    };
    Problem {
        from: vec![0.0; d],
        to: vec![1.0; d],
        outline: None,
        plane: PlaneState::Strain,
        density: density.into(),
        equation: NeoHookeanLaw::new(young, poisson).into(),
        terms: Vec::new(),
        heat: None,
        at_rest: false,
        manufactured: true,
        faces: Vec::new(),
        follows_motion: true,
        bodies: Vec::new(),
        initial_stress: InitialStress::default(),
        initial_displacement: Vec::new(),
        initial_velocity: Vec::new(),
        until,
        motion: Motion::new(displacement.iter().map(formula).collect()),
        tolerance: 1e-8,
        linearised: None,
        shared: None,
    }
}

/// Wallstedt & Guilkey (2008): `u_i = A sin(pi X_i) sin(pi (phi_i + c t))`.
#[test]
fn the_force_of_the_axis_aligned_motion() {
    let (bulk, mu) = (8333.33, 3846.15);
    let young: f64 = 9.0 * bulk * mu / (3.0 * bulk + mu);
    let poisson = (3.0 * bulk - 2.0 * mu) / (2.0 * (3.0 * bulk + mu));
    let speed = young.sqrt();
    let body = format!("0.05*sin(pi*s)*sin(pi*(phi + {speed}*tau))");
    let wave: (&str, &[&str], &str) = ("wave", &["s", "phi", "tau"], &body);
    let components = ["wave(X, 0, t)", "wave(Y, 2/3, t)", "wave(Z, 4/3, t)"];
    let made = problem((young, poisson, 1.0), &[wave], &components, 0.01);
    let found = made.manufactured_force(&[0.23, 0.61, 0.37], 0.0031);
    for (found, published) in found.iter().zip([453.410_869_66, 114.088_227_19, -1_809.332_256_58])
    {
        assert_relative_eq!(*found, published, max_relative = 1e-10);
    }
}

/// The composition of two simple shears preserves volume: `y = Y + S sin(2 pi x)`, with the present
/// position x. Positions and forces were computed from `b = u_tt - Div P/rho0` by hand.
#[rstest]
#[case([0.1, 0.2], 0.15, [0.108_273_536_1, 0.205_472_113_1], [0.252_164_288_7, 0.204_106_154_8])]
#[case([0.37, 0.81], 0.25, [0.357_324_566_2, 0.820_648_821_5], [-0.386_327_165_2, 0.358_998_951])]
#[case([0.6, 0.05], 0.1, [0.601_826_415_3, 0.046_471_309_1], [0.055_666_248_8, -0.119_572_641])]
fn the_force_of_two_shears_does_not_depend_on_the_bulk_modulus(
    #[case] place: [f64; 2],
    #[case] t: f64,
    #[case] position: [f64; 2],
    #[case] published: [f64; 2],
) {
    let shift: (&str, &[&str], &str) = ("S", &["s"], "0.02*sin(3*s)");
    let components = ["S(t)*sin(2*pi*Y)", "S(t)*sin(2*pi*(X + S(t)*sin(2*pi*Y)))"];
    for poisson in [0.0, 0.3, 0.4999] {
        let made = problem((2.0 * (1.0 + poisson), poisson, 1.0), &[shift], &components, 0.25);
        let mut u = [0.0; 2];
        made.motion.displacement(&place, t, &mut u);
        let found = made.manufactured_force(&place, t);
        // The bulk modulus multiplies the rounding errors of ln J = 0.
        let epsilon = if poisson < 0.4 { 1e-10 } else { 1e-9 };
        for axis in 0..2 {
            assert_abs_diff_eq!(place[axis] + u[axis], position[axis], epsilon = 1e-10);
            assert_abs_diff_eq!(found[axis], published[axis], epsilon = epsilon);
        }
    }
}

/// The nonlinear simple wave `F = F0(X - C(F) t)` needs no force and has no closed form. But along
/// a characteristic `X = xi + C t` F is constant, and `x = x0(xi) + (v + F C) t`. Newton's
/// iteration for xi, written as nested formulas, converges together with its derivatives.
const WAVE: [(&str, &[&str], &str); 8] = [
    ("F0", &["q"], "1 + 0.1*sin(2*pi*q)"),
    ("slope", &["q"], "0.2*pi*cos(2*pi*q)"),
    ("C", &["f"], "100*sqrt((1 + 1/f^2)/2)"),
    ("dC", &["f"], "-1e4/(2*f^3*C(f))"),
    ("v", &["f"], "-100/sqrt(2)*(sqrt(f^2 + 1) - asinh(1/f) - sqrt(2) + asinh(1))"),
    ("better", &["x", "s", "q"], "q - (q + s*C(F0(q)) - x)/(1 + s*dC(F0(q))*slope(q))"),
    (
        "xi",
        &["x", "s"],
        "better(x, s, better(x, s, better(x, s, better(x, s, better(x, s, x - 100*s)))))",
    ),
    ("u", &["x", "s", "q"], "q + 0.05/pi*(1 - cos(2*pi*q)) + s*(v(F0(q)) + F0(q)*C(F0(q))) - x"),
];

/// Half of the time at which the shock forms (s).
const HALF: f64 = 0.030_861_8 / 2.0;

#[test]
fn a_simple_wave_needs_no_force() {
    let free = Problem {
        manufactured: false,
        ..problem((1e4, 0.0, 1.0), &WAVE, &["u(X, t, xi(X, t))"], HALF)
    };
    free.check().expect("a solution without any force");
}

#[rstest]
fn a_simple_wave_keeps_f_along_its_characteristics(#[values(0.05, 0.4, 0.77)] place: f64) {
    let wave = problem((1e4, 0.0, 1.0), &WAVE, &["u(X, t, xi(X, t))"], HALF);
    let now = wave.motion.derivatives(&[place], HALF);
    let f = 1.0 + now.grad[0][0];
    let speed = 100.0 * f64::midpoint(1.0, 1.0 / (f * f)).sqrt();
    let carried = 1.0 + 0.1 * libm::sin(2.0 * std::f64::consts::PI * (place - speed * HALF));
    assert_relative_eq!(f, carried, max_relative = 1e-12);
    let rise = |f: f64| (f * f + 1.0).sqrt() - libm::asinh(1.0 / f);
    let expected = -100.0 / 2.0_f64.sqrt() * (rise(f) - rise(1.0));
    assert_relative_eq!(now.velocity[0], expected, max_relative = 1e-10);
}

/// With cos instead of sin, the bar starts at rest with displacements of 2 % of its length and
/// strains of 6 %. A start without the corresponding stress, volume or domains has no order.
#[test]
fn bar_that_starts_deformed_has_order_two() {
    let (scene, _) =
        include_str!("../../verification/bars-at-large-strain/mms-fixed-bar-small.yaml")
            .split_once("methods:")
            .expect("methods");
    let scene = scene.replace("sin(c*pi*t)", "cos(c*pi*t)").replace("G: 1e-4", "G: 0.02");
    let text = scene
        + r"methods:
  - mpm: {basis: cpgimp, transfer: flip, scheme: musl, start: half_step_back}
  - fem: {element: linear, mass: lumped, start: half_step_back}
judge: {norm: max_rms}
expect:
  - order: [1.8, 2.15]
    finest_pair: [1.95, 2.05]
    because: order 2 in space and, started half a step back, in time
";
    let suite = valid_suite(&text);
    for case in Runner::new(&suite).run(&|| ()).cases {
        assert!(case.passed(), "{}: {:?}", case.case, case.unmet);
    }
}
