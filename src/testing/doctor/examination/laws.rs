//! Examination of the columns `stress` and `deformation_gradient` of each law at finite strain.
//!
//! A body with negligible stiffness moves with `v = L (X - C)` until stretch, shear and rotation
//! are of order one. In the middle of the body, the column `deformation_gradient` is compared with
//! F from the displacements. The column `stress` is compared with the initial stress of a second
//! body, which starts with the same F because of its initial displacement `(F - I) (X - C)`.

use super::stress::{impulses, inside, require_whole_body};
use crate::mpm::det_of_rows;
use crate::testing::doctor::prelude::*;
use crate::testing::doctor::scene::SOFT;
use nalgebra::Matrix3;

pub(super) const EXAMINATION: Examination = Examination {
    name: "laws",
    expected: "at finite strain and rotation, the column `deformation_gradient` agrees with the \
               motion and the column `stress` with the law",
    after: &["translation", "force", "transfer", "stress"],
    covers: &["laws: linear_elastic", "laws: neo_hookean", "laws: corotated", "laws: hencky"],
    examine,
};

const GRADIENT: [[f64; 3]; 3] = [[0.25, 0.45, 0.1], [-0.15, -0.1, 0.2], [0.05, -0.1, 0.15]];

/// Stretch rate (1/s) in [`volumes`].
const STRETCHED: f64 = 0.5;

/// Maximum error of the stretch in [`volumes`], relative to the imposed one.
const FOLLOWS: f64 = 0.1;

/// Initial displacement gradient of a body that starts deformed.
const START: [[f64; 3]; 3] = [[0.1, -0.3, 0.0], [0.2, 0.0, -0.1], [0.0, 0.1, 0.1]];

/// Maximum error of a component over the largest one. Laws in rate form have time step errors.
const NEAR: f64 = 0.04;

const STEPS: u64 = 25;

/// State with small strains. The errors in this state and at half its time show whether an error
/// grows with the strain.
const EARLY: usize = 4;

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = patient.able_with(&[2, 3, 1], &FINITE, &scene, &|needs| {
        needs.columns = vec!["stress"];
    })?;
    let is_able = |kind: Kind| patient.able(&[kind.0], &[kind.1], &scene).is_ok();
    // All laws run in the first supported number of dimensions, and the first law in all of them.
    let laws = FINITE.into_iter().map(|law| (first.dimension, law));
    let dimensions = [1, 2, 3].into_iter().map(|d| (d, first.law));
    let mut kinds: Vec<Kind> = laws.chain(dimensions).filter(|kind| is_able(*kind)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let mut scenes: Vec<BoxScene> = kinds.iter().map(|kind| scene(*kind)).collect();
    // In a body that starts undeformed, F and the velocity gradient commute, which hides errors in
    // the order of products. One law therefore also runs from a deformed start.
    let elastic = FINITE.map(|law| (first.dimension, law));
    let mut elastic = elastic.into_iter().filter(|(d, law)| *d > 1 && *law != "linear_elastic");
    scenes.extend(elastic.find_map(|kind| patient.able(&[kind.0], &[kind.1], &deformed).ok()));
    let courses = patient.run_all(&scenes)?;
    let mut measured = Vec::new();
    let (mut of_f, mut of_law, mut wrong) = (Vec::new(), Vec::new(), Vec::new());
    for (scene, course) in scenes.iter().zip(&courses) {
        let state = &course.states[course.last()];
        let name = format!("{} in {}-D", scene.law, scene.dimension);
        let motion = deformation_gradient(course, scene);
        let column = inside(course, scene, &state.deformation_gradient);
        let gradient = column.as_ref().unwrap_or(&motion);
        let stress = law_at(scene, gradient)?;
        let off = column.as_ref().map(|f| error(f, &motion));
        let stress_column = inside(course, scene, &state.stress);
        let stress_off = stress_column.as_ref().map(|column| error(column, &stress));
        let texts = [(off, "F"), (stress_off, "stress")].into_iter().filter_map(|(off, column)| {
            off.map(|off| format!("relative error of {column} {}", shown(off)))
        });
        measured.push(format!("{name}: {}", texts.collect::<Vec<_>>().join(", ")));
        // `start` reports ignored deformations. A defect of the law would be repeated.
        let is_deformed = !scene.displacement.is_zero();
        if is_deformed && (wrong.contains(&scene.law) || !starts_deformed(course, scene)) {
            continue;
        }
        if let (Some(column), true) = (&column, off.is_some_and(|off| !(off <= NEAR))) {
            of_f.push(of_gradient(&name, column, &motion, scene));
        } else if let (Some(column), true) =
            (&stress_column, stress_off.is_some_and(|off| !(off <= NEAR)))
        {
            // A body that starts deformed has no small strains.
            let law = if is_deformed {
                None
            } else {
                let [early, earliest] = [EARLY, EARLY / 2].map(|k| stress_errors(course, scene, k));
                of_parameters(&name, [stress_error(column, &stress), early?, earliest?])
            };
            wrong.push(scene.law);
            let differs = || of_stress(&name, column, &stress, gradient, scene);
            of_law.push(law.map_or_else(differs, Ok)?);
        }
    }
    // A wrong F also causes a wrong stress, so findings on F replace findings on the stress.
    let mut all = Examined::default();
    all.add(Examined::new(measured.join("; "), if of_f.is_empty() { of_law } else { of_f }));
    if all.findings.is_empty() {
        all.add(volumes(patient, (first.dimension, first.law))?);
    }
    Ok(all)
}

