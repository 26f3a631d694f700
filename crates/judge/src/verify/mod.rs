//! The judge: whether an error decreases with the formal order, and how certain this is.
//!
//! | module | content |
//! |---|---|
//! | [`quantity`](Quantity), [`norm`](Norms) | the error of one level as a number |
//! | [`conservation`](ConservationError) | drift of conserved sums without external forces |
//! | [`level`](Level), [`hypothesis`](OrderHypothesis) | errors, pairwise orders, tested order |
//! | [`fit`](Interval), [`t_quantile`](two_sided_95) | order by regression, and its interval |
//! | `window` | the asymptotic levels |
//! | `error_trend` | floor, divergence, oscillation |
//! | [`judge`](judge()) | the decision sequence, and the verdict |
//! | `verdict/reason`, [`verdict/name`](Verdict) | sentences and names of verdicts in reports |
//! | [`case`](judge_case) | judgement of a case: all results that a report shows |
//! | [`judge_plan`](JudgePlan), [`rerun`](Reruns) | inputs of a judgement, and repeated levels |
//! | [`floor`](Floor) | the cause of an error floor |
//! | [`richardson`](Richardson) | order and limit from three values |
//! | [`limit_estimate`](LimitEstimate) | order and limit of a series, with intervals |
//! | [`cost`](Ranking) | cost of accuracy, in transfers or seconds |
//! | [`spectrum`](SpectrumStudy) | measured and predicted phase speed and damping of a wave |
//! | [`stability`](StabilityStudy) | growth in runs, amplification matrix, limits by bisection |
//! | [`gradient`](GradientStudy) | derivatives that a solver reports |
//! | [`expectation`](Expectation), [`limits`](Limits) | expectations of suites |
//! | [`figure`](CaseFigure) | registry of the measured values that suites can bound |
//!
//! Two rules apply everywhere. Comparisons are written so that NaN fails: the code tests the
//! required condition (`error <= tolerance`), never its opposite. The shape of a series is
//! recognised by ratios, so units of error and spacing do not change a verdict.

mod case;
mod conservation;
mod convergence;
mod cost;
mod energy_rate;
pub mod error;
mod exclusion;
mod expectation;
mod figure;
mod gradient;
mod grouping;
mod judge_plan;
pub mod order;
mod outcome;
mod rerun;
mod spectrum;
mod stability;
pub mod verdict;

pub use case::{CaseJudgement, judge_case};
pub use conservation::Conserved;
pub use convergence::{Convergence, LevelOutcome, StudySettings};
pub use cost::{Agreement, pareto_front};
pub use error::clock::Clock;
pub use error::norm::Norms;
pub use error::observer::History;
pub use error::quantity::Quantity;
pub use error::run::{Comparison, RunResult, run};
pub use exclusion::rounding_bound;
pub use expectation::gate::{GateResult, Gating, Requirement};
pub use expectation::limits::{Limits, Measured};
pub use expectation::proposal::propose;
pub use expectation::unmet::{Unmet, UnmetCode};
pub use expectation::{Bounds, Expectation};
pub use figure::{BoundKind, CaseFigure, FigureNeed};
pub use gradient::GradientStudy;
pub use judge_plan::{JudgePlan, LevelRun};
pub use order::fit::Interval;
pub use order::hypothesis::OrderHypothesis;
pub use order::level::{Axis, Level, observed_order};
pub use order::limit_estimate::{LimitEstimate, SeriesPoint, estimate_limit};
pub use order::richardson::Richardson;
pub use order::window::FEWEST_LEVELS;
pub use outcome::{CaseOutcome, CaseResult, StudyResults, SuiteOutcome};
pub use spectrum::SpectrumStudy;
pub use stability::{Stability, StabilityExpectation, StabilityStudy, amplification};
pub use verdict::diagnosis::Diagnosis;
pub use verdict::judge::{Judgement, judge};
pub use verdict::name::{UnknownVerdict, Verdict};

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    conservation::ConservationError,
    cost::{
        ConvergingPart, End, Exponent, Machine, MethodCost, Ranked, Ranking, Reach, Sample,
        TARGETS, TimedSuite, Timing, Workload, by_transfers, rankings,
    },
    error::clock::{MOST_STEPS, STEP_TOLERANCE, StepKind, is_instant},
    error::declaration::SumNeed,
    error::judged_box::JudgedBox,
    error::judged_sum::JudgedSum,
    error::norm::{ErrorScale, NormName, RunErrors, larger},
    error::observer::displacement_at,
    error::run::run_recorded,
    error::spread::{RunRecord, spread},
    exclusion::{Exclusion, single_precision_spacing},
    expectation::CaseFindings,
    expectation::gate::Acceptance,
    expectation::proposal::{Ground, Proposal, ProposedKey},
    figure::RunFigure,
    gradient::{
        FIRST_LEVEL, GradientEntry, GradientEvidence, GradientLevel, GradientState, GradientTerms,
        LAST_LEVEL, Perturbed, Sweep, SweepPoint, Taylor, ValueCheck,
    },
    grouping::{distinct, grouped},
    judge_plan::LevelSizes,
    order::format_number::{format_number, rounded, tuple},
    order::limit_estimate::{EstimateRefusal, LEVELS_OF_ESTIMATE},
    order::t_quantile::two_sided_95,
    outcome::{Exemption, ForceRow, InternalForce},
    rerun::{Reruns, RoundingSizes},
    spectrum::{
        AMPLITUDE, MeasuredWave, ObservedWave, PERIODS, Recurrence, SpectrumExpectation,
        SpectrumRow, WaveFigures, run_wave, steps_of_run,
    },
    stability::{
        AmplificationError, Critical, FigureBounds, Prediction, Radius, Scales, StabilityLimit,
        StabilityRow, Trial, is_looked_at, spectral_radius, stability_limit, trial,
    },
    verdict::diagnosis::{Cause, ChangedRun, Evidence, KnownCause, KnownCauseKind},
    verdict::floor::{Floor, FloorCause, Probe},
};
