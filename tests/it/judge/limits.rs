//! Coverage of the estimated limit for the built-in suites with an exact solution.
//!
//! ```console
//! cargo test --test it limits_cover -- --ignored --nocapture    # a few minutes
//! ```
//!
//! Each case runs on its usual levels. Functionals of the final state are displacement, velocity
//! and temperature, component by component. They are interpolated at three points of the body (and
//! at the observed point of the suite). A functional whose exact value is below a millionth of the
//! largest one of the suite is omitted: it is zero by symmetry, or the wave has not reached the
//! point. A hash of the name assigns each suite to one of two halves. The constants of the estimate
//! were chosen on the first half.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mpm_verify::embedded;
use mpm_verify::exact::Truth;
use mpm_verify::prelude::{Extent, Suite};
use mpm_verify::study::{TimeStep, subject, time_steps};
use mpm_verify::subject::Samples;
use mpm_verify::suite::{Against, Case, ConvergencePlan};
use mpm_verify::verify::{Axis, Richardson, SeriesPoint, displacement_at, estimate_limit};
use rayon::prelude::*;

/// Minimum coverage on the half of the suites that was not used to choose the constants.
const LEAST_COVERAGE: f64 = 0.93;

/// Maximum exact value of a functional that counts as zero, relative to the largest exact value of
/// the suite.
const ZERO: f64 = 1e-6;

/// Points of the body, as fractions of its bounding box along each axis.
const PLACES: [[f64; 3]; 3] = [[0.5, 0.5, 0.5], [0.37, 0.61, 0.43], [0.83, 0.21, 0.68]];

/// Values of a functional on the levels of a case.
struct FunctionalSeries {
    suite: String,
    /// First letter of the name of the quantity.
    quantity: char,
    /// Quantity, component and point.
    name: String,
    exact: f64,
    points: Vec<SeriesPoint>,
}

/// Name, exact value and computed value of each functional of a final state.
type Functionals = Vec<(String, f64, f64)>;

fn functionals(plan: &ConvergencePlan, truth: &dyn Truth, t: f64, end: &Samples) -> Functionals {
    let d = plan.scene.dimension();
    let (from, to) = (&plan.scene.from, &plan.scene.to);
    let place = |shares: &[f64; 3]| -> Vec<f64> {
        (0..d).map(|k| from[k] + shares[k] * (to[k] - from[k])).collect()
    };
    let places: Vec<Vec<f64>> = PLACES.iter().map(place).chain(plan.observe.clone()).collect();
    let mut all = Functionals::new();
    let is_inside = |place: &Vec<f64>| plan.exact.as_ref().is_none_or(|exact| exact.holds(place));
    for (k, place) in places.iter().enumerate().filter(|(_, place)| is_inside(place)) {
        let mut exact = vec![0.0; d];
        let mut field = |name: &str, exact: &[f64], values: Vec<f64>| {
            if values.len() != end.label.len() {
                return;
            }
            let mut interpolated = end.clone();
            interpolated.displacement = values;
            for (axis, u) in displacement_at(&interpolated, place).iter().flatten().enumerate() {
                all.push((format!("{name}{axis}@{k}"), exact[axis], *u));
            }
        };
        truth.displacement(place, t, &mut exact);
        field("u", &exact, end.displacement.clone());
        truth.velocity(place, t, &mut exact);
        field("v", &exact, end.velocity.clone());
        if let Some(temperature) = truth.temperature(place, t) {
            let values = end.temperature.iter().flat_map(|value| vec![*value; d]).collect();
            field("T", &vec![temperature; d], values);
        }
    }
    all.retain(|(name, ..)| !name.starts_with('T') || name.starts_with("T0"));
    all
}

/// Returns the series of all functionals of a case; empty if a run fails.
fn of_case(
    suite: &Suite,
    plan: &ConvergencePlan,
    case: &Case,
    steps: &[TimeStep],
) -> Vec<FunctionalSeries> {
    let truth: &dyn Truth = match (&plan.exact, &plan.conduction) {
        (Some(exact), _) => exact,
        (None, Some(heat)) => heat,
        (None, None) => return Vec::new(),
    };
    let mut all: Vec<FunctionalSeries> = Vec::new();
    let mut levels = 0;
    for TimeStep { level, clock, .. } in steps.iter().filter(|step| step.case == case.name) {
        let Ok(mut subject) = subject(plan, case.method, *level) else { return Vec::new() };
        for _ in 0..clock.steps {
            if subject.step(clock.dt()).is_err() {
                return Vec::new();
            }
        }
        let mut end = Samples::default();
        subject.sample(&mut end);
        levels += 1;
        let h = match plan.refine.axis {
            Axis::Space => level.h,
            Axis::Time => clock.dt(),
            Axis::Particles => level.particle_spacing(plan.scene.dimension()),
        };
        for (name, exact, value) in functionals(plan, truth, clock.until, &end) {
            let point = SeriesPoint { h, value, resolution: 0.0 };
            if let Some(known) = all.iter_mut().find(|known| known.name == name) {
                known.points.push(point);
            } else {
                let quantity = name.chars().next().unwrap_or_default();
                let suite = suite.name.clone();
                all.push(FunctionalSeries { suite, quantity, name, exact, points: vec![point] });
            }
        }
    }
    all.retain(|series| series.points.len() == levels && levels >= 4);
    all
}

