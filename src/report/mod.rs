//! Output of a [`SuiteOutcome`](crate::verify::SuiteOutcome) for people and programs.
//!
//! - [`text()`]: the aligned text of snapshots, without time, host, date and path.
//! - [`json()`]: one document, an interface for programs.
//! - [`latex()`]: tables for papers; with the feature `cli` also `csv()`, and `junit()` for CI
//!   services.
//! - [`svg()`]: figures, drawn by [`figure`].
//! - [`mod@page`]: one HTML page with the complete results.
//! - [`drift`]: comparison of two texts, number by number.
//! - [`mod@compare`]: comparison of two JSON documents, the largest changes first.

pub(crate) mod columns;
pub mod compare;
#[cfg(feature = "cli")]
mod csv;
pub mod figure;
#[cfg(test)]
mod fixture;
pub(crate) mod json;
#[cfg(feature = "cli")]
mod junit;
pub(crate) mod latex;
pub(crate) mod matrix;
pub(crate) mod names;
pub mod page;
pub(crate) mod study;
pub(crate) mod suite;
pub(crate) mod text;

#[cfg(test)]
mod tests;

#[cfg(feature = "cli")]
pub use csv::csv;
pub use json::schema::report_schema;

#[cfg(feature = "cli")]
#[doc(hidden)]
pub use junit::RunTimes;
#[cfg(feature = "cli")]
pub use junit::junit;
pub use latex::latex;
pub use suite::json::json;
pub use suite::overview::overview;
pub use suite::svg;
pub use suite::text::{case, summary, text};
pub use text::cost::{cost, timed};
pub use text::diagnosis::diagnosis;
pub use text::drift;
pub use text::profile::{difference, profile};
pub use text::proposal::proposals;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    figure::Figure,
    figure::cost::cost_figures,
    json::{diagnosis_json, timed_json},
    suite::json::profile as profile_json,
    suite::overview::glance,
    suite::plotted,
    suite::verdicts::counts,
    text::plot::convergence_plot,
    text::profile::profiles,
    text::prose::{counted, indented, wrapped_row},
};
