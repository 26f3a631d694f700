//! The contract of a subject: the built-in solver fulfils it. For each rule there is a subject that
//! violates only this rule.

use super::own_solver::{OwnSolver, SWINGING_BAR};
use crate::common::solver::{Solver, solver};
use crate::common::{built_in_suite, valid_suite};
use mpm_verify::prelude::*;
use mpm_verify::study;
use mpm_verify::testing::conformance_on;
use rstest::rstest;
use std::sync::atomic::{AtomicUsize, Ordering};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fault {
    Nothing,
    NoDimension,
    NoPoint,
    ShortVelocity,
    StressOfOnePoint,
    NanAtStart,
    NanLater,
    LosesAPoint,
    FarLabel,
    CurrentLabels,
    TurnedLabels,
    NoWeight,
    PresentVolume,
    OwnPlacesOfTwiceTheBody,
    GrowingWeight,
    Displaced,
    AtRest,
    Appends,
    Fails,
    OwnStep,
    StandsStill,
    NoWork,
    WorkOfLastStep,
    OneParticleMore,
    CrossingsOfLastStep,
    AllAndOneLeft,
    InitialJ,
    NegativeJ,
    TwiceTheMass,
    AnotherWayEachTime,
}

/// The built-in solver on a level, with a fault.
pub(super) struct FaultySubject {
    pub(super) sound: Box<dyn Subject>,
    pub(super) fault: Fault,
    /// Number of steps so far.
    pub(super) steps: u64,
    /// Number of the subject among the subjects of its factory.
    pub(super) number: usize,
}

impl Subject for FaultySubject {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.steps += 1;
        match self.fault {
            Fault::Fails if self.steps > 1 => Err(Failure::External("gives up".to_owned())),
            Fault::OwnStep => self.sound.step(1e-3),
            Fault::StandsStill => Ok(()),
            _ => self.sound.step(dt),
        }
    }

    fn sample(&self, samples: &mut Samples) {
        let mut own = Samples::default();
        self.sound.sample(&mut own);
        let later = self.steps > 0;
        match self.fault {
            Fault::NoDimension => own.dimension = 0,
            Fault::NoPoint => own.restart(1),
            Fault::ShortVelocity => drop(own.velocity.pop()),
            Fault::StressOfOnePoint => own.stress.truncate(1),
            Fault::NanAtStart => own.displacement[3] = f64::NAN,
            Fault::NanLater if later => own.velocity[3] = f64::NAN,
            Fault::LosesAPoint if later => {
                let short = own.clone();
                own.restart(1);
                for p in 1..short.len() {
                    let (u, v) = (short.displacement[p], short.velocity[p]);
                    own.push(&[short.label[p]], &[u], &[v], short.weight[p]);
                }
            }
            Fault::FarLabel => own.label[3] = 1e3,
            Fault::CurrentLabels => {
                own.label.iter_mut().zip(&own.displacement).for_each(|(label, u)| *label += u);
            }
            Fault::TurnedLabels if later => own.label.reverse(),
            Fault::NoWeight => own.weight[3] = 0.0,
            Fault::PresentVolume => own.weight.iter_mut().for_each(|weight| *weight *= 1.01),
            Fault::OwnPlacesOfTwiceTheBody => {
                own.label[3] += 0.01;
                own.weight.iter_mut().for_each(|weight| *weight *= 2.0);
            }
            Fault::GrowingWeight if later => own.weight[3] *= 1.01,
            Fault::Displaced => own.displacement.iter_mut().for_each(|u| *u += 0.1),
            Fault::AtRest if !later => own.velocity.fill(0.0),
            Fault::AnotherWayEachTime if later => own.displacement[3] += self.number as f64,
            _ => {}
        }
        if self.fault == Fault::Appends {
            samples.dimension = own.dimension;
            for (into, from) in [
                (&mut samples.label, own.label),
                (&mut samples.displacement, own.displacement),
                (&mut samples.velocity, own.velocity),
                (&mut samples.weight, own.weight),
            ] {
                into.extend(from);
            }
        } else {
            *samples = own;
        }
    }

    fn counters(&self) -> RunCounters {
        let mut counters = self.sound.counters();
        match self.fault {
            Fault::NoWork => counters.transfers = 0,
            Fault::WorkOfLastStep => counters.transfers = 80,
            Fault::OneParticleMore => counters.particles = counters.particles.map(|n| n + 1),
            Fault::CrossingsOfLastStep => counters.crossings = Some(9 - self.steps),
            Fault::AllAndOneLeft => counters.left_domain = counters.particles.map(|n| n + 1),
            Fault::InitialJ => counters.min_j = 1.5,
            Fault::NegativeJ => counters.min_j = -1.0,
            _ => {}
        }
        counters
    }

    fn totals(&self) -> Option<Totals> {
        let totals = self.sound.totals()?;
        Some(if self.fault == Fault::TwiceTheMass { totals.plus(totals) } else { totals })
    }
}