/// The stress in the middle of a body, compared with the law.
#[derive(Debug, Clone, Copy)]
struct StressError {
    /// Least-squares ratio of the stress to that of the law.
    factor: f64,
    /// Largest error of a component, relative to the largest component of the law.
    error: f64,
    /// Error of the stress divided by `factor`.
    remainder: f64,
}

fn stress_error(column: &[f64], law: &[f64]) -> StressError {
    let dot = |a: &[f64]| a.iter().zip(law).map(|(a, b)| a * b).sum::<f64>();
    let factor = dot(column) / dot(law);
    let scaled: Vec<f64> = column.iter().map(|x| x / factor).collect();
    StressError { factor, error: error(column, law), remainder: error(&scaled, law) }
}

fn stress_errors(course: &Course, scene: &BoxScene, k: usize) -> Result<StressError, Hindrance> {
    let state = &course.states[k];
    let f = inside(course, scene, &state.deformation_gradient);
    let f = f.unwrap_or_else(|| deformation_gradient_at(course, scene, k));
    let column = inside(course, scene, &state.stress).unwrap_or_default();
    Ok(stress_error(&column, &law_at(scene, &f)?))
}

/// Returns a finding if the stress is wrong by a constant factor, or already at small strains,
/// where other stress measures agree. `errors` belong to states with decreasing strains.
fn of_parameters(name: &str, errors: [StressError; 3]) -> Option<SolverFinding> {
    let [end, early, earliest] = errors;
    let is_scaled =
        |at: &StressError| at.remainder <= NEAR && (at.factor / end.factor - 1.0).abs() <= NEAR;
    let look_at = "the parameters of this law: E, nu, and the moduli that are computed from them; \
                   the unit of its stress";
    if (end.factor - 1.0).abs() > NEAR && errors.iter().all(is_scaled) {
        let factor = shown(end.factor);
        return Some(SolverFinding::defect(
            "law-scaled",
            format!("{name}: at all strains, the stress is {factor} times the stress of the law"),
            "a modulus of this law is wrong by this factor, or all moduli are",
            look_at,
        ));
    }
    let is_constant = (earliest.error / early.error - 1.0).abs() <= 0.4;
    let finding = SolverFinding::defect(
        "law-differs",
        format!(
            "{name}: already at small strains, the stress has an error of {} of its largest \
             component",
            shown(earliest.error)
        ),
        "the parameters of this law are wrong, or lambda and mu are used in the wrong places. \
         Another strain or stress measure would cause no error at small strains",
        look_at,
    );
    (is_constant && earliest.error > 2.0 * NEAR).then_some(finding)
}

/// Whether displacement and F after the first step are close to their initial values.
fn starts_deformed(course: &Course, scene: &BoxScene) -> bool {
    let d = scene.dimension;
    let start = &course.problem.particles.deformation_gradient[..d * d];
    let f = inside(course, scene, &course.states[1].deformation_gradient);
    f.is_none_or(|f| error(&f, start) <= 0.1)
        && course.first_motion() <= 0.3 * course.farthest(displacement, 0, [0.0; 3])
}

