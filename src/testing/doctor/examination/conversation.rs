//! The conversation: the same request has the same answer, however the steps are asked for.

use crate::testing::doctor::course::{Course, displacement, minus, shown, size};
use crate::testing::doctor::finding::SolverFinding;
use crate::testing::doctor::patient::{Examined, Hindrance, Patient};
use crate::testing::doctor::question::Examination;
use crate::testing::doctor::scene::BoxScene;

/// Steps of each run.
const STEPS: u64 = 6;

pub(super) const EXAMINATION: Examination = Examination {
    name: "conversation",
    expected: "a problem is taken, steps are as many and as long as was asked, and a second run of it \
               has the same bits",
    after: &[],
    examine,
};

fn examine(patient: &Patient<'_>) -> Result<Examined, Hindrance> {
    let scene = patient.able(&[2, 3, 1], &|kind| {
        let mut scene = BoxScene::of_cells(kind, [0.25; 3], 3.0, 3.0);
        scene.velocity = vec!["0.25".to_owned(); kind.0];
        BoxScene { steps: STEPS, dt: 0.05, ..scene }
    })?;
    let (problem, _) = scene.problem().map_err(Hindrance::Lacks)?;
    let stepwise = patient.run_problem(problem.clone())?;
    if let Some(failure) = stepwise.failure {
        return Err(Hindrance::Broke(failure));
    }
    let mut findings = Vec::new();
    findings.extend(repeated(&stepwise, &patient.run_problem(problem.clone())?, patient));
    if findings.is_empty() {
        let mut at_once = problem;
        at_once.instants = vec![STEPS];
        findings.extend(grouped(&stepwise, &patient.run_problem(at_once)?, patient));
    }
    if findings.is_empty() {
        let halved = BoxScene { dt: 0.5 * scene.dt, ..scene.clone() };
        findings.extend(halved_step(&stepwise, &patient.run(&halved)?));
    }
    let (n, d, law) = (stepwise.states[0].len(), scene.dimension, scene.law);
    Ok(Examined::new(format!("{n} points in {d} dimensions, law {law}, {STEPS} steps"), findings))
}

/// Largest difference of displacements at the end, over that of the motion.
fn apart(a: &Course, b: &Course) -> f64 {
    let (last, other) = (a.last(), b.last());
    let pairs = a.states[last].displacement.iter().zip(&b.states[other].displacement);
    let most = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    most / a.farthest(displacement, last, [0.0; 3]).max(f64::MIN_POSITIVE)
}

fn repeated(first: &Course, second: &Course, patient: &Patient<'_>) -> Option<SolverFinding> {
    let same = first.states == second.states;
    let off = apart(first, second);
    let seen = format!("displacements of two runs of one problem differ by {} of it", shown(off));
    if same {
        return None;
    }
    Some(if off <= patient.rounding() {
        SolverFinding::remark(
            "rounding-differs-each-time",
            seen,
            "sums are made in another order each time, as threads come",
            "atomic additions and reductions over threads; reports of two runs will differ in their \
             last digits",
        )
    } else {
        SolverFinding::defect(
            "another-way-each-time",
            seen,
            "something is left over from an earlier run, is not initialised, or is random",
            "arrays that are not set to zero, random numbers in the seeding, races between threads",
        )
    })
}

fn grouped(stepwise: &Course, at_once: &Course, patient: &Patient<'_>) -> Option<SolverFinding> {
    let off = apart(stepwise, at_once);
    if off <= patient.rounding() {
        return None;
    }
    let way = |course: &Course| size(course.mean(displacement, course.last()));
    let steps = STEPS as f64 * way(at_once) / way(stepwise);
    let seen = format!(
        "{STEPS} steps in one `advance` end {} of the way off those of {STEPS} messages: at \
         {} steps' way",
        shown(off),
        shown(steps)
    );
    let look_at = "the loop over `steps` of `advance`, and what is done before and after it: the \
                   start of a run is done once, when the problem comes";
    Some(SolverFinding::defect(
        "steps-depend-on-messages",
        seen,
        "`advance` does not take as many steps as it says, or each message begins anew",
        look_at,
    ))
}

fn halved_step(whole: &Course, half: &Course) -> Option<SolverFinding> {
    let way = |course: &Course| {
        let mean = |k| course.mean(displacement, k);
        size(minus(mean(course.last()), mean(1)))
    };
    let ratio = way(half) / way(whole);
    // A constant speed gives a half, a constant acceleration a quarter; nothing at all is a matter
    // for `translation`.
    if way(whole) == 0.0 || ratio <= 0.75 {
        return None;
    }
    Some(SolverFinding::defect(
        "own-step",
        format!("half the `dt` leads to {} of the way, where 0.5 was expected", shown(ratio)),
        "steps have a length of the solver's own",
        "the `dt` of `advance`, and that of `problem`, which is the same",
    ))
}
