//! One subject on one level, held against the truth.

use super::{
    clock::Clock,
    norm::Norms,
    observer::{History, displacement_at},
};
use crate::{
    exact::Truth,
    subject::{Census, Failure, Samples, Subject},
};

/// What a run has shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Errors of the displacement at the end (m); all NaN if the run failed.
    pub errors: Norms,
    /// Largest RMS error over the instants (m); NaN if the run failed.
    pub max_rms: f64,
    /// Counters at the end, or at the failure.
    pub census: Census,
    /// Steps taken.
    pub steps: u64,
    /// Why and when the run ended early.
    pub failure: Option<String>,
    /// The observed label, if one was asked for and the run came to its end.
    pub history: Option<History>,
    /// Displacement at the observed place at the end (m).
    pub displacement: Option<f64>,
}

/// Steps `subject` through `clock` and takes its error against `truth` at every instant, at the
/// subject's own reference labels; watches the label nearest to `observe`.
pub fn run(
    subject: &mut dyn Subject,
    truth: &dyn Truth,
    clock: &Clock,
    observe: Option<&[f64]>,
) -> Run {
    let mut watch = Watch::new(subject, truth, observe);
    for step in 1..=clock.steps {
        if let Err(failure) = subject.step(clock.dt()) {
            return failed(subject, step, clock.time(step), &failure);
        }
        watch.look(subject, clock, step);
    }
    watch.finished(subject, clock.steps, observe)
}

/// The state of the comparison while a subject runs.
struct Watch<'a> {
    truth: &'a dyn Truth,
    samples: Samples,
    errors: Norms,
    max_rms: f64,
    history: Option<(usize, History)>,
}

impl<'a> Watch<'a> {
    fn new(subject: &dyn Subject, truth: &'a dyn Truth, observe: Option<&[f64]>) -> Self {
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        let history = observe.map(|place| {
            let (at, mut history) = History::start(&samples, place);
            history.record(at, &samples, truth, 0.0);
            (at, history)
        });
        Self { truth, samples, errors: Norms::NONE, max_rms: 0.0, history }
    }

    fn look(&mut self, subject: &dyn Subject, clock: &Clock, step: u64) {
        if !clock.is_instant(step) {
            return;
        }
        subject.sample(&mut self.samples);
        let t = clock.time(step);
        self.errors = errors(&self.samples, self.truth, t);
        let rms = self.errors.rms;
        self.max_rms = if rms.is_nan() { rms } else { self.max_rms.max(rms) };
        if let Some((at, history)) = &mut self.history {
            history.record(*at, &self.samples, self.truth, t);
        }
    }

    fn finished(self, subject: &dyn Subject, steps: u64, observe: Option<&[f64]>) -> Run {
        let place = observe.and_then(|place| place.first());
        Run {
            errors: self.errors,
            max_rms: self.max_rms,
            census: subject.census(),
            steps,
            failure: None,
            displacement: place.and_then(|x| displacement_at(&self.samples, *x)),
            history: self.history.map(|(_, history)| history),
        }
    }
}

/// A run that broke has no error, only a reason.
fn failed(subject: &dyn Subject, step: u64, t: f64, failure: &Failure) -> Run {
    Run {
        errors: Norms::NONE,
        max_rms: f64::NAN,
        census: subject.census(),
        steps: step,
        failure: Some(format!("{failure} (step {step}, t = {t:.4} s)")),
        history: None,
        displacement: None,
    }
}

/// Norms of `u_num - u_exact` at the labels of `samples` at time `t`.
pub fn errors(samples: &Samples, truth: &dyn Truth, t: f64) -> Norms {
    let d = samples.dimension;
    let mut exact = vec![0.0; d];
    let mut error = Vec::with_capacity(samples.displacement.len());
    for (label, u) in samples.label.chunks(d).zip(samples.displacement.chunks(d)) {
        truth.displacement(label, t, &mut exact);
        error.extend(u.iter().zip(&exact).map(|(u, e)| u - e));
    }
    Norms::of(&error, d, &samples.weight)
}
