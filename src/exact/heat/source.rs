//! The source of heat as a suite states it.

use crate::exact::formula::Formula;
use crate::exact::motion::variables;

/// The source (W/kg) at the reference position `label` (m), a time (s) and a temperature (K).
/// Variables of `formula` are the coordinates, t and, where it was bound to that too, T.
pub fn source_at(formula: &Formula, label: &[f64], t: f64, temperature: f64) -> f64 {
    let mut all = [0.0; 5];
    all[..4].copy_from_slice(&variables(label, t));
    all[label.len() + 1] = temperature;
    formula.eval(&all[..formula.variables()])
}
