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
mod study_results;
pub mod verdict;

pub use case::{CaseJudgement, judge_case};
pub use conservation::{ConservationError, Conserved};
pub use convergence::{Convergence, LevelOutcome};
pub use cost::{
    Agreement, ConvergingPart, End, Exponent, Machine, MethodCost, Ranked, Ranking, Reach, Sample,
    TARGETS, TimedSuite, Timing, Workload, by_transfers, pareto_front, rankings,
};
pub use error::clock::is_instant;
pub use error::clock::{Clock, MOST_STEPS, STEP_TOLERANCE, StepKind};
pub use error::declaration::SumNeed;
pub use error::judged_box::JudgedBox;
pub use error::judged_sum::JudgedSum;
pub use error::norm::ErrorScale;
pub use error::norm::larger;
pub use error::norm::{NormName, Norms, RunErrors};
pub use error::observer::{History, displacement_at};
pub use error::quantity::Quantity;
pub use error::run::{Comparison, RunResult, errors, run, run_recorded};
pub use error::spread::{RunRecord, spread};
pub use exclusion::{Exclusion, rounding_bound, single_precision_spacing};
pub use expectation::gate::{Acceptance, GateResult, Gating, Requirement, UnmetRequirement};
pub use expectation::limits::{Limits, Measured};
pub use expectation::proposal::{Ground, Proposal, ProposedKey, propose};
pub use expectation::{Bounds, CaseFindings, Expectation};
pub use figure::{BoundKind, CaseFigure, FigureNeed, RunFigure};
pub use gradient::{
    FIRST_LEVEL, GradientEntry, GradientEvidence, GradientLevel, GradientState, GradientStudy,
    GradientTerms, LAST_LEVEL, Perturbed, Sweep, SweepPoint, Taylor, ValueCheck,
};
pub use grouping::{distinct, grouped};
pub use judge_plan::{JudgePlan, LevelRun, LevelSizes};
pub use order::fit::Interval;
pub use order::format_number::{format_number, rounded, tuple};
pub use order::hypothesis::OrderHypothesis;
pub use order::level::{Axis, Level, observed_order};
pub use order::limit_estimate::{
    EstimateRefusal, LEVELS_OF_ESTIMATE, LimitEstimate, SeriesPoint, estimate_limit,
};
pub use order::richardson::Richardson;
pub use order::t_quantile::two_sided_95;
pub use order::window::FEWEST_LEVELS;
pub use outcome::{CaseOutcome, Exemption, SuiteOutcome};
pub use rerun::{Reruns, RoundingSizes};
pub use spectrum::{
    AMPLITUDE, MeasuredWave, ObservedWave, PERIODS, Recurrence, SpectrumExpectation, SpectrumRow,
    SpectrumStudy, WaveFigures, run_wave, steps_of_run,
};
pub use stability::is_looked_at;
pub use stability::{
    AmplificationError, Critical, FigureBounds, Prediction, Radius, Scales, Stability,
    StabilityExpectation, StabilityLimit, StabilityRow, StabilityStudy, Trial, amplification,
    spectral_radius, stability_limit, trial,
};
pub use study_results::{ForceRow, InternalForce, StudyResults};
pub use verdict::diagnosis::{Cause, ChangedRun, Diagnosis, Evidence, KnownCause, KnownCauseKind};
pub use verdict::floor::{Floor, FloorCause, Probe};
pub use verdict::judge::{Judgement, judge};
pub use verdict::name::{UnknownVerdict, Verdict};
