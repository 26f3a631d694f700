//! Tests of the formula language as a whole.

// If results are defined to be equal, they are compared bit for bit.
#![allow(clippy::float_cmp)]

mod derivatives;
mod errors;
mod functions;
mod hoisted;
mod language;
mod limits;
mod random;
mod tables;

use mpm_verify::exact::formula::{Expr, Formula, FormulaError, Scope};

/// Parses `source` with these variables, and with the constants of a bar in scope.
fn bind(source: &str, variables: &[&str]) -> Result<Formula, FormulaError> {
    Formula::bind(&Expr::parse(source)?, &bar(), variables)
}

/// Creates a scope with the constants of a bar and two functions.
fn bar() -> Scope {
    let mut scope = Scope::new();
    for (name, value) in [("E", 4.0), ("rho", 2.0), ("L", 0.5), ("omega", 3.0), ("g", 10.0)] {
        scope.constant(name, value).unwrap();
    }
    declare(&mut scope, "s", &["tau"], "-g/2*max(tau,0)^2");
    declare(&mut scope, "wave", &["x", "t"], "s(x)+sin(omega*t)");
    scope
}

fn declare(scope: &mut Scope, name: &str, parameters: &[&str], body: &str) {
    let parameters: Vec<String> = parameters.iter().map(ToString::to_string).collect();
    scope.function(name, &parameters, Expr::parse(body).unwrap()).unwrap();
}
