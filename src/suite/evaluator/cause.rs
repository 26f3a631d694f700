//! Finds the parameter that causes an invalid number.

use super::{Evaluator, shown};
use crate::exact::formula::{Expr, Formula};
use crate::suite::yaml::{Diagnostic, NumberText, Path, Place, Step};

/// Values for which most formulas are finite. A parameter is suspected if the formula is finite
/// with one of them, or with its own magnitude, in its place.
const HARMLESS: [f64; 2] = [1.0, 0.5];

impl Evaluator<'_> {
    /// A diagnostic of an invalid number from the formula at `path`; it lists the parameters of the
    /// formula.
    pub(crate) fn unusable(
        &self,
        path: &Path,
        text: &NumberText,
        message: &str,
        label: &str,
    ) -> Diagnostic {
        let read = self.read_by(text);
        let read: Vec<String> = read.iter().map(|(name, value)| self.found(name, *value)).collect();
        self.diagnostic(path, message).with_label(label).with_help(&read.join(", "))
    }

    /// A diagnostic of a formula of parameters whose value is not finite.
    pub(super) fn not_finite(&self, path: &Path, text: &NumberText, value: f64) -> Diagnostic {
        let (label, value) = ("expected a finite number", shown(value));
        let what = match path.steps() {
            [Step::Key(top), Step::Key(name)] if top == "parameters" => name.clone(),
            _ => text.to_string(),
        };
        let read = self.read_by(text);
        let suspected = |(name, value): &&(String, f64)| {
            let mut instead = HARMLESS.into_iter().chain([value.abs()]);
            instead.any(|instead| self.is_finite_with(text, name, instead))
        };
        let suspects: Vec<_> = read.iter().filter(suspected).collect();
        if suspects.is_empty() {
            let message = format!("`{text}` is {value}, which is not finite");
            return self.unusable(path, text, &message, label);
        }
        let causes: Vec<String> =
            suspects.iter().map(|(name, value)| format!("`{name}` is {}", shown(*value))).collect();
        let message = format!("`{what}` is {value} because {}", causes.join(" and "));
        let places: Vec<String> =
            suspects.iter().map(|(name, value)| self.found(name, *value)).collect();
        self.diagnostic(path, &message).with_label(label).with_help(&places.join(", "))
    }

    /// The parameters that a formula reads, be it through functions, with their values.
    fn read_by(&self, text: &NumberText) -> Vec<(String, f64)> {
        let formula =
            Expr::parse(&text.to_string()).and_then(|expr| Formula::bind(&expr, &self.scope, &[]));
        let uses = formula.map(|formula| formula.uses().clone()).unwrap_or_default();
        let constants = self.scope.constants().filter(|(name, _)| uses.contains(*name));
        constants.map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Whether the formula is finite with another value of a parameter.
    fn is_finite_with(&self, text: &NumberText, name: &str, value: f64) -> bool {
        let scope = self.scope.with(name, value);
        let formula =
            Expr::parse(&text.to_string()).and_then(|expr| Formula::bind(&expr, &scope, &[]));
        formula.is_ok_and(|formula| formula.constant().is_some_and(f64::is_finite))
    }

    /// A parameter with its value and the line that declares it.
    fn found(&self, name: &str, value: f64) -> String {
        let value = shown(value);
        match self.line_of(name) {
            Some(line) => format!("`{name}` is {value} (line {line})"),
            None => format!("`{name}` is {value}"),
        }
    }

    /// The line that declares a parameter.
    pub(super) fn line_of(&self, parameter: &str) -> Option<usize> {
        let path = Path::top("parameters").then(parameter);
        self.source.key_at(path.steps()).map(Place::line)
    }
}
