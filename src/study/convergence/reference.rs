//! A truth that is computed: FEM on a mesh much finer than any level.

use crate::exact::Truth;
use crate::fem::Bar;
use crate::study::setup::bar::{bar, reference_method};
use crate::subject::Subject;
use crate::suite::model::{Against, ConvergencePlan};
use crate::suite::scene::grid_size::cell_size;

/// Displacement and velocity of a fine bar, kept at every instant of the study. Only asked at
/// instants, so nothing is interpolated in time.
pub(crate) struct Reference {
    until: f64,
    from: f64,
    spacing: f64,
    /// Nodal displacements and velocities at each instant, the start first.
    states: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Reference {
    /// Runs the reference of `plan` to `until` (s).
    ///
    /// # Errors
    /// One line that says why it could not be computed.
    pub(crate) fn compute(plan: &ConvergencePlan, until: f64) -> Result<Self, String> {
        let fine = plan.reference.as_ref().ok_or("the suite declares no reference")?;
        let method = reference_method(fine);
        let mut bar = bar(plan, method, fine.cells)?;
        let dt = fine.dt.eval(&[cell_size(&plan.scene, fine.cells)]);
        let clock = plan.clock(Against::Reference, until, dt).ok_or("dt makes no sense")?;
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

    /// Linear interpolation between nodes at the instant nearest to `t`.
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

/// The index of the instant nearest to `t` (s), of so many from 0 to `until`.
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
