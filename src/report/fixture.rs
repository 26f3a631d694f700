//! Outcome of a suite in which no two numbers are equal, for tests of the writers.

use crate::subject::{ColumnSize, Holder, Profile};
use crate::verify::{
    Axis, CaseOutcome, Conserved, Convergence, Critical, ErrorScale, Floor, ForceRow,
    GradientLevel, GradientStudy, InternalForce, Interval, JudgedBox, Judgement, Level,
    LevelOutcome, LimitEstimate, Machine, MethodCost, NormName, Perturbed, Prediction, Probe,
    Quantity, Ranking, RunFigure, Sample, SpectrumRow, SpectrumStudy, Stability, StabilityLimit,
    StabilityRow, StabilityStudy, StepKind, StudyResults, StudySettings, SuiteOutcome, Sweep,
    SweepPoint, Taylor, TimedSuite, Timing, Trial, Unmet, UnmetCode, ValueCheck, Verdict,
    WaveFigures, Workload,
};
use serde_json::json;
use std::sync::Arc;

/// Returns a text in which each white space is one space.
pub(super) fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns a number with the digits `case`, `level` and `index`: 0.001203 for case 1, level 2 and
/// index 3.
pub(super) fn digits(case: u32, level: usize, index: u32) -> f64 {
    f64::from(1000 * case + 100 * level as u32 + index) / 1e6
}

/// Judged errors of two cases on three levels, whose spacings are 0.8, 0.4 and 0.2 m.
pub(super) const ERRORS: [[f64; 3]; 2] = [[0.06, 0.02, 0.005], [0.08, 0.03, f64::NAN]];

pub(super) fn interval(value: f64, low: f64, high: f64) -> Interval {
    Interval { value, low, high }
}

/// Creates a level of `case`. The coarsest level does not count, and a level without error failed.
fn level(case: u32, k: usize) -> LevelOutcome {
    let (error, size) = (ERRORS[case as usize - 1][k], libm::exp2(-(k as f64)));
    let of = |index| digits(case, k, index);
    let count = |index: u64| 1000 * u64::from(case) + 100 * k as u64 + index;
    let norms = |first| {
        json!({"rms": of(first), "l1": of(first + 1), "l2": of(first + 2), "linf": of(first + 3),
            "mass_l2": of(first + 4)})
    };
    let errors = |first| json!({"at_end": norms(first), "largest": norms(first + 5)});
    // The largest drift is that of the second level.
    let power = [1e5, 1e3, 1e4][k] * if case == 1 { 1.0 } else { 10.0 };
    let drift = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|sum| sum / power);
    let velocity = f64::from(3 * case + k as u32) - 4.0;
    let run = json!({
        "errors": errors(11), "displacement_errors": errors(21),
        "drift": drift,
        "energy_rate": {"value": of(41), "low": of(42), "high": of(43)},
        "counters": {"particles": count(51), "transfers": 1000 * count(52),
            "crossings": if k == 0 { count(53) } else { 0 }, "left_domain": count(54),
            "min_j": f64::from(count(55) as u32) / 1e3},
        "steps": count(56), "failure": error.is_nan().then_some("broken at 7 s"),
        "history": {"label": [0.25], "velocity": [[0.0, 3.0, 2.0], [1.0, velocity, -4.0]]},
        "displacement": [of(58)], "observed_error": of(59), "observed_exact": [of(60)],
        "residual_speed": f64::from(4 + k as u32) / power,
    });
    // The time steps of the second case are too long.
    let stable = f64::from(count(4) as u32 * [3, 1][case as usize - 1]) / 2e6;
    LevelOutcome {
        cells: 5 << k,
        h: [0.4, 0.25, 0.1][k],
        spacing: 0.8 * size,
        dt: of(1),
        ppc: (case == 1).then_some(4 + k as u64),
        run: serde_json::from_value(run).expect("a result"),
        error,
        usable: k > 0,
        rounding_bound: Some(of(2)),
        is_below_rounding: false,
        spread: Some(of(3)),
        order: (k > 0).then_some(f64::from(case) + 0.11 * k as f64),
        stable_time_step: Some(stable),
    }
}

/// Creates the study of `case` 1, which converges, or 2, which fails.
pub(super) fn convergence(case: u32) -> Convergence {
    let levels: Vec<LevelOutcome> = (0..3).map(|k| level(case, k)).collect();
    let converges = case == 1;
    let corner = |x: f64, y: f64| vec![x, y];
    Convergence {
        settings: StudySettings {
            axis: Axis::Space,
            formal_order: 1.75,
            norm: NormName::L2,
            of: Quantity::Velocity,
            within: Some(JudgedBox { from: corner(0.1, 0.2), to: corner(0.3, 0.4) }),
            scale: Some(2.5),
            error_scale: ErrorScale { problem: "a problem".to_owned(), size: 4.0, growth: 3.0 },
            compared: true,
            steps: StepKind::Time,
            observed_at: Some(vec![0.35]),
        },
        bounded: false,
        accepted: None,
        remarks: vec![format!("remark {case}")],
        drifts: vec![Conserved::Momentum, Conserved::Energy],
        rated: true,
        judgement: Judgement {
            verdict: if converges { Verdict::Converging } else { Verdict::Failed },
            order: converges.then(|| interval(2.0, 1.9, 2.2)),
            window: converges.then(|| vec![1, 2]),
            pairwise: levels.iter().map(|level| level.order).collect(),
            levels: levels.iter().map(|level| Level::new(level.spacing, level.error)).collect(),
            reason: format!("reason {case}"),
        },
        floor: converges.then(|| Floor {
            error: 0.5,
            probes: vec![
                Probe { axis: Axis::Time, error: Ok(0.45) },
                Probe { axis: Axis::Space, error: Ok(0.125) },
                Probe { axis: Axis::Particles, error: Err("no room".to_owned()) },
            ],
        }),
        observed_limit: converges.then(|| {
            let (order, limit) = (interval(1.5, 1.25, 1.875), interval(0.0012, 0.001, 0.0015));
            Ok(LimitEstimate { order, limit, finest: 0.0011 })
        }),
        levels,
    }
}

