//! From a checked text to a typed value.

use super::translate::SampleOf;
use super::{Diagnostic, Source, shape, translate};
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
    read_with(source, &|_, _| None)
}

/// The same, with a sample value for a missing key where one is known.
pub(crate) fn read_with<T: DeserializeOwned>(
    source: &Source,
    sample: &SampleOf<'_>,
) -> Result<T, Diagnostic> {
    let parser = serde_yaml::Deserializer::from_str(source.text());
    shape::check(source)
        .and_then(|()| serde_yaml::with::singleton_map_recursive::deserialize(parser))
        .map_err(|error| translate::diagnostic(source, &error, sample))
}
