//! Names that a suite declares.

use std::collections::BTreeMap;
use std::ops::Range;

use super::ast::Expr;
use super::builtin::is_reserved;
use super::lexer::{FormulaError, is_name};

/// The constants and functions that formulas may use.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    constants: BTreeMap<String, f64>,
    functions: BTreeMap<String, Function>,
    tables: BTreeMap<String, Tabulated>,
    /// Names, each defined as an expression of constants and the free variable.
    definitions: BTreeMap<String, Expr>,
    /// The free variable, which functions and definitions may also use.
    free: Option<String>,
}

#[derive(Debug, Clone)]
pub(super) struct Function {
    pub(super) parameters: Vec<String>,
    pub(super) body: Expr,
}

#[derive(Debug, Clone)]
pub(super) struct Tabulated {
    pub(super) by: String,
    pub(super) body: Expr,
}

impl Scope {
    /// Creates an empty scope.
    pub fn new() -> Self {
        Self::default()
    }

    /// Declares a constant, such as a parameter of a suite.
    ///
    /// # Errors
    /// When `name` is invalid or taken, or when `value` is not finite.
    pub fn constant(&mut self, name: &str, value: f64) -> Result<(), FormulaError> {
        self.admit(name)?;
        if !value.is_finite() {
            let message = format!("the constant `{name}` is {value}, which is not finite");
            return Err(FormulaError::new(0..name.len(), message));
        }
        self.constants.insert(name.to_owned(), value);
        Ok(())
    }

    /// Declares `name` as the free variable, which functions and definitions may use.
    ///
    /// # Errors
    /// When `name` is invalid or taken.
    pub fn free(&mut self, name: &str) -> Result<(), FormulaError> {
        self.admit(name)?;
        self.free = Some(name.to_owned());
        Ok(())
    }

    /// Declares a name for an expression of constants, functions, other definitions and the free
    /// variable.
    ///
    /// # Errors
    /// When `name` is invalid or taken.
    pub fn definition(&mut self, name: &str, body: Expr) -> Result<(), FormulaError> {
        self.admit(name)?;
        self.definitions.insert(name.to_owned(), body);
        Ok(())
    }

    /// Returns this scope with a new value for a declared constant.
    #[must_use]
    pub fn with(&self, name: &str, value: f64) -> Self {
        let mut scope = self.clone();
        if let Some(known) = scope.constants.get_mut(name) {
            *known = value;
        }
        scope
    }

    /// Declares a function. Bodies are resolved when a formula uses them, so any order is valid.
    ///
    /// # Errors
    /// When `name` or a parameter is invalid or taken, or when the index of a sum in the body is a
    /// parameter.
    pub fn function(
        &mut self,
        name: &str,
        parameters: &[String],
        body: Expr,
    ) -> Result<(), FormulaError> {
        self.admit(name)?;
        for (position, parameter) in parameters.iter().enumerate() {
            self.fresh(parameter, 0..parameter.len())?;
            if parameter == name || parameters[..position].contains(parameter) {
                let message = format!("the parameter `{parameter}` of `{name}` is already in use");
                return Err(FormulaError::new(0..parameter.len(), message));
            }
        }
        if let Some(sum) = body.sums().find(|sum| parameters.contains(&sum.index)) {
            let message = format!("`{}` is already a parameter of `{name}`", sum.index);
            return Err(FormulaError::new(sum.index_span.clone(), message).within(name));
        }
        let function = Function { parameters: parameters.to_vec(), body };
        self.functions.insert(name.to_owned(), function);
        Ok(())
    }

    /// Declares the piecewise linear function `name` of `by`, a constant or a variable, through
    /// `rows` (argument and value, ascending). It is constant before and after the rows.
    ///
    /// # Errors
    /// When `name` or `by` is invalid, or when `name` is taken.
    pub fn table(&mut self, name: &str, by: &str, rows: &[(f64, f64)]) -> Result<(), FormulaError> {
        self.admit(name)?;
        Self::named(by)?;
        let table = Tabulated { by: by.to_owned(), body: interpolation(by, rows)? };
        self.tables.insert(name.to_owned(), table);
        Ok(())
    }

    /// Checks that `name` is a valid name.
    ///
    /// # Errors
    /// When `name` is not a letter or `_` followed by ASCII letters, digits and `_`.
    pub fn named(name: &str) -> Result<(), FormulaError> {
        if is_name(name) {
            return Ok(());
        }
        Err(FormulaError::new(0..name.len(), format!("`{name}` is not a name"))
            .help("a name is made of ASCII letters, digits and `_`, no digit first"))
    }

