//! Examination of load steps: a column under its own weight, in one load step and in five.
//!
//! The column stands on the low face of the first axis, and rollers hold its sides. With the height
//! L and the longitudinal modulus M, its displacement under the fraction s of the weight is
//! `s rho g (X^2/2 - L X)/M`, up to a relative error of the order of the strain `rho g L/M`.

use crate::testing::doctor::prelude::*;

pub(super) const EXAMINATION: Examination = Examination {
    name: "load-steps",
    expected: "a column under its own weight has the exact displacement after one load step and \
               after five, and after load step k of five a displacement of k/5 of that",
    after: &[],
    covers: &["load_steps", "loads: gravity", "conditions: free"],
    examine,
};

/// Elastic laws for which suites with load steps are available.
const LAWS: [&str; 2] = ["neo_hookean", "hencky"];

const CELLS: f64 = 8.0;

const STRAIN: f64 = 0.004;

/// Maximum error, relative to the largest displacement. The error of linear functions is at most
/// `(h/L)^2/4` of the displacement.
const NEAR: f64 = 0.03 + STRAIN;

const RULES: Rules<7> = Rules {
    quantities: [
        ("after one load step of one", 1.0, NEAR),
        ("of five", 0.2, NEAR),
        ("after two", 0.4, NEAR),
        ("after three", 0.6, NEAR),
        ("after four", 0.8, NEAR),
        ("after five", 1.0, NEAR),
        ("deviation from the exact profile", 0.0, NEAR),
    ],
    findings: &[
        ("load-not-ramped", ramp(1.0, 1.0, 0.0), "the whole load acts from the first load step on"),
        ("load-per-step", ramp(1.0, 1.0, 1.0), "each load step adds the whole load"),
        ("load-one-step-late", ramp(0.0, 0.0, 0.2), "load step k has the load of step k - 1"),
        (
            "load-steps-differ",
            [1.0, ANY, ANY, ANY, ANY, ANY, ANY],
            "the column is correct after one load step of one, but wrong in five: the load does \
             not grow in equal parts, or the state after a step (F, stress, volume, displacement) \
             is not the start of the next one",
        ),
        (
            "column-differs",
            [ANY; 7],
            "gravity, particle masses, the modulus of uniaxial strain lambda + 2 mu or the \
             conditions on faces are wrong, or the iteration for the equilibrium stops too early",
        ),
    ],
    look_at: "the fraction of the load: after load step k of `load_steps`, the body is in \
              equilibrium under k/load_steps of its loads, in the state that starts from the \
              previous equilibrium",
};

/// Returns the displacements after one load step, and after five with equal increments.
const fn ramp(one: f64, first: f64, growth: f64) -> Pattern<7> {
    let (second, third) = (first + growth, first + 2.0 * growth);
    let (fourth, fifth) = (third + growth, third + 2.0 * growth);
    [one, first, second, third, fourth, fifth, 0.0]
}

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let first = patient.able(&[2, 3, 1], &LAWS, &|kind| column(kind, 1))?;
    let kind = (first.dimension, first.law);
    let scenes = [column(kind, 1), column(kind, 5)];
    let courses = patient.run_all(&scenes)?;
    Ok(RULES.judge(&[row(&scenes, &courses)]))
}

fn column(kind: Kind, steps: u64) -> BoxScene {
    let mut scene = BoxScene::of_cells(kind, [0.75, 0.25, 0.5], CELLS, 0.0);
    scene.grid = scene.body.clone();
    scene.grid.1[0] += scene.h;
    scene.faces = vec![(FACES[0][0], if kind.0 == 1 { "fixed" } else { "roller" })];
    let sides = FACES[1..kind.0].iter().flatten();
    scene.faces.extend(sides.map(|face| (*face, "roller")));
    let (lambda, mu) = scene.lame();
    let mut gravity = vec![0.0; kind.0];
    gravity[0] = -STRAIN * (lambda + 2.0 * mu) / (scene.density * CELLS * scene.h);
    scene.extras.load_steps = true;
    BoxScene { gravity: Some(gravity), steps, dt: 1.0, ..scene }
}

/// Returns the displacements after one load step and after each of five, relative to the exact one
/// under the whole weight, and the largest deviation from its profile.
fn row(scenes: &[BoxScene], courses: &[Course]) -> Row<7> {
    let (mut values, mut deviation) = ([None; 7], 0.0);
    let states = courses
        .iter()
        .zip(scenes)
        .flat_map(|(course, scene)| (1..=course.last()).map(move |k| share(course, scene, k)));
    for (value, (factor, off)) in values.iter_mut().zip(states) {
        *value = Some(factor);
        // NaN counts as a deviation.
        deviation = if off <= deviation { deviation } else { off };
    }
    values[6] = Some(deviation);
    ("relative to the exact displacement under the whole weight".to_owned(), values)
}

/// Returns the factor of the exact displacement that fits state `k` best, and the largest
/// difference from this multiple, relative to the largest exact displacement.
fn share(course: &Course, scene: &BoxScene, k: usize) -> (f64, f64) {
    let length = CELLS * scene.h;
    let exact = |label: Vector3<f64>| {
        let x = label[0] - scene.body.0[0];
        STRAIN * (0.5 * x * x / length - x)
    };
    let points: Vec<_> = course.points(displacement, k).collect();
    let products: f64 = points.iter().map(|(label, u)| exact(*label) * u[0]).sum();
    let squares: f64 = points.iter().map(|(label, _)| exact(*label) * exact(*label)).sum();
    let factor = products / squares;
    let differences = points.iter().map(|(label, u)| (u[0] - factor * exact(*label)).abs());
    let most = |most: f64, x| if x <= most { most } else { x };
    (factor, differences.fold(0.0, most) / (0.5 * STRAIN * length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    fn built_in_load_steps_have_no_finding(
        #[values("neo_hookean", "hencky")] law: &'static str,
        #[values("linear", "cpgimp", "quadratic_bspline")] basis: &str,
        #[values(1, 2)] dimension: usize,
    ) {
        let scenes = [1, 5].map(|steps| column((dimension, law), steps));
        let method = format!("basis: {basis}, scheme: quasi_static");
        let run = |scene: &BoxScene| scene.built_in(&method).unwrap_or_else(|e| panic!("{e}"));
        let examined = RULES.judge(&[row(&scenes, &scenes.each_ref().map(run))]);
        assert!(examined.findings.is_empty(), "{}", examined.measured);
    }
}
