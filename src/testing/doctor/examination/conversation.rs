//! Examination of the protocol: equal requests must give equal answers, and the number of steps per
//! message must not matter.

use super::force::ramp;
use crate::external::ProblemNeeds;
use crate::testing::doctor::prelude::*;

const STEPS: u64 = 6;

pub(super) const EXAMINATION: Examination = Examination {
    name: "conversation",
    expected: "the solver accepts a problem, takes the requested number of steps of the requested \
               length, and gives bit-identical results in a second run",
    after: &[],
    covers: &["conditions: free", "binary"],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &ANY_LAW, &|kind| {
        let mut scene = BoxScene::of_cells(kind, [0.25; 3], 3.0, 6.0);
        scene.velocity = scene.uniform([0.25; 3]);
        BoxScene { steps: STEPS, dt: 0.05, ..scene }
    })?;
    let problem = scene.problem()?;
    let stepwise = complete(patient.run_problem(&scene, problem.clone())?)?;
    let second = patient.run_problem(&scene, problem.clone())?;
    let mut finding =
        wrong_weights(&stepwise, &scene).or_else(|| repeated(&stepwise, &second, patient));
    if finding.is_none() {
        let mut problem = problem;
        problem.instants = vec![STEPS];
        let at_once = patient.run_problem(&scene, problem)?;
        finding = grouped(&stepwise, &at_once, patient, "at constant speed");
    }
    let (n, d, law) = (stepwise.states[0].len(), scene.dimension, scene.law);
    if finding.is_none() {
        finding = grouped_under_acceleration(patient, (d, law))?;
    }
    if finding.is_none() {
        let halved = BoxScene { dt: 0.5 * scene.dt, ..scene };
        finding = halved_step(&stepwise, &patient.run(&halved)?);
    }
    Ok(Examined::new(format!("{n} points in {d}-D, law {law}, {STEPS} steps"), finding))
}

/// Returns a finding if the weights of the points do not sum to the volume of the body. If the
/// points are a sample of the particles, the sum may be wrong by less than one weight.
fn wrong_weights(course: &Course, scene: &BoxScene) -> Option<SolverFinding> {
    let weights = &course.states[0].weight;
    let lengths = scene.body.0.iter().zip(&scene.body.1).map(|(low, high)| high - low);
    let (volume, sum) = (lengths.product::<f64>(), weights.iter().sum::<f64>());
    let largest = weights.iter().copied().fold(0.0, f64::max);
    let is_near = (sum - volume).abs() <= (0.95 * largest).min(0.5 * volume) + 1e-6 * volume;
    let (n, d, [sum, share]) = (weights.len(), scene.dimension, [sum, sum / volume].map(shown));
    let finding = SolverFinding::defect(
        "weights-of-points",
        format!(
            "the weights of {n} points sum to {sum} m^{d}, which is {share} times the volume of \
             the body"
        ),
        "the weights of the points in `ready` are not the volumes that the points represent",
        "`weight` of `points`: volumes of the undeformed body (m, m^2 or m^3), not masses or ones. \
         A node on the boundary of a mesh has only the parts of its cells inside the body, such as \
         half a cell on a face",
    );
    (!is_near).then_some(finding)
}

/// Returns the largest difference of a final column, relative to the largest value of the column.
fn difference(field: Field, a: &Course, b: &Course) -> f64 {
    let (last, other) = (a.last(), b.last());
    largest_difference(field(&a.states[last]), field(&b.states[other]))
        / a.farthest(field, last, [0.0; 3]).max(f64::MIN_POSITIVE)
}

fn repeated(first: &Course, second: &Course, patient: &Patient<'_>) -> Option<SolverFinding> {
    if first.states == second.states {
        return None;
    }
    let difference = difference(displacement, first, second);
    let shown = shown(difference);
    let seen = format!(
        "the final displacements of two runs of the same problem differ by {shown} of the largest \
         displacement"
    );
    Some(if difference <= patient.rounding() {
        SolverFinding::remark(
            "rounding-differs-each-time",
            seen,
            "sums are computed in a different order in each run, for example by several threads",
            "atomic additions and parallel reductions. The last digits of reports will differ \
             between runs",
        )
    } else {
        SolverFinding::defect(
            "another-way-each-time",
            seen,
            "the run uses data of an earlier run, uninitialised memory or random numbers",
            "arrays that are not set to zero; random numbers in the initial positions; data races \
             between threads",
        )
    })
}

