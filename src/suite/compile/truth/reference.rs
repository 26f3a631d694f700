//! A reference that is computed by finite elements, from `reference`.

use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::ReferenceSpec;
use crate::suite::model::ReferencePlan;
use crate::suite::yaml::{Diagnostic, Path};

/// The reference FEM, if that is what `spec` asks for.
///
/// # Errors
/// A diagnostic of what is missing, or of a scene that is not one-dimensional.
pub(crate) fn reference(
    evaluator: &Evaluator<'_>,
    spec: &ReferenceSpec,
    dimension: usize,
) -> Result<Option<ReferencePlan>, Diagnostic> {
    let path = Path::top("reference");
    let (equation, fem) = match (spec.equation, &spec.fem) {
        (Some(equation), Some(fem)) => (equation, fem),
        (None, None) if spec.same_method.is_some() => return Ok(None),
        _ => {
            let message =
                "a reference is a `fem` computation of an `equation`, or the `same_method`";
            return Err(evaluator.diagnostic_at_key(&path, message));
        }
    };
    if dimension != 1 {
        let message = format!("the reference FEM is 1-D, the scene {dimension}-D");
        let diagnostic = evaluator.diagnostic_at_key(&path, &message);
        return Err(diagnostic.with_help("give this scene an `exact` solution"));
    }
    let path = path.then("fem");
    Ok(Some(ReferencePlan {
        equation,
        element: fem.element,
        mass: fem.mass,
        cells: evaluator.count(&path.then("cells"), &fem.cells, "the number of elements")?,
        dt: evaluator.formula(&path.then("dt"), &fem.dt, &["h"])?,
    }))
}