/// Names of the measured values of a run.
pub(super) const FIGURES: [&str; 13] = [
    "energy",
    "energy_kept",
    "kinetic_kept",
    "momentum",
    "angular_momentum",
    "least_j",
    "speed",
    "null_share",
    "largest_null_share",
    "stress_spread",
    "checkerboard",
    "stress",
    "displacement",
];

/// Returns the measured value `index` of run `run`: 0.401005 for run 1 and index 3.
pub(super) fn figure(run: usize, index: usize) -> f64 {
    digits((100 * (index + 1) + run) as u32, 0, 5)
}

fn trial(k: usize, verdict: Stability) -> Trial {
    let why = (k == 1).then_some("energy grows");
    let mut trial = json!({"verdict": verdict, "why": why, "steps": 500 + k});
    for (index, name) in FIGURES.iter().enumerate() {
        trial[name] = json!(figure(k, index));
    }
    serde_json::from_value(trial).expect("a trial")
}

/// Creates a study that searches for limits, or that measures runs.
fn stability(seeks: bool) -> StabilityStudy {
    let confirmed = vec![(0.9, trial(2, Stability::Stable)), (1.1, trial(3, Stability::Unstable))];
    let at = Prediction { limit: StabilityLimit::At(0.731), leaves: Some((-0.6, 0.8)) };
    let limits = [
        Critical { predicted: Some(at), confirmed, observed: Some(StabilityLimit::Below(0.05)) },
        Critical {
            predicted: None,
            confirmed: Vec::new(),
            observed: Some(StabilityLimit::Above(4.0)),
        },
    ];
    let trials = [trial(0, Stability::Stable), trial(1, Stability::Unstable)];
    let row = |((k, critical), trial): ((usize, Critical), Trial)| StabilityRow {
        value: [0.25, 0.375][k],
        trial: (!seeks).then_some(trial),
        critical: seeks.then_some(critical),
        refused: None,
    };
    StabilityStudy {
        swept: if seeks { "place" } else { "load" }.to_owned(),
        sought: seeks.then(|| "C".to_owned()),
        figures: vec![RunFigure::Momentum, RunFigure::LeastJ],
        rows: limits.into_iter().enumerate().zip(trials).map(row).collect(),
    }
}

fn gradient() -> GradientStudy {
    let level = |(k, gradient, exact): (u32, f64, f64)| GradientLevel {
        cells: 6 << k,
        h: 0.5 / f64::from(1 << k),
        dt: digits(6, k as usize, 1),
        gradient,
        exact,
    };
    // The function 3 q + 5 q^2 at q = 2, with the derivative 22 instead of 23.
    let value = |q: f64| 3.0 * q + 5.0 * q * q;
    let perturbed = [1, 2].map(|level| {
        let by = 2.0 / f64::from(1 << level);
        Perturbed { level, by, above: value(2.0 + by), below: value(2.0 - by) }
    });
    let point = |at, value, gradient| SweepPoint { at, value, gradient };
    GradientStudy {
        functional: "mean_displacement",
        parameter: "young",
        single_precision: false,
        value: ValueCheck { reported: 26.5, computed: 26.0, tolerance: 1.0 },
        taylor: Taylor { value: 26.0, gradient: 22.0, rounding: 1e-9, perturbed: perturbed.into() },
        levels: [(0, 22.0, 23.0), (1, 23.25, 23.0)].map(level).into(),
        sweep: Some(Sweep { change: -3.0, share: 0.875, jumps: vec![0.25, -0.5] }),
        points: vec![point(1.5, 15.75, 18.0), point(2.5, 38.75, 28.0)],
        evidence: None,
    }
}

fn spectrum() -> SpectrumStudy {
    let figures = |phase_error, log_kept| WaveFigures { phase_error, log_kept };
    let row = |cells, measured, predicted| SpectrumRow {
        cells,
        courant: cells / 16.0,
        steps: 700 + cells as u64,
        predicted: Some(predicted),
        measured,
        cells_for_one_percent: Some(cells + 0.75),
        limit: Some(1.0 + 0.5 / cells),
    };
    let first = row(4.0, Ok(figures(Some(-0.012), 0.0)), figures(Some(-0.0125), -0.5));
    let second = row(8.0, Err("no wave".to_owned()), figures(None, -0.25));
    SpectrumStudy { rows: vec![first, second] }
}

