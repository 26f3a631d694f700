//! Determines whether a suite requests the null space of the grid or the energy ledger, which runs
//! compute only on request.

use crate::mpm::TransferKind;
use crate::mpm::input::MpmMethod;
use crate::subject::PlaneState;
use crate::suite::compile::check::sums::refuse_law_without_energy;
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::StabilitySpec;
use crate::suite::model::Scene;
use crate::suite::model::method::Method;
use crate::suite::yaml::Diagnostic;
use crate::verify::RunFigure;

/// Returns the first quantity in `show` or `expect` for which `is_meant` is true, with its path.
fn first<'a>(
    evaluator: &'a Evaluator<'a>,
    spec: &StabilitySpec,
    is_meant: impl Fn(RunFigure) -> bool,
) -> Option<(SuitePath<'a>, &'static str)> {
    let shown = spec.show.iter().enumerate();
    let shown = shown.map(|(i, figure)| (evaluator.top("show").then(i), *figure));
    let expected = spec.expect.iter().enumerate().flat_map(|(i, entry)| {
        let path = evaluator.top("expect").then(i).then("figures");
        let named =
            entry.figures.as_slice().iter().filter_map(|(name, _)| RunFigure::by_name(name));
        named.map(move |figure| (path.then(figure.name()), figure))
    });
    let (path, figure) = shown.chain(expected).find(|(_, figure)| is_meant(*figure))?;
    Some((path, figure.name()))
}

fn refuse_several_bodies(
    path: &SuitePath<'_>,
    name: &str,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if scene.bodies.is_empty() {
        return Ok(());
    }
    let message =
        format!("`{name}` is supported for a single body only, but the scene lists `bodies`");
    Err(path.diagnostic(&message))
}

/// Whether a requested quantity needs the null space of the grid. Refuses several bodies.
pub(crate) fn null_space(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<bool, Diagnostic> {
    let Some((path, name)) = first(evaluator, spec, RunFigure::is_of_null_space) else {
        return Ok(false);
    };
    refuse_several_bodies(&path, name, scene)?;
    Ok(true)
}

/// Whether a requested quantity needs the energy ledger, which assigns energy changes to the stages
/// of a step. Refuses scenes and studies for which the ledger is not implemented.
pub(crate) fn ledger(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<bool, Diagnostic> {
    let Some((path, name)) = first(evaluator, spec, RunFigure::is_of_ledger) else {
        return Ok(false);
    };
    refuse_several_bodies(&path, name, scene)?;
    if spec.critical.is_some() {
        let message = format!(
            "`{name}` is not supported with `critical`: the search for a limit has many runs"
        );
        return Err(path.diagnostic(&message));
    }
    if scene.plane == PlaneState::Axisymmetric {
        let message = "the energy ledger is not supported in `plane: axisymmetric`: it has no entry \
                       for the hoop stress";
        return Err(path.diagnostic(message));
    }
    refuse_law_without_energy(&path, scene)?;
    Ok(true)
}

/// Refuses the method at `path` if the energy ledger does not describe its steps.
pub(crate) fn refuse_unledgered(path: &SuitePath<'_>, method: &Method) -> Result<(), Diagnostic> {
    let Method::Mpm(MpmMethod { transfer, .. }) = method else { return Ok(()) };
    let path = path.then("mpm");
    if transfer.kind() == TransferKind::Cells {
        let message = format!(
            "the energy ledger is not supported with the transfer `{}`, which integrates over cells",
            transfer.name()
        );
        return Err(path.then("transfer").diagnostic(&message));
    }
    if method.averages_volume() {
        let message = "the energy ledger is not supported with `volume: averaged`: its force does not \
                       derive from a stored energy";
        let diagnostic = path.then("volume").diagnostic(message);
        return Err(diagnostic.with_help("use `particle` for a study of the energy"));
    }
    Ok(())
}