/// Compares the momentum flux in a body stretched to 1.5 times its length with the flux according
/// to the law. The flux is wrong if forces contain reference volumes. The result is empty if the
/// solver averages velocities, so that the body is stretched less, or if the points are a sample.
fn volumes(patient: &Patient<'_>, kind: Kind) -> Result<Examined, Hindrance> {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.5, 0.625], 12.0, 5.0);
    scene.velocity = scene.slope((0, 0), STRETCHED);
    // Waves travel one cell during the stretch.
    scene.young = scene.density * H * H;
    let scene = BoxScene { steps: STEPS, dt: 1.0 / STEPS as f64, ..scene };
    let courses = patient.run_all(&[scene.clone(), scene.soft()])?;
    let stretched = deformation_gradient(&courses[1], &scene)[0] - 1.0;
    let is_stretched = (stretched - STRETCHED).abs() <= FOLLOWS * STRETCHED;
    if require_whole_body(&courses[0], &scene).is_err() || !is_stretched {
        return Ok(Examined::default());
    }
    let impulse = |course: &Course| impulses(course, &scene, 0, 0)[course.last()];
    let d = scene.dimension;
    // First Piola-Kirchhoff stress, by Simpson's rule. Because J = F_00, P_00 equals sigma_00.
    let mut expected = 0.0;
    for (share, weight) in [(0.0, 1.0), (0.25, 4.0), (0.5, 2.0), (0.75, 4.0), (1.0, 1.0)] {
        let mut f = vec![0.0; d * d];
        (0..d).for_each(|i| f[i * d + i] = 1.0);
        f[0] += share * STRETCHED;
        expected += weight / 12.0 * law_at(&scene, &f)?[0];
    }
    let ratio = (impulse(&courses[0]) - impulse(&courses[1])) / expected;
    let force = shown(ratio);
    let measured = format!(
        "in a body that is stretched to 1.5 times its length, the force is {force} of the expected \
         force (accepted: 0.85 to 1.15)"
    );
    if (ratio - 1.0).abs() <= 0.15 {
        return Ok(Examined::new(measured, None));
    }
    let masses = mass_ratio(patient, &scene);
    let by_mass = masses.map(shown).map_or(String::new(), |mass| {
        format!(
            ". Under a given total force, the accelerations show that the mass of the stretched \
             body is {mass} times the initial mass"
        )
    });
    let law = scene.law;
    let seen = format!(
        "{law}: the impulse of the internal force is {force} of the expected impulse{by_mass}"
    );
    let finding = if masses.is_some_and(|mass| !((mass - 1.0).abs() <= 0.1)) {
        SolverFinding::defect(
            "mass-at-finite-strain",
            seen,
            "the masses of particles change with J = det F, for example because they are \
             recomputed as initial density times present volume",
            "the mass of a particle, which never changes: rho0 V0 = rho V",
        )
    } else {
        SolverFinding::defect(
            "volume-at-finite-strain",
            seen,
            if masses.is_some() {
                "the particle volumes do not follow J = det F: they are not updated, updated \
                 twice, or divided by J"
            } else {
                "the particle volumes do not follow J = det F: they are not updated, updated \
                 twice, or divided by J. Masses that are recomputed from present volumes give the \
                 same motion"
            },
            "the volume in internal forces: V = J V0 with the Cauchy stress, or V0 with the \
             Kirchhoff stress; the mass of a particle, which never changes",
        )
    };
    Ok(Examined::new(measured, Some(finding)))
}

/// Returns the mass of the stretched body over its initial mass: the acceleration under a constant
/// force in the first steps over that in the last steps. `None` without support for such a force.
fn mass_ratio(patient: &Patient<'_>, scene: &BoxScene) -> Option<f64> {
    let force = scene.density * (0..scene.dimension).fold(0.01, |f, _| f * 12.0 * H);
    let pulled = |_| BoxScene { force: Some(force), ..scene.soft() };
    let scene = patient.able(&[scene.dimension], &[scene.law], &pulled).ok()?;
    let course = patient.run(&scene).ok()?;
    let last = course.last();
    let gained = |to: usize| course.mean(velocity, to)[0] - course.mean(velocity, to - 4)[0];
    let ratio = gained(5) / gained(last);
    ratio.is_finite().then_some(ratio)
}

fn scene(kind: Kind) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.5, 0.625], 6.0, 5.0);
    scene.velocity = scene.linear(|i, j| GRADIENT[i][j]);
    let scene = BoxScene { steps: STEPS, dt: 1.0 / STEPS as f64, ..scene };
    BoxScene { young: SOFT.sqrt() * scene.young, ..scene }
}

fn deformed(kind: Kind) -> BoxScene {
    let scene = scene(kind);
    let displacement = scene.linear(|i, j| START[i][j]);
    BoxScene { displacement, ..scene }
}

