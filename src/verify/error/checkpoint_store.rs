//! Keeping the state of a run while it goes on, so that an interrupted one need not start anew.
//!
//! What is kept is the state of the subject and of whoever watches it, after a step. Where it is kept, how
//! often, and whether it is that of this very run is the keeper's business.

use crate::subject::{Checkpoint, Memory, Subject};

/// Keeps the state of one run.
pub trait CheckpointStore {
    /// What an earlier run like this one has left, if anything.
    fn left(&mut self) -> Option<Vec<u8>>;

    /// Told what became of it: the number of steps after which the run goes on, or none if it is of no
    /// use and the run starts anew.
    fn taken(&mut self, steps: Option<u64>);

    /// Whether the state is to be kept now: asked after every step but the last.
    fn is_due(&mut self) -> bool;

    /// Keeps the state.
    fn keep(&mut self, state: &[u8]);
}

/// Keeps nothing.
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

/// A subject, what watches it, and the steps that they have taken: as a run that was interrupted has left
/// them, or at the start.
///
/// # Errors
/// Those of `make`, which is asked for another subject if the first one has been given a state that does
/// not fit.
pub(crate) fn resumed<W: Memory, E>(
    mut make: impl FnMut() -> Result<Box<dyn Subject>, E>,
    watch: impl Fn(&dyn Subject) -> W,
    steps: u64,
    keeper: &mut dyn CheckpointStore,
) -> Result<(Box<dyn Subject>, W, u64), E> {
    let mut subject = make()?;
    let mut watching = watch(subject.as_ref());
    let Some(left) = keeper.left() else { return Ok((subject, watching, 0)) };
    let (mut checkpoint, mut done) = (Checkpoint::of(&left), 0_u64);
    let goes_on = visit(&mut checkpoint, &mut done, &mut watching, subject.as_mut())
        && checkpoint.is_used_up()
        && (1..steps).contains(&done);
    keeper.taken(goes_on.then_some(done));
    if goes_on {
        return Ok((subject, watching, done));
    }
    let subject = make()?;
    let watching = watch(subject.as_ref());
    Ok((subject, watching, 0))
}

/// Keeps the state after `done` of `steps` steps, if it is time and the subject can say it.
pub(crate) fn keep_if_due(
    keeper: &mut dyn CheckpointStore,
    (mut done, steps): (u64, u64),
    watch: &mut impl Memory,
    subject: &mut dyn Subject,
) {
    if done == steps || !keeper.is_due() {
        return;
    }
    let mut checkpoint = Checkpoint::empty();
    if visit(&mut checkpoint, &mut done, watch, subject) {
        keeper.keep(&checkpoint.into_bytes());
    }
}

fn visit(
    checkpoint: &mut Checkpoint<'_>,
    done: &mut u64,
    watch: &mut impl Memory,
    subject: &mut dyn Subject,
) -> bool {
    checkpoint.visit(done);
    checkpoint.visit(watch);
    subject.checkpoint(checkpoint)
}
