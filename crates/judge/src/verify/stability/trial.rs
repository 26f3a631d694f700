//! Runs a solver and observes whether the energy grows.
//!
//! The energy is the kinetic energy plus `V |sigma|^2 / (2 M)`, where M is the stiffness against
//! uniaxial strain: the strain energy in 1-D at small strain, otherwise only the size of the
//! stress. The energy is divided by its initial value, or by the energy of a unit strain if the
//! body starts at rest.

use crate::verify::conservation::{Balance, ConservationError, Conserved};
use crate::verify::error::norm::largest_length;
use crate::verify::{Scales, Stability, Trial, larger};
use mpm_subject::{Failure, Samples, Subject};

/// Number of initial steps that are all checked; later, every [`EVERY`]th step is checked.
const FIRST: u64 = 64;
const EVERY: u64 = 16;

/// Whether the state is checked after a step.
pub fn is_looked_at(step: u64, steps: u64) -> bool {
    step <= FIRST || step.is_multiple_of(EVERY) || step == steps
}

/// Runs `steps` steps, whose lengths (s) cycle through `dt`. Stops on instability or failure.
pub fn trial(subject: &mut dyn Subject, dt: &[f64], steps: u64, scales: &Scales) -> Trial {
    let mut monitor = TrialMonitor::new(subject, *scales);
    let mut lengths = dt.iter().cycle();
    for step in 1..=steps {
        let dt = *lengths.next().unwrap_or(&f64::NAN);
        monitor.time += dt;
        if let Err(failure) = subject.step(dt) {
            return monitor.failed(subject, step, &failure);
        }
        if is_looked_at(step, steps) {
            monitor.look(subject);
            if !(monitor.energy <= scales.unstable_above) {
                return monitor.grown(subject, step);
            }
        }
    }
    let verdict = if monitor.energy <= scales.stable_below {
        Stability::Stable
    } else {
        Stability::BoundedGrowth
    };
    monitor.ended(subject, verdict, None, steps)
}

struct TrialMonitor {
    scales: Scales,
    time: f64,
    samples: Samples,
    balance: Option<Balance>,
    reference: f64,
    kinetic_start: f64,
    energy: f64,
    last: f64,
    speed: f64,
    kinetic: f64,
    /// Current and largest kinetic energy in the null space (J).
    null: f64,
    null_most: f64,
}

impl TrialMonitor {
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
        let mut monitor = Self {
            scales,
            time: 0.0,
            samples,
            balance: subject.totals().map(Balance::start),
            reference,
            kinetic_start,
            energy: 0.0,
            last: 0.0,
            speed: 0.0,
            kinetic: 0.0,
            null: f64::NAN,
            null_most: 0.0,
        };
        monitor.look(subject);
        monitor
    }

    fn look(&mut self, subject: &dyn Subject) {
        subject.sample(&mut self.samples);
        let moving = kinetic(subject, self.scales.centred);
        self.kinetic = larger(self.kinetic, moving);
        self.last = (moving + stored(&self.samples, self.scales.modulus)) / self.reference;
        if self.scales.null_space {
            self.null = subject.null_space_energy().unwrap_or(f64::NAN);
        }
        self.null_most = larger(self.null_most, self.null);
        self.energy = larger(self.energy, self.last);
        let fastest = largest_length(&self.samples.velocity, self.samples.dimension);
        self.speed = larger(self.speed, fastest / self.scales.speed);
        if let Some(balance) = &mut self.balance {
            balance.look(subject.totals().as_ref());
        }
    }

    /// Creates the result of a run beyond the energy bound; infinite or NaN energy is a failure.
    fn grown(self, subject: &dyn Subject, step: u64) -> Trial {
        let t = self.time;
        if !self.last.is_finite() {
            let why = format!("the energy is not finite (step {step}, t = {t:.4e} s)");
            return self.ended(subject, Stability::Failed, Some(why), step);
        }
        let why = format!(
            "the energy is {:.1e} times its initial value (step {step}, t = {t:.4e} s)",
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
        let drift = self.balance.as_ref().map_or(ConservationError::NONE, Balance::drift);
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
            least_j: subject.counters().min_j,
            speed: self.speed,
            null_share: self.null / self.kinetic,
            largest_null_share: self.null_most / self.kinetic,
            stress_spread: stress_spread(&self.samples),
            checkerboard: checkerboard(&self.samples),
            stress: largest_length(&self.samples.stress, d * d) / self.scales.modulus,
            displacement: largest_length(&self.samples.displacement, d),
        }
    }
}