/// The built-in solver in the role of a user's solver.
struct OurSolver {
    suite: Suite,
    fault: Fault,
    made: AtomicUsize,
}

impl OurSolver {
    fn new(suite: Suite, fault: Fault) -> Self {
        Self { suite, fault, made: AtomicUsize::new(0) }
    }

    fn breaches(&self) -> Vec<Breach> {
        conformance_on(self, &self.suite)
    }
}

impl SolverFactory for OurSolver {
    fn name(&self) -> &'static str {
        "ours"
    }

    fn subject(&self, _: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let plan = self.suite.convergence().expect("a convergence study");
        let sound = study::subject(plan, plan.cases[0].method, plan.refine.levels[0])?;
        let number = self.made.fetch_add(1, Ordering::Relaxed);
        Ok(Box::new(FaultySubject { sound, fault: self.fault, steps: 0, number }))
    }
}

#[rstest]
#[case::no_dimension(Fault::NoDimension, "dimension", "`dimension` = 1", "0")]
#[case::no_point(Fault::NoPoint, "counts", "at least one point", "`weight` is empty")]
#[case::a_number_short(Fault::ShortVelocity, "counts", "20 numbers in `velocity`", "19")]
#[case::stress_of_one(Fault::StressOfOnePoint, "counts", "20 numbers in `stress`", "1")]
#[case::nan_at_start(Fault::NanAtStart, "finite numbers", "at the start", "displacement[3] = NaN")]
#[case::nan_later(Fault::NanLater, "finite numbers", "a step that returns", "velocity[3] = NaN")]
#[case::a_point_is_lost(Fault::LosesAPoint, "counts", "20 numbers in `label`", "19 after 1 steps")]
#[case::far_label(Fault::FarLabel, "labels", "inside the grid", "label[3] = 1e3")]
#[case::current(Fault::CurrentLabels, "order of labels", "at all times", "after 1 steps")]
#[case::turned(Fault::TurnedLabels, "order of labels", "label[0] = 6.25e-1", "2.4375e1 after")]
#[case::no_weight(Fault::NoWeight, "weights", "positive weights", "weight[3] = 0")]
#[case::present(Fault::PresentVolume, "weights", "weight[0] = 1.25e0", "1.2625e0")]
#[case::two_bodies(Fault::OwnPlacesOfTwiceTheBody, "weights", "sum to the volume", "5e1 m^D")]
#[case::growing(Fault::GrowingWeight, "weights", "weight[3] = 1.25e0 at all times", "1.2625e0")]
#[case::displaced(Fault::Displaced, "initial state", "displacement[0] = 0e0", "1e-1")]
#[case::at_rest(Fault::AtRest, "initial state", "velocity[", "0e0")]
#[case::appends(Fault::Appends, "sample", "to replace the", "40 numbers in `label` instead of 20")]
#[case::fails(Fault::Fails, "step", "6 steps of", "step 2 fails: the solver gives up")]
#[case::own_step(Fault::OwnStep, "step", "half the motion", "in a full step")]
#[case::stands_still(Fault::StandsStill, "step", "points to move by about", "at most 0e0 m")]
#[case::no_work(Fault::NoWork, "work counters", "`transfers` to increase", "0 after step 1")]
#[case::last_work(Fault::WorkOfLastStep, "work counters", "`transfers` to increase", "80 after")]
#[case::one_more(Fault::OneParticleMore, "run counters", "`particles` = 20, or none", "21 after")]
#[case::crossings(Fault::CrossingsOfLastStep, "run counters", "never to decrease", "Some(8)")]
#[case::all_left(Fault::AllAndOneLeft, "run counters", "`left_domain` of at most 20", "21 after")]
#[case::initial_j(Fault::InitialJ, "run counters", "smallest det F so far", "1.5e0")]
#[case::negative_j(Fault::NegativeJ, "run counters", "0 < `min_j`", "-1e0")]
#[case::mass(Fault::TwiceTheMass, "totals", "`mass` = 2.5e1 kg", "5e1 kg")]
#[case::another(Fault::AnotherWayEachTime, "repeat", "the same results", "displacement[3]")]
fn each_breach_is_found_and_said(
    #[case] fault: Fault,
    #[case] about: &str,
    #[case] expected: &str,
    #[case] seen: &str,
) {
    // Rules do not depend on the direction of the motion.
    let reversed = SWINGING_BAR.replace("v0: 0.01", "v0: -0.01");
    for suite in [SWINGING_BAR, &reversed] {
        let breaches = OurSolver::new(valid_suite(suite), fault).breaches();
        let of_part = breaches.iter().find(|breach| breach.about == about);
        let breach = of_part.unwrap_or_else(|| panic!("nothing about {about}: {breaches:#?}"));
        assert!(breach.expected.contains(expected) && breach.seen.contains(seen), "{breach}");
        let others: Vec<&Breach> = breaches.iter().filter(|other| other.about != about).collect();
        // A subject that does not move does no work either.
        let both = fault == Fault::StandsStill && others.iter().all(|o| o.about == "work counters");
        assert!(others.is_empty() || both, "{others:#?}");
    }
}

