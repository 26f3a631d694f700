//! From a checked text to a typed value, and back for text that the program writes for itself.

use super::shape::TopValue;
use super::translate::SampleOf;
use super::{Diagnostic, Source, shape, translate};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Reads a file into a type.
///
/// Enums are written as a map of one key (`material: {linear_elastic: {young: E}}`), and as a
/// bare name where the variant has no parameters (`basis: linear`). Types should say
/// `#[serde(deny_unknown_fields)]`, and use neither untagged nor internally tagged enums nor
/// `flatten`: those lose the place of an error.
///
/// # Errors
/// The first mistake in the file, with its place.
pub fn read<T: DeserializeOwned>(source: &Source) -> Result<T, Diagnostic> {
    CheckedShape::new(source, "")?.read(&|_, _| None)
}

/// A file whose shape has been checked, ready to be read into a type.
pub(crate) struct CheckedShape<'s> {
    source: &'s Source,
    top: TopValue,
}

impl<'s> CheckedShape<'s> {
    /// Checks the shape of `source`, and keeps the value of its key `key`, by which the type may be
    /// chosen.
    ///
    /// # Errors
    /// The first mistake of shape, with its place.
    pub(crate) fn new(source: &'s Source, key: &str) -> Result<Self, Diagnostic> {
        let top = shape::check(source, key);
        let top = top.map_err(|error| translate::diagnostic(source, &error, &|_, _| None))?;
        Ok(Self { source, top })
    }

    /// The value of the key that is kept.
    pub(crate) fn top(&self) -> &TopValue {
        &self.top
    }

    /// Reads the file into a type, with a sample value for a missing key where one is known.
    ///
    /// # Errors
    /// The first mistake in the file, with its place.
    pub(crate) fn read<T: DeserializeOwned>(&self, sample: &SampleOf<'_>) -> Result<T, Diagnostic> {
        let parser = serde_yaml::Deserializer::from_str(self.source.text());
        serde_yaml::with::singleton_map_recursive::deserialize(parser)
            .map_err(|error| translate::diagnostic(self.source, &error, sample))
    }
}

/// The text of a value.
///
/// # Errors
/// The message of the library on a value that it cannot write.
pub(crate) fn written<T: Serialize>(value: &T) -> Result<String, String> {
    serde_yaml::to_string(value).map_err(|error| error.to_string())
}

/// The value of a text, if it is one.
pub(crate) fn read_again<T: DeserializeOwned>(text: &str) -> Option<T> {
    serde_yaml::from_str(text).ok()
}