fn case(name: &str, verdict: &str, study: Option<StudyResults>) -> CaseOutcome {
    let setting = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    let basis = if name.contains("ugimp") { "ugimp" } else { "linear" };
    CaseOutcome {
        expected: Some("order 1.75".to_owned()),
        because: if name == "mpm-ugimp" { "a guess" } else { "a proof" }.to_owned(),
        verdict: verdict.to_owned(),
        reason: format!("reason {name}"),
        study,
        ..CaseOutcome::new(name, "mpm", vec![setting("basis", basis), setting("transfer", "flip")])
    }
}

/// Creates a suite with a case of each kind of study, and one that its solver does not support.
pub(super) fn outcome() -> SuiteOutcome {
    let forces = [(0.125, 3, 4, 1.5, 1.2), (0.625, 2, 5, -2.5, -2.0)];
    let force = |(position, left, right, force, predicted)| ForceRow {
        position,
        left,
        right,
        force,
        predicted,
    };
    let forces = InternalForce { rows: forces.map(force).into() };
    let mut cases = vec![
        case("mpm-linear", "converging", Some(StudyResults::Convergence(Arc::new(convergence(1))))),
        case("mpm-ugimp", "failed", Some(StudyResults::Convergence(Arc::new(convergence(2))))),
        case("force", "agrees", Some(StudyResults::InternalForce(Arc::new(forces)))),
        case("limit", "limit of C", Some(StudyResults::Stability(Arc::new(stability(true))))),
        case(
            "sweep",
            "stable, unstable",
            Some(StudyResults::Stability(Arc::new(stability(false)))),
        ),
        case("derivative", "wrong", Some(StudyResults::Gradient(Arc::new(gradient())))),
        case("wave", "failed", Some(StudyResults::Spectrum(Arc::new(spectrum())))),
        case("other", "", None).not_applicable(vec!["fixed".to_owned()], "lacks"),
    ];
    cases[1].unmet = vec![Unmet::new(UnmetCode::RunFailed, "the run failed")];
    cases[0].profile = Some(Profile {
        effects: vec!["gravity", "traction"],
        particles: 20,
        nodes: 9,
        passes: vec!["P2G(mass)".to_owned(), "G2P(x)".to_owned()],
        visits: vec![("p2g mass", 40), ("g2p x", 3)],
        columns: vec![
            ColumnSize { name: "X", holder: Holder::Particle, entries: 20, bytes: 16 },
            ColumnSize { name: "layer", holder: Holder::Particle, entries: 4, bytes: 2 },
            ColumnSize { name: "m", holder: Holder::Node, entries: 9, bytes: 8 },
        ],
    });
    SuiteOutcome {
        suite: "odd".to_owned(),
        group: "ends".to_owned(),
        title: "50 % of a bar".to_owned(),
        source: "a book".to_owned(),
        about: "First. Second.".to_owned(),
        statement: vec![("young".to_owned(), "E = 7".to_owned())],
        meaning: 0xabc,
        cases,
    }
}

/// Creates a ranking of `cheap`, with order 2 and work ~ h^-3, and `exact`, whose work is
/// proportional to the inverse of its error.
pub(super) fn ranking() -> Ranking {
    let method = |name: &str, formal_order, growth, levels: [[f64; 3]; 3]| {
        let sample = |[spacing, error, work]: [f64; 3]| Sample {
            spacing,
            error,
            work,
            usable: true,
            asymptotic: true,
            failed: false,
        };
        MethodCost {
            name: name.to_owned(),
            samples: levels.map(sample).into(),
            formal_order,
            growth,
        }
    };
    let cheap = [[0.4, 0.08, 3.0], [0.2, 0.02, 24.0], [0.1, 0.005, 192.0]];
    let exact = [[0.4, 0.04, 10.0], [0.2, 0.004, 100.0], [0.1, 0.0004, 1000.0]];
    let methods = vec![method("cheap", 2.0, 3.0, cheap), method("exact", 4.0, 3.0, exact)];
    Ranking::new("a problem".to_owned(), 4.0, &[0.01, 0.001], methods)
}

/// Creates a suite with times of the levels of its first two cases.
pub(super) fn timed_suite() -> TimedSuite {
    let level = |case: u32, k: usize| {
        let of = |index| digits(case, k, index);
        let timing = Timing { median: of(71), low: of(11), high: of(99), repeats: 7 + k };
        (Workload { transfers: 1.0, updates: 1e7 * of(75), steps: 2.0 }, Some(timing))
    };
    let mut outcome = outcome();
    outcome.cases.truncate(2);
    TimedSuite {
        outcome,
        levels: [1, 2].map(|case| (0..3).map(|k| level(case, k)).collect()).into(),
        machine: Machine {
            cores: 3,
            load: Some([0.25, 0.5]),
            waited: Some(0.125),
            fixed_loop: Some(Timing { median: 4.0, low: 3.5, high: 4.25, repeats: 11 }),
        },
    }
}
