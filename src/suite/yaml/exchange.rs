//! Text that the program writes for itself to read again: numbers come back bit by bit, NaN and
//! infinities among them, which JSON cannot express.

use serde::Serialize;
use serde::de::DeserializeOwned;

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
