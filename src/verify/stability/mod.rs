//! Stability: whether a run stays bounded, and the limit of a parameter.
//!
//! | module | contents |
//! |---|---|
//! | [`trial_result`](Trial) | verdict and measured values of one run |
//! | [`trial`](trial()) | one run: energy relative to its initial value, J, largest speed |
//! | [`amplification`](amplification()) | matrix of one step, from runs of perturbed states |
//! | [`radius`](spectral_radius) | the largest eigenvalue of the amplification matrix |
//! | [`limit`](stability_limit()) | smallest unstable value of a parameter |
//! | [`expectation`](StabilityExpectation) | expectations of suites |
//! | [`outcome`](StabilityStudy) | the rows of a report |

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
pub(crate) use trial::is_looked_at;
pub use trial::trial;
pub use trial_result::{Scales, Stability, Trial};
