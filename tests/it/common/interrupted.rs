//! Compares resumed runs with uninterrupted runs.

use mpm_verify::subject::{Checkpoint, Memory, Samples, Subject};

/// Number of steps before a run is interrupted, and number of all its steps.
const BREAKS: [usize; 2] = [1, 5];
const STEPS: usize = 9;

fn written(memory: &mut impl Memory) -> Vec<u8> {
    let mut checkpoint = Checkpoint::empty();
    checkpoint.visit(memory);
    checkpoint.into_bytes()
}

fn state(subject: &mut impl Subject) -> Vec<u8> {
    let mut checkpoint = Checkpoint::empty();
    assert!(subject.checkpoint(&mut checkpoint));
    checkpoint.into_bytes()
}

/// Returns all observable state of a subject, as bits.
fn seen(subject: &mut impl Subject) -> (Vec<u8>, Vec<u8>, Vec<u8>, String) {
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    let (mut totals, counters) = (subject.totals(), format!("{:?}", subject.counters()));
    (state(subject), written(&mut samples), written(&mut totals), counters)
}

/// Asserts that an uninterrupted run, and one that a new subject resumes, end in the same state,
/// even if a step fails. Returns whether all steps succeeded.
pub(crate) fn goes_on<S: Subject>(make: impl Fn() -> S, dt: f64, what: &str) -> bool {
    let step = |subject: &mut S, steps| (0..steps).try_for_each(|_| subject.step(dt));
    let mut whole = make();
    let end = step(&mut whole, STEPS);
    let whole = seen(&mut whole);
    for at in BREAKS {
        let mut first = make();
        if step(&mut first, at).is_err() {
            break;
        }
        let left = state(&mut first);
        assert!(state(&mut first) == left, "{what}: a look changes it");
        let mut second = make();
        let mut checkpoint = Checkpoint::from_bytes(&left);
        assert!(second.checkpoint(&mut checkpoint) && checkpoint.is_used_up(), "{what}: no fit");
        assert_eq!(step(&mut second, STEPS - at), end, "{what}: ends otherwise");
        assert!(seen(&mut second) == whole, "{what}: goes on otherwise after step {at}");
        let mut torn = Checkpoint::from_bytes(&left[..left.len() / 2]);
        assert!(second.checkpoint(&mut torn) && !torn.is_used_up(), "{what}: takes half a state");
    }
    end.is_ok()
}
