//! The material of a body, from words.

use crate::{
    mpm::{MaterialPlan, MaterialWords, Range},
    suite::{
        compile::{evaluator::Binder, path::Path, wording::shown},
        yaml::{Complaint, NumberText},
    },
};

/// The material and its density (kg/m^D).
pub(crate) fn material(
    binder: &Binder<'_>,
    path: &Path,
    words: &MaterialWords<NumberText>,
) -> Result<(MaterialPlan, f64), Complaint> {
    let path = path.then(words.name());
    words.numbers(|key, parameter, text| {
        let at = path.then(key);
        match parameter.range {
            Range::Positive => binder.positive(&at, text, parameter.what),
            Range::NotNegative => not_negative(binder, &at, text, parameter.what),
            Range::PoissonsRatio => poissons_ratio(binder, &at, text),
        }
    })
}

fn not_negative(
    binder: &Binder<'_>,
    path: &Path,
    text: &NumberText,
    what: &str,
) -> Result<f64, Complaint> {
    let value = binder.number(path, text)?;
    if value >= 0.0 {
        return Ok(value);
    }
    let message = format!("{what} is {}, and must not be below zero", shown(value));
    Err(binder.complain(path, &message).with_label("expected zero or a positive number"))
}

fn poissons_ratio(binder: &Binder<'_>, path: &Path, text: &NumberText) -> Result<f64, Complaint> {
    let poisson = binder.number(path, text)?;
    if poisson > -1.0 && poisson < 0.5 {
        return Ok(poisson);
    }
    let message = format!("Poisson's ratio is {poisson}");
    Err(binder.complain(path, &message).with_label("expected a number above -1 and below 0.5"))
}
