//! One run, watched for growth.
//!
//! The energy is that of a small motion: the kinetic one and `V |sigma|^2 / (2 M)`, with M the stiffness
//! against uniaxial strain. In 1-D and at small strain that is the strain energy; elsewhere it is a
//! measure of the size of the stress, which is all that growth needs. It is compared with its start,
//! or, in a body that starts at rest, with the energy of a strain of one.

use super::{
    checkerboard::{checkerboard, stress_spread},
    verdict::Stability,
};
use crate::{
    subject::{Failure, Samples, Subject},
    verify::{
        conservation::{Balance, Conserved, Drift},
        norm::larger,
    },
};

/// What a trial measures with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Wave speed (m/s).
    pub speed: f64,
    /// Stiffness against uniaxial strain (Pa).
    pub modulus: f64,
    /// Largest energy, over that at the start, of a run that is stable.
    pub stable_below: f64,
    /// Energy, over that at the start, beyond which a run is unstable and ends.
    pub unstable_above: f64,
    /// Whether the kinetic energy is that about the centre of mass: where nothing holds the body, a
    /// common velocity is no size of its motion.
    pub centred: bool,
}

/// What a run has shown. Figures of a run that failed are those up to its last step.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// How it ended.
    pub verdict: Stability,
    /// Why, where it did not come to its end: what broke, which particle, when.
    pub why: Option<String>,
    /// Steps taken.
    pub steps: u64,
    /// The largest energy over that at the start.
    pub energy: f64,
    /// The energy at the end over that at the start.
    pub energy_kept: f64,
    /// Kinetic energy at the end over that at the start; NaN where there was none.
    pub kinetic_kept: f64,
    /// The largest relative change of the momentum.
    pub momentum: f64,
    /// The largest relative change of the angular momentum.
    pub angular_momentum: f64,
    /// The smallest J met.
    pub least_j: f64,
    /// The largest speed met, over the wave speed.
    pub speed: f64,
    /// The largest less the smallest mean normal stress over the largest in magnitude, at the end.
    pub stress_spread: f64,
    /// Changes of the pressure from particle to particle over its size, at the end.
    pub checkerboard: f64,
    /// The largest stress over the modulus, at the end.
    pub stress: f64,
    /// The largest displacement (m), at the end.
    pub displacement: f64,
}

/// Steps after which the state is looked at: each of the first ones, and then at equal distances.
/// Growth that matters in ten thousand steps is slow, and fast growth is over in these first ones.
const FIRST: u64 = 64;
const EVERY: u64 = 16;

/// Runs `subject` for `steps` steps, whose lengths (s) are taken from `dt` in turn, or until it is
/// unstable or fails.
pub fn trial(subject: &mut dyn Subject, dt: &[f64], steps: u64, scales: &Scales) -> Trial {
    let mut watch = Watch::new(subject, *scales);
    let mut lengths = dt.iter().cycle();
    for step in 1..=steps {
        let dt = *lengths.next().unwrap_or(&f64::NAN);
        watch.time += dt;
        if let Err(failure) = subject.step(dt) {
            return watch.failed(subject, step, &failure);
        }
        if step <= FIRST || step % EVERY == 0 || step == steps {
            watch.look(subject);
            if !(watch.energy <= scales.unstable_above) {
                return watch.grown(subject, step);
            }
        }
    }
    let verdict = if watch.energy <= scales.stable_below {
        Stability::Stable
    } else {
        Stability::BoundedGrowth
    };
    watch.ended(subject, verdict, None, steps)
}

struct Watch {
    scales: Scales,
    time: f64,
    samples: Samples,
    balance: Option<Balance>,
    reference: f64,
    kinetic_start: f64,
    energy: f64,
    last: f64,
    speed: f64,
}

