//! Checkpoints of a run, from which an interrupted one goes on.
//!
//! A checkpoint is the state of the subject and of its monitor after a step. The store decides
//! where and how often it is kept, and whether it belongs to this run.

use crate::subject::{Checkpoint, Memory, Subject};

/// Store of the checkpoints of one run.
pub trait CheckpointStore {
    /// Checkpoint of an earlier run like this one, if there is any.
    fn left(&mut self) -> Option<Vec<u8>>;

    /// Receives the number of steps after which the run goes on from that checkpoint, or none if it
    /// does not fit and the run starts anew.
    fn taken(&mut self, steps: Option<u64>);

    /// Whether a checkpoint is due, asked after every step but the last.
    fn is_due(&mut self) -> bool;

    /// Keeps a checkpoint.
    fn keep(&mut self, state: &[u8]);
}

/// A store that keeps nothing.
pub struct NoCheckpoints;

impl CheckpointStore for NoCheckpoints {
    fn left(&mut self) -> Option<Vec<u8>> {
        None
    }

    fn taken(&mut self, _: Option<u64>) {}

    fn is_due(&mut self) -> bool {
        false
    }

    fn keep(&mut self, _: &[u8]) {}
}

/// A subject, its monitor, and the steps taken: from the checkpoint of an interrupted run, or at
/// the start.
///
/// # Errors
/// Those of `make`, which is asked for another subject if the first one has been given a state that
/// does not fit.
pub(crate) fn resumed<W: Memory, E>(
    mut make: impl FnMut() -> Result<Box<dyn Subject>, E>,
    start: impl Fn(&dyn Subject) -> W,
    steps: u64,
    store: &mut dyn CheckpointStore,
) -> Result<(Box<dyn Subject>, W, u64), E> {
    let mut subject = make()?;
    let mut monitor = start(subject.as_ref());
    let Some(left) = store.left() else { return Ok((subject, monitor, 0)) };
    let (mut checkpoint, mut done) = (Checkpoint::from_bytes(&left), 0_u64);
    let goes_on = visit(&mut checkpoint, &mut done, &mut monitor, subject.as_mut())
        && checkpoint.is_used_up()
        && (1..steps).contains(&done);
    store.taken(goes_on.then_some(done));
    if goes_on {
        return Ok((subject, monitor, done));
    }
    let subject = make()?;
    let monitor = start(subject.as_ref());
    Ok((subject, monitor, 0))
}

/// Keeps the state after `done` of `steps` steps, if it is time and the subject can say it.
pub(crate) fn keep_if_due(
    store: &mut dyn CheckpointStore,
    (mut done, steps): (u64, u64),
    monitor: &mut impl Memory,
    subject: &mut dyn Subject,
) {
    if done == steps || !store.is_due() {
        return;
    }
    let mut checkpoint = Checkpoint::empty();
    if visit(&mut checkpoint, &mut done, monitor, subject) {
        store.keep(&checkpoint.into_bytes());
    }
}

fn visit(
    checkpoint: &mut Checkpoint<'_>,
    done: &mut u64,
    monitor: &mut impl Memory,
    subject: &mut dyn Subject,
) -> bool {
    checkpoint.visit(done);
    checkpoint.visit(monitor);
    subject.checkpoint(checkpoint)
}
