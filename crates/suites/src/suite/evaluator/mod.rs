//! Evaluates the texts of a suite file to numbers and formulas. Errors have positions.

mod names;

use crate::exact::formula::{Expr, Formula, FormulaError, Scope};
use crate::suite::yaml::{
    Diagnostic, InPlaceOfNumber, NumberOr, NumberText, OneOrMany, Ordered, Path, Place, Source,
    Step,
};
use mpm_subject::nearest;
use serde::Deserialize;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Maximum count in a suite (cells, particles per cell, instants).
const MOST: f64 = 1e7;

pub(crate) const COORDINATES: [&str; 3] = ["X", "Y", "Z"];

pub(crate) const DISPLACEMENTS: [&str; 3] = ["ux", "uy", "uz"];

pub(crate) fn coordinates_and_time(dimension: usize) -> Vec<&'static str> {
    COORDINATES[..dimension].iter().copied().chain(["t"]).collect()
}

/// A number, a formula of the preceding parameters, or a table.
pub(crate) type ParameterSpec = NumberOr<TableSpec>;

/// Table of values that depend on another parameter or on a variable of formulas, such as
/// `{by: t, table: [[0, 0], [0.1, 1]]}`.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TableSpec {
    /// Argument of the table: a parameter, or a variable of formulas.
    pub(crate) by: String,
    /// Rows, each with a value of `by` and the corresponding value of the table.
    pub(crate) table: Vec<Vec<NumberText>>,
}

impl InPlaceOfNumber for TableSpec {
    const EXPECTED: &'static str = "a number, a formula, or `{by: t, table: [[0, 0], [0.1, 1]]}`";
}

/// A parameter: its name and text, and its value unless it is a table.
pub(crate) type DeclaredParameter = (String, String, Option<f64>);

/// Evaluates formulas with the names that a suite declares, and records which names are used.
pub(crate) struct Evaluator<'a> {
    source: &'a Source,
    scope: Scope,
    used: RefCell<BTreeSet<String>>,
    heads: Vec<String>,
    /// Names of all parameters of the suite, including those not yet declared.
    parameters: Vec<String>,
}

impl<'a> Evaluator<'a> {
    pub(crate) fn source(&self) -> &'a Source {
        self.source
    }

    /// Declares functions, then parameters. Also returns name, text and value of each parameter.
    pub(crate) fn new(
        source: &'a Source,
        parameters: &Ordered<ParameterSpec>,
        functions: &Ordered<String>,
    ) -> Result<(Self, Vec<DeclaredParameter>), Diagnostic> {
        let scope = Scope::new();
        let heads = functions.as_slice().iter().map(|(head, _)| head.clone()).collect();
        let names = parameters.as_slice().iter().map(|(name, _)| name.clone()).collect();
        let used = RefCell::default();
        let mut evaluator = Self { source, scope, used, heads, parameters: names };
        for (head, body) in functions.as_slice() {
            evaluator.declare_function(head, body)?;
        }
        let mut values = Vec::new();
        for (name, spec) in parameters.as_slice() {
            let (text, value) = match spec {
                ParameterSpec::Number(text) => {
                    let value = evaluator.parameter(name).number(text)?;
                    let declared = evaluator.scope.constant(name, value);
                    declared.map_err(|error| evaluator.parameter(name).at_key(&error))?;
                    (text.to_string(), Some(value))
                }
                ParameterSpec::Map(spec) => evaluator.declare_table(name, spec)?,
            };
            values.push((name.clone(), text, value));
        }
        Ok((evaluator, values))
    }

    /// Returns the place of a value, given by its keys from the top of the file, such as `run.dt`.
    pub(crate) fn top(&self, keys: &str) -> SuitePath<'_> {
        SuitePath { evaluator: self, path: Path::top(keys) }
    }

    fn function(&self, head: &str) -> SuitePath<'_> {
        self.top("functions").then(head)
    }

    pub(super) fn parameter(&self, name: &str) -> SuitePath<'_> {
        self.top("parameters").then(name)
    }

    fn declare_function(&mut self, head: &str, body: &str) -> Result<(), Diagnostic> {
        let help = "write the name and its arguments: `s(tau)`";
        let (name, arguments) = head
            .split_once('(')
            .and_then(|(name, rest)| Some((name.trim(), rest.trim_end().strip_suffix(')')?)))
            .ok_or_else(|| {
                let message = format!("`{head}` is not a function declaration");
                self.function(head).diagnostic_at_key(&message).with_help(help)
            })?;
        let arguments: Vec<String> = arguments.split(',').map(|a| a.trim().to_owned()).collect();
        if name.is_empty() || arguments.iter().any(String::is_empty) {
            let message = format!("`{head}` lacks a name or an argument");
            return self.function(head).refuse_key(&message, help);
        }
        let body = Expr::parse(body).map_err(|error| self.function(head).in_text(&error))?;
        let declared = self.scope.function(name, &arguments, body);
        declared.map_err(|error| match error.within {
            Some(_) => self.function(head).in_text(&error),
            None => self.function(head).at_key(&error),
        })
    }

    /// Whether `text` cannot be a number because it depends on a coordinate.
    pub(crate) fn depends_on_coordinate(&self, text: &NumberText) -> bool {
        let unknown = bind(text, &self.scope, &[]).err().and_then(|error| error.unknown);
        unknown.is_some_and(|name| COORDINATES.contains(&name.as_str()))
    }
}

