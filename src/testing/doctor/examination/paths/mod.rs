//! Examination of the column `stress` along prescribed strain paths.
//!
//! The body is so heavy that no wave moves during the run. It therefore follows `v = L (X - X_c)`,
//! and its deformation gradient grows from I to `I + L` in one second. The built-in solver computes
//! the expected stress in the middle of the body in a Total Lagrangian run, which represents the
//! motion exactly. The path is taken from the measured motion, which differs from the prescribed
//! one if velocities are averaged (PIC) or if basis functions are fixed to the grid.
//!
//! ```text
//! mod     runs the paths of a law, and selects a finding on the first wrong stress
//! laws    paths and mistakes of J2 plasticity, fluids and plane stress
//! soils   paths and mistakes of soils
//! ```

mod laws;
mod soils;

use crate::testing::doctor::prelude::*;
pub(super) use laws::{FLUIDS, PLANE_STRESS, PLASTICITY};
pub(super) use soils::SOILS;

use super::laws::deformation_gradient;
use super::stress::{inside, require_whole_body};

const AFTER: &[&str] = &["translation", "force", "transfer", "stress", "laws"];

/// Young's modulus (Pa) of all paths.
const YOUNG: f64 = 15_000.0;

/// Poisson's ratio. Below 0.25, soils with a friction angle of 30 degrees yield in compression.
const POISSON: f64 = 0.2;

/// Density (kg/m3). The density is so large that waves travel only about 1e-8 cells in a second.
const DENSITY: f64 = 1e22;

/// Number of steps of all paths except those in one step.
const STEPS: u64 = 20;

/// Maximum error of a stress that has a known cause, relative to the largest component.
const NEAR: f64 = 0.025;

/// The stress depends on the number of steps if the errors with one and with 20 steps differ so
/// much that the smaller one is at most this fraction of the larger one.
const STEP_RATIO: f64 = 0.3;

type StrainGradient = [[f64; 3]; 3];

const COMPRESSION: StrainGradient = [[-0.000_75, 0.0, 0.0], [0.0; 3], [0.0; 3]];

/// Shear with different principal stresses, on a face of the Mohr-Coulomb pyramid.
const SHEAR: StrainGradient = [[0.000_3, 0.0, 0.0], [0.0, -0.000_3, 0.0], [0.0; 3]];

/// Name of a finding, its cause, and the code to check.
type LawCause = (&'static str, &'static str, &'static str);

/// A mistake: the change of the scene and the factor that give the wrong stress, and the finding.
type LawMistake = (fn(&mut BoxScene), f64, LawCause);

#[derive(Clone, Copy)]
struct StrainPath {
    name: &'static str,
    gradient: StrainGradient,
    steps: u64,
    set: fn(&mut BoxScene),
    /// Whether the path is examined in every number of dimensions.
    everywhere: bool,
    /// Maximum error; `None` for [`bound`].
    bound: Option<f64>,
    /// Finding on any wrong stress; `None` for a finding from the mistakes of the laws.
    cause: Option<LawCause>,
}

impl StrainPath {
    const fn new(name: &'static str, gradient: StrainGradient, set: fn(&mut BoxScene)) -> Self {
        Self { name, gradient, steps: STEPS, set, everywhere: false, bound: None, cause: None }
    }

    const fn steps(self, steps: u64) -> Self {
        Self { steps, ..self }
    }

    const fn everywhere(self) -> Self {
        Self { everywhere: true, ..self }
    }

    const fn cause(self, cause: LawCause) -> Self {
        Self { cause: Some(cause), ..self }
    }

    fn scene(&self, kind: Kind) -> BoxScene {
        let mut scene = path(kind, &self.gradient, self.steps);
        (self.set)(&mut scene);
        scene
    }
}

struct Laws {
    names: &'static [&'static str],
    /// Numbers of dimensions. All paths run in the first one that the solver supports.
    dimensions: &'static [usize],
    /// Differences between correct codes, divided by the strain: of the stress measure, relative to
    /// the stress; and of the strain measure, relative to the strain.
    measures: [f64; 2],
    paths: &'static [StrainPath],
    mistakes: &'static [LawMistake],
    /// Returns the finding on a wrong stress that no mistake explains. The last argument is true if
    /// the stress is right with another number of steps.
    otherwise: fn(&Leg, &[Leg], bool) -> LawCause,
}

#[derive(Clone)]
struct Leg {
    path: StrainPath,
    scene: BoxScene,
    /// Measured stress (Pa).
    stress: Vec<f64>,
    /// Stress of the law (Pa).
    expected: Vec<f64>,
    /// Maximum error of the stress, relative to the largest expected component.
    bound: f64,
}

impl Leg {
    /// Returns the error of the stress, relative to the largest expected component.
    fn relative_error(&self) -> f64 {
        self.distance(&self.expected)
    }

    /// Returns the largest difference between the stress and `other`, relative to the largest
    /// expected component; infinite if a component is NaN.
    fn distance(&self, other: &[f64]) -> f64 {
        let differences = self.stress.iter().zip(other).map(|(a, b)| (a - b).abs());
        let most = |most: f64, x: f64| if x.is_finite() { most.max(x) } else { f64::INFINITY };
        differences.fold(0.0, most) / largest(&self.expected)
    }

