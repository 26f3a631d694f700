//! Computes reference solutions for suites without an exact solution.
//!
//! `Reference` is a FEM solution on a mesh much finer than any level. `FineGrid` is for studies in
//! space, in any dimension: it runs the method itself on a grid much finer than any level. The
//! reference positions of its particles form a lattice, or the bilinear map of a lattice, so the
//! motion can be interpolated. `FineSteps` is for studies in time: it runs the method itself on the
//! same grid, with steps so short that the result is the limit dt -> 0 of the space-discrete
//! equations.
//!
//! With time steps near the Courant limit, the error of the grid is larger than the error of the
//! time step and would hide it. A reference from `FineSteps` has the same grid error, so only the
//! error of the time step remains. Methods that filter the velocity in every step (PIC, APIC) have
//! no limit dt -> 0. Neither `FineGrid` nor `FineSteps` checks that the method converges to the
//! right solution.

use crate::exact::Truth;
use crate::fem::Bar;
use crate::mpm::{Quadrilateral, Vector};
use crate::study::setup::bar::{bar, reference_method};
use crate::study::setup::dispatch::subject;
use crate::subject::{Precision, Samples, Start, Subject, SubjectError};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Against, Case, ConvergencePlan};
use crate::suite::scene::cell_size;
use crate::verify::error::observer::lagrange_weights;
use std::borrow::Cow;
use std::cmp::Ordering;

/// Displacement and velocity of a finely meshed bar at every instant of the study.
pub(crate) struct Reference {
    until: f64,
    from: f64,
    spacing: f64,
    states: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Reference {
    pub(crate) fn compute(plan: &ConvergencePlan, until: f64) -> Result<Self, SubjectError> {
        let fine = plan.reference.as_ref().ok_or("the suite declares no reference")?;
        let method = reference_method(fine);
        let mut bar = bar(plan, method, fine.cells)?;
        let dt = fine.dt.eval(&[cell_size(&plan.scene, fine.cells)]);
        let clock = plan.clock(Against::Reference, until, dt).ok_or("dt is invalid")?;
        let mut states = vec![state(&bar)];
        for step in 1..=clock.steps {
            bar.step(clock.dt()).map_err(|failure| format!("reference: {failure}"))?;
            if clock.is_instant(step) {
                states.push(state(&bar));
            }
        }
        let nodes = bar.nodes();
        Ok(Self { until, from: nodes[0], spacing: nodes[1] - nodes[0], states })
    }

    fn interpolate(
        &self,
        field: impl Fn(&(Vec<f64>, Vec<f64>)) -> &Vec<f64>,
        x: f64,
        t: f64,
    ) -> f64 {
        let nodal = field(&self.states[nearest_instant(t, self.until, self.states.len())]);
        let place = ((x - self.from) / self.spacing).clamp(0.0, (nodal.len() - 1) as f64);
        let left = (place as usize).min(nodal.len() - 2);
        let share = place - left as f64;
        nodal[left] * (1.0 - share) + nodal[left + 1] * share
    }
}

/// Returns the index of the instant nearest to `t` (s) among `count` instants from 0 to `until`.
pub(crate) fn nearest_instant(t: f64, until: f64, count: usize) -> usize {
    let last = (count - 1) as f64;
    libm::round(t / until * last).clamp(0.0, last) as usize
}

fn state(bar: &Bar) -> (Vec<f64>, Vec<f64>) {
    (bar.nodal_displacements().to_vec(), bar.nodal_velocities().collect())
}

impl Truth for Reference {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        into[0] = self.interpolate(|states| &states.0, label[0], t);
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        into[0] = self.interpolate(|states| &states.1, label[0], t);
    }
}

/// Number of interpolation points per axis: order 6, higher than that of any method.
const NEAR: usize = 6;

/// Displacement and velocity of a particle lattice at the start and at every instant.
pub(crate) struct FineGrid {
    until: f64,
    /// Map from the unit square, where the particles form a lattice, to the body.
    panel: Option<Quadrilateral>,
    lattice: Lattice,
    states: Vec<(Vec<f64>, Vec<f64>)>,
}

