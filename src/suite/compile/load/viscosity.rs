//! Artificial viscosity, from words to the solver.

use crate::{
    mpm::ArtificialViscosity,
    suite::{
        compile::{
            check::subject_support::fem_lacks, evaluator::Evaluator, path::Path, wording::shown,
        },
        grammar::{ConvergenceSpec, ViscositySpec},
        model::Scene,
        yaml::{Diagnostic, NumberText},
    },
};

/// The effect on one of the bodies of a scene, on a grid of cell size `h` (m), if it lists one.
pub(crate) fn on(body: &Scene, h: f64) -> Option<ArtificialViscosity> {
    let [linear, quadratic] = body.viscosity?;
    Some(ArtificialViscosity {
        linear,
        quadratic,
        length: h,
        speed: body.wave_speed(),
        q: Vec::new(),
    })
}

/// Gives the scene an artificial viscosity.
pub(crate) fn add(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &ViscositySpec,
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    if scene.viscosity.is_some() {
        return Err(evaluator.diagnostic(path, "artificial viscosity appears twice"));
    }
    let coefficient = |key: &str, text: &NumberText| {
        let path = path.then(key);
        let value = evaluator.number(&path, text)?;
        if value >= 0.0 {
            return Ok(value);
        }
        let message = format!("a coefficient of viscosity is {}", shown(value));
        Err(evaluator.diagnostic(&path, &message).with_label("expected zero or a positive number"))
    };
    let linear = coefficient("linear", &words.linear)?;
    let quadratic = coefficient("quadratic", &words.quadratic)?;
    scene.viscosity = Some([linear, quadratic]);
    Ok(())
}

/// Refuses the FEM, which has no artificial viscosity.
pub(crate) fn check(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if scene.viscosity.is_none() {
        return Ok(());
    }
    fem_lacks(evaluator, words, "artificial viscosity")
}
