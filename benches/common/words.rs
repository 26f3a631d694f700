//! Words of the command line: a number of particles, and parts of the names of what is timed.

/// Words but for options that `cargo bench` adds.
fn words() -> impl Iterator<Item = String> {
    std::env::args().skip(1).filter(|word| !word.starts_with('-'))
}

/// The number of particles, or the `usual` one.
pub(crate) fn count(usual: f64) -> f64 {
    words().find_map(|word| word.parse().ok()).unwrap_or(usual)
}

/// Whether `id` has all words that are no numbers.
pub(crate) fn selects(id: &str) -> bool {
    words().all(|word| word.parse::<f64>().is_ok() || id.contains(&word))
}