impl Watch {
    fn new(subject: &dyn Subject, scales: Scales) -> Self {
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        let kinetic_start = kinetic(subject, scales.centred);
        let start = kinetic_start + stored(&samples, scales.modulus);
        let reference = if start > 0.0 {
            start
        } else {
            0.5 * scales.modulus * samples.weight.iter().sum::<f64>()
        };
        let mut watch = Self {
            scales,
            time: 0.0,
            samples,
            balance: subject.totals().map(Balance::start),
            reference,
            kinetic_start,
            energy: 0.0,
            last: 0.0,
            speed: 0.0,
        };
        watch.look(subject);
        watch
    }

    fn look(&mut self, subject: &dyn Subject) {
        subject.sample(&mut self.samples);
        self.last = (kinetic(subject, self.scales.centred)
            + stored(&self.samples, self.scales.modulus))
            / self.reference;
        self.energy = larger(self.energy, self.last);
        self.speed = larger(self.speed, fastest(&self.samples) / self.scales.speed);
        if let Some(balance) = &mut self.balance {
            balance.look(subject.totals().as_ref());
        }
    }

    /// An energy that is no number is a failure, not growth.
    fn grown(self, subject: &dyn Subject, step: u64) -> Trial {
        let t = self.time;
        if !self.last.is_finite() {
            let why = format!("the energy is not finite (step {step}, t = {t:.4e} s)");
            return self.ended(subject, Stability::Failed, Some(why), step);
        }
        let why = format!(
            "the energy is {:.1e} times that at the start (step {step}, t = {t:.4e} s)",
            self.energy
        );
        self.ended(subject, Stability::Unstable, Some(why), step)
    }

    fn failed(self, subject: &dyn Subject, step: u64, failure: &Failure) -> Trial {
        let why = format!("{failure} (step {step}, t = {:.4e} s)", self.time);
        self.ended(subject, Stability::Failed, Some(why), step)
    }

    fn ended(
        self,
        subject: &dyn Subject,
        verdict: Stability,
        why: Option<String>,
        steps: u64,
    ) -> Trial {
        let drift = self.balance.as_ref().map_or(Drift::NONE, Balance::drift);
        let largest = |column: &[f64], size: usize| {
            column.chunks_exact(size.max(1)).map(length).fold(0.0, larger)
        };
        let d = self.samples.dimension;
        Trial {
            verdict,
            why,
            steps,
            energy: self.energy,
            energy_kept: self.last,
            kinetic_kept: kinetic(subject, self.scales.centred) / self.kinetic_start,
            momentum: drift.of(Conserved::Momentum),
            angular_momentum: drift.of(Conserved::AngularMomentum),
            least_j: subject.census().min_j,
            speed: self.speed,
            stress_spread: stress_spread(&self.samples),
            checkerboard: checkerboard(&self.samples),
            stress: largest(&self.samples.stress, d * d) / self.scales.modulus,
            displacement: largest(&self.samples.displacement, d),
        }
    }
}

/// Kinetic energy (J), less that of the centre of mass where that is not asked for.
fn kinetic(subject: &dyn Subject, centred: bool) -> f64 {
    let Some(totals) = subject.totals() else { return 0.0 };
    let square: f64 = totals.momentum.iter().map(|p| p * p).sum();
    let common = if centred { square / (2.0 * totals.mass) } else { 0.0 };
    // Rounding may take more than there is; NaN stays NaN.
    let rest = totals.kinetic_energy - common;
    if rest < 0.0 { 0.0 } else { rest }
}

/// `sum V0 |sigma|^2 / (2 M)` (J).
fn stored(samples: &Samples, modulus: f64) -> f64 {
    let d = samples.dimension.max(1);
    let squares = samples.stress.chunks_exact(d * d).map(|s| s.iter().map(|s| s * s).sum::<f64>());
    squares.zip(&samples.weight).map(|(square, weight)| weight * square).sum::<f64>()
        / (2.0 * modulus)
}

fn fastest(samples: &Samples) -> f64 {
    samples.velocity.chunks_exact(samples.dimension.max(1)).map(length).fold(0.0, larger)
}

fn length(components: &[f64]) -> f64 {
    components.iter().fold(0.0, |all, c| libm::hypot(all, *c))
}