/// Computes F in the middle of the body at the end of the run, row by row.
pub(super) fn deformation_gradient(course: &Course, scene: &BoxScene) -> Vec<f64> {
    deformation_gradient_at(course, scene, course.last())
}

/// Fits F in the middle of the body in state `k` to the displacements, row by row.
fn deformation_gradient_at(course: &Course, scene: &BoxScene, k: usize) -> Vec<f64> {
    let (d, centre) = (scene.dimension, scene.centre());
    let points = course.points(displacement, k).filter(|(label, _)| scene.is_central(label, 1.0));
    let points: Vec<_> = points.map(|(label, u)| (label - centre, u)).collect();
    let mut f = vec![0.0; d * d];
    for i in 0..d {
        for j in 0..d {
            // The points are symmetric about the centre, so the fit can treat each axis separately.
            let slope: f64 = points.iter().map(|(x, u)| x[j] * u[i]).sum();
            let squares: f64 = points.iter().map(|(x, _)| x[j] * x[j]).sum();
            f[i * d + j] = f64::from(u8::from(i == j)) + slope / squares;
        }
    }
    f
}

/// Returns the initial stress (Pa), row by row, for the deformation gradient `f`.
fn law_at(scene: &BoxScene, f: &[f64]) -> Result<Vec<f64>, Hindrance> {
    let d = scene.dimension;
    let deformed = BoxScene {
        displacement: scene.motion_to(f),
        velocity: AffineField::default(),
        ..scene.clone()
    };
    let problem = deformed.problem()?;
    Ok(problem.particles.stress[..d * d].to_vec())
}

/// Returns the maximum error of a component, relative to the largest component of `expected`.
fn error(tensor: &[f64], expected: &[f64]) -> f64 {
    let scale = expected.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
    let differences = tensor.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |largest, x| if x <= largest { largest } else { x }) / scale
}

fn of_gradient(name: &str, mean: &[f64], f: &[f64], scene: &BoxScene) -> SolverFinding {
    let d = scene.dimension;
    let [seen, expected] = [mean, f].map(shown_list);
    let seen = format!("{name}: in the middle of the body, F is {seen}, expected {expected}");
    let look_at = "the column, which is F = dx/dX row after row: F_ij = dx_i/dX_j; the update F <- \
                   (I + dt L) F with the new velocity gradient L, not F (I + dt L)";
    if error(mean, &transposed(f, d)) <= NEAR {
        return SolverFinding::defect(
            "deformation-gradient-transposed",
            seen,
            "the column contains the transpose of F",
            look_at,
        );
    }
    SolverFinding::defect(
        "deformation-gradient-update",
        seen,
        "the update of F is wrong at finite strain and rotation: factors in the wrong order, only \
         the symmetric part of L, or det F set to another value",
        look_at,
    )
}

fn of_stress(
    name: &str,
    mean: &[f64],
    stress: &[f64],
    f: &[f64],
    scene: &BoxScene,
) -> Result<SolverFinding, Hindrance> {
    let d = scene.dimension;
    let relative =
        |stress: &[f64]| shown_list(&stress.iter().map(|s| s / scene.young).collect::<Vec<_>>());
    let [seen, expected] = [mean, stress].map(relative);
    let seen = format!(
        "{name}: in the middle of the body, the stress divided by E is {seen}, expected {expected}"
    );
    let of_rate = |rate: &[f64]| {
        let off = error(mean, rate);
        off <= 2.0 * NEAR && off <= 0.5 * error(mean, stress)
    };
    if scene.law == "linear_elastic" && of_jaumann_rate(scene, f).is_some_and(|rate| of_rate(&rate))
    {
        return Ok(SolverFinding::remark(
            "objective-rate",
            seen,
            "the stress is integrated with the Jaumann rate. The law `linear_elastic` has the \
             plain rate, sigma' = C : D, without spin terms",
            "the spin terms of the stress rate. Results will differ in suites with large rotations \
             and this law. Omit the spin terms, or remove the law from `laws`",
        ));
    }
    let small = of_small_strain(scene, f);
    if scene.law == "linear_elastic" && error(mean, &small) <= NEAR {
        return Ok(SolverFinding::defect(
            "stress-at-finite-strain",
            seen,
            "the stress is that of small strains, C : sym(F - I). The law `linear_elastic` \
             integrates the rate sigma' = C : D, which differs at finite strain. A solver with \
             linear kinematics has the law `small_strain`",
            "`laws` of the capabilities: list `small_strain` in place of `linear_elastic`. Suites \
             with `linear_elastic` and an exact solution of small strains then remain applicable",
        ));
    }
    // If F^T F is used in place of F F^T, isotropic laws give the stress for F^T.
    let of_transpose = law_at(scene, &transposed(f, d))?;
    let factor = mean[0] / stress[0];
    let scaled: Vec<f64> = stress.iter().map(|s| factor * s).collect();
    let j = det_of_rows(d, f);
    let (finding, cause) = if d > 1 && error(mean, &of_transpose) <= NEAR {
        (
            "stress-not-objective",
            "the stress is computed from F^T F, in the reference axes, and does not rotate with \
             the body. The Cauchy stress requires F F^T",
        )
    } else if (factor / j - 1.0).abs() <= NEAR && error(mean, &scaled) <= NEAR {
        (
            "stress-not-cauchy",
            "the column contains the Kirchhoff stress J sigma instead of the Cauchy stress sigma",
        )
    } else {
        (
            "stress-at-finite-strain",
            "the law differs at finite strain: another strain or stress measure (Kirchhoff, \
             Piola), an objective stress rate instead of the plain rate or the reverse, or a \
             missing factor J",
        )
    };
    Ok(SolverFinding::defect(
        finding,
        seen,
        cause,
        "the equation of the law, which `mpm-verify explain SUITE` prints (`linear_elastic`: \
         sigma' = C : D); the column, which is the Cauchy stress row after row; left and right \
         Cauchy-Green tensors",
    ))
}

