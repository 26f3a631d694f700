//! Numbers of loads and boundary conditions, for the built-in and for external solvers.

use crate::exact::formula::Formula;
use crate::exact::{Region, variables};
use crate::mpm::input::VectorOfTime;

#[derive(Debug, Clone, Default)]
pub(crate) struct LoadNumbers {
    /// Constants with their keys (SI units).
    pub(crate) constants: Vec<(&'static str, f64)>,
    pub(crate) field: Option<NumberField>,
    /// Part of the bodies on which the load acts, if it acts on a set.
    pub(crate) region: Option<Region>,
}

/// A quantity given by formulas of t, the coordinates and the displacement, or some of these.
#[derive(Debug, Clone)]
pub(crate) struct NumberField {
    pub(crate) key: &'static str,
    /// Whether the quantity is a vector with D components.
    pub(crate) is_vector: bool,
    formulas: Vec<Formula>,
}

impl LoadNumbers {
    pub(crate) fn constants(constants: &[(&'static str, f64)]) -> Self {
        Self { constants: constants.to_vec(), ..Self::default() }
    }

    pub(crate) fn vector(key: &'static str, formulas: &[Formula]) -> Self {
        let field = NumberField { key, is_vector: true, formulas: formulas.to_vec() };
        Self { field: Some(field), ..Self::default() }
    }

    pub(crate) fn scalar(key: &'static str, formula: &Formula) -> Self {
        let field = NumberField { key, is_vector: false, formulas: vec![formula.clone()] };
        Self { field: Some(field), ..Self::default() }
    }

    pub(crate) fn on(self, region: &Region) -> Self {
        Self { region: Some(region.clone()), ..self }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.constants.is_empty() && self.field.is_none()
    }
}

impl NumberField {
    pub(crate) fn constant(&self) -> Option<Vec<f64>> {
        self.formulas.iter().map(Formula::constant).collect()
    }

    /// Returns whether the value depends on the coordinates, on time, and on the displacement.
    pub(crate) fn depends_on(&self, d: usize) -> [bool; 3] {
        let reads = |from: usize, to: usize| {
            let mut formulas = self.formulas.iter();
            formulas.any(|formula| (from..to.min(formula.variables())).any(|i| formula.reads(i)))
        };
        if self.formulas.iter().all(|formula| formula.variables() == 1) {
            return [false, reads(0, 1), false];
        }
        [reads(0, d), reads(d, d + 1), reads(d + 1, 2 * d + 1)]
    }

    /// Returns the value at `label` (m, D numbers), time `t` (s) and displacement `u` (m).
    pub(crate) fn at(&self, label: &[f64], t: f64, u: &[f64]) -> Vec<f64> {
        let mut all = label.to_vec();
        all.push(t);
        all.extend(label.iter().enumerate().map(|(i, _)| u.get(i).copied().unwrap_or(0.0)));
        let value = |formula: &Formula| match formula.variables() {
            1 => formula.eval(&[t]),
            count => formula.eval(&all[..count]),
        };
        self.formulas.iter().map(value).collect()
    }
}

pub(crate) fn of_time(formulas: &[Formula]) -> VectorOfTime {
    let formulas = formulas.to_vec();
    Box::new(move |t, into| {
        for (value, formula) in into.iter_mut().zip(&formulas) {
            *value = formula.eval(&[t]);
        }
    })
}

pub(crate) fn of_place_and_time(
    formulas: &[Formula],
) -> impl Fn(&[f64], f64, &mut [f64]) + Send + Sync + 'static {
    let formulas = formulas.to_vec();
    move |x, t, into| {
        let variables = variables(x, t);
        for (value, formula) in into.iter_mut().zip(&formulas) {
            *value = formula.eval(&variables[..=x.len()]);
        }
    }
}

pub(crate) fn scalar(formula: &Formula) -> impl Fn(&[f64], f64) -> f64 + Send + 'static {
    let formula = formula.clone();
    move |x, t| formula.at(x, t)
}

pub(crate) fn sources(formulas: &[Formula]) -> String {
    formulas.iter().map(Formula::source).collect::<Vec<_>>().join(", ")
}

/// Writes a scalar or a vector with its unit: `2 m/s2` or `(0, -g) [m/s2]`.
pub(crate) fn value_with_unit(formulas: &[Formula], unit: &str) -> String {
    let list = sources(formulas);
    let unit = unit_after(&list, unit);
    if formulas.len() == 1 { format!("{list}{unit}") } else { format!("({list}){unit}") }
}

/// Appends a unit, in brackets unless all formulas are numbers: `0.1, 0.2 s` or `h/3 [s]`.
pub(crate) fn with_unit(text: &str, unit: &str) -> String {
    format!("{text}{}", unit_after(text, unit))
}

/// Returns the unit as written after `text`, beginning with a space.
pub(crate) fn unit_after(text: &str, unit: &str) -> String {
    let is_number = |one: &str| one.parse::<f64>().is_ok();
    if text.split(", ").all(is_number) { format!(" {unit}") } else { format!(" [{unit}]") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::formula::{Expr, Scope};
    use rstest::rstest;

    fn formula(text: &str, variables: &[&str]) -> Formula {
        Formula::bind(&Expr::parse(text).unwrap(), &Scope::new(), variables).unwrap()
    }

    #[rstest]
    #[case::number(&["-2"], "-2 m/s2")]
    #[case::formula(&["2*t"], "2*t [m/s2]")]
    #[case::numbers(&["0", "-2"], "(0, -2) m/s2")]
    #[case::formulas(&["0", "-2*t"], "(0, -2*t) [m/s2]")]
    fn units_follow_values(#[case] texts: &[&str], #[case] expected: &str) {
        let formulas: Vec<Formula> = texts.iter().map(|text| formula(text, &["t"])).collect();
        assert_eq!(value_with_unit(&formulas, "m/s2"), expected);
    }

    #[rstest]
    #[case::constant("3", &["t"], [false; 3], 3.0)]
    #[case::of_time("2*t", &["t"], [false, true, false], 1.0)]
    #[case::of_time_alone("2*t", &["X", "Y", "t"], [false, true, false], 1.0)]
    #[case::of_place("Y", &["X", "Y", "t"], [true, false, false], 5.0)]
    #[case::of_displacement("uy - t", &["X", "Y", "t", "ux", "uy"], [false, true, true], 6.5)]
    fn a_field_names_what_it_depends_on(
        #[case] text: &str,
        #[case] variables: &[&str],
        #[case] depends: [bool; 3],
        #[case] value: f64,
    ) {
        let field = LoadNumbers::scalar("rate", &formula(text, variables)).field.unwrap();
        assert_eq!(field.depends_on(2), depends);
        assert_eq!(field.at(&[4.0, 5.0], 0.5, &[6.0, 7.0]), [value]);
        assert_eq!(field.constant().is_some(), depends == [false; 3]);
    }
}
