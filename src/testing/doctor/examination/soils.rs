//! Examination of soil plasticity along prescribed strain paths: yield, flow, edges, the apex,
//! objectivity and the number of steps.
//!
//! The body is so heavy that no wave moves during the run. It therefore follows `v = L (X - X_c)`,
//! and its deformation gradient grows from I to `I + L` in one second. The built-in solver computes
//! the expected stress in the middle of the body in a Total Lagrangian run, which represents the
//! motion exactly. The path is taken from the measured motion, which differs from the prescribed
//! one if velocities are averaged (PIC) or if basis functions are fixed to the grid.

use super::laws::deformation_gradient;
use super::stress::inside;
use crate::testing::doctor::course::{AffineField, Course, shown};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Examination, Examined, Hindrance, Patient};
use crate::testing::doctor::scene::{BoxScene, FRICTION, FRICTION_ANGLE, Kind};

pub(super) const EXAMINATION: Examination = Examination {
    name: "soils",
    expected: "in compression, extension, shear and rotation, the column `stress` agrees with the \
               soil law, for one large step and for many small steps",
    after: &["conversation", "rest", "translation", "force", "transfer", "stress", "laws"],
    covers: &["laws: drucker_prager", "laws: mohr_coulomb"],
    examine,
};

const LAWS: [&str; 2] = ["drucker_prager", "mohr_coulomb"];

/// Maximum error of a stress component, relative to the largest component. Laws in rate form have
/// an error of the order of the strain (0.003). With PIC the motion in the middle is not uniform,
/// and the error is up to 0.016.
const NEAR: f64 = 0.025;

/// Maximum error on the path with a rotation; larger than [`NEAR`], because affine transfers change
/// a rotation in their first step.
const NEAR_WITH_ROTATION: f64 = 0.1;

/// The stress is said to depend on the number of steps if the errors with one and with 20 steps
/// differ so much that the smaller one is at most this fraction of the larger one.
const STEP_RATIO: f64 = 0.3;

/// Strength of a soil, as a fraction of Young's modulus. The soil yields at a tenth of the final
/// strain of a path.
const STRENGTH: f64 = 1.0 / 15_000.0;

/// Number of steps of all paths except the one-step path.
const STEPS: u64 = 20;

const YOUNG: f64 = 15_000.0;

/// Poisson's ratio. Below 0.25, soils with a friction angle of 30 degrees yield in uniaxial
/// compression.
const POISSON: f64 = 0.2;

/// Density (kg/m3). The density is so large that waves travel only about 1e-8 cells in a second.
const DENSITY: f64 = 1e22;

/// Displacement gradient at the end of a path of uniaxial compression.
const COMPRESSION: [[f64; 3]; 3] = [[-0.003, 0.0, 0.0], [0.0; 3], [0.0; 3]];
/// Displacement gradient of a uniaxial extension whose elastic stress lies beyond the apex of the
/// yield surface.
const EXTENSION: [[f64; 3]; 3] = [[0.0006, 0.0, 0.0], [0.0; 3], [0.0; 3]];
/// Displacement gradient of a shear with three different principal stresses, so the stress is on a
/// face of the Mohr-Coulomb pyramid.
const SHEAR: [[f64; 3]; 3] = [[0.0012, 0.0, 0.0], [0.0, -0.0012, 0.0], [0.0; 3]];
/// Displacement gradient of a compression to 0.97 along X and a rotation by 0.4 rad: the cosine is
/// 0.921061 and the sine 0.389418.
const ROTATION: [[f64; 3]; 3] =
    [[0.921_061 * 0.97 - 1.0, -0.389_418, 0.0], [0.389_418 * 0.97, 0.921_061 - 1.0, 0.0], [0.0; 3]];

struct Leg {
    scene: BoxScene,
    stress: Vec<f64>,
    expected: Vec<f64>,
}

impl Leg {
    /// Returns the error of the stress, relative to the largest expected component.
    fn relative_error(&self) -> f64 {
        error(&self.stress, &self.expected)
    }

    /// Whether the stress is wrong. NaN counts as wrong.
    fn is_wrong(&self) -> bool {
        !(self.relative_error() <= NEAR)
    }