/// Returns the small-strain stress `C : sym(F - I)` (Pa), row by row.
fn of_small_strain(scene: &BoxScene, f: &[f64]) -> Vec<f64> {
    let (d, (lambda, mu)) = (scene.dimension, scene.lame());
    let excess = |i: usize, j: usize| f[i * d + j] - f64::from(u8::from(i == j));
    let pressure = lambda * (0..d).map(|i| excess(i, i)).sum::<f64>();
    let entry = |i: usize, j: usize| {
        let spherical = if i == j { pressure } else { 0.0 };
        spherical + mu * (excess(i, j) + excess(j, i))
    };
    (0..d * d).map(|k| entry(k / d, k % d)).collect()
}

/// Integrates the Jaumann rate of linear elasticity, `sigma' = C : D + W sigma - sigma W` with the
/// spin W. The displacement gradient grows linearly in time up to the deformation gradient `f`.
/// Returns the stress (Pa), row by row, or `None` if the body becomes inverted.
fn of_jaumann_rate(scene: &BoxScene, f: &[f64]) -> Option<Vec<f64>> {
    const PARTS: u64 = 400;
    let d = scene.dimension;
    let (lambda, mu) = scene.lame();
    let identity = Matrix3::identity();
    let entry = |i, j| if i < d && j < d { f[i * d + j] } else { f64::from(u8::from(i == j)) };
    let end = Matrix3::from_fn(entry);
    let change = (end - identity) / PARTS as f64;
    let mut sigma = Matrix3::zeros();
    for part in 0..PARTS {
        let middle = identity + (part as f64 + 0.5) * change;
        let step = change * middle.try_inverse()?;
        let strain = 0.5 * (step + step.transpose());
        let spin = step - strain;
        let law = lambda * strain.trace() * identity + 2.0 * mu * strain;
        sigma += law + spin * sigma - sigma * spin;
    }
    Some((0..d * d).map(|k| sigma[(k / d, k % d)]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In simple shear by g, the Jaumann rate gives `mu sin(g)` and normal stresses of
    /// `+-mu (1 - cos(g))`, positive along the shear. The plain rate gives `mu g` alone.
    #[test]
    fn jaumann_rate_is_a_remark() {
        let scene = scene((2, "linear_elastic"));
        let (mu, (sin, cos)) = (scene.lame().1, libm::sincos(0.8));
        let normal = mu * (1.0 - cos);
        for (sign, name) in [(1.0, "objective-rate"), (-1.0, "stress-at-finite-strain")] {
            let column = [sign * normal, mu * sin, mu * sin, -sign * normal];
            let (law, f) = ([0.0, mu * 0.8, mu * 0.8, 0.0], [1.0, 0.8, 0.0, 1.0]);
            let finding = of_stress("", &column, &law, &f, &scene);
            assert_eq!(finding.unwrap_or_else(|_| panic!("it fails")).name, name);
        }
    }
}
