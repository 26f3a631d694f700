//! Safe reading of handwritten YAML, with the place of every error.
//!
//! ```text
//! path -> Source          size, encoding, characters, nesting: refused before the parser runs
//!      -> read::<Suite>   typed; every error becomes a Complaint with file:line:column
//!      -> Source::value_at, within   the place of a value that proves wrong later on
//! ```
//!
//! This is the only module that names the YAML library. What a suite does not need is refused:
//! anchors, aliases, tags, merge keys and a second document. A suite names a value once under
//! `parameters`, and without aliases no file can unfold into more than it holds.
//!
//! ```
//! use mpm_verify::suite::yaml::{Source, read};
//!
//! #[derive(serde::Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Refine {
//!     cells: Vec<usize>,
//! }
//!
//! let source = Source::from_text("bar.yaml", "cels: [5, 10]\n").unwrap();
//! let complaint = read::<Refine>(&source).err().unwrap();
//! assert_eq!(complaint.one_line(), "bar.yaml:1:1: unknown key `cels`");
//! assert_eq!(complaint.help(), Some("did you mean `cells`?"));
//! ```

pub(crate) mod diagnostic;
pub(crate) mod locate;
pub(crate) mod number;
pub(crate) mod one_or_many;
pub(crate) mod ordered;
pub(crate) mod phrase;
pub(crate) mod place;
pub(crate) mod read;
pub(crate) mod scalars;
pub(crate) mod scan;
pub(crate) mod shape;
pub(crate) mod source;

#[cfg(test)]
mod tests;

pub use diagnostic::{Diagnostic, Severity};
pub(crate) use locate::Path;
pub use locate::Step;
pub use number::NumberText;
pub(crate) use number::{InPlaceOfNumber, NumberOr};
pub use one_or_many::OneOrMany;
pub use ordered::Ordered;
pub use place::Place;
pub use read::read;
pub(crate) use read::{CheckedShape, read_again, written};
pub(crate) use shape::TopValue;
pub use shape::refuse;
pub use source::{MAX_BYTES, Source};

/// The most entries that one list or one map may have.
pub const MAX_ENTRIES: usize = 1000;

/// The deepest nesting of lists and maps; the YAML parser's cost is quadratic in it.
pub const MAX_NESTING: usize = 64;
