//! What the FEM bar cannot do: refused before anything runs.

use crate::suite::{
    compile::{evaluator::Binder, path::Path, scene::boundary::Hold},
    grammar::ConvergenceWords,
    model::Scene,
    yaml::Complaint,
};

/// Refuses conditions that the bar does not know, if the suite asks for one.
pub(crate) fn check(
    binder: &Binder<'_>,
    words: &ConvergenceWords,
    scene: &Scene,
) -> Result<(), Complaint> {
    if !words.has_fem_reference() && words.fem_method().is_none() {
        return Ok(());
    }
    let path = Path::top("scene");
    let help = "remove the FEM, also as `reference`, or the condition";
    for face in &scene.faces {
        if matches!(face.hold, Hold::Periodic | Hold::Friction(_) | Hold::Velocity(_)) {
            let message = format!(
                "the {} face {}, and the FEM knows fixed and free ends only",
                face.name,
                face.hold.verb()
            );
            let at = path.then("boundary").then(face.name);
            return Err(binder.complain(&at, &message).with_help(help));
        }
    }
    if let Some(set) = scene.sets.iter().find(|set| set.velocity.is_some()) {
        let message = format!("the set `{}` is driven, which the FEM cannot do", set.name);
        let at = path.then("sets").then(set.name.as_str());
        return Err(binder.complain_key(&at, &message).with_help(help));
    }
    Ok(())
}
