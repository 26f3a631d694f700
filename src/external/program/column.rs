//! Columns of numbers in messages.

use schemars::JsonSchema;
use serde::Deserialize;

/// A column, as numbers or as a part of the bytes that follow: its offset, and how many doubles.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
pub(super) enum ColumnText {
    Numbers(Vec<f64>),
    Bytes { f64: (usize, usize) },
}

impl ColumnText {
    /// How many numbers the column says that it has.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Bytes { f64: (_, length) } => *length,
        }
    }

    /// The numbers of the column `name`, of which there must be `count`, all finite.
    pub(super) fn numbers(
        self,
        name: &str,
        count: usize,
        bytes: &[u8],
    ) -> Result<Vec<f64>, String> {
        let numbers = match self {
            Self::Numbers(numbers) => numbers,
            Self::Bytes { f64: (offset, length) } => {
                let end = length.checked_mul(8).and_then(|length| offset.checked_add(length));
                let part = end.and_then(|end| bytes.get(offset..end)).ok_or_else(|| {
                    format!(
                        "gave the column `{name}` as {length} doubles from byte {offset} on, of \
                         {} bytes",
                        bytes.len()
                    )
                })?;
                let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
                part.chunks_exact(8).map(number).collect()
            }
        };
        if numbers.len() != count {
            let found = numbers.len();
            return Err(format!("gave the column `{name}` {found} numbers, expected {count}"));
        }
        match numbers.iter().position(|number| !number.is_finite()) {
            Some(at) => Err(format!("gave the column `{name}` {} as number {at}", numbers[at])),
            None => Ok(numbers),
        }
    }
}
