//! Positions at which the error is judged: the box `judge.within` to which errors are restricted,
//! and the observed point. Faces that cannot affect the solution in the box are left out.
//!
//! The stated solution may violate the condition on a face if no elastic wave from that face
//! reaches the box during the run. The solution in the box then depends only on initial data.

use crate::exact::{Face, Problem, Survey};
use crate::suite::compile::scene::outline;
use crate::suite::compile::study::StudyDraft;
use crate::suite::evaluator::{Evaluator, SuitePath, shown};
use crate::suite::grammar::ObserveSpec;
use crate::suite::model::Scene;
use crate::suite::yaml::Diagnostic;
use crate::verify::{JudgedBox, format_number};

const MOTION: &str = "state the solution under `exact`, or remove `within`";

pub(crate) fn places(
    draft: &StudyDraft<'_>,
    exact: Option<&Problem>,
) -> Result<(Option<JudgedBox>, Option<Vec<f64>>), Diagnostic> {
    let observe = draft.spec.observe.as_ref().map(|spec| observed(draft, spec)).transpose()?;
    let within = judged_box(draft, exact)?;
    if let (Some(within), Some(place)) = (&within, &observe)
        && !within.holds(place)
    {
        let path = draft.evaluator.top("observe.at");
        let diagnostic = path.diagnostic("the observed point is outside `judge.within`");
        return Err(diagnostic.with_label(&format!("expected a point in {}", within.words())));
    }
    Ok((within, observe))
}

fn judged_box(
    StudyDraft { evaluator, spec, scene }: &StudyDraft<'_>,
    exact: Option<&Problem>,
) -> Result<Option<JudgedBox>, Diagnostic> {
    let Some(stated) = &spec.judge.within else { return Ok(None) };
    let path = evaluator.top("judge.within");
    let (from, to) = outline::corners(&path, stated, scene.dimension())?;
    refuse_outside(&path.then("from"), scene, &from)?;
    refuse_outside(&path.then("to"), scene, &to)?;
    let refuse = |message: &str, help: &str| path.refuse_key(message, help);
    if spec.judge.of.is_sum() {
        let of = spec.judge.of.words();
        let message = format!("`within` is not supported for the {of}, a sum over the whole body");
        return refuse(&message, "judge a field such as `stress`, or remove `within`");
    }
    if spec.exact.is_none() || spec.reference.is_some() {
        return refuse("`within` needs a motion that is stated under `exact`", MOTION);
    }
    let Some(exact) = exact.filter(|exact| exact.heat.is_none()) else {
        return refuse(
            "`within` is not supported with `heat`: heat from every face reaches the box at once",
            MOTION,
        );
    };
    if scene.outline.is_some() || !exact.bodies.is_empty() {
        let message = "`within` is supported for a single body of kind `box` only";
        return refuse(message, "use `body: {box: ...}`, or remove `within`");
    }
    Ok(Some(JudgedBox { from, to }))
}

fn observed(draft: &StudyDraft<'_>, spec: &ObserveSpec) -> Result<Vec<f64>, Diagnostic> {
    let (path, scene) = (draft.evaluator.top("observe.at"), &draft.scene);
    let place = path.point(&spec.at, scene.dimension())?;
    refuse_outside(&path, scene, &place)?;
    let outside = scene.outline.as_ref().filter(|outline| !outline.holds(&place));
    if let Some(kind) = outside.map(|outline| outline.kind()) {
        return path.expected(&format!("a point in the {kind}"), "this point is outside the body");
    }
    Ok(place)
}

fn refuse_outside(path: &SuitePath<'_>, scene: &Scene, place: &[f64]) -> Result<(), Diagnostic> {
    for (axis, x) in place.iter().enumerate() {
        let (low, high) = (scene.from[axis], scene.to[axis]);
        if !(low..=high).contains(x) {
            let message = format!("{} is outside the body", shown(*x));
            let label = format!("expected a number from {} to {}", shown(low), shown(high));
            return Err(path.then(axis).diagnostic(&message).with_label(&label));
        }
    }
    Ok(())
}

/// Returns `exact` without the faces whose condition the motion violates. Refuses a box that a wave
/// from such a face reaches before the end of the run.
pub(crate) fn without_distant_faces(
    evaluator: &Evaluator<'_>,
    within: &JudgedBox,
    exact: Problem,
    survey: &Survey,
) -> Result<Problem, Diagnostic> {
    let violates = |face: &usize| exact.violation_on_face(*face, survey).is_some();
    let violated: Vec<usize> = (0..exact.faces.len()).filter(violates).collect();
    let reach = exact.wave_speed() * exact.until;
    for number in &violated {
        let Face { name, axis, high, .. } = exact.faces[*number];
        let (corner, distance) = if high {
            ("to", exact.to[axis] - within.to[axis])
        } else {
            ("from", within.from[axis] - exact.from[axis])
        };
        if !(distance >= reach) {
            let message = format!(
                "the box is {} m from the {name} face, whose condition the solution violates, and \
                 an elastic wave from this face travels {} m in {} s at {} m/s",
                format_number(distance),
                format_number(reach),
                format_number(exact.until),
                format_number(exact.wave_speed()),
            );
            let at = evaluator.top("judge.within").then(corner).then(axis);
            let label = format!("expected a distance of at least {} m", format_number(reach));
            let diagnostic = at.diagnostic(&message).with_label(&label);
            return Err(diagnostic.with_help("shorten the run, or move the box away from the face"));
        }
    }
    let is_satisfied = |(number, _): &(usize, &Face)| !violated.contains(number);
    let satisfied = exact.faces.iter().enumerate().filter(is_satisfied);
    let faces = satisfied.map(|(_, face)| face.clone()).collect();
    Ok(Problem { faces, ..exact })
}
