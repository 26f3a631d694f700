//! Predicted time of a run from its workload:
//!
//! ```text
//! seconds = a transfers + b particle updates + c steps x nodes + d steps
//! ```
//!
//! The coefficients are non-negative and minimise the relative errors at measured levels
//! (non-negative least squares, Lawson & Hanson 1974, chapter 23). The four counts grow nearly in
//! proportion within one refinement, so noise would make some coefficients negative. A fit is
//! therefore computed for each of the fifteen subsets of the four terms, and the best one without a
//! negative coefficient is used.

/// Work of a run, by kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Workload {
    /// Number of particle-node transfers.
    pub transfers: f64,
    /// Number of particles times number of steps.
    pub updates: f64,
    /// Number of nodes times number of steps.
    pub node_steps: f64,
    /// Number of steps.
    pub steps: f64,
}

/// Seconds per unit of each kind of work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Model {
    /// Seconds per transfer, per particle update, per node and step, and per step.
    pub seconds: [f64; 4],
}

const COLUMNS: usize = 4;

impl Workload {
    fn columns(&self) -> [f64; COLUMNS] {
        [self.transfers, self.updates, self.node_steps, self.steps]
    }
}

impl Model {
    /// Fits the model to runs and their times (s); `None` if no run took any time.
    pub fn fit(runs: &[(Workload, f64)]) -> Option<Self> {
        let rows: Vec<[f64; COLUMNS]> = runs
            .iter()
            .filter(|(_, seconds)| *seconds > 0.0 && seconds.is_finite())
            .map(|(load, seconds)| load.columns().map(|x| x / seconds))
            .collect();
        let mut best: Option<(f64, [f64; COLUMNS])> = None;
        for subset in 1_u32..1 << COLUMNS {
            let chosen: Vec<usize> = (0..COLUMNS).filter(|k| subset >> k & 1 == 1).collect();
            // With fewer than two runs for each coefficient, a fit would follow the noise.
            if chosen.len() > (rows.len() / 2).max(1) {
                continue;
            }
            let Some(solved) = solve(&rows, &chosen) else { continue };
            if !solved.iter().all(|x| *x >= 0.0 && x.is_finite()) {
                continue;
            }
            let rest = residual(&rows, &solved);
            if best.is_none_or(|(least, _)| rest < least) {
                best = Some((rest, solved));
            }
        }
        best.map(|(_, seconds)| Self { seconds })
    }

    /// Returns the predicted seconds of a run.
    pub fn predict(&self, load: &Workload) -> f64 {
        load.columns().iter().zip(&self.seconds).map(|(x, s)| x * s).sum()
    }
}

/// Returns `sum (prediction / measured - 1)^2`.
fn residual(rows: &[[f64; COLUMNS]], seconds: &[f64; COLUMNS]) -> f64 {
    let off = |row: &[f64; COLUMNS]| {
        let share: f64 = row.iter().zip(seconds).map(|(x, s)| x * s).sum();
        (share - 1.0) * (share - 1.0)
    };
    rows.iter().map(off).sum()
}

/// Solves the least-squares problem for the chosen columns by the normal equations, with each
/// column scaled to length 1; `None` if the columns are linearly dependent.
fn solve(rows: &[[f64; COLUMNS]], chosen: &[usize]) -> Option<[f64; COLUMNS]> {
    let n = chosen.len();
    let length = |k: &usize| rows.iter().map(|row| row[*k] * row[*k]).sum::<f64>().sqrt();
    let lengths: Vec<f64> = chosen.iter().map(length).collect();
    if lengths.iter().any(|length| !(*length > 0.0)) {
        return None;
    }
    let entry = |row: &[f64; COLUMNS], i: usize| row[chosen[i]] / lengths[i];
    let mut matrix = vec![vec![0.0; n + 1]; n];
    for row in rows {
        for i in 0..n {
            for j in 0..n {
                matrix[i][j] += entry(row, i) * entry(row, j);
            }
            matrix[i][n] += entry(row, i);
        }
    }
    eliminate(&mut matrix)?;
    let mut seconds = [0.0; COLUMNS];
    for i in 0..n {
        seconds[chosen[i]] = matrix[i][n] / lengths[i];
    }
    Some(seconds)
}