/// Computes the kinetic energy (J). `centred` excludes the energy of the centre of mass.
fn kinetic(subject: &dyn Subject, centred: bool) -> f64 {
    let Some(totals) = subject.totals() else { return 0.0 };
    let square: f64 = totals.momentum.iter().map(|p| p * p).sum();
    let common = if centred { square / (2.0 * totals.mass) } else { 0.0 };
    // Rounding may make the difference negative. NaN remains NaN.
    let rest = totals.kinetic_energy - common;
    if rest < 0.0 { 0.0 } else { rest }
}

/// Computes `sum V0 |sigma|^2 / (2 M)` (J).
fn stored(samples: &Samples, modulus: f64) -> f64 {
    let d = samples.dimension.max(1);
    let squares = samples.stress.chunks_exact(d * d).map(|s| s.iter().map(|s| s * s).sum::<f64>());
    squares.zip(&samples.weight).map(|(square, weight)| weight * square).sum::<f64>()
        / (2.0 * modulus)
}

/// Maximum number of particles for the neighbour search, which compares all pairs.
const MOST: usize = 4096;

/// Maximum distance between neighbours along an axis, in units of the shortest distance.
const NEAR: f64 = 1.2;

/// Computes the mean normal stress of each particle (Pa); `None` without stresses.
fn pressures(samples: &Samples) -> Option<Vec<f64>> {
    let (n, d) = (samples.len(), samples.dimension.max(1));
    let mean =
        |p: usize| (0..d).map(|i| samples.stress[(p * d + i) * d + i]).sum::<f64>() / d as f64;
    (samples.stress.len() == n * d * d).then(|| (0..n).map(mean).collect())
}

/// Computes largest minus smallest mean normal stress, relative to the largest magnitude.
pub(super) fn stress_spread(samples: &Samples) -> f64 {
    let pressures = pressures(samples).unwrap_or_default();
    let high = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = pressures.iter().copied().fold(f64::INFINITY, f64::min);
    (high - low) / high.abs().max(low.abs())
}