    /// Returns the largest difference between the stress errors of `self` and `other`, relative to
    /// the largest expected component.
    fn distance_from(&self, other: &Self) -> f64 {
        let errors = |leg: &Self| -> Vec<f64> {
            leg.stress.iter().zip(&leg.expected).map(|(found, expected)| found - expected).collect()
        };
        let pairs = errors(self).into_iter().zip(errors(other)).zip(&self.expected);
        let moved: Vec<f64> = pairs.map(|((a, b), expected)| expected + (a - b)).collect();
        error(&moved, &self.expected)
    }

    /// Whether the measured stress agrees with the expected stress of `other`, a scene with another
    /// law or other parameters.
    fn is_that_of(&self, other: &BoxScene) -> Result<bool, Hindrance> {
        Ok(error(&self.stress, &expected(other)?) <= NEAR)
    }

    fn describe(&self, path: &str) -> String {
        let over = |stress: &[f64]| {
            let parts: Vec<String> = stress.iter().map(|s| shown(s / YOUNG)).collect();
            format!("({})", parts.join(", "))
        };
        format!(
            "{} in {}-D, {path}: in the middle of the body, the stress divided by E is {}, \
             expected {}",
            self.scene.law,
            self.scene.dimension,
            over(&self.stress),
            over(&self.expected)
        )
    }
}

/// All paths of one law; `None` for a path that does not exist in this number of dimensions.
struct Legs {
    compression: Leg,
    one_step: Leg,
    extension: Leg,
    shear: Option<Leg>,
    rotation: Option<Leg>,
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = |kind: Kind| path(kind, &COMPRESSION, STEPS);
    let able = |laws: &[&'static str]| {
        patient.able_with(&[2, 3, 1], laws, &scene, &|needs| needs.columns = vec!["stress"])
    };
    able(&LAWS)?;
    let (mut measured, mut findings) = (Vec::new(), Vec::<SolverFinding>::new());
    for law in LAWS {
        let Ok(first) = able(&[law]) else { continue };
        let legs = legs(patient, (first.dimension, law))?;
        let named = [
            ("compression", Some(&legs.compression)),
            ("one step", Some(&legs.one_step)),
            ("extension", Some(&legs.extension)),
            ("shear", legs.shear.as_ref()),
            ("rotation", legs.rotation.as_ref()),
        ];
        let texts = named.iter().filter_map(|(name, leg)| {
            leg.map(|leg| format!("{name} {}", shown(leg.relative_error())))
        });
        let texts: Vec<String> = texts.collect();
        measured.push(format!(
            "{law} in {}-D: relative error of the stress in {}",
            first.dimension,
            texts.join(", ")
        ));
        let finding = finding(&legs)?;
        let is_new = |finding: &SolverFinding| findings.iter().all(|one| one.name != finding.name);
        findings.extend(finding.filter(is_new));
    }
    Ok(Examined::new(measured.join("; "), findings))
}

fn legs(patient: &Patient<'_>, kind: Kind) -> Result<Legs, Hindrance> {
    let mut scenes = vec![
        path(kind, &COMPRESSION, STEPS),
        path(kind, &COMPRESSION, 1),
        path(kind, &EXTENSION, STEPS),
    ];
    if kind.0 > 1 {
        scenes.push(path(kind, &SHEAR, STEPS));
        let strong = path(kind, &ROTATION, STEPS);
        scenes.push(BoxScene { strength: 10.0 * strong.strength, ..strong });
    }
    let courses = patient.run_all(&scenes)?;
    let legs = scenes.into_iter().zip(&courses).map(|(scene, course)| {
        let stress = in_middle(course, &scene)?;
        let scene = with_gradient(&scene, &deformation_gradient(course, &scene));
        let expected = expected(&scene)?;
        Ok(Leg { scene, stress, expected })
    });
    let mut legs = legs.collect::<Result<Vec<Leg>, Hindrance>>()?.into_iter();
    let mut next = || legs.next();
    let none = || Hindrance::Broke("a path gives no stress".to_owned());
    Ok(Legs {
        compression: next().ok_or_else(none)?,
        one_step: next().ok_or_else(none)?,
        extension: next().ok_or_else(none)?,
        shear: next(),
        rotation: next(),
    })
}