/// Compares six steps in one message with six messages of one step. Under all loads that the solver
/// supports, this reveals an operation that is done once per message instead of once per step.
fn grouped_under_acceleration(
    patient: &Patient<'_>,
    kind: Kind,
) -> Result<Option<SolverFinding>, Hindrance> {
    let accelerated = |gravity: bool| {
        let mut scene = BoxScene::of_cells(kind, [0.2625, 0.3875, 0.1375], 3.0, 3.0);
        scene.velocity = scene.linear(|i, j| if i == j { 0.1 } else { 0.0 });
        // Particles change cells at this velocity.
        scene.velocity.value = scene.uniform([1.0; 3]).value;
        scene.gravity = gravity.then(|| vec![0.37; kind.0]);
        BoxScene { young: 3.0, steps: STEPS, dt: 0.02, ..scene }
    };
    let is_able = |gravity: bool, more: &dyn Fn(&mut ProblemNeeds)| {
        patient.able_with(&[kind.0], &[kind.1], &|_| accelerated(gravity), more).is_ok()
    };
    let is_manufactured = is_able(false, &|needs| needs.manufactured = true);
    let scene = accelerated(!is_manufactured && is_able(true, &|_| ()));
    let mut problem = scene.problem()?;
    if is_manufactured {
        ramp(&mut problem);
    }
    let mut at_once = problem.clone();
    at_once.instants = vec![STEPS];
    let stepwise = match patient.run_problem(&scene, problem).and_then(complete) {
        Ok(stepwise) => stepwise,
        // A failed run is not reported here, because other examinations report it.
        Err(Hindrance::Broke(_)) => return Ok(None),
        Err(lacks) => return Err(lacks),
    };
    let at_once = complete(patient.run_problem(&scene, at_once)?)?;
    Ok(grouped(&stepwise, &at_once, patient, "under acceleration"))
}

fn grouped(
    stepwise: &Course,
    at_once: &Course,
    patient: &Patient<'_>,
    motion: &str,
) -> Option<SolverFinding> {
    let off = difference(displacement, stepwise, at_once);
    let speed = difference(velocity, stepwise, at_once);
    let others: [Field; 2] = [|samples| &samples.stress, |samples| &samples.deformation_gradient];
    let others = others.map(|field| {
        let (a, b) =
            (field(&stepwise.states[stepwise.last()]), field(&at_once.states[at_once.last()]));
        let scale = a.iter().map(|x| x.abs()).fold(f64::MIN_POSITIVE, f64::max);
        largest_difference(a, b) / scale
    });
    let columns = others.into_iter().fold(0.0, f64::max);
    // Rounding errors of stresses, which depend on differences of displacements, are larger.
    if off.max(speed) <= patient.rounding() && columns <= 1e3 * patient.rounding() {
        return None;
    }
    let distance = |course: &Course| course.mean(displacement, course.last()).norm();
    let steps = STEPS as f64 * distance(at_once) / distance(stepwise);
    let [off, speed, columns, steps] = [off, speed, columns, steps].map(shown);
    let seen = format!(
        "{motion}, {STEPS} steps in one `advance` and {STEPS} messages of one step give different \
         results: the final states differ by {off} of the displacement, {speed} of the velocity \
         and {columns} of stress or F. With one message, the body moves as far as in {steps} \
         single steps"
    );
    Some(SolverFinding::defect(
        "steps-depend-on-messages",
        seen,
        "an operation is done once per message instead of once per step or run (initial half step \
         back, reset of affine matrices or F, time restarted at zero), or `advance` takes a wrong \
         number of steps",
        "the loop over `steps` of `advance`, and the code before and after this loop. A run must \
         be initialised only once, when the problem arrives, and the time must continue from \
         `from`",
    ))
}

fn halved_step(whole: &Course, half: &Course) -> Option<SolverFinding> {
    let distance = |course: &Course| {
        let mean = |k| course.mean(displacement, k);
        (mean(course.last()) - mean(1)).norm()
    };
    let ratio = distance(half) / distance(whole);
    // For half the step length, the ratio is 1/2 at constant speed and 1/4 at constant
    // acceleration. Bodies that do not move are reported by the examination `translation`.
    if distance(whole) == 0.0 || ratio <= 0.75 {
        return None;
    }
    Some(SolverFinding::defect(
        "own-step",
        format!(
            "with half the `dt`, the body moves {} of the original distance, expected 0.5",
            shown(ratio)
        ),
        "the solver uses a time step of its own",
        "the time step: use the `dt` of `advance`, which equals the `dt` of the problem",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::Samples;

    /// Arguments: the number of equal weights, and their sum over the volume of the body.
    #[test]
    fn weights_sum_to_the_volume_of_the_body() {
        let scene = BoxScene::of_cells((2, "linear_elastic"), [0.25; 3], 3.0, 6.0);
        let mut course = Course::new(&scene.problem().expect("a problem"));
        let mut is_wrong = |n: usize, sum: f64| {
            let weight = vec![sum * 9.0 * H * H / n as f64; n];
            course.states = vec![Samples { weight, ..Samples::default() }];
            wrong_weights(&course, &scene).is_some()
        };
        assert!(!is_wrong(36, 1.02) && is_wrong(36, 1.03) && is_wrong(36, 0.6));
        assert!(!is_wrong(1, 1.49) && is_wrong(1, 1.51));
    }
}
