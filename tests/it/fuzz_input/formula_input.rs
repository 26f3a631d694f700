//! Interprets bytes as the text of a formula.

use mpm_verify::exact::formula::{Expr, Formula, FormulaError, Jet, Scope};

/// Positions (m) and times (s).
const POINTS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [0.25, 1.5, -2.0], [-1e300, 1e-300, 3.0]];

/// Parses the bytes as a formula of three variables. Panics if parsing or evaluation panics, or if
/// evaluation with and without derivatives gives different bits of the value.
pub(crate) fn evaluate(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let scope = scope().expect("a sound scope");
    let Ok(expression) = Expr::parse(text) else { return };
    let Ok(formula) = Formula::bind(&expression, &scope, &["t", "X", "Y"]) else { return };
    for point in POINTS {
        let value = formula.eval(&point);
        let jets: [Jet<3>; 3] = std::array::from_fn(|axis| Jet::variable(point[axis], axis));
        let jet = formula.eval(&jets).value();
        let same = value.to_bits() == jet.to_bits() || (value.is_nan() && jet.is_nan());
        assert!(same, "{text}: {value:e} with derivatives is {jet:e}");
    }
}

fn scope() -> Result<Scope, FormulaError> {
    let mut scope = Scope::new();
    scope.constant("L", 2.5)?;
    scope.constant("E", 100.0)?;
    scope.function("wave", &["s".to_owned()], Expr::parse("sin(pi*s)/L")?)?;
    scope.table("ramp", "t", &[(0.0, 0.0), (1.0, 2.0), (3.0, -1.0)])?;
    Ok(scope)
}
