//! Converts a text to a typed value, and rewrites errors of the YAML library for authors of
//! suites. Also reads and writes YAML that only this program uses.

use super::phrase::{expected, found, listed};
use super::syntax::tab;
use super::{Diagnostic, Source};
use mpm_subject::nearest;
use serde::Serialize;
use serde::de::{DeserializeOwned, Error};

/// Parses a file into a type.
///
/// Enums are written as a map with one key (`material: {linear_elastic: {young: E}}`), or as a
/// plain name if the variant has no parameters (`basis: linear`). Types should have
/// `#[serde(deny_unknown_fields)]`. They should not use untagged enums, internally tagged enums or
/// `flatten`, which lose the position of an error.
///
/// # Errors
/// The first error in the file, with its position.
pub fn read<T: DeserializeOwned>(source: &Source) -> Result<T, Diagnostic> {
    parse(source, &|_, _| None)
}

/// Parses a file into a type. The error for a missing key shows a value from `sample`.
pub(crate) fn parse<T: DeserializeOwned>(
    source: &Source,
    sample: &SampleOf<'_>,
) -> Result<T, Diagnostic> {
    if source.is_empty() {
        let message = "the file is empty; a suite starts with `suite: NAME`";
        return Err(Fault { source, offset: 0 }.at_token(message));
    }
    let parser = serde_yaml::Deserializer::from_str(source.text());
    serde_yaml::with::singleton_map_recursive::deserialize(parser)
        .map_err(|error| diagnostic(source, &error, sample))
}

/// Error of the YAML library for a value that it cannot write.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub(crate) struct WriteError(#[from] serde_yaml::Error);

impl From<WriteError> for String {
    fn from(error: WriteError) -> Self {
        error.to_string()
    }
}

pub(crate) fn written<T: Serialize>(value: &T) -> Result<String, WriteError> {
    Ok(serde_yaml::to_string(value)?)
}

pub(crate) fn read_again<T: DeserializeOwned>(text: &str) -> Option<T> {
    serde_yaml::from_str(text).ok()
}

/// Returns a sample value for the owner of a key (empty for the whole file) and the key.
pub(crate) type SampleOf<'a> = dyn Fn(&str, &str) -> Option<&'static str> + 'a;

fn diagnostic(source: &Source, error: &serde_yaml::Error, sample: &SampleOf<'_>) -> Diagnostic {
    let text = error.to_string();
    let offset = error.location().map_or(source.text().len(), |location| location.index());
    let fault = Fault { source, offset };
    if let Some([message, label, help]) = refused(&text) {
        return fault.at_token(message).with_label(label).with_help(help);
    }
    // The parser of the tree accepts some tabs and indicators that this library refuses.
    let is_at_tab = source.text().as_bytes().get(offset) == Some(&b'\t');
    let is_no_value = text.starts_with("found character that cannot start any token");
    if text.starts_with("found a tab character") || (is_no_value && is_at_tab) {
        return tab(source.name(), source.text(), offset);
    }
    if is_no_value {
        let message = "a value cannot start with this character";
        return fault.at_token(message).with_help("put the value in quotes");
    }
    let position = error
        .location()
        .map(|location| format!(" at line {} column {}", location.line(), location.column()));
    let text = position.and_then(|position| text.strip_suffix(&position)).unwrap_or(&text);
    let (path, problem) = split_path(text);
    fault
        .unknown(problem)
        .or_else(|| fault.missing(path, problem, sample))
        .or_else(|| fault.wrong_type(problem))
        .or_else(|| fault.wrong_length(problem))
        .unwrap_or_else(|| fault.at_token(problem))
}

/// Splits an error of the library into a path, such as `scene.material`, and the problem.
fn split_path(text: &str) -> (&str, &str) {
    const OPENINGS: [&str; 7] = [
        "unknown field `",
        "unknown variant `",
        "missing field `",
        "duplicate field `",
        "invalid type: ",
        "invalid value: ",
        "invalid length ",
    ];
    let start = OPENINGS.iter().filter_map(|opening| text.find(opening)).min().unwrap_or(0);
    (text[..start].trim_end_matches(": "), &text[start..])
}

#[derive(Clone, Copy)]
struct Fault<'a> {
    source: &'a Source,
    offset: usize,
}

impl<'a> Fault<'a> {
    fn at_token(self, message: &str) -> Diagnostic {
        let range = self.source.token_at(self.offset);
        Diagnostic::at(self.source.name(), self.source.text(), range, message)
    }

    /// Moves this fault to the next scalar, and also returns the text of the scalar.
    fn at_first_name(self) -> (Self, &'a str) {
        let scalar = self.source.scalar_from(self.offset);
        let offset = scalar.map_or(self.offset, |scalar| scalar.range.start);
        let name = scalar.map_or("this", |scalar| &scalar.value);
        (Self { offset, ..self }, name)
    }