    /// Returns the names of the declared tables, in alphabetical order.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        self.tables.keys().map(String::as_str)
    }

    /// Returns names and values of the declared constants, in alphabetical order.
    pub fn constants(&self) -> impl Iterator<Item = (&str, f64)> {
        self.constants.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// Returns the names of the declared functions, in alphabetical order.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.functions.keys().map(String::as_str)
    }

    pub(super) fn value(&self, name: &str) -> Option<f64> {
        self.constants.get(name).copied()
    }

    pub(super) fn defined(&self, name: &str) -> Option<(&str, &Expr)> {
        self.definitions.get_key_value(name).map(|(name, body)| (name.as_str(), body))
    }

    pub(super) fn is_free(&self, name: &str) -> bool {
        self.free.as_deref() == Some(name)
    }

    pub(super) fn tabulated(&self, name: &str) -> Option<(&str, &Tabulated)> {
        self.tables.get_key_value(name).map(|(name, table)| (name.as_str(), table))
    }

    pub(super) fn called(&self, name: &str) -> Option<(&str, &Function)> {
        self.functions.get_key_value(name).map(|(name, function)| (name.as_str(), function))
    }

    /// Refuses the `name` at `span` if it is invalid or already has a meaning.
    pub(super) fn fresh(&self, name: &str, span: Range<usize>) -> Result<(), FormulaError> {
        Self::named(name)?;
        let roles = [
            (is_reserved(name), "a builtin name"),
            (self.constants.contains_key(name), "a constant"),
            (self.functions.contains_key(name), "a function"),
            (self.tables.contains_key(name), "a table"),
            (self.definitions.contains_key(name), "a definition"),
        ];
        match roles.iter().find(|(is_taken, _)| *is_taken) {
            Some((_, role)) => Err(FormulaError::new(span, format!("`{name}` is already {role}"))),
            None => Ok(()),
        }
    }

    /// Refuses to declare `name` if it already has a meaning or is the name of a parameter.
    fn admit(&self, name: &str) -> Result<(), FormulaError> {
        self.fresh(name, 0..name.len())?;
        let taken = |function: &Function| function.parameters.iter().any(|known| known == name);
        match self.functions.iter().find(|(_, function)| taken(function)) {
            None => Ok(()),
            Some((function, _)) => {
                let message =
                    format!("`{name}` is already a parameter of the function `{function}`");
                Err(FormulaError::new(0..name.len(), message))
            }
        }
    }
}

/// Creates the expression of a table: its first value plus the rise in each interval.
fn interpolation(by: &str, rows: &[(f64, f64)]) -> Result<Expr, FormulaError> {
    let rise = |pair: &[(f64, f64)]| {
        let ((from, low), (to, high)) = (pair[0], pair[1]);
        format!("+({:e})*(min(max({by},{from:e}),{to:e})-({from:e}))", (high - low) / (to - from))
    };
    let first = rows.first().map_or(0.0, |(_, value)| *value);
    Expr::parse(&format!("({first:e}){}", rows.windows(2).map(rise).collect::<String>()))
}

#[cfg(test)]
mod tests {
    use super::super::{Formula, Jet};
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn a_free_variable_is_differentiated_through_definitions_and_functions()
    -> Result<(), FormulaError> {
        let mut scope = Scope::new();
        scope.function("s", &["x".to_owned()], Expr::parse("x*w")?)?;
        scope.constant("rho", 2.0)?;
        scope.free("E")?;
        scope.definition("w", Expr::parse("sqrt(E/rho)")?)?;
        let formula = Formula::bind(&Expr::parse("s(t)*E")?, &scope, &["t", "E"])?;
        let value = formula.eval(&[Jet::<2>::variable(3.0, 0), Jet::variable(8.0, 1)]);
        // The function is t E sqrt(E/2), whose derivative with respect to E is 3/2 t sqrt(E/2).
        assert_abs_diff_eq!(value.value(), 48.0, epsilon = 1e-12);
        assert_abs_diff_eq!(value.d(1), 9.0, epsilon = 1e-12);
        assert_abs_diff_eq!(value.dd(0, 1), 3.0, epsilon = 1e-12);
        assert!(
            scope.constant("w", 1.0).is_err() && scope.definition("s", Expr::parse("1")?).is_err()
        );
        assert!(Formula::bind(&Expr::parse("w")?, &scope, &["t"]).is_err(), "no value for E");
        Ok(())
    }
}