/// Place of a value in a suite file, which evaluates the value and creates diagnostics.
#[derive(Clone)]
pub(crate) struct SuitePath<'a> {
    pub(crate) evaluator: &'a Evaluator<'a>,
    path: Path,
}

impl SuitePath<'_> {
    pub(crate) fn then(&self, step: impl Into<Step>) -> Self {
        Self { path: self.path.then(step), ..*self }
    }

    /// Returns the place of value number `i` of a list of `alternatives`; otherwise this place.
    pub(crate) fn alternative<T>(&self, alternatives: &OneOrMany<T>, i: usize) -> Self {
        if alternatives.is_listed() { self.then(i) } else { self.clone() }
    }

    /// Parses a formula of the given `variables` and of declared names.
    pub(crate) fn formula(
        &self,
        text: &NumberText,
        variables: &[&str],
    ) -> Result<Formula, Diagnostic> {
        self.evaluator.refuse_taken(variables)?;
        let bound = bind(text, &self.evaluator.scope, variables);
        let formula = bound.map_err(|error| self.in_text(&error))?;
        self.evaluator.used.borrow_mut().extend(formula.uses().iter().cloned());
        Ok(formula)
    }

    pub(crate) fn vector(
        &self,
        texts: &[NumberText],
        dimension: usize,
        variables: &[&str],
    ) -> Result<Vec<Formula>, Diagnostic> {
        if texts.len() != dimension {
            let (got, d) = (texts.len(), dimension);
            let message = format!("{got} components in a scene of dimension {d}");
            return self.expected(&format!("{d}"), &message);
        }
        let bind = |(i, text): (usize, &NumberText)| {
            let path = self.then(i);
            let formula = path.formula(text, variables)?;
            match formula.constant() {
                Some(value) if !value.is_finite() => Err(path.not_finite(text, value)),
                _ => Ok(formula),
            }
        };
        texts.iter().enumerate().map(bind).collect()
    }

    pub(crate) fn field(&self, text: &NumberText, dimension: usize) -> Result<Formula, Diagnostic> {
        self.formula(text, &coordinates_and_time(dimension))
    }

    pub(crate) fn fields(
        &self,
        texts: &[NumberText],
        d: usize,
    ) -> Result<Vec<Formula>, Diagnostic> {
        self.vector(texts, d, &coordinates_and_time(d))
    }

    pub(crate) fn number(&self, text: &NumberText) -> Result<f64, Diagnostic> {
        let value = self.formula(text, &[])?.constant().unwrap_or(f64::NAN);
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.not_finite(text, value))
    }

    pub(crate) fn positive(&self, text: &NumberText, what: &str) -> Result<f64, Diagnostic> {
        let value = self.number(text)?;
        if value > 0.0 {
            return Ok(value);
        }
        let message = format!("{what} is {}, but must be above zero", shown(value));
        Err(self.unusable(text, &message, "expected a positive number"))
    }

    pub(crate) fn zero_or_positive(
        &self,
        text: &NumberText,
        what: &str,
    ) -> Result<f64, Diagnostic> {
        let value = self.number(text)?;
        if value >= 0.0 {
            return Ok(value);
        }
        let message = format!("{what} is {}", shown(value));
        self.expected("zero or a positive number", &message)
    }

    pub(crate) fn count(&self, text: &NumberText, what: &str) -> Result<u64, Diagnostic> {
        self.count_up_to(MOST, text, what)
    }

    pub(crate) fn count_up_to(
        &self,
        most: f64,
        text: &NumberText,
        what: &str,
    ) -> Result<u64, Diagnostic> {
        let value = self.number(text)?;
        if (1.0..=most).contains(&value) && value.fract() == 0.0 {
            return Ok(value as u64);
        }
        let message = format!("{what} is {}", shown(value));
        let label = format!("expected a whole number from 1 to {most:e}");
        Err(self.unusable(text, &message, &label))
    }

    pub(crate) fn point(
        &self,
        texts: &[NumberText],
        dimension: usize,
    ) -> Result<Vec<f64>, Diagnostic> {
        self.vector(texts, dimension, &[])?;
        texts.iter().enumerate().map(|(i, text)| self.then(i).number(text)).collect()
    }

    pub(crate) fn interval(&self, pair: &[NumberText]) -> Result<(f64, f64), Diagnostic> {
        let label = "expected [low, high]";
        let [low, high] = pair else {
            return Err(self.diagnostic("an interval has two ends").with_label(label));
        };
        let (low, high) = (self.then(0).number(low)?, self.then(1).number(high)?);
        if low <= high {
            return Ok((low, high));
        }
        let message = format!("the interval ends at {high} and starts at {low}");
        Err(self.diagnostic(&message).with_label(label))
    }

    /// Returns the text of the key `because`, which must give a reason for the `stated` value.
    pub(crate) fn because(&self, stated: &str, text: &str) -> Result<String, Diagnostic> {
        let text = text.trim();
        if !text.is_empty() {
            return Ok(text.to_owned());
        }
        let message = format!("`because` is empty: state the reason for {stated}");
        self.then("because").expected("a text", &message)
    }

    pub(crate) fn diagnostic(&self, message: &str) -> Diagnostic {
        self.evaluator.source.diagnostic_at(self.path.steps(), message)
    }

    pub(crate) fn diagnostic_at_key(&self, message: &str) -> Diagnostic {
        let source = self.evaluator.source;
        match source.key_at(self.path.steps()) {
            Some(place) => source.diagnostic(place, message),
            None => self.diagnostic(message),
        }
    }

    pub(crate) fn refuse<T>(&self, message: &str, help: &str) -> Result<T, Diagnostic> {
        Err(self.diagnostic(message).with_help(help))
    }

    pub(crate) fn refuse_key<T>(&self, message: &str, help: &str) -> Result<T, Diagnostic> {
        Err(self.diagnostic_at_key(message).with_help(help))
    }

    /// Refuses the value at this place. The label is `expected` followed by `wanted`.
    pub(crate) fn expected<T>(&self, wanted: &str, message: &str) -> Result<T, Diagnostic> {
        Err(self.diagnostic(message).with_label(&format!("expected {wanted}")))
    }

    /// Returns a diagnostic about a part of this formula, or of a function that it calls.
    fn in_text(&self, error: &FormulaError) -> Diagnostic {
        let Self { evaluator, path } = self;
        let function = error.within.as_ref().and_then(|name| evaluator.head_of(name));
        let path = function
            .map_or_else(|| path.clone(), |head| Path::top("functions").then(head.as_str()));
        let diagnostic = match evaluator.source.within(path.steps(), error.span.clone()) {
            Some(place) => evaluator.source.diagnostic(place, &error.message),
            None => evaluator.source.diagnostic_at(path.steps(), &error.message),
        };
        match error.unknown.as_deref().filter(|name| evaluator.comes_later(name)) {
            Some(name) => {
                let line = evaluator.line_of(name);
                let line = line.map_or_else(String::new, |n| format!(" (line {n})"));
                let help = format!("`{name}` is declared further down{line}: move it up");
                diagnostic.with_help(&help)
            }
            None => with_help(diagnostic, error),
        }
    }

    fn at_key(&self, error: &FormulaError) -> Diagnostic {
        with_help(self.diagnostic_at_key(&error.message), error)
    }

    /// Returns a diagnostic about an invalid number, with the parameters of its formula.
    pub(crate) fn unusable(&self, text: &NumberText, message: &str, label: &str) -> Diagnostic {
        let read = self.evaluator.read_by(text);
        let read: Vec<String> =
            read.iter().map(|(name, value)| self.evaluator.found(name, *value)).collect();
        self.diagnostic(message).with_label(label).with_help(&read.join(", "))
    }

    fn not_finite(&self, text: &NumberText, value: f64) -> Diagnostic {
        let (label, value) = ("expected a finite number", shown(value));
        let what = match self.path.steps() {
            [Step::Key(top), Step::Key(name)] if top == "parameters" => name.clone(),
            _ => text.to_string(),
        };
        let read = self.evaluator.read_by(text);
        let suspected = |(name, value): &&(String, f64)| {
            let mut instead = HARMLESS.into_iter().chain([value.abs()]);
            instead.any(|instead| self.evaluator.is_finite_with(text, name, instead))
        };
        let suspects: Vec<_> = read.iter().filter(suspected).collect();
        if suspects.is_empty() {
            let message = format!("`{text}` is {value}, which is not finite");
            return self.unusable(text, &message, label);
        }
        let causes: Vec<String> =
            suspects.iter().map(|(name, value)| format!("`{name}` is {}", shown(*value))).collect();
        let message = format!("`{what}` is {value} because {}", causes.join(" and "));
        let places: Vec<String> =
            suspects.iter().map(|(name, value)| self.evaluator.found(name, *value)).collect();
        self.diagnostic(&message).with_label(label).with_help(&places.join(", "))
    }
}

