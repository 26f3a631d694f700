//! The Pareto front: settings that no other one beats in both error and work.

use super::sample::Sample;

/// Share by which an error must be smaller to be worth more work: methods whose errors agree to
/// more digits than anybody reads are not traded for each other.
pub(super) const WORTH: f64 = 0.01;

/// Indices of what is on the front, from the least work to the least error. Of equals the first
/// counts.
pub fn pareto_front(samples: &[Sample]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..samples.len()).filter(|k| samples[*k].counts()).collect();
    let key = |k: usize| (samples[k].work, samples[k].error);
    order.sort_by(|a, b| {
        let ((work_a, error_a), (work_b, error_b)) = (key(*a), key(*b));
        work_a.total_cmp(&work_b).then(error_a.total_cmp(&error_b)).then(a.cmp(b))
    });
    let mut least = f64::INFINITY;
    order.retain(|k| {
        let better = samples[*k].error < least * (1.0 - WORTH);
        if better {
            least = samples[*k].error;
        }
        better
    });
    order
}