    fn unknown(self, problem: &str) -> Option<Diagnostic> {
        let (kind, rest) = match problem.strip_prefix("unknown field `") {
            Some(rest) => ("key", rest),
            None => ("name", problem.strip_prefix("unknown variant `")?),
        };
        // The name is text from the file and may contain any character. The expected text is from
        // this crate.
        let (name, valid) =
            rest.rsplit_once("`, expected ").or_else(|| rest.rsplit_once("`, there are no "))?;
        let valid: Vec<&str> = valid.split('`').skip(1).step_by(2).collect();
        let help = match nearest(name, valid.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            _ if name.bytes().all(|c| c.is_ascii_digit()) => {
                "a comma separates entries; write numbers with a decimal point: `0.5`".to_owned()
            }
            None if valid.is_empty() => format!("no {kind} is possible here"),
            None => format!("possible {kind}s: {}", listed(&valid)),
        };
        Some(
            self.at_token(&format!("unknown {kind} `{name}`"))
                .with_label(&format!("not a known {kind}"))
                .with_help(&help),
        )
    }

    fn missing(self, path: &str, problem: &str, sample: &SampleOf<'_>) -> Option<Diagnostic> {
        let key = problem.strip_prefix("missing field `")?.strip_suffix('`')?;
        let owner = path.rsplit('.').next().unwrap_or_default();
        let inside = if owner.is_empty() { String::new() } else { format!(" in `{owner}`") };
        let owner = owner.split('[').next().unwrap_or_default();
        let value = sample(owner, key).unwrap_or("VALUE");
        Some(
            self.at_token(&format!("missing key `{key}`{inside}"))
                .with_label(&format!("these keys lack `{key}`"))
                .with_help(&format!("add `{key}: {value}`{inside}")),
        )
    }

    fn wrong_type(self, problem: &str) -> Option<Diagnostic> {
        let what = problem
            .strip_prefix("invalid type: ")
            .or_else(|| problem.strip_prefix("invalid value: "))?;
        let (unexpected, wanted) = what.rsplit_once(", expected ")?;
        if let Some(diagnostic) = self.wrong_settings(unexpected, wanted) {
            return Some(diagnostic);
        }
        let wanted = expected(wanted);
        let diagnostic = self
            .at_token(&format!("expected {wanted}, found {}", found(unexpected)))
            .with_label(&format!("{wanted} is expected here"));
        Some(if self.is_quoted_number() {
            diagnostic.with_help("remove the quotes")
        } else {
            diagnostic
        })
    }

    /// Returns the error for a choice with missing or unexpected settings, or for several choices.
    fn wrong_settings(self, unexpected: &str, wanted: &str) -> Option<Diagnostic> {
        let (fault, name) = self.at_first_name();
        match (unexpected, wanted) {
            (_, "unit variant") => Some(
                fault
                    .at_token(&format!("`{name}` takes no settings"))
                    .with_help(&format!("write the bare name `{name}`")),
            ),
            ("unit variant", _) => Some(
                fault
                    .at_token(&format!("`{name}` needs settings"))
                    .with_help(&format!("write `{name}: ...` with its settings")),
            ),
            (_, "map with a single key") => Some(self.not_one_name()),
            _ => None,
        }
    }

    fn not_one_name(self) -> Diagnostic {
        self.at_token("one name with its settings is expected here, found none or several")
            .with_help("write `{NAME: {...}}`; a list holds several")
    }

    fn wrong_length(self, problem: &str) -> Option<Diagnostic> {
        let (length, wanted) =
            problem.strip_prefix("invalid length ")?.split_once(", expected ")?;
        if wanted == "map containing 1 entry" {
            return Some(self.not_one_name());
        }
        let wanted = expected(wanted);
        Some(
            self.at_token(&format!("expected {wanted}, found {length}"))
                .with_label(&format!("{wanted} is expected here")),
        )
    }

    fn is_quoted_number(self) -> bool {
        let scalar = self.source.scalar_at(self.offset).filter(|scalar| scalar.is_quoted());
        scalar.is_some_and(|scalar| scalar.value.parse::<f64>().is_ok())
    }
}

/// Separates the three texts of a refusal, because the error of a deserializer is one string.
/// Sources with control characters are refused, so no file can forge the separator.
const FENCE: char = '\u{1f}';

/// Creates the error for a value that is refused during deserialization.
///
/// `label` and `help` may be empty. [`read`] shows the three texts unchanged, at the
/// position of the innermost value being parsed.
pub fn refuse<E: Error>(message: &str, label: &str, help: &str) -> E {
    let [message, label, help] = [message, label, help].map(|part| part.replace(FENCE, " "));
    E::custom(format!("{FENCE}{message}{FENCE}{label}{FENCE}{help}{FENCE}"))
}

fn refused(error: &str) -> Option<[&str; 3]> {
    let mut parts = error.split(FENCE).skip(1);
    Some([parts.next()?, parts.next()?, parts.next()?])
}
