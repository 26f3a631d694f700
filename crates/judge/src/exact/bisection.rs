//! Bisection down to neighbouring floating-point numbers.

/// Returns the number between `low` and `high` at which `reaches` changes from false to true.
pub(crate) fn bisect(mut low: f64, mut high: f64, reaches: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return middle;
        }
        if reaches(middle) { high = middle } else { low = middle }
    }
}
