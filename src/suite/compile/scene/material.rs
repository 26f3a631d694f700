//! The material of a body, from words.

use crate::mpm::{MaterialPlan, MaterialSpec, Range};
use crate::suite::evaluator::{COORDINATES, Evaluator, shown};
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// The material and its density (kg/m3).
pub(crate) fn material(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &MaterialSpec<NumberText>,
) -> Result<(MaterialPlan, f64), Diagnostic> {
    let path = path.then(words.name());
    words.numbers(|key, parameter, text| {
        let at = path.then(key);
        let value = match parameter.range {
            Range::Positive => evaluator.positive(&at, text, parameter.what),
            Range::NotNegative => not_negative(evaluator, &at, text, parameter.what),
            Range::PoissonsRatio => poissons_ratio(evaluator, &at, text),
        };
        value.map_err(uniform)
    })
}

/// A diagnostic of a parameter that varies from place to place, with what to state instead.
fn uniform(diagnostic: Diagnostic) -> Diagnostic {
    let varies = |name: &&str| diagnostic.message() == format!("unknown name `{name}`");
    if !COORDINATES.iter().any(varies) {
        return diagnostic;
    }
    diagnostic.with_help(
        "a material is the same all over its body: where it changes, state several `bodies` in \
         `scene`, each with its own",
    )
}

fn not_negative(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
    what: &str,
) -> Result<f64, Diagnostic> {
    let value = evaluator.number(path, text)?;
    if value >= 0.0 {
        return Ok(value);
    }
    let message = format!("{what} is {}, and must not be below zero", shown(value));
    Err(evaluator.unusable(path, text, &message, "expected zero or a positive number"))
}

fn poissons_ratio(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
) -> Result<f64, Diagnostic> {
    let poisson = evaluator.number(path, text)?;
    if poisson > -1.0 && poisson < 0.5 {
        return Ok(poisson);
    }
    let message = format!("Poisson's ratio is {poisson}");
    Err(evaluator.unusable(path, text, &message, "expected a number above -1 and below 0.5"))
}
