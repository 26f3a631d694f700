//! Safe parsing of handwritten YAML, with a position for every error.
//!
//! ```text
//! path -> Source          checks size, encoding, syntax and rules for all keys; has all positions
//!      -> read::<Suite>   typed; every error becomes a Diagnostic with file:line:column
//!      -> Source::value_at, within   the position of a value that is rejected later
//! ```
//!
//! Only this module uses the YAML libraries. Features that suites do not need are refused: anchors,
//! aliases, tags, merge keys and a second document. A suite defines a repeated value once under
//! `parameters`. Because aliases are refused, a small file cannot expand into a large value.
//!
//! ```
//! use mpm_suites::suite::yaml::{Source, read};
//!
//! #[derive(serde::Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct Refine {
//!     cells: Vec<usize>,
//! }
//!
//! let source = Source::from_text("bar.yaml", "cels: [5, 10]\n").unwrap();
//! let diagnostic = read::<Refine>(&source).err().unwrap();
//! assert_eq!(diagnostic.one_line(), "bar.yaml:1:1: unknown key `cels`");
//! assert_eq!(diagnostic.help(), Some("did you mean `cells`?"));
//! ```

pub(crate) mod diagnostic;
pub(crate) mod locate;
pub(crate) mod number;
pub(crate) mod one_or_many;
pub(crate) mod ordered;
pub(crate) mod phrase;
pub(crate) mod place;
pub(crate) mod read;
pub(crate) mod source;
pub(crate) mod syntax;
pub(crate) mod tree;

#[cfg(test)]
mod tests;

pub use diagnostic::{Diagnostic, Severity};
pub(crate) use locate::Path;

pub(crate) use number::{InPlaceOfNumber, NumberOr};
pub use one_or_many::OneOrMany;
pub use place::Place;
pub use read::read;
pub(crate) use read::{parse, read_again, written};
pub use source::Source;
#[cfg(feature = "external-programs")]
pub(crate) use source::read_text;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    locate::Step, number::NumberText, ordered::Ordered, read::refuse, source::MAX_BYTES,
};

/// Maximum number of entries in a list or a map.
pub const MAX_ENTRIES: usize = 1000;

/// Maximum nesting depth of lists and maps, because the cost of the YAML parser is quadratic in the
/// depth.
pub const MAX_NESTING: usize = 64;
