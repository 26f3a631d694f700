//! A force per unit mass given by formulas, evaluated at fixed reference positions.

use super::bound::Formula;
use super::hoisted::Hoisted;
use super::jet::Jet;
use super::number::Number;
use crate::exact::motion::variables;

/// Maximum number of operations (with unrolled sums) of formulas precomputed for each position.
const MAX_OPERATIONS: u64 = 5000;

/// Formulas of the coordinates, t and optionally the displacement, at fixed positions.
pub struct FormulaForce {
    formulas: Vec<Formula>,
    labels: Vec<Vec<f64>>,
    /// The formulas split by their dependence on position and time, if this lowers the cost.
    hoisted: Option<Hoisted<f64>>,
}

impl FormulaForce {
    /// Prepares the evaluation at the reference positions `labels` (m).
    pub fn new(formulas: &[Formula], labels: &[&[f64]]) -> Self {
        let place_and_time = formulas.len() + 1;
        let is_cheap = |formula: &Formula| {
            formula.variables() == place_and_time && formula.operations() <= MAX_OPERATIONS
        };
        let hoisted = formulas.iter().all(is_cheap).then(|| {
            let mut hoisted = Hoisted::new(formulas, place_and_time);
            for label in labels {
                hoisted.add(label);
            }
            hoisted
        });
        let labels = if hoisted.is_some() { &[][..] } else { labels };
        let labels = labels.iter().map(|label| label.to_vec()).collect();
        Self { formulas: formulas.to_vec(), labels, hoisted }
    }

    /// Writes the force (m/s2) at each position and time `t` (s), without allocation. `u` returns
    /// the displacement (m) of the position with a given index.
    pub fn write(&mut self, t: f64, u: &dyn Fn(usize) -> [f64; 3], into: &mut [[f64; 3]]) {
        if let Some(hoisted) = &mut self.hoisted {
            hoisted.set_time(t);
            for (place, force) in into.iter_mut().enumerate() {
                force.iter_mut().zip(hoisted.eval(place)).for_each(|(into, value)| *into = value);
            }
            return;
        }
        let depends_on_u = depends_on_displacement(&self.formulas);
        for (p, (force, label)) in into.iter_mut().zip(&self.labels).enumerate() {
            let u = if depends_on_u { u(p) } else { [0.0; 3] };
            for (force, formula) in force.iter_mut().zip(&self.formulas) {
                *force = at_displaced(formula, label, t, &u);
            }
        }
    }

    /// Computes an upper bound on the largest eigenvalue (1/s2) of the symmetric part of -db/du,
    /// over all positions at t = 0, from Gershgorin circles. `u` is as in [`write`](Self::write).
    pub fn stiffness(&self, u: &dyn Fn(usize) -> [f64; 3]) -> f64 {
        if !depends_on_displacement(&self.formulas) {
            return 0.0;
        }
        let of = |label: &[f64], u: [f64; 3]| {
            let seeds: [Jet<3>; 3] = std::array::from_fn(|a| Jet::variable(u[a], a));
            let slope = |formula| at_displaced::<Jet<3>>(formula, label, 0.0, &seeds);
            let slopes: Vec<Jet<3>> = self.formulas.iter().map(slope).collect();
            let held = |i: usize, j: usize| -0.5 * (slopes[i].d(j) + slopes[j].d(i));
            let circle = |i: usize| {
                let others = (0..slopes.len()).filter(|j| *j != i).map(|j| held(i, j).abs());
                held(i, i) + others.sum::<f64>()
            };
            (0..slopes.len()).map(circle).fold(0.0, f64::max)
        };
        let all = self.labels.iter().enumerate();
        all.map(|(p, label)| of(label, u(p))).fold(0.0, f64::max)
    }
}

/// Whether the formulas of a force have the displacement as variables.
fn depends_on_displacement(formulas: &[Formula]) -> bool {
    formulas.iter().any(|formula| formula.variables() > formulas.len() + 1)
}

impl Formula {
    /// Evaluates the formula at the reference position `label` (m) and time `t` (s), for the
    /// displacement `u` (m).
    pub fn at_displaced(&self, label: &[f64], t: f64, u: &[f64; 3]) -> f64 {
        at_displaced(self, label, t, u)
    }
}

fn at_displaced<T: Number>(formula: &Formula, label: &[f64], t: f64, u: &[T; 3]) -> T {
    let (d, place) = (label.len(), variables(label, t));
    let mut all = [T::from(0.0); 7];
    for (value, known) in all.iter_mut().zip(place) {
        *value = T::from(known);
    }
    all[d + 1..][..d].copy_from_slice(&u[..d]);
    formula.eval(&all[..formula.variables()])
}