#[test]
fn built_in_solver_meets_the_contract() {
    let bar = OurSolver::new(valid_suite(SWINGING_BAR), Fault::Nothing).breaches();
    assert!(bar.is_empty(), "{bar:#?}");
    for name in [
        "mms-periodic-bar-sin",
        "mms-axis-aligned-2d",
        "rotating-disk",
        "two-disks",
        // More cells along y than along x.
        "fluid-column",
    ] {
        let suite = built_in_suite(name);
        let breaches = OurSolver::new(suite, Fault::Nothing).breaches();
        assert!(breaches.is_empty(), "{name}: {breaches:#?}");
    }
}

#[test]
fn solver_of_the_example_meets_the_contract() {
    let breaches = conformance(&OwnSolver);
    assert!(breaches.is_empty(), "{breaches:#?}");
}

#[test]
fn solver_without_a_supported_suite_gets_the_reason() {
    let able = Some(Capabilities::of(&[1], &["linear_elastic"], &["free", "fixed"], &[]));
    let refusing = Solver { able, ..solver("refusing", |_| Err("a bad day".into())) };
    let breaches = conformance(&refusing);
    assert_eq!(breaches.len(), 1, "{breaches:#?}");
    for words in ["problem: ", "vibrating-bar: a bad day", "the solver lacks dimensions: 2"] {
        assert!(breaches[0].to_string().contains(words), "{}", breaches[0]);
    }
    let breaches = conformance_on(&refusing, &valid_suite(SWINGING_BAR));
    assert!(breaches[0].seen.contains("a bad day"), "{breaches:#?}");
}
