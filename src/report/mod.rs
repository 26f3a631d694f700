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
pub(crate) mod json;
#[cfg(feature = "cli")]
mod junit;
pub(crate) mod latex;
pub(crate) mod matrix;
pub mod page;
pub(crate) mod study;
pub(crate) mod suite;
pub(crate) mod text;

#[cfg(feature = "cli")]
pub use csv::csv;
pub use figure::Figure;
pub use figure::cost::cost_figures;
pub use json::diagnosis_json;
pub use json::schema::report_schema;
pub use json::timed_json;
#[cfg(feature = "cli")]
pub use junit::{RunTimes, junit};
pub use latex::latex;
pub use suite::json::{json, profile as profile_json};
pub use suite::overview::{glance, overview};
pub use suite::svg;
pub use suite::text::{case, summary, text};
pub use text::cost::{cost, timed};
pub use text::diagnosis::diagnosis;
pub use text::drift;
pub use text::profile::{difference, profile, profiles};
pub use text::proposal::proposals;
pub use text::prose::indented;
