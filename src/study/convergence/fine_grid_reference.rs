//! Truth for studies in space where no formula is known, in any dimension: the same method on a
//! grid much finer than any level.
//!
//! Its particles are the points of a lattice in the reference configuration, between which the
//! motion is interpolated there, wherever they have moved. Whether the limit of the method is right
//! is left to an exact solution.

use super::reference::nearest_instant;
use super::small_step_reference;
use crate::exact::Truth;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan};
use crate::verify::error::observer::lagrange_weights;

/// Points on each axis that take part in an interpolation: of order 6, above that of any method.
const NEAR: usize = 6;

/// Displacement and velocity of a lattice of particles at the start and at every instant.
pub(crate) struct FineGrid {
    until: f64,
    lattice: Lattice,
    states: Vec<(Vec<f64>, Vec<f64>)>,
}

impl FineGrid {
    /// Runs the method of `case` on `level`, starting half a step back.
    ///
    /// # Errors
    /// One line that says why that was not possible.
    pub(crate) fn compute(
        plan: &ConvergencePlan,
        case: &Case,
        level: LevelPlan,
    ) -> Result<Self, String> {
        let mut states = Vec::new();
        let end = small_step_reference::run(plan, case, level, |now| {
            states.push((now.displacement.clone(), now.velocity.clone()));
        })?;
        let lattice = Lattice::of(&end.label, end.dimension);
        let lattice = lattice.ok_or("reference: its particles are no lattice")?;
        Ok(Self { until: case.until, lattice, states })
    }

    fn state(&self, t: f64) -> &(Vec<f64>, Vec<f64>) {
        &self.states[nearest_instant(t, self.until, self.states.len())]
    }
}

impl Truth for FineGrid {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.lattice.interpolate(&self.state(t).0, label, into);
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.lattice.interpolate(&self.state(t).1, label, into);
    }
}

/// Points at all combinations of coordinates.
struct Lattice {
    /// Coordinates on each axis, ascending.
    axes: Vec<Vec<f64>>,
    /// Index of the particle at each point, the first axis fastest.
    particles: Vec<usize>,
}

impl Lattice {
    /// The lattice that `labels` are, `d` numbers each, in any order; `None` if they are none.
    fn of(labels: &[f64], d: usize) -> Option<Self> {
        let axis = |axis: usize| {
            let mut all: Vec<f64> = labels.iter().skip(axis).step_by(d).copied().collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let axes: Vec<Vec<f64>> = (0..d).map(axis).collect();
        let points = axes.iter().try_fold(1_usize, |points, all| points.checked_mul(all.len()))?;
        if points == 0 || points * d != labels.len() {
            return None;
        }
        let mut particles = vec![None; points];
        for (p, label) in labels.chunks_exact(d).enumerate() {
            let along = axes.iter().zip(label).rev();
            let point = along.fold(0, |point, (all, x)| {
                point * all.len() + all.partition_point(|known| known < x)
            });
            particles[point] = Some(p);
        }
        Some(Self { axes, particles: particles.into_iter().collect::<Option<_>>()? })
    }

    /// The value at `label` of a field that has one number for each axis at each particle.
    fn interpolate(&self, field: &[f64], label: &[f64], into: &mut [f64]) {
        let along = self.axes.iter().zip(label);
        let near: Vec<_> = along.map(|(all, x)| lagrange_weights(all, *x, NEAR)).collect();
        into.fill(0.0);
        for k in 0..near.iter().map(|(_, weights)| weights.len()).product() {
            let (mut rest, mut stride, mut point, mut weight) = (k, 1, 0, 1.0);
            for ((first, weights), all) in near.iter().zip(&self.axes) {
                let i = rest % weights.len();
                rest /= weights.len();
                point += (first + i) * stride;
                stride *= all.len();
                weight *= weights[i];
            }
            let start = self.particles[point] * into.len();
            for (sum, value) in into.iter_mut().zip(&field[start..]) {
                *sum += weight * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// A lattice of seven, three and two points (as far as `d` goes), in no order.
    fn labels(d: usize) -> Vec<f64> {
        let counts = &[7, 3, 2][..d];
        let points: usize = counts.iter().product();
        let point = |k: usize| {
            let mut rest = k * 5 % points;
            counts.iter().map(move |count| {
                let i = rest % count;
                rest /= count;
                (i as f64 + 0.5) / *count as f64
            })
        };
        (0..points).flat_map(point).collect()
    }

    /// Of degree 5, 2 and 1 along the axes: what their points determine.
    fn field(label: &[f64]) -> Vec<f64> {
        let degrees = [5.0, 2.0, 1.0];
        let product: f64 = label.iter().zip(degrees).map(|(x, n)| 1.0 - libm::pow(*x, n)).product();
        label.iter().map(|x| product - 2.0 * x).collect()
    }

    #[rstest]
    fn a_motion_is_interpolated_axis_by_axis(
        #[values(1, 2, 3)] d: usize,
        #[values([0.3, 0.6, 0.4], [0.02, 0.1, 0.9], [0.5, 0.5, 0.25], [1.0, 0.0, 1.0])] at: [f64;
            3],
    ) {
        let labels = labels(d);
        let values: Vec<f64> = labels.chunks(d).flat_map(field).collect();
        let mut found = vec![f64::NAN; d];
        Lattice::of(&labels, d).unwrap().interpolate(&values, &at[..d], &mut found);
        for (found, expected) in found.iter().zip(field(&at[..d])) {
            assert_relative_eq!(*found, expected, max_relative = 1e-12, epsilon = 1e-12);
        }
    }

    #[rstest]
    #[case::nothing(&[], 2)]
    #[case::one_is_missing(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 2)]
    #[case::one_is_there_twice(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0], 2)]
    #[case::one_is_off(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.1], 2)]
    fn what_is_no_lattice(#[case] labels: &[f64], #[case] d: usize) {
        assert!(Lattice::of(labels, d).is_none());
    }
}
