//! Stability: whether a run stays bounded, and the limit of a parameter.

mod amplification;
mod expectation;
mod limit;
mod outcome;
mod radius;
mod trial;
mod trial_result;

pub use amplification::{AmplificationError, amplification};
pub use expectation::{FigureBounds, StabilityExpectation};
pub use limit::{StabilityLimit, stability_limit};
pub use outcome::{Critical, Prediction, StabilityRow, StabilityStudy};
pub use radius::{Radius, spectral_radius};
pub use trial::is_looked_at;
pub use trial::trial;
pub use trial_result::{Scales, Stability, Trial};