/// Computes the RMS difference between the mean normal stress of a particle and that of its
/// neighbours, relative to the RMS of the mean normal stress. NaN without stresses or neighbours,
/// or with too many particles.
pub(super) fn checkerboard(samples: &Samples) -> f64 {
    let (n, d) = (samples.len(), samples.dimension.max(1));
    let Some(pressure) = pressures(samples).filter(|_| (2..=MOST).contains(&n)) else {
        return f64::NAN;
    };
    let label = |p: usize| &samples.label[p * d..(p + 1) * d];
    let square = |p: usize, q: usize| {
        label(p).iter().zip(label(q)).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    let others = |p: usize| (0..n).filter(move |q| *q != p);
    let shortest = (1..n).map(|q| square(0, q)).fold(f64::INFINITY, f64::min) * NEAR * NEAR;
    let (mut apart, mut size, mut count) = (0.0, 0.0, 0_u32);
    for p in 0..n {
        let near: Vec<usize> = others(p).filter(|q| square(p, *q) <= shortest).collect();
        if near.is_empty() {
            continue;
        }
        let around = near.iter().map(|q| pressure[*q]).sum::<f64>() / near.len() as f64;
        apart += (pressure[p] - around) * (pressure[p] - around);
        size += pressure[p] * pressure[p];
        count += 1;
    }
    if count == 0 { f64::NAN } else { (apart / size).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{
        Critical, Prediction, RunFigure, StabilityExpectation, StabilityLimit, StabilityRow,
        StabilityStudy,
    };
    use approx::assert_relative_eq;
    use mpm_subject::{RunCounters, Totals};
    use rstest::rstest;

    /// One point of mass 2 under a constant stress, with a given kinetic energy (J) for each step.
    struct Scripted {
        kinetic: Vec<f64>,
        stress: f64,
        step: usize,
    }

    impl Subject for Scripted {
        fn step(&mut self, _: f64) -> Result<(), Failure> {
            self.step += 1;
            Ok(())
        }

        fn sample(&self, samples: &mut Samples) {
            samples.restart(1);
            samples.push(&[0.0], &[0.0], &[0.0], 1.0);
            samples.stress.push(self.stress);
        }

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }

        fn totals(&self) -> Option<Totals> {
            let kinetic_energy = self.kinetic[self.step];
            let momentum = [4.0, 0.0, 0.0];
            Some(Totals { mass: 2.0, momentum, kinetic_energy, ..Totals::default() })
        }
    }

    const SCALES: Scales = Scales {
        speed: 1.0,
        modulus: 0.5,
        stable_below: 2.0,
        unstable_above: 100.0,
        centred: false,
        null_space: false,
    };

    /// Runs a scripted solver. With a modulus of 1/2 the stress of 1 stores 1 J.
    fn watched(kinetic: &[f64], centred: bool) -> Trial {
        let mut subject = Scripted { kinetic: kinetic.to_vec(), stress: 1.0, step: 0 };
        let scales = Scales { centred, ..SCALES };
        trial(&mut subject, &[1.0], kinetic.len() as u64 - 1, &scales)
    }

    /// Two particles of 2 and 4 m2 in the plane; the third step fails. The stresses store
    /// `(2 * 25 + 4 * 169) * 1e12/(2 * 1e6)` = 3.63e8 J at the start and at the end, and four times
    /// as much in between.
    struct Plane(usize);

    impl Subject for Plane {
        fn step(&mut self, _: f64) -> Result<(), Failure> {
            self.0 += 1;
            let failure = Failure::External("stopped".to_owned());
            if self.0 < 3 { Ok(()) } else { Err(failure) }
        }

        fn sample(&self, samples: &mut Samples) {
            let factor = [1.0, 2.0, 1.0, 1.0][self.0];
            samples.restart(2);
            samples.push(&[0.0, 0.0], &[factor, 0.0], &[0.0, 3e-6], 2.0);
            samples.push(&[3.0, 1.0], &[0.9, -1.2], &[5e-6 * factor, -12e-6 * factor], 4.0);
            let stress = [3e6, 0.0, 0.0, 4e6, -5e6, 0.0, 0.0, -12e6];
            samples.stress.extend(stress.map(|s| factor * s));
        }

        fn counters(&self) -> RunCounters {
            RunCounters { min_j: 0.75, ..RunCounters::new(0) }
        }

        fn totals(&self) -> Option<Totals> {
            let k = self.0;
            Some(Totals {
                kinetic_energy: [1e8, 4e8, 0.5e8, 0.5e8][k],
                momentum: [[0.0; 3], [3.0, 4.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]][k],
                momentum_size: [40.0, 50.0, 20.0, 20.0][k],
                angular_momentum: [0.0, 0.0, [7.0, 5.0, 6.0, 6.0][k]],
                angular_momentum_size: 16.0,
                ..Totals::default()
            })
        }

        fn null_space_energy(&self) -> Option<f64> {
            Some([1e7, 2.4e8, 1.2e8, 1.2e8][self.0])
        }
    }

    /// Runs the plane with a wave speed of 4e-6 m/s and a modulus of 1e6 Pa.
    fn plane(steps: u64, unstable_above: f64, null_space: bool) -> Trial {
        let (speed, modulus, stable_below) = (4e-6, 1e6, 3.99);
        let scales = Scales { speed, modulus, stable_below, unstable_above, null_space, ..SCALES };
        trial(&mut Plane(0), &[0.5, 0.25], steps, &scales)
    }

    /// The energies are 4.63e8, 18.52e8 and 4.13e8 J. The pressures at the end are -3.5 and 8.5
    /// MPa.
    #[test]
    fn measured_values_of_a_run_by_hand() {
        let found = plane(2, 4.01, true);
        assert_eq!((found.verdict, found.why.clone()), (Stability::BoundedGrowth, None));
        for &figure in RunFigure::ALL {
            let expected = match figure {
                RunFigure::Energy => 4.0,
                RunFigure::EnergyKept => 4.13 / 4.63,
                RunFigure::KineticKept => 0.5,
                RunFigure::Momentum => 0.1,
                RunFigure::AngularMomentum => 0.125,
                RunFigure::LeastJ => 0.75,
                RunFigure::Speed => 6.5,
                RunFigure::NullShare => 0.3,
                RunFigure::LargestNullShare => 0.6,
                RunFigure::Checkerboard => (288.0 / 84.5_f64).sqrt(),
                RunFigure::StressSpread => 12.0 / 8.5,
                RunFigure::Stress => 13.0,
                RunFigure::Displacement => 1.5,
                RunFigure::Steps => 2.0,
            };
            assert_relative_eq!(figure.of(&found), expected, max_relative = 1e-14);
        }
        assert!(plane(2, 4.01, false).null_share.is_nan());
    }

    #[test]
    fn growth_and_failure_are_reported_with_step_and_time() {
        let grown = plane(2, 3.99, false);
        assert_eq!((grown.verdict, grown.steps), (Stability::Unstable, 1));
        let why = "the energy is 4.0e0 times its initial value (step 1, t = 5.0000e-1 s)";
        assert_eq!(grown.why.as_deref(), Some(why));
        let failed = plane(9, 4.01, false);
        assert_eq!((failed.verdict, failed.steps), (Stability::Failed, 3));
        assert_eq!(failed.why.as_deref(), Some("the solver stopped (step 3, t = 1.2500e0 s)"));
        let looked_at = |step| is_looked_at(step, 99);
        assert_eq!([1, 64, 65, 80, 98, 99].map(looked_at), [true, true, false, true, false, true]);
    }

    /// A unit strain of a volume of 1 stores half the modulus.
    #[test]
    fn energy_from_rest_is_relative_to_a_unit_strain() {
        let mut subject = Scripted { kinetic: vec![0.0, 6e-6], stress: 0.0, step: 0 };
        let scales = Scales { modulus: 8e-6, ..SCALES };
        let found = trial(&mut subject, &[1.0], 1, &scales);
        assert_relative_eq!(found.energy, 1.5, max_relative = 1e-14);
        assert_eq!(found.verdict, Stability::Stable);
    }

    /// A body of 2 kg and 4 kg m/s has an energy of 4 J, all due to its common motion.
    #[test]
    fn a_common_motion_is_left_out_where_it_is_asked() {
        assert_relative_eq!(watched(&[5.0, 9.0], true).energy, 3.0, max_relative = 1e-14);
        assert_relative_eq!(watched(&[5.0, 9.0], false).energy, 10.0 / 6.0, max_relative = 1e-14);
    }

    fn row_with_limit(limit: StabilityLimit, runs: &[(f64, Stability)]) -> StabilityRow {
        let trial = |verdict| Trial { verdict, ..watched(&[3.0, 4.0], false) };
        let confirmed = runs.iter().map(|(share, verdict)| (*share, trial(*verdict))).collect();
        let predicted = Some(Prediction { limit, leaves: None });
        let critical = Some(Critical { predicted, confirmed, observed: None });
        StabilityRow { value: 1.0, trial: None, critical, refused: None }
    }

    #[rstest]
    #[case::stable(Stability::Stable, [true, true, false, false])]
    #[case::bounded_growth(Stability::BoundedGrowth, [false; 4])]
    #[case::unstable(Stability::Unstable, [false, false, true, true])]
    #[case::failed(Stability::Failed, [false, false, true, true])]
    fn runs_on_both_sides_confirm_a_limit(#[case] verdict: Stability, #[case] agrees: [bool; 4]) {
        use StabilityLimit::{Above, At, Below};
        for ((predicted, share), agrees) in
            [(At(5.0), 0.98), (Above(9.0), 1.0), (At(5.0), 1.02), (Below(1.0), 1.0)]
                .into_iter()
                .zip(agrees)
        {
            let unmet = StabilityExpectation::default()
                .unmet(&row_with_limit(predicted, &[(share, verdict)]));
            let words = verdict.words();
            let text = format!("a run at {share} of the predicted limit is {words} after 1 steps");
            assert_eq!(unmet, if agrees { vec![] } else { vec![text] });
        }
    }

    #[test]
    fn a_search_is_summarised_by_its_lowest_and_highest_limit() {
        let runs = [(0.98, Stability::Stable), (1.02, Stability::Unstable)];
        let all = [StabilityLimit::At(0.7), StabilityLimit::Above(9.0), StabilityLimit::At(0.3)];
        let rows: Vec<StabilityRow> = all.map(|at| row_with_limit(at, &runs[..1])).into();
        let mut study = StabilityStudy {
            swept: "rho".to_owned(),
            sought: Some("C".to_owned()),
            figures: Vec::new(),
            rows,
        };
        study.rows[2] = row_with_limit(all[2], &runs);
        let text = "from 0.3 to 0.7 for 3 values of `rho`; 4 runs at 0.98, 1.02 times the predicted limits";
        assert_eq!((study.reason().as_str(), study.verdict().as_str()), (text, "limit of C"));
        study.rows = vec![row_with_limit(all[1], &[])];
        assert_eq!(study.reason(), "none in the range, for 1 value of `rho`");
    }

    #[test]
    fn one_row_that_is_not_stable_fails_a_study() {
        let row = |kinetic: &[f64]| StabilityRow {
            value: 1.0,
            trial: Some(watched(kinetic, false)),
            critical: None,
            refused: None,
        };
        let study = |rows| StabilityStudy {
            swept: "C".to_owned(),
            sought: None,
            figures: Vec::new(),
            rows,
        };
        let (stable, grown) = (row(&[3.0, 4.0]), row(&[3.0, 11.0]));
        assert!(!study(vec![stable.clone(), stable.clone()]).fails());
        let mixed = study(vec![stable.clone(), stable.clone(), grown]);
        assert!(mixed.fails());
        let texts = (mixed.verdict(), mixed.reason());
        assert_eq!(
            texts,
            ("stable, bounded growth".into(), "stable for 2 of 3 values of `C`".into())
        );
        assert!(study(vec![StabilityRow { trial: None, ..stable }]).fails());
    }

    #[test]
    fn the_fastest_counts_whatever_its_direction() {
        assert_eq!(largest_length(&[1.0, -1.0, 3.0, -4.0, 0.0, 4.5], 2), 5.0);
        assert_eq!(largest_length(&[], 0), 0.0);
        assert!(largest_length(&[1.0, f64::NAN, 2.0], 1).is_nan());
    }

    fn row(stress: &[f64]) -> Samples {
        let n = stress.len();
        Samples {
            dimension: 1,
            label: (0..n).map(|p| p as f64).collect(),
            weight: vec![1.0; n],
            stress: stress.to_vec(),
            ..Samples::default()
        }
    }

    /// Each particle is compared with the mean of its neighbours; without any it does not count.
    #[rstest]
    #[case::alternating(&[0.0, 1.0, 2.0, 3.0, 4.0], &[1.0, -1.0, 1.0, -1.0, 1.0], 4.0)]
    #[case::uniform(&[0.0, 1.0, 2.0, 3.0], &[3.0; 4], 0.0)]
    #[case::apart(&[0.0, 1.0, 9.0], &[1.0, 3.0, 2.0], 8.0 / 10.0)]
    #[case::a_mean(&[0.0, 1.0, 2.0], &[1.0, 4.0, 3.0], (9.0 + 4.0 + 1.0) / 26.0)]
    #[case::zero(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4], f64::NAN)]
    #[case::nothing(&[], &[], f64::NAN)]
    fn checkerboards(#[case] label: &[f64], #[case] stress: &[f64], #[case] square: f64) {
        let found = checkerboard(&Samples { label: label.to_vec(), ..row(stress) });
        assert!((found - square.sqrt()).abs() < 1e-15 || found.is_nan() && square.is_nan());
    }

    #[test]
    fn stress_spread_is_relative_to_the_largest_magnitude() {
        assert_relative_eq!(stress_spread(&row(&[1.0, -4.0, 2.0])), 1.5);
        assert_relative_eq!(stress_spread(&row(&[8.0, 2.0])), 0.75);
    }
}
