//! The judge: does an error fall with the order that theory gives, and how sure is that?
//!
//! | module | holds |
//! |---|---|
//! | [`quantity`](Quantity), [`norm`](Norms) | the error of one level as a number |
//! | [`keeper`](Keeper) | a run that is interrupted and goes on |
//! | [`conservation`](Drift) | what a free motion keeps, watched over a run |
//! | [`level`](Level), [`claim`](Claim) | what is judged, and against what |
//! | [`axis`](Axis) | which spacing is refined |
//! | [`pairwise`](observed_order) | the order between two levels |
//! | [`fit`](Interval), [`student`](two_sided_95) | the order by regression, with its confidence interval |
//! | `window` | which levels are asymptotic |
//! | `shape` | floor, divergence, oscillation |
//! | [`judge`](judge()) | the questions, and the verdict |
//! | [`floor`](Floor) | whose error a floor is |
//! | [`richardson`](Richardson) | order and limit from three values |
//! | [`cost`](Ranking) | what accuracy costs, in transfers or seconds |
//! | [`stability`](StabilityStudy) | runs watched for growth, the step as a matrix, limits by bisection |
//! | [`expectation`](Expectation), [`limits`](Limits) | what must come out |
//!
//! Two principles hold throughout. Comparisons are written so that NaN fails: what must hold is
//! asked (`error <= tolerance`), never its opposite. And shapes are told by ratios, never by absolute numbers, so that no
//! unit of error or spacing changes a verdict.

mod axis;
mod beta;
mod claim;
mod clock;
mod conservation;
mod cost;
mod expectation;
mod figures;
mod fit;
mod floor;
mod judge;
mod keeper;
mod level;
mod limits;
mod norm;
mod observer;
mod outcome;
mod pairwise;
mod quantity;
mod reason;
mod richardson;
mod run;
mod secular;
mod shape;
mod shown;
mod stability;
mod student;
#[cfg(test)]
mod tests;
mod verdict;
mod window;
mod yardstick;

pub use axis::Axis;
pub use claim::Claim;
pub use clock::{Clock, MOST_STEPS};
pub use conservation::{Conserved, Drift};
pub use cost::{
    Agreement, Bid, Contender, End, Exponent, Load, Machine, Model, Part, Priced, Ranked, Ranking,
    Reach, TARGETS, Timing, Tried, pareto_front, rankings,
};
pub use expectation::{Bounds, Expectation, Seen};
pub use fit::Interval;
pub use floor::{Floor, FloorCause, Probe};
pub use judge::{Judgement, judge};
pub use keeper::{Keeper, Nobody};
pub use level::Level;
pub use limits::{Limits, Measured};
pub use norm::Norms;
pub(crate) use norm::larger;
pub use observer::{History, displacement_at};
pub use outcome::{CaseOutcome, Convergence, ForceRow, LevelOutcome, Study, SuiteOutcome};
pub use pairwise::observed_order;
pub use quantity::{Quantity, errors_of};
pub use richardson::{Richardson, RichardsonClass, SAFETY_FACTOR};
pub use run::{Comparison, errors, resume, run};
pub use shown::Run;
pub use stability::{
    Critical, Prediction, Radius, RunFigure, Scales, Stability, StabilityExpectation,
    StabilityLimit, StabilityRow, StabilityStudy, Trial, Wanted, amplification, resume_trial,
    spectral_radius, stability_limit, trial,
};
pub use student::two_sided_95;
pub use verdict::{UnknownVerdict, Verdict};
pub use yardstick::{Yardstick, largest_exact};