/// Creates a body whose displacement gradient grows to `gradient` in `steps` steps.
pub(super) fn path(kind: Kind, gradient: &[[f64; 3]; 3], steps: u64) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.5, 0.625], 6.0, 5.0);
    let d = scene.dimension;
    let part = |i: usize, j: usize| if i < d && j < d { gradient[i][j] } else { 0.0 };
    let gradient = std::array::from_fn(|i| std::array::from_fn(|j| part(i, j)));
    scene.velocity = AffineField { gradient, centre: scene.centre(), ..AffineField::default() };
    (scene.young, scene.poisson, scene.density) = (YOUNG, POISSON, DENSITY);
    scene.strength = STRENGTH * YOUNG;
    BoxScene { steps, dt: 1.0 / steps as f64, ..scene }
}

/// Returns `scene` with a motion that ends in the deformation gradient `f`, row after row.
fn with_gradient(scene: &BoxScene, f: &[f64]) -> BoxScene {
    let d = scene.dimension;
    let mut scene = scene.clone();
    for (k, slope) in f.iter().enumerate() {
        let (i, j) = (k / d, k % d);
        scene.velocity.gradient[i][j] = slope - f64::from(u8::from(i == j));
    }
    scene
}

/// Returns the mean stress (Pa) in the middle of the body at the end of the run, row after row.
pub(super) fn in_middle(course: &Course, scene: &BoxScene) -> Result<Vec<f64>, Hindrance> {
    inside(course, scene, &course.states[course.last()].stress)
        .ok_or_else(|| Hindrance::Broke("the column `stress` is missing".to_owned()))
}

/// Computes the stress (Pa) in the middle of `scene` at the end with the built-in solver.
fn expected(scene: &BoxScene) -> Result<Vec<f64>, Hindrance> {
    const METHOD: &str = "basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian";
    in_middle(&scene.built_in(METHOD)?, scene)
}

/// Returns the first finding on a law. A path is examined only if the stresses on all simpler paths
/// are correct.
fn finding(legs: &Legs) -> Result<Option<SolverFinding>, Hindrance> {
    let Legs { compression, one_step, extension, shear, rotation } = legs;
    let face_is_right = shear.as_ref().is_some_and(|leg| !leg.is_wrong());
    let on_edge = compression.scene.law == "mohr_coulomb" && face_is_right;
    let [least, most] = sorted(compression.relative_error(), one_step.relative_error());
    let depends_on_steps =
        !(compression.distance_from(one_step) <= NEAR) && (on_edge || least <= STEP_RATIO * most);
    if depends_on_steps {
        let (leg, steps) =
            if one_step.is_wrong() { (one_step, "one step") } else { (compression, "20 steps") };
        let name = format!("compression in {steps}");
        if on_edge {
            return Ok(Some(edge(leg, &name)));
        }
        return Ok(Some(SolverFinding::defect(
            "soil-depends-on-steps",
            leg.describe(&name),
            "the stress depends on the number of steps, although the strain path is straight. The \
             return mapping stops before the stress reaches the yield surface, or uses the flow \
             direction at the start of the step",
            "the return mapping, which must give a stress on the yield surface at the end of a \
             step of any size",
        )));
    }
    if let Some(leg) = [compression, one_step].into_iter().find(|leg| leg.is_wrong()) {
        return of_stress(leg, "compression", on_edge).map(Some);
    }
    if let Some(leg) = shear.as_ref().filter(|leg| leg.is_wrong()) {
        return of_stress(leg, "shear", false).map(Some);
    }
    if extension.is_wrong() {
        return Ok(Some(SolverFinding::defect(
            "soil-apex",
            extension.describe("extension beyond the apex"),
            "in tension, the return mapping does not end at the apex of the yield surface, or the \
             strength is wrong",
            "the return to the apex, p = k/eta (Drucker-Prager) or p = c cot(phi) (Mohr-Coulomb), \
             which is required if the return to the cone or to an edge would reverse the deviator",
        )));
    }
    let is_wrong = |leg: &&Leg| !(leg.relative_error() <= NEAR_WITH_ROTATION);
    let Some(rotation) = rotation.as_ref().filter(is_wrong) else { return Ok(None) };
    Ok(Some(SolverFinding::defect(
        "soil-not-objective",
        rotation.describe("compression with a rotation by 0.4"),
        "the stress is correct without rotation, but wrong with rotation: the elastic strain or \
         the plastic state does not rotate with the body",
        "the elastic strain b_e = F Cp^-1 F^T, with Cp^-1 in the reference axes; for laws in rate \
         form, an objective stress rate",
    )))
}

