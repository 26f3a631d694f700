//! Declares tables, and refuses reserved, unused and undeclared names.

use super::{Evaluator, ParameterSpec, SuitePath, TableSpec, shown, with_help};
use crate::exact::formula::{Expr, Formula, Scope};
use crate::suite::yaml::{Diagnostic, NumberText, Ordered};

impl Evaluator<'_> {
    pub(crate) fn refuse_taken(&self, variables: &[&str]) -> Result<(), Diagnostic> {
        for name in variables {
            let declared = self.scope.constants().map(|(known, _)| known);
            let is_parameter = declared.chain(self.scope.tables()).any(|known| known == *name);
            let path = match self.head_of(name) {
                _ if is_parameter => self.parameter(name),
                Some(head) => self.function(head),
                None => continue,
            };
            let message = format!("`{name}` is a variable of formulas and cannot be declared");
            let help = format!("rename it; the variables are {}", variables.join(", "));
            return path.refuse_key(&message, &help);
        }
        Ok(())
    }

    pub(crate) fn refuse_unused(
        &self,
        parameters: &Ordered<ParameterSpec>,
        functions: &Ordered<String>,
    ) -> Result<(), Diagnostic> {
        let parameters = parameters.as_slice().iter().map(|(name, _)| ("parameter", name));
        let functions = functions.as_slice().iter().map(|(head, _)| ("function", head));
        let used = self.used.borrow();
        let mut declared = parameters.chain(functions);
        let Some((kind, key)) = declared.find(|(_, key)| !used.contains(name_in(key))) else {
            return Ok(());
        };
        let message = format!("the {kind} `{}` is never used", name_in(key));
        self.top(&format!("{kind}s"))
            .then(key.as_str())
            .refuse_key(&message, "remove it, or use it")
    }

    pub(super) fn comes_later(&self, name: &str) -> bool {
        self.parameters.iter().any(|known| known == name)
            && !self.scope.constants().any(|(known, _)| known == name)
            && !self.scope.tables().any(|known| known == name)
    }

    /// Returns the declared head of `function`, such as `s(tau)`.
    pub(super) fn head_of(&self, function: &str) -> Option<&String> {
        self.heads.iter().find(|head| name_in(head) == function)
    }

    /// Declares a table and returns its text, and its value if it depends on a parameter.
    pub(super) fn declare_table(
        &mut self,
        name: &str,
        spec: &TableSpec,
    ) -> Result<(String, Option<f64>), Diagnostic> {
        let path = self.parameter(name);
        let rows = rows(&path.then("table"), spec)?;
        let (by, by_path) = (&spec.by, path.then("by"));
        Scope::named(by).map_err(|error| with_help(by_path.diagnostic(&error.message), &error))?;
        if by == name {
            let message = format!("the table of `{name}` depends on `{name}` itself");
            return Err(by_path.diagnostic(&message));
        }
        let by_parameter = self.parameters.contains(by);
        if by_parameter {
            by_path.number(&NumberText::Formula(by.clone()))?;
        }
        let declared = self.scope.table(name, by, &rows);
        declared.map_err(|error| self.parameter(name).at_key(&error))?;
        let of_name = || self.parameter(name).number(&NumberText::Formula(name.to_owned()));
        let value = by_parameter.then(of_name).transpose()?;
        if value.is_some() {
            self.used.borrow_mut().remove(name);
        }
        let written = spec.table.iter().map(|row| format!("{} at {by} = {}", row[1], row[0]));
        Ok((format!("({})", written.collect::<Vec<_>>().join(", ")), value))
    }
}

impl<'a> Evaluator<'a> {
    pub(crate) fn with_free(
        &self,
        name: &str,
        parameters: &Ordered<ParameterSpec>,
        functions: &Ordered<String>,
    ) -> Result<Evaluator<'a>, Diagnostic> {
        let mut evaluator =
            Evaluator::new(self.source, &Ordered::default(), functions).map(|(new, _)| new)?;
        evaluator.parameters.clone_from(&self.parameters);
        for (key, spec) in parameters.as_slice() {
            let text = match spec {
                ParameterSpec::Number(text) => text.to_string(),
                ParameterSpec::Map(spec) => {
                    evaluator.declare_table(key, spec)?;
                    continue;
                }
            };
            let declared = if key == name {
                evaluator.scope.free(name)
            } else {
                Expr::parse(&text).and_then(|body| {
                    let formula = Formula::bind(&body, &evaluator.scope, &[name])?;
                    match formula.constant() {
                        Some(value) => evaluator.scope.constant(key, value),
                        None => evaluator.scope.definition(key, body),
                    }
                })
            };
            declared.map_err(|error| evaluator.parameter(key).at_key(&error))?;
        }
        Ok(evaluator)
    }
}

fn name_in(head: &str) -> &str {
    head.split('(').next().unwrap_or(head).trim()
}

fn rows(path: &SuitePath<'_>, spec: &TableSpec) -> Result<Vec<(f64, f64)>, Diagnostic> {
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for (i, row) in spec.table.iter().enumerate() {
        let path = path.then(i);
        let [at, value] = row.as_slice() else {
            let label = format!("expected a value of `{}` and the value of the parameter", spec.by);
            return Err(path.diagnostic("this row does not have two numbers").with_label(&label));
        };
        let row = (path.then(0).number(at)?, path.then(1).number(value)?);
        if let Some((before, _)) = rows.last().filter(|(before, _)| !(*before < row.0)) {
            let message = format!("{} follows {}", shown(row.0), shown(*before));
            let label = "expected rows in ascending order";
            return Err(path.then(0).diagnostic(&message).with_label(label));
        }
        rows.push(row);
    }
    if rows.len() < 2 {
        return path
            .refuse("a table needs at least two rows", "for a constant parameter, write a number");
    }
    Ok(rows)
}
