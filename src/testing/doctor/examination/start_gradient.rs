//! Bodies whose initial strain or stress varies linearly, as part of the examination `start`.

use crate::external::SMALL_STRAIN;
use crate::testing::doctor::prelude::*;

/// Gradient (1/m) of an initial strain that varies along the first axis. Strains are at most 0.006.
const STRAIN_GRADIENT: f64 = 0.008;

/// Velocities at the end of the first step may belong to a time half a step earlier or later. The
/// faces move outwards faster than the middle, and a transfer that diffuses momentum over some
/// cells carries this to the middle: APIC with cubic B-splines and five sub-steps has 1.14. If the
/// law computes the stress from F, a wrong initial stress acts in the first step only.
const GRADIENT: Rules<2> = Rules {
    quantities: [("velocity after one step", 1.0, 0.62), ("acceleration in later steps", 1.0, 0.3)],
    findings: &[
        ("initial-stress-uniform", [ANY, 0.0], UNIFORM),
        ("initial-stress-uniform", [0.0, 1.0], UNIFORM),
        (
            "initial-stress-gradient",
            [ANY; 2],
            "the initial stress varies wrongly over the body: values belong to other particles, or \
             masses or volumes do not",
        ),
    ],
    look_at: "`particles.stress`, `particles.deformation_gradient` and `particles.initial_stress` \
              of the problem, which have one tensor for each particle, in the order of the \
              particles",
};

const UNIFORM: &str = "the initial stress or F of one particle, or a mean over the body, is used \
                       for all particles";

/// Examines bodies with the initial strain `c (X - X_c)` or the initial stress `M c (X - X_c)`.
/// Until waves arrive, the middle has the acceleration `M c/rho` (M: longitudinal modulus).
pub(super) fn examine(
    patient: &Patient<'_>,
    undeformed: &dyn Fn(Kind) -> BoxScene,
) -> Result<Examined, Hindrance> {
    let graded = |kind: Kind, by_stress: bool| {
        let mut scene = undeformed(kind);
        let ((lambda, mu), c) = (scene.lame(), STRAIN_GRADIENT);
        let from_centre = format!("(X - ({:e}))", scene.centre()[0]);
        let mut formulas = vec!["0".to_owned(); kind.0];
        formulas[0] = format!("{:e}*{from_centre}^2", 0.5 * c);
        scene.extras.keys.push(if by_stress {
            format!("initial_stress: {{xx: \"{:e}*{from_centre}\"}}", (lambda + 2.0 * mu) * c)
        } else {
            format!("initial_displacement: {formulas:?}")
        });
        scene
    };
    let able = |laws: &[&'static str], by_stress| {
        patient.able(&[2, 3, 1], laws, &|kind| graded(kind, by_stress)).ok()
    };
    let laws = FINITE.iter().chain(&[SMALL_STRAIN]);
    let laws = laws.filter_map(|law| Some(("strain", able(&[law], false)?)));
    let by_stress = able(&FINITE, true).map(|scene| ("stress", scene));
    let (names, scenes): (Vec<&str>, Vec<BoxScene>) = laws.chain(by_stress).unzip();
    if scenes.is_empty() {
        return Ok(Examined::default());
    }
    let courses = patient.run_all(&scenes)?;
    let rows = names.into_iter().zip(scenes.iter().zip(&courses)).map(|(name, (scene, course))| {
        let values = accelerations(course, scene).map(Some);
        (format!("{} with a gradient of the initial {name}", scene.law), values)
    });
    Ok(GRADIENT.judge(&rows.collect::<Vec<Row<2>>>()))
}

/// Returns the accelerations in the first and in later steps, relative to `M c/rho`.
fn accelerations(course: &Course, scene: &BoxScene) -> [f64; 2] {
    let (lambda, mu) = scene.lame();
    let speed = |k: usize| {
        let near = course.points(velocity, k).filter(|(label, _)| scene.is_central(label, 2.0));
        let (sum, count) = near.fold((0.0, 0.0), |(s, n), (_, v)| (s + v[0], n + 1.0));
        sum / count
    };
    let speeds: Vec<f64> = (1..=course.last()).map(speed).collect();
    let (_, slope, _) = line(&course.times[1..], &speeds);
    let expected = (lambda + 2.0 * mu) * STRAIN_GRADIENT / scene.density;
    [speeds[0] / course.times[1] / expected, slope / expected]
}
