//! Arguments of the command line: a number of particles, and parts of the names of measurements.

/// Returns the arguments without the options that `cargo bench` adds.
fn words() -> impl Iterator<Item = String> {
    std::env::args().skip(1).filter(|word| !word.starts_with('-'))
}

/// Returns the number of particles, or `usual` if no argument is a number.
pub(crate) fn count(usual: f64) -> f64 {
    words().find_map(|word| word.parse().ok()).unwrap_or(usual)
}

/// Returns the first argument that ends in `suffix`.
#[allow(dead_code, reason = "only some benches write one")]
pub(crate) fn file(suffix: &str) -> Option<String> {
    words().find(|word| word.ends_with(suffix))
}

/// Whether `id` contains all arguments that are neither numbers nor files.
pub(crate) fn selects(id: &str) -> bool {
    let is_part = |word: &String| word.parse::<f64>().is_err() && !word.contains('.');
    words().filter(is_part).all(|word| id.contains(&word))
}