/// Whether a suite belongs to the second half, by bit 32 of the FNV-1a hash of its name.
fn is_for_test(suite: &str) -> bool {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    suite.bytes().fold(0xcbf2_9ce4_8422_2325, mix) >> 32 & 1 == 1
}

#[derive(Default)]
struct Tally {
    series: usize,
    answered: usize,
    covered: usize,
    indexed: usize,
    covered_by_index: usize,
    refusals: BTreeMap<&'static str, usize>,
    suites: BTreeMap<String, [usize; 2]>,
}

impl Tally {
    fn add(&mut self, series: &FunctionalSeries) {
        self.series += 1;
        match estimate_limit(&series.points) {
            Ok(estimate) => {
                let covers = estimate.covers(series.exact);
                self.answered += 1;
                self.covered += usize::from(covers);
                let suite = self.suites.entry(series.suite.clone()).or_default();
                suite[usize::from(covers)] += 1;
            }
            Err(refusal) => *self.refusals.entry(refusal.name()).or_default() += 1,
        }
        // The interval of the grid convergence index from the finest three levels (Roache 1994).
        let mut sorted = series.points.clone();
        sorted.sort_by(|a, b| b.h.total_cmp(&a.h));
        let [.., a, b, c] = sorted[..] else { return };
        let found = Richardson::new([a.h, b.h, c.h], [a.value, b.value, c.value]);
        if let Some(limit) = found.extrapolated {
            self.indexed += 1;
            let error = (c.value - series.exact).abs();
            self.covered_by_index += usize::from(error <= 1.25 * (limit - c.value).abs());
        }
    }

    fn coverage(&self) -> f64 {
        self.covered as f64 / self.answered as f64
    }

    fn print(&self, name: &str) {
        let share = |part: usize, all: usize| 100.0 * part as f64 / all as f64;
        println!(
            "{name}: {} series; estimate for {} ({:.1} %) in {} suites, coverage {:.1} %; grid \
             convergence index for {}, coverage {:.1} %; refused: {:?}",
            self.series,
            self.answered,
            share(self.answered, self.series),
            self.suites.len(),
            100.0 * self.coverage(),
            self.indexed,
            share(self.covered_by_index, self.indexed),
            self.refusals
        );
        let missed: Vec<String> = self
            .suites
            .iter()
            .filter(|(_, [missed, _])| *missed > 0)
            .map(|(suite, [missed, covered])| format!("{suite} {missed} of {}", missed + covered))
            .collect();
        println!("  not covered: {}", missed.join(", "));
    }
}

#[test]
#[ignore = "runs all suites: a few minutes"]
fn limits_cover_the_exact_value_in_93_per_cent_of_the_test_suites() {
    let all = Mutex::new(Vec::new());
    let names: Vec<&str> = embedded::names().collect();
    names.par_iter().for_each(|name| {
        let Some(Ok(source)) = embedded::source(name) else { return };
        let Ok(suite) = Suite::load(&source) else { return };
        let Some(plan) = suite.convergence() else { return };
        let steps = time_steps(&suite, Extent::Usual);
        let exact = plan.cases.par_iter().filter(|case| case.against == Against::Exact);
        exact.for_each(|case| {
            let series = of_case(&suite, plan, case, &steps);
            all.lock().unwrap().extend(series);
        });
    });
    let all = all.into_inner().unwrap();
    let mut largest: BTreeMap<(&str, char), f64> = BTreeMap::new();
    for series in &all {
        let most = largest.entry((&series.suite, series.quantity)).or_default();
        *most = most.max(series.exact.abs());
    }
    let is_zero = |series: &FunctionalSeries| {
        !(series.exact.abs() > ZERO * largest[&(series.suite.as_str(), series.quantity)])
    };
    let mut halves = [Tally::default(), Tally::default()];
    let mut together = Tally::default();
    for series in all.iter().filter(|series| !is_zero(series)) {
        halves[usize::from(is_for_test(&series.suite))].add(series);
        together.add(series);
    }
    for (name, half) in ["calibration", "test"].into_iter().zip(&halves) {
        half.print(name);
    }
    together.print("all");
    let [_, test] = &halves;
    assert!(test.answered > 500 && test.coverage() >= LEAST_COVERAGE, "{}", test.coverage());
}