fn sorted(a: f64, b: f64) -> [f64; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// Returns the finding on a wrong stress on a path. `on_edge` is true for a Mohr-Coulomb soil whose
/// stress is wrong on an edge but right on a face.
fn of_stress(leg: &Leg, path: &str, on_edge: bool) -> Result<SolverFinding, Hindrance> {
    if leg.is_that_of(&BoxScene { law: "hencky", ..leg.scene.clone() })? {
        return Ok(SolverFinding::defect(
            "soil-does-not-yield",
            leg.describe(path),
            "the stress stays elastic beyond the yield surface",
            "the yield function; the units of the strength; the signs: the mean stress p and \
             principal stresses are positive in tension",
        ));
    }
    for (share, flow) in
        [(1.0, "associated: the dilation equals the friction"), (0.0, "without dilation")]
    {
        if leg.is_that_of(&BoxScene { dilation: share, ..leg.scene.clone() })? {
            return Ok(flow_direction(leg, path, &format!("the plastic flow is {flow}")));
        }
    }
    if on_edge {
        return Ok(edge(leg, path));
    }
    match is_on_surface(leg) {
        Some(true) if path == "compression" => Ok(flow_direction(
            leg,
            path,
            "the stress is on the yield surface, but at the wrong point",
        )),
        _ => Ok(yield_surface(leg, path)),
    }
}

fn edge(leg: &Leg, path: &str) -> SolverFinding {
    SolverFinding::defect(
        "soil-edge",
        leg.describe(path),
        "the return to a face of the yield surface is correct, but the return to an edge, where \
         two principal stresses are equal, is wrong",
        "the return to both planes of the edge, with two plastic multipliers; the choice of the \
         edge; after the return, no yield function may be positive",
    )
}

fn flow_direction(leg: &Leg, path: &str, cause: &str) -> SolverFinding {
    SolverFinding::defect(
        "soil-flow-direction",
        leg.describe(path),
        cause,
        "the flow potential, which contains the dilation in place of the friction; the volumetric \
         part of the return, which is K times the dilation",
    )
}

fn yield_surface(leg: &Leg, path: &str) -> SolverFinding {
    SolverFinding::defect(
        "soil-yield-surface",
        leg.describe(path),
        "the stress is not on the yield surface of the problem: wrong coefficient, wrong strength, \
         wrong sign of the mean stress, or angles in wrong units",
        "the yield function: sqrt(J2) + eta p = k with p positive in tension (Drucker-Prager); (t1 \
         - t3) + (t1 + t3) sin(phi) = 2 c cos(phi) with angles in degrees (Mohr-Coulomb)",
    )
}

/// Whether the measured stress of a uniaxial strain path is on the yield surface, with a tolerance
/// for rounded parameters. `None` in one dimension, where the lateral stress is unknown.
fn is_on_surface(leg: &Leg) -> Option<bool> {
    let d = leg.scene.dimension;
    if d == 1 {
        return None;
    }
    let j = 1.0 + leg.scene.velocity.gradient[0][0];
    let (axial, lateral) = (j * leg.stress[0], j * leg.stress[d + 1]);
    let (one, other) = if leg.scene.law == "drucker_prager" {
        let shear = (axial - lateral).abs() / 3.0_f64.sqrt();
        (shear, FRICTION * (axial + 2.0 * lateral) / 3.0 - leg.scene.strength)
    } else {
        let (sin, cos) = libm::sincos(FRICTION_ANGLE.to_radians());
        let strength = 2.0 * leg.scene.strength * cos;
        (lateral - axial, (lateral + axial) * sin - strength)
    };
    Some((one + other).abs() <= NEAR * (one.abs() + other.abs()))
}

/// Computes the largest difference of a component, relative to the largest component of `expected`.
/// The result is infinite if a component is NaN.
fn error(stress: &[f64], expected: &[f64]) -> f64 {
    let scale = expected.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let differences = stress.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(
        0.0,
        |largest: f64, x| {
            if x.is_finite() { largest.max(x) } else { f64::INFINITY }
        },
    ) / scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Returns the axial and lateral Kirchhoff stress (Pa) of a Drucker-Prager soil in uniaxial
    /// compression by the logarithmic strain `e > 0`.
    fn cone(scene: &BoxScene, e: f64) -> (f64, f64) {
        let (lambda, mu) = scene.lame();
        let (bulk, dilation) = (lambda + 2.0 * mu / 3.0, FRICTION * scene.dilation);
        let shear = 2.0 * mu / 3.0_f64.sqrt();
        let (rate, strength) = (shear - FRICTION * bulk, scene.strength);
        let flow = rate / (mu + bulk * FRICTION * dilation) * (e - strength / rate);
        let (mean, root) = (-bulk * e - bulk * dilation * flow, shear * e - mu * flow);
        (mean - 2.0 / 3.0_f64.sqrt() * root, mean + root / 3.0_f64.sqrt())
    }

    /// Returns the stresses of [`cone`] for a Mohr-Coulomb soil. On an edge of the pyramid, two
    /// planes share one plastic multiplier.
    fn pyramid(scene: &BoxScene, e: f64) -> (f64, f64) {
        let (lambda, mu) = scene.lame();
        let modulus = lambda + 2.0 * mu;
        let [(sin, cos), (dilates, _)] =
            [1.0, scene.dilation].map(|share| libm::sincos((FRICTION_ANGLE * share).to_radians()));
        let rate = (1.0 - sin) * modulus - (1.0 + sin) * lambda;
        let volume = 4.0 * lambda * dilates;
        let lateral_flow = volume + 2.0 * mu * (1.0 + dilates);
        let axial_flow = volume - 4.0 * mu * (1.0 - dilates);
        let beyond = e - 2.0 * scene.strength * cos / rate;
        let flow = rate / ((1.0 + sin) * lateral_flow - (1.0 - sin) * axial_flow) * beyond;
        (-modulus * e - flow * axial_flow, -lambda * e - flow * lateral_flow)
    }

    #[rstest]
    #[case("drucker_prager", cone)]
    #[case("mohr_coulomb", pyramid)]
    fn expected_stress_matches_the_closed_form(
        #[case] law: &'static str,
        #[case] closed_form: fn(&BoxScene, f64) -> (f64, f64),
        #[values(1, STEPS)] steps: u64,
        #[values(0.0, 1.0 / 3.0, 1.0)] dilation: f64,
        #[values(1, 2)] dimension: usize,
    ) {
        let scene = BoxScene { dilation, ..path((dimension, law), &COMPRESSION, steps) };
        let stress = expected(&scene).unwrap_or_else(|_| panic!("the built-in solver fails"));
        let j = 1.0 + COMPRESSION[0][0];
        let (axial, lateral) = closed_form(&scene, -libm::log(j));
        assert_relative_eq!(j * stress[0], axial, max_relative = 1e-9);
        if dimension > 1 {
            assert_relative_eq!(j * stress[3], lateral, max_relative = 1e-9);
        }
    }

    fn compression(law: &'static str, dilation: f64) -> Leg {
        let scene = path((2, law), &COMPRESSION, STEPS);
        let of = |scene: &BoxScene| expected(scene).unwrap_or_else(|_| panic!("it fails"));
        let stress = of(&BoxScene { dilation, ..scene.clone() });
        Leg { stress, expected: of(&scene), scene }
    }

    #[rstest]
    fn other_flow_ends_on_the_yield_surface(
        #[values("drucker_prager", "mohr_coulomb")] law: &'static str,
        #[values(0.0, 1.0)] dilation: f64,
    ) {
        let leg = compression(law, dilation);
        assert_eq!(is_on_surface(&leg), Some(true));
        assert!(leg.is_wrong(), "off by {}", leg.relative_error());
        let found = of_stress(&leg, "compression", false).unwrap_or_else(|_| panic!("it fails"));
        assert_eq!(found.name, "soil-flow-direction");
    }

    #[test]
    fn elastic_stress_is_beyond_the_yield_surface() {
        let leg = compression("drucker_prager", 1.0 / 3.0);
        assert!(!leg.is_wrong());
        let scene = BoxScene { law: "hencky", ..leg.scene.clone() };
        let stress = expected(&scene).unwrap_or_else(|_| panic!("it fails"));
        let leg = Leg { stress, ..leg };
        assert_eq!(is_on_surface(&leg), Some(false));
        let found = of_stress(&leg, "compression", false).unwrap_or_else(|_| panic!("it fails"));
        assert_eq!(found.name, "soil-does-not-yield");
    }

    #[test]
    fn stress_that_is_not_a_number_is_wrong() {
        let leg = compression("drucker_prager", 1.0 / 3.0);
        let leg = Leg { stress: vec![f64::NAN; 4], ..leg };
        assert!(leg.is_wrong() && !(leg.distance_from(&leg) <= NEAR));
    }
}
