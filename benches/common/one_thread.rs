//! Timing on one thread.

/// Limits all further parallel work to one thread.
pub(crate) fn one_thread() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("no pool yet");
}