/// Solves a linear system by Gauss-Jordan elimination. Diagonal pivots suffice for normal
/// equations. The last column becomes the solution.
fn eliminate(matrix: &mut [Vec<f64>]) -> Option<()> {
    /// Squared sine of the angle below which two columns count as linearly dependent.
    const LEAST_PIVOT: f64 = 1e-9;
    for i in 0..matrix.len() {
        let pivot = matrix[i][i];
        if !(pivot > LEAST_PIVOT) {
            return None;
        }
        matrix[i].iter_mut().for_each(|x| *x /= pivot);
        let row = matrix[i].clone();
        for (_, other) in matrix.iter_mut().enumerate().filter(|(j, _)| *j != i) {
            let factor = other[i];
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// Returns the workload of a level in 2-D, with additional cells around the body.
    fn load(cells: f64) -> Workload {
        let (particles, steps) = (4.0 * cells * cells, 10.0 * cells);
        Workload {
            transfers: 48.0 * particles * steps,
            updates: particles * steps,
            node_steps: (cells + 7.0) * (cells + 7.0) * steps,
            steps,
        }
    }

    fn runs(seconds: [f64; 4], noise: f64) -> Vec<(Workload, f64)> {
        let run = |(k, cells): (usize, f64)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            (load(cells), Model { seconds }.predict(&load(cells)) * (1.0 + sign * noise))
        };
        [8.0, 12.0, 16.0, 24.0, 32.0, 48.0].into_iter().enumerate().map(run).collect()
    }

    #[test]
    fn what_made_the_times_is_found_again() {
        let model = Model::fit(&runs([2e-9, 0.0, 5e-9, 1e-7], 0.0)).unwrap();
        assert_relative_eq!(model.seconds[0] + model.seconds[1] / 48.0, 2e-9, max_relative = 1e-6);
        assert_relative_eq!(model.seconds[2], 5e-9, max_relative = 1e-4);
        assert_relative_eq!(model.seconds[3], 1e-7, max_relative = 1e-3);
    }

    #[test]
    fn one_run_predicts_by_one_cost() {
        let model = Model::fit(&[(load(8.0), 0.5)]).unwrap();
        assert_relative_eq!(model.predict(&load(8.0)), 0.5, max_relative = 1e-12);
        assert_eq!(model.seconds.iter().filter(|s| **s > 0.0).count(), 1);
    }

    #[test]
    fn runs_without_time_have_no_model() {
        let nothing = Workload { transfers: 0.0, updates: 0.0, node_steps: 0.0, steps: 0.0 };
        assert_eq!(Model::fit(&[]), None);
        assert_eq!(Model::fit(&[(load(8.0), f64::NAN), (load(8.0), 0.0)]), None);
        assert_eq!(Model::fit(&[(nothing, 1.0)]), None);
    }

    #[test]
    fn a_run_that_took_no_time_is_left_out() {
        let mut runs = runs([2e-9, 0.0, 5e-9, 1e-7], 0.0);
        let model = Model::fit(&runs);
        runs.extend([0.0, -1.0, f64::INFINITY, f64::NAN].map(|seconds| (load(64.0), seconds)));
        assert_eq!(Model::fit(&runs), model);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

        /// On any machine, with 3 % noise, the predicted time on a grid twice as fine is within 15
        /// %.
        #[test]
        fn time_of_a_finer_level_is_predicted(
            a in 1e-10..1e-8_f64, b in 0.0..1e-7_f64, c in 0.0..1e-7_f64, d in 0.0..1e-5_f64,
            noise in -0.03..0.03_f64,
        ) {
            let seconds = [a, b, c, d];
            let model = Model::fit(&runs(seconds, noise)).unwrap();
            let wanted = Model { seconds }.predict(&load(96.0));
            let off = model.predict(&load(96.0)) / wanted - 1.0;
            prop_assert!(off.abs() < 0.15, "{off}");
            prop_assert!(model.seconds.iter().all(|s| *s >= 0.0));
        }
    }
}
