//! A run of a study that is interrupted and goes on shows what a whole one does.

use mpm_verify::study::Runner;
use mpm_verify::suite::{ConvergencePlan, StabilityPlan, StudyPlan, Suite, embedded};
use mpm_verify::verify::{CheckpointStore, Convergence, StabilityStudy};
use rstest::rstest;
use std::any::Any;
use std::sync::{Arc, Mutex};

/// The only run of a suite of one case: its steps, and all that it shows.
struct Run {
    steps: u64,
    shown: String,
}

/// What the store of one run holds.
#[derive(Default)]
struct Store {
    /// The step whose state is stored, and the steps that there have been.
    at: u64,
    asked: u64,
    state: Option<Vec<u8>>,
    reported: Vec<Option<u64>>,
}

struct Shared<'a>(&'a Mutex<Store>);

impl CheckpointStore for Shared<'_> {
    fn left(&mut self) -> Option<Vec<u8>> {
        self.0.lock().unwrap().state.clone()
    }

    fn taken(&mut self, steps: Option<u64>) {
        self.0.lock().unwrap().reported.push(steps);
    }

    fn is_due(&mut self) -> bool {
        let mut store = self.0.lock().unwrap();
        store.asked += 1;
        store.asked == store.at
    }

    fn keep(&mut self, state: &[u8]) {
        self.0.lock().unwrap().state = Some(state.to_vec());
    }
}

fn load(name: &str) -> Suite {
    Suite::load(&embedded::source(name).unwrap().unwrap()).unwrap()
}

fn with_plan(suite: &Suite, plan: impl StudyPlan) -> Suite {
    let mut suite = suite.clone();
    suite.study = Arc::new(plan);
    suite
}

/// One level of one case.
fn of_level(suite: &Suite, plan: &ConvergencePlan, case: usize, level: usize) -> Suite {
    let mut plan = plan.clone();
    plan.cases = vec![plan.cases[case].clone()];
    plan.cases[0].expectation.as_mut().unwrap().floor = None;
    plan.refine.levels = vec![plan.refine.levels[level]];
    plan.refine.usual = 1;
    with_plan(suite, plan)
}

/// The run of `runner`.
fn run(runner: &Runner<'_>) -> Run {
    let outcome = runner.case(0, &|| ());
    let study = outcome.study.expect(&outcome.reason);
    let study: &dyn Any = study.as_ref();
    if let Some(Convergence { levels, .. }) = study.downcast_ref() {
        let [level] = &levels[..] else { panic!("one level") };
        return Run { steps: level.run.steps, shown: format!("{level:?}") };
    }
    let StabilityStudy { rows, .. } = study.downcast_ref().expect("a study of steps");
    let [row] = &rows[..] else { panic!("one row") };
    Run { steps: row.trial.as_ref().expect("a run").steps, shown: format!("{row:?}") }
}

/// The run of a suite with this store, and the store afterwards.
fn run_with(suite: &Suite, store: Store) -> (Run, Store) {
    let store = Mutex::new(store);
    let found = run(&Runner::new(suite).checkpointing(&|| Box::new(Shared(&store))));
    (found, store.into_inner().unwrap())
}

/// Interrupted after a third of its steps, a run shows the same. Returns the state that was left.
fn goes_on(suite: &Suite) -> Vec<u8> {
    let (name, whole) = (suite.case_names()[0], run(&Runner::new(suite)));
    let at = (whole.steps / 3).max(1);
    let (first, left) = run_with(suite, Store { at, ..Store::default() });
    assert_eq!(first.shown, whole.shown, "{name}");
    assert_eq!(left.reported, [], "{name}: nothing was left");
    let state = left.state.expect(name);
    let (second, taken) = run_with(suite, Store { state: Some(state.clone()), ..Store::default() });
    assert_eq!(second.shown, whole.shown, "{name}");
    assert_eq!(taken.reported, [Some(at)], "{name}");
    state
}

/// Every kind of subject and all that a judge gathers: histories, the totals of a run, a state of
/// rest, temperatures, F and stress, sums over the body; bodies in contact, walls with friction and driven ones,
/// plastic flow.
#[rstest]
#[case("vibrating-bar")]
#[case("vibrating-bar-long")]
#[case("column-hencky-small-load")]
#[case("fem-vibrating-bar")]
#[case("heat-convection")]
#[case("thermal-expansion-mms")]
#[case("two-bar-impact")]
#[case("sticking-block")]
#[case("plastic-wave")]
#[case("rotating-block")]
#[case("simple-shear")]
#[case("plane-stress-wave")]
#[case("plane-stress-pull")]
#[case("vibrating-bar-reaction")]
#[case("axisymmetric-wave")]
#[case("pressurised-cylinder")]
fn an_interrupted_level_shows_what_a_whole_one_does(#[case] name: &str) {
    let suite = load(name);
    let plan: &ConvergencePlan = suite.plan().unwrap();
    for case in [0, plan.cases.len() - 1] {
        goes_on(&of_level(&suite, plan, case, 0));
    }
}

/// Cut short, after more steps than there are, and of another level.
#[test]
fn a_level_starts_anew_if_what_is_left_is_no_state_of_it() {
    let suite = load("vibrating-bar");
    let plan: &ConvergencePlan = suite.plan().unwrap();
    let coarsest = of_level(&suite, plan, 0, 0);
    let (whole, state) = (run(&Runner::new(&coarsest)), goes_on(&coarsest));
    let of_another = goes_on(&of_level(&suite, plan, 0, 1));
    let torn = state[..state.len() / 2].to_vec();
    let beyond = [&whole.steps.to_le_bytes(), &state[8..]].concat();
    for state in [torn, beyond, of_another] {
        let (found, store) = run_with(&coarsest, Store { state: Some(state), ..Store::default() });
        assert_eq!(found.shown, whole.shown);
        assert_eq!(store.reported, [None], "no such state");
    }
}

/// Runs that come to their end, and runs that fail by name; steps of two lengths.
#[rstest]
#[case("extreme-compression")]
#[case("varying-step")]
fn an_interrupted_run_shows_what_a_whole_one_does(#[case] name: &str) {
    let suite = load(name);
    let plan: &StabilityPlan = suite.plan().unwrap();
    for row in [0, plan.values.len() - 1] {
        let mut plan = plan.clone();
        plan.cases.truncate(1);
        plan.values = vec![plan.values[row]];
        goes_on(&with_plan(&suite, plan));
    }
}
