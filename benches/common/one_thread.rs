//! Timing on one thread.

/// From now on passes are not shared: all that would be is done by one thread.
pub(crate) fn one_thread() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("no pool yet");
}