    fn is_wrong(&self) -> bool {
        !(self.relative_error() <= self.bound)
    }

    /// Returns the largest difference between the errors of two legs, relative to the largest
    /// expected component.
    fn distance_from(&self, other: &Self) -> f64 {
        let errors = other.stress.iter().zip(&other.expected).map(|(stress, right)| stress - right);
        let moved: Vec<f64> = errors.zip(&self.expected).map(|(off, right)| right + off).collect();
        self.distance(&moved)
    }

    /// Whether the stress fits `factor` times that of the changed law better than its own law.
    fn is_that_of(&self, (change, factor, _): &LawMistake) -> Result<bool, Hindrance> {
        let mut scene = self.scene.clone();
        change(&mut scene);
        let other: Vec<f64> = expected(&scene)?.iter().map(|stress| factor * stress).collect();
        let off = self.distance(&other);
        Ok(off <= NEAR && off <= 0.3 * self.relative_error())
    }

    fn finding(&self, (name, cause, look_at): LawCause) -> SolverFinding {
        let (BoxScene { law, dimension, .. }, path) = (&self.scene, self.path.name);
        let [stress, expected] = [&self.stress, &self.expected].map(|list| shown_list(list));
        let [error, bound] = [self.relative_error(), self.bound].map(shown);
        let seen = format!(
            "{law} in {dimension}-D, {path}: in the middle of the body, the stress is {stress} Pa, \
             expected {expected} Pa. The relative error is {error}, the accepted error {bound}"
        );
        SolverFinding::defect(name, seen, cause, look_at)
    }
}

fn examine(patient: &Patient<'_>, laws: &Laws) -> Result<Examined, Hindrance> {
    let able = |dimensions: &[usize], law: &[&'static str]| {
        let scene = |kind: Kind| laws.paths[0].scene(kind);
        patient.able_with(dimensions, law, &scene, &|needs| needs.columns = vec!["stress"])
    };
    able(laws.dimensions, laws.names)?;
    let (mut all, mut refused) = (Examined::default(), None);
    for law in laws.names {
        let mut run: Vec<Leg> = Vec::new();
        for d in laws.dimensions.iter().filter(|d| able(&[**d], &[*law]).is_ok()) {
            match legs(patient, (*d, law), laws, !run.is_empty()) {
                Ok(legs) => run.extend(legs),
                Err(Hindrance::Lacks(reason)) => refused = Some(reason),
                Err(broke) => return Err(broke),
            }
        }
        for legs in run.chunk_by(|a, b| a.scene.dimension == b.scene.dimension) {
            let errors = legs.iter().map(|leg| {
                let [error, bound] = [leg.relative_error(), leg.bound].map(shown);
                format!("{} {error} (<= {bound})", leg.path.name)
            });
            let (d, errors) = (legs[0].scene.dimension, errors.collect::<Vec<_>>().join(", "));
            let measured = format!("{law} in {d}-D: relative error of the stress in {errors}");
            all.add(Examined::new(measured, None));
        }
        all.add(Examined::new(String::new(), finding(&run, laws)?));
    }
    match refused {
        Some(reason) if all.measured.is_empty() => Err(Hindrance::Lacks(reason)),
        _ => Ok(all),
    }
}

/// Runs the paths of a law, or only those that are examined in every number of dimensions.
fn legs(
    patient: &Patient<'_>,
    kind: Kind,
    laws: &Laws,
    everywhere: bool,
) -> Result<Vec<Leg>, Hindrance> {
    let applies = |path: &&StrainPath| {
        let is_plane = path.gradient[0][1] != 0.0 || path.gradient[1] != [0.0; 3];
        let is_viscous = path.scene(kind).extras.viscosity > 0.0;
        (path.everywhere || !everywhere)
            && (kind.0 > 1 || !is_plane)
            && (kind.1 == "newtonian" || !is_viscous)
    };
    let paths: Vec<&StrainPath> = laws.paths.iter().filter(applies).collect();
    let scenes: Vec<BoxScene> = paths.iter().map(|path| path.scene(kind)).collect();
    let courses = patient.run_all(&scenes)?;
    let leg = |((path, scene), course): ((&StrainPath, &BoxScene), &Course)| {
        let stress = in_middle(course, scene)?;
        let unevenness = unevenness(course, scene);
        let velocity = scene.motion_to(&deformation_gradient(course, scene));
        let scene = BoxScene { velocity, ..scene.clone() };
        let expected = expected(&scene)?;
        let bound = || bound(patient, &scene, &expected, unevenness, laws.measures);
        let bound = path.bound.unwrap_or_else(bound);
        Ok(Leg { path: *path, scene, stress, expected, bound })
    };
    paths.into_iter().zip(&scenes).zip(&courses).map(leg).collect()
}