impl FineGrid {
    pub(crate) fn compute(
        plan: &ConvergencePlan,
        case: &Case,
        level: LevelPlan,
    ) -> Result<Self, SubjectError> {
        let mut states = Vec::new();
        let end = run(plan, case, level, |now| {
            states.push((now.displacement.clone(), now.velocity.clone()));
        })?;
        let panel = plan.scene.mapped.clone();
        let lattice = match &panel {
            None => Lattice::of(&end.label, end.dimension),
            Some(panel) => Lattice::of(&middles(panel, level, &end), end.dimension),
        };
        let lattice = lattice.ok_or("reference: its particles are not on a lattice")?;
        Ok(Self { until: case.until, panel, lattice, states })
    }

    fn coordinates<'l>(&self, label: &'l [f64]) -> Cow<'l, [f64]> {
        match (&self.panel, label) {
            (Some(panel), [x, y]) => Cow::Owned(panel.inverse(&Vector::from([*x, *y])).to_vec()),
            _ => Cow::Borrowed(label),
        }
    }

    fn state(&self, t: f64) -> &(Vec<f64>, Vec<f64>) {
        &self.states[nearest_instant(t, self.until, self.states.len())]
    }
}

impl Truth for FineGrid {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.lattice.interpolate(&self.state(t).0, &self.coordinates(label), into);
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.lattice.interpolate(&self.state(t).1, &self.coordinates(label), into);
    }
}

/// Returns the centres of the particles of a mapped body in the unit square, without rounding
/// errors.
fn middles(panel: &Quadrilateral, level: LevelPlan, samples: &Samples) -> Vec<f64> {
    let per_axis = libm::round(level.ppc.map_or(1.0, |ppc| (ppc as f64).sqrt())) as usize;
    let counts = panel.counts(level.h, per_axis);
    let points = samples.label.chunks_exact(2).map(|x| panel.inverse(&Vector::from([x[0], x[1]])));
    let middle = |point: [f64; 2]| {
        [0, 1].map(|axis| {
            let count = counts[axis] as f64;
            (libm::floor(point[axis] * count) + 0.5) / count
        })
    };
    points.flat_map(middle).collect()
}

/// Particles that form a lattice: points at all combinations of the coordinates of the axes.
struct Lattice {
    /// Coordinates on each axis, ascending.
    axes: Vec<Vec<f64>>,
    /// Index of the particle at each point. The index of the first axis varies fastest.
    particles: Vec<usize>,
}

impl Lattice {
    /// Creates the lattice of positions in any order (`d` coordinates each), if they form one.
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

/// Displacement and velocity of every particle at every instant, computed by the method under test.
pub(crate) struct FineSteps {
    until: f64,
    dimension: usize,
    /// Indices of the particles, sorted by reference position.
    order: Vec<usize>,
    states: Vec<Samples>,
}

impl FineSteps {
    /// Runs the method of `case` with steps of `dt` (s). Initial velocities are taken at t = -dt/2.
    pub(crate) fn compute(
        plan: &ConvergencePlan,
        case: &Case,
        dt: f64,
    ) -> Result<Self, SubjectError> {
        let level = plan.refine.levels.first().ok_or("no level")?;
        let mut states = Vec::new();
        let level = LevelPlan { dt, ..*level };
        let now = run(plan, case, level, |now| states.push(now.clone()))?;
        let mut order: Vec<usize> = (0..now.len()).collect();
        order.sort_by(|a, b| compare(label(&now, *a), label(&now, *b)));
        Ok(Self { until: case.until, dimension: now.dimension, order, states })
    }

