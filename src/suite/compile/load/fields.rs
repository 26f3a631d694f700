//! Formulas as the functions that effects and boundary conditions of the solver take.

use crate::exact::formula::Formula;
use crate::exact::variables;
use crate::mpm::{ScalarField, Vector, VelocityField};

/// Formulas of t, one for each component.
pub(crate) fn of_time<const D: usize>(
    formulas: &[Formula],
) -> Box<dyn Fn(f64) -> Vector<D> + Send> {
    let formulas = formulas.to_vec();
    Box::new(move |t| Vector::from_fn(|i, _| formulas[i].eval(&[t])))
}

/// Formulas of the coordinates and t, one for each component.
pub(crate) fn of_place_and_time<const D: usize>(formulas: &[Formula]) -> VelocityField<D> {
    let formulas = formulas.to_vec();
    Box::new(move |x: &Vector<D>, t| {
        let variables = variables(x.as_slice(), t);
        Vector::from_fn(|i, _| formulas[i].eval(&variables[..=D]))
    })
}

/// A formula of the coordinates and t.
pub(crate) fn scalar<const D: usize>(formula: &Formula) -> ScalarField<D> {
    let formula = formula.clone();
    Box::new(move |x: &Vector<D>, t| formula.eval(&variables(x.as_slice(), t)[..=D]))
}

/// Component i of formulas of the coordinates and t at a place; none of them is zero.
pub(crate) fn component(formulas: &[Formula], i: usize, label: &[f64], t: f64) -> f64 {
    let all = variables(label, t);
    formulas.get(i).map_or(0.0, |formula| formula.eval(&all[..=label.len()]))
}

/// The formulas as the suite writes them.
pub(crate) fn sources(formulas: &[Formula]) -> String {
    formulas.iter().map(Formula::source).collect::<Vec<_>>().join(", ")
}