/// Returns the finding on the first wrong stress. A path is examined only if the stresses on all
/// simpler paths are correct.
fn finding(legs: &[Leg], laws: &Laws) -> Result<Option<SolverFinding>, Hindrance> {
    for (k, leg) in legs.iter().enumerate() {
        let next = legs.get(k + 1).filter(|next| {
            let is_same = next.path.gradient == leg.path.gradient && leg.path.cause.is_none();
            is_same && leg.path.steps == 1 && next.scene.dimension == leg.scene.dimension
        });
        let differs = |next: &&Leg| !(leg.distance_from(next) <= leg.bound.max(next.bound));
        if let Some(next) = next.filter(differs) {
            let errors = [leg, next].map(Leg::relative_error);
            if errors[0].min(errors[1]) <= STEP_RATIO * errors[0].max(errors[1]) {
                let wrong = if errors[0] > errors[1] { leg } else { next };
                return Ok(Some(wrong.finding((laws.otherwise)(wrong, legs, true))));
            }
        }
        if !leg.is_wrong() {
            continue;
        }
        let mut cause = leg.path.cause;
        for mistake in laws.mistakes {
            if cause.is_none() && leg.is_that_of(mistake)? {
                cause = Some(mistake.2);
            }
        }
        let cause = cause.unwrap_or_else(|| (laws.otherwise)(leg, legs, false));
        return Ok(Some(leg.finding(cause)));
    }
    Ok(None)
}

/// Returns the maximum error of a stress, relative to the largest expected component.
///
/// Sound codes differ in the stress measure, whose relative difference is the volume strain, and in
/// the strain measure: logarithmic, linear, or the sum of velocity gradients of explicit steps. The
/// elastic law turns a difference of strains into a stress, which is larger than the stress of a
/// yielding material by the ratio of elastic stress to stress. A motion that is not uniform is
/// another path, with strains that differ by its `unevenness`, and rates that differ more.
fn bound(
    patient: &Patient<'_>,
    scene: &BoxScene,
    expected: &[f64],
    unevenness: f64,
    measures: [f64; 2],
) -> f64 {
    let slopes = scene.velocity.gradient;
    let strain = slopes.iter().flatten().fold(0.0, |most: f64, slope| most.max(slope.abs()));
    let (lambda, mu) = scene.lame();
    let ratio = strain * (lambda + 2.0 * mu) / largest(expected);
    let rounding = patient.tolerance(1e-9, NEAR);
    let uneven = if scene.extras.viscosity > 0.0 { 6.0 } else { 2.0 } * unevenness;
    1.25 * strain * (measures[0] + measures[1] * ratio) + uneven * (1.0 + ratio) + rounding
}

/// Returns the largest deviation of the displacements near the middle of the body from a uniform
/// gradient that grows in proportion to time, relative to the final displacements there. A sample
/// of the points has too few near the middle to show the deviation, which grows towards the faces.
fn unevenness(course: &Course, scene: &BoxScene) -> f64 {
    let reach = if require_whole_body(course, scene).is_ok() { 1.0 } else { 1.5 };
    let field = scene.motion_to(&deformation_gradient(course, scene));
    let end = course.times[course.last()];
    let (mut most, mut whole) = (0.0, 0.0_f64);
    for k in 1..=course.last() {
        let points = course.points(displacement, k);
        for (x, u) in points.filter(|(label, _)| scene.is_central(label, reach)) {
            let off = (u - course.times[k] / end * field.at(x)).norm();
            most = f64::max(most, off);
            whole = whole.max(field.at(x).norm());
        }
    }
    most / whole
}

/// Creates a body whose displacement gradient grows to `gradient` in `steps` steps.
pub(super) fn path(kind: Kind, gradient: &StrainGradient, steps: u64) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.5, 0.625], 6.0, 5.0);
    scene.velocity = scene.linear(|i, j| gradient[i][j]);
    (scene.young, scene.poisson, scene.density) = (YOUNG, POISSON, DENSITY);
    BoxScene { steps, dt: 1.0 / steps as f64, ..scene }
}

/// Returns the mean stress (Pa) in the middle of the body at the end of the run, row after row.
pub(super) fn in_middle(course: &Course, scene: &BoxScene) -> Result<Vec<f64>, Hindrance> {
    inside(course, scene, &course.states[course.last()].stress)
        .ok_or_else(|| Hindrance::Broke("the column `stress` is missing".to_owned()))
}

/// Computes the stress (Pa) in the middle of `scene` at the end with the built-in solver, for a
/// body of four cells along each axis: only nodes of outer cells have an inexact velocity.
fn expected(scene: &BoxScene) -> Result<Vec<f64>, Hindrance> {
    const METHOD: &str = "basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian";
    let at =
        |cells: f64| scene.centre().iter().take(scene.dimension).map(|x| x + cells * H).collect();
    let (body, grid) = ((at(-2.0), at(2.0)), (at(-3.0), at(3.0)));
    let scene = BoxScene { body, grid, ..scene.clone() };
    in_middle(&scene.built_in(METHOD)?, &scene)
}

fn largest(stress: &[f64]) -> f64 {
    stress.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max)
}
