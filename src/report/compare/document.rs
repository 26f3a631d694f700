//! Parsed form of a document written by [`json()`](crate::report::json()).
//!
//! Unknown keys are ignored, because later versions have more keys. Keys that were added after the
//! first version may be missing.

use serde::{Deserialize, Deserializer, de};
use std::collections::BTreeSet;
use std::fmt;

/// The part of a run's results that is compared.
#[derive(Debug, Clone, Deserialize)]
pub struct ReportDocument {
    pub(super) suites: Vec<SuiteDocument>,
}

/// Reason why a text is not a valid report document, with the position in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unreadable {
    /// Description of the error.
    pub message: String,
    /// Line and column, counted from one; `None` if the position is unknown.
    pub place: Option<(usize, usize)>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct SuiteDocument {
    #[serde(rename = "suite")]
    pub(super) name: String,
    /// Description of the problem as rows of name and value.
    #[serde(default)]
    pub(super) statement: Vec<(String, String)>,
    pub(super) cases: Vec<CaseDocument>,
    #[serde(default)]
    pub(super) cost: Vec<RankingDocument>,
}

/// Work that the methods need to reach target errors.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct RankingDocument {
    pub(super) problem: String,
    pub(super) work: String,
    pub(super) targets: Vec<JsonNumber>,
    pub(super) methods: Vec<MethodDocument>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct MethodDocument {
    #[serde(rename = "case")]
    pub(super) name: String,
    /// One entry for each target; `None` if the method does not reach it.
    pub(super) reached: Vec<Option<ReachedDocument>>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct ReachedDocument {
    pub(super) work: JsonNumber,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct CaseDocument {
    #[serde(rename = "case")]
    pub(super) name: String,
    pub(super) verdict: String,
    pub(super) passed: bool,
    #[serde(default)]
    pub(super) unmet: Vec<String>,
    pub(super) judge: Option<JudgeDocument>,
    pub(super) axis: Option<String>,
    pub(super) observed_order: Option<OrderDocument>,
    pub(super) levels: Vec<LevelDocument>,
    pub(super) stability: Option<StabilityDocument>,
}

/// Judged quantity, norm and box. Errors are compared only if these are equal in both runs.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct JudgeDocument {
    pub(super) of: String,
    pub(super) norm: String,
    pub(super) scale: Option<JsonNumber>,
    pub(super) within: Option<WithinDocument>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct WithinDocument {
    pub(super) from: Vec<JsonNumber>,
    pub(super) to: Vec<JsonNumber>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct OrderDocument {
    pub(super) value: JsonNumber,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct LevelDocument {
    pub(super) cells: u64,
    pub(super) h: JsonNumber,
    pub(super) spacing: JsonNumber,
    pub(super) ppc: Option<u64>,
    pub(super) transfers: u64,
    pub(super) judged: Option<JsonNumber>,
    /// Whether the level counts for the verdict.
    pub(super) counts: Option<bool>,
    pub(super) failure: Option<String>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct StabilityDocument {
    pub(super) swept: String,
    pub(super) sought: Option<String>,
    pub(super) rows: Vec<StabilityRowDocument>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct StabilityRowDocument {
    pub(super) value: JsonNumber,
    pub(super) run: Option<TrialDocument>,
    pub(super) predicted: Option<LimitDocument>,
    pub(super) observed: Option<LimitDocument>,
}

#[derive(Debug, Clone, Deserialize)]
pub(super) struct TrialDocument {
    pub(super) verdict: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum LimitDocument {
    At(JsonNumber),
    Above(JsonNumber),
    Below(JsonNumber),
}

impl ReportDocument {
    /// Parses a document.
    ///
    /// # Errors
    /// If the text is not JSON, if a key is missing or has the wrong type, or if a case occurs
    /// twice, because the comparison would be ambiguous.
    pub fn read(text: &str) -> Result<Self, Unreadable> {
        let document: Self = serde_json::from_str(text).map_err(|error| {
            let (line, column) = (error.line(), error.column());
            let whole = error.to_string();
            let place = format!(" at line {line} column {column}");
            let message = whole.strip_suffix(&place).unwrap_or(&whole).to_owned();
            Unreadable { message, place: (line > 0).then_some((line, column.max(1))) }
        })?;
        let mut seen = BTreeSet::new();
        let twice = document
            .cases()
            .map(|(suite, case)| name(suite, case))
            .find(|name| !seen.insert(name.clone()));
        match twice {
            None => Ok(document),
            Some(twice) => {
                let message = format!("the case `{twice}` is there twice");
                Err(Unreadable { message, place: None })
            }
        }
    }

    pub(super) fn cases(&self) -> impl Iterator<Item = (&SuiteDocument, &CaseDocument)> {
        self.suites.iter().flat_map(|suite| suite.cases.iter().map(move |case| (suite, case)))
    }
}

pub(super) fn name(suite: &SuiteDocument, case: &CaseDocument) -> String {
    format!("{}::{}", suite.name, case.name)
}

impl LevelDocument {
    /// Returns the judged error; `None` if the level failed or the error is not finite.
    pub(super) fn error(&self) -> Option<f64> {
        let JsonNumber(error) = self.judged?;
        (self.failure.is_none() && error.is_finite()).then_some(error)
    }

    pub(super) fn is_broken(&self) -> bool {
        self.failure.is_some() || self.judged.is_some_and(|JsonNumber(error)| !error.is_finite())
    }
}

/// A number, or one of `"nan"`, `"inf"`, `"-inf"`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JsonNumber(pub(super) f64);

impl<'de> Deserialize<'de> for JsonNumber {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(NumberVisitor).map(Self)
    }
}

struct NumberVisitor;

impl de::Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"nan\", \"inf\" or \"-inf\"")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<f64, E> {
        match word {
            "nan" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            other => Err(E::invalid_value(de::Unexpected::Str(other), &self)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        let texts = ["0.1", "3", "-3", "\"inf\"", "\"-inf\"", "\"0.1\"", "true", "null"];
        let read = texts.map(|text| serde_json::from_str(text).ok().map(|JsonNumber(value)| value));
        let (large, none) = (f64::INFINITY, None);
        let expected =
            [Some(0.1), Some(3.0), Some(-3.0), Some(large), Some(-large), none, none, none];
        assert_eq!(read, expected);
    }

    #[test]
    fn numbers_survive_writing_and_reading() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.1, 1e-300, -0.0] {
            let text = crate::report::columns::number(value).to_string();
            let JsonNumber(read) = serde_json::from_str(&text).expect("a number");
            assert_eq!(read.to_bits(), value.to_bits(), "{text}");
        }
    }
}
