//! What the program writes for itself to read again: numbers come back bit by bit, NaN and infinities
//! among them, which JSON has no words for. Nobody else's text is read here.

use serde::{Serialize, de::DeserializeOwned};

/// The text of a value.
///
/// # Errors
/// What the library says that it cannot write.
pub(crate) fn written<T: Serialize>(value: &T) -> Result<String, String> {
    serde_yaml::to_string(value).map_err(|error| error.to_string())
}

/// The value of a text, if it is one.
pub(crate) fn read_again<T: DeserializeOwned>(text: &str) -> Option<T> {
    serde_yaml::from_str(text).ok()
}
