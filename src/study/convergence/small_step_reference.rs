//! Truth for studies in time: the same method on the same grid, with steps so short that the result
//! is the limit dt -> 0 of the equations that are discrete in space.
//!
//! It separates the error of the time step from that of the grid, which for a body at its Courant
//! limit is the larger one and would hide it. Whether the limit is right is left to the exact
//! solution. Methods that filter the velocity in every step (PIC and its kin) have no such limit.

use super::reference::nearest_instant;
use crate::exact::Truth;
use crate::study::setup::dispatch::subject;
use crate::subject::{Samples, Start};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan};
use std::cmp::Ordering;

/// Displacement and velocity of every label of a method at every instant.
pub(crate) struct FineSteps {
    until: f64,
    dimension: usize,
    /// Indices of the labels, sorted by position.
    order: Vec<usize>,
    /// The start, and every instant.
    states: Vec<Samples>,
}

impl FineSteps {
    /// Runs the method of `case` with steps of `dt` (s), starting half a step back.
    ///
    /// # Errors
    /// One line that says why that was not possible.
    pub(crate) fn compute(plan: &ConvergencePlan, case: &Case, dt: f64) -> Result<Self, String> {
        let level = plan.refine.levels.first().ok_or("no level")?;
        let mut states = Vec::new();
        let level = LevelPlan { dt, ..*level };
        let now = run(plan, case, level, |now| states.push(now.clone()))?;
        let mut order: Vec<usize> = (0..now.len()).collect();
        order.sort_by(|a, b| compare(label(&now, *a), label(&now, *b)));
        Ok(Self { until: case.until, dimension: now.dimension, order, states })
    }

    /// The numbers of `field` at `wanted` at the instant nearest to `t`; NaN where there is no such
    /// label.
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

/// Runs the method of `case` on `level`, starting half a step back, and shows the start and every
/// instant. Returns what is seen at the end.
///
/// # Errors
/// One line that says why that was not possible.
pub(crate) fn run(
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
    mut show: impl FnMut(&Samples),
) -> Result<Samples, String> {
    let mut subject = subject(plan, second_order(case.method), level)?;
    let clock = case.clock(plan, level.dt).ok_or("dt makes no sense")?;
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

/// The method with the start that is of second order.
fn second_order(mut method: Method) -> Method {
    match &mut method {
        Method::Mpm { start, .. } | Method::Fem { start, .. } => *start = Start::HalfStepBack,
        Method::Heat { .. } | Method::External { .. } => {}
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