    /// Copies the values of the particle with reference position `wanted` at the instant nearest to
    /// `t`; NaN if there is no such particle.
    fn find(&self, field: fn(&Samples) -> &[f64], wanted: &[f64], t: f64, into: &mut [f64]) {
        let samples = &self.states[nearest_instant(t, self.until, self.states.len())];
        match self.order.binary_search_by(|p| compare(label(samples, *p), wanted)) {
            Ok(found) => {
                into.copy_from_slice(row(field(samples), self.dimension, self.order[found]));
            }
            Err(_) => into.fill(f64::NAN),
        }
    }
}

/// Runs the method of `case` on `level`, with initial velocities at t = -dt/2. Passes the states at
/// the start and at every instant to `show`, and returns the state at the end.
pub(crate) fn run(
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
    mut show: impl FnMut(&Samples),
) -> Result<Samples, SubjectError> {
    let mut subject = subject(plan, second_order(case.method), level)?;
    let clock = case.clock(plan, level.dt).ok_or("dt is invalid")?;
    let mut now = Samples::default();
    subject.sample(&mut now);
    show(&now);
    for step in 1..=clock.steps {
        subject.step(clock.dt()).map_err(|failure| format!("reference: {failure}"))?;
        if clock.is_instant(step) {
            subject.sample(&mut now);
            show(&now);
        }
    }
    Ok(now)
}

fn row(field: &[f64], dimension: usize, p: usize) -> &[f64] {
    &field[p * dimension..(p + 1) * dimension]
}

fn label(samples: &Samples, p: usize) -> &[f64] {
    row(&samples.label, samples.dimension, p)
}

fn compare(a: &[f64], b: &[f64]) -> Ordering {
    let unequal = a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    unequal.unwrap_or_else(|| a.len().cmp(&b.len()))
}

/// Changes the method to double precision and to velocities at t = -dt/2 (second order).
fn second_order(mut method: Method) -> Method {
    match &mut method {
        Method::Mpm(method) => {
            (method.start, method.precision) = (Start::HalfStepBack, Precision::Double);
        }
        Method::Fem { start, .. } => *start = Start::HalfStepBack,
        Method::QuasiStatic { .. } | Method::Heat { .. } | Method::External { .. } => {}
    }
    method
}

impl Truth for FineSteps {
    fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.find(|samples| &samples.displacement, label, t, into);
    }

    fn velocity(&self, label: &[f64], t: f64, into: &mut [f64]) {
        self.find(|samples| &samples.velocity, label, t, into);
    }
}

/// Placeholder for a suite without exact solution, in which only conserved sums are checked.
pub(crate) struct Unknown;

impl Truth for Unknown {
    fn displacement(&self, _: &[f64], _: f64, into: &mut [f64]) {
        into.fill(f64::NAN);
    }

    fn velocity(&self, _: &[f64], _: f64, into: &mut [f64]) {
        into.fill(f64::NAN);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Returns a lattice of 7, 3 and 2 points along the first `d` axes, in random order.
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

    /// Returns a polynomial of the highest degrees that the points determine: 5, 2 and 1.
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

    #[test]
    fn particles_of_a_panel_form_a_lattice_in_the_unit_square() {
        let corners = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]];
        let panel = Quadrilateral::new(corners.map(Vector::from)).unwrap();
        let level = LevelPlan { cells: 4, h: 12.0, dt: 1.0, ppc: Some(4) };
        let mut samples = Samples::default();
        let particles = panel.fill::<2>(1.0, level.h, 2);
        for x in particles.x0.iter().rev() {
            samples.push(&[x[0], x[1]], &[x[0] - 3.0 * x[1], x[1]], &[0.0; 2], 1.0);
        }
        let lattice = Lattice::of(&middles(&panel, level, &samples), 2);
        let grid = FineGrid {
            until: 1.0,
            panel: Some(panel),
            lattice: lattice.expect("a lattice"),
            states: vec![(samples.displacement, samples.velocity)],
        };
        let mut found = [f64::NAN; 2];
        for label in [[3.0, 20.0], [30.0, 40.0], [48.0, 60.0], [0.0, 0.0]] {
            grid.displacement(&label, 1.0, &mut found);
            let expected = [label[0] - 3.0 * label[1], label[1]];
            assert_relative_eq!(found[..], expected[..], max_relative = 1e-11, epsilon = 1e-10);
        }
    }

    #[rstest]
    #[case::nothing(&[], 2)]
    #[case::one_is_missing(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], 2)]
    #[case::one_is_there_twice(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0], 2)]
    #[case::one_is_off(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.1], 2)]
    fn incomplete_or_shifted_labels_are_no_lattice(#[case] labels: &[f64], #[case] d: usize) {
        assert!(Lattice::of(labels, d).is_none());
    }
}
