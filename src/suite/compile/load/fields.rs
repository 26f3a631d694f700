//! Formulas as the functions that effects and boundary conditions of the solver take.

use crate::exact::formula::{Formula, Number};
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

/// A formula of the coordinates, t and, where it was bound to that too, the displacement, at the
/// place `label` (m) with the displacement `u` (m).
pub(crate) fn of_displacement<T: Number>(
    formula: &Formula,
    (label, t): (&[f64], f64),
    u: &[T; 3],
) -> T {
    let (d, place) = (label.len(), variables(label, t));
    let mut all = [T::from(0.0); 7];
    for (value, known) in all.iter_mut().zip(place) {
        *value = T::from(known);
    }
    all[d + 1..][..d].copy_from_slice(&u[..d]);
    formula.eval(&all[..formula.variables()])
}

/// The formulas as the suite writes them.
pub(crate) fn sources(formulas: &[Formula]) -> String {
    formulas.iter().map(Formula::source).collect::<Vec<_>>().join(", ")
}