fn bind(text: &NumberText, scope: &Scope, variables: &[&str]) -> Result<Formula, FormulaError> {
    Formula::bind(&Expr::parse(&text.to_string())?, scope, variables)
}

fn with_help(diagnostic: Diagnostic, error: &FormulaError) -> Diagnostic {
    match &error.help {
        Some(help) => diagnostic.with_help(help),
        None => diagnostic,
    }
}

/// Formats a number as an author would write it: 1e300 instead of 1 followed by 300 zeros.
pub(crate) fn shown(value: f64) -> String {
    NumberText::Number(value).to_string()
}

/// Suggests the known name that is most similar to `name`, or lists all `known` names.
pub(crate) fn suggestion(kind: &str, name: &str, known: &[&str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known {kind}: {}", known.join(", ")),
    }
}

/// Values for which most formulas are finite, to find the cause of one that is not.
const HARMLESS: [f64; 2] = [1.0, 0.5];

impl Evaluator<'_> {
    fn read_by(&self, text: &NumberText) -> Vec<(String, f64)> {
        let formula = bind(text, &self.scope, &[]);
        let uses = formula.map(|formula| formula.uses().clone()).unwrap_or_default();
        let constants = self.scope.constants().filter(|(name, _)| uses.contains(*name));
        constants.map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn is_finite_with(&self, text: &NumberText, name: &str, value: f64) -> bool {
        let scope = self.scope.with(name, value);
        let formula = bind(text, &scope, &[]);
        formula.is_ok_and(|formula| formula.constant().is_some_and(f64::is_finite))
    }

    fn found(&self, name: &str, value: f64) -> String {
        let value = shown(value);
        match self.line_of(name) {
            Some(line) => format!("`{name}` is {value} (line {line})"),
            None => format!("`{name}` is {value}"),
        }
    }

    /// Refuses the first entry whose flag is true. An entry also has the keys of the refused value
    /// from the top of the file, and the text for the `diagnostic`.
    pub(crate) fn refuse_first(
        &self,
        entries: &[(bool, &str, &str)],
        diagnostic: impl FnOnce(SuitePath<'_>, &str) -> Diagnostic,
    ) -> Result<(), Diagnostic> {
        match entries.iter().find(|(applies, ..)| *applies) {
            Some((_, path, text)) => Err(diagnostic(self.top(path), text)),
            None => Ok(()),
        }
    }

    pub(super) fn line_of(&self, parameter: &str) -> Option<usize> {
        self.source.key_at(self.parameter(parameter).path.steps()).map(Place::line)
    }
}
