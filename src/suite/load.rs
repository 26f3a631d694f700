//! From words to a suite: every number computed, every name resolved, the truth checked.

use super::{
    bar_limits,
    binder::{Binder, Parameter},
    cases, comparable, force, law,
    model::{ConvergencePlan, ReferencePlan, Scene, StudyPlan, Suite},
    path::Path,
    scene, size, truth,
    wording::shown,
    words::{
        ConvergenceWords, Head, InternalForceWords, ObserveWords, ReferenceWords, RefineWords,
        StudyName,
    },
    yaml::{Complaint, Ordered, Source, read},
};

/// Instants at which the error is taken unless a suite says otherwise.
const INSTANTS: u64 = 50;

impl Suite {
    /// Reads and checks a suite. No solver runs.
    ///
    /// # Errors
    /// A [`Complaint`] with the place of the first thing that is wrong.
    pub fn load(source: &Source) -> Result<Self, Complaint> {
        match study_of(source)? {
            StudyName::Convergence => convergence(source),
            StudyName::InternalForce => internal_force(source),
        }
    }
}

/// The kind of study, which decides what other keys are known.
fn study_of(source: &Source) -> Result<StudyName, Complaint> {
    read::<Head>(source).map(|head| head.study)
}

fn convergence(source: &Source) -> Result<Suite, Complaint> {
    let words: ConvergenceWords = read(source)?;
    let (binder, parameters) = Binder::new(source, &words.parameters, &words.functions)?;
    name(&binder, &words.suite)?;
    let scene = scene::scene(&binder, &words.scene)?;
    bar_limits::check(&binder, &words, &scene)?;
    let (cells, ppc) = refine(&binder, &words.refine, scene.dimension())?;
    let dt = binder.formula(&Path::top("run").then("dt"), &words.run.dt, &["h"])?;
    let instants = words.run.instants.as_ref().map_or(Ok(INSTANTS), |text| {
        binder.count(&Path::top("run").then("instants"), text, "the number of instants")
    })?;
    let until = cases::until(&binder, &words.run.until)?;
    let latest = until.iter().map(|(_, t)| *t).fold(0.0, f64::max);
    let exact = truth::exact(&binder, &words, &scene, latest)?;
    let dimension = scene.dimension();
    let reference = words.reference.as_ref().map(|words| reference(&binder, words, dimension));
    let reference = reference.transpose()?;
    law::check(&binder, &words, &scene)?;
    if exact.is_none() && reference.is_none() {
        let message = "no truth: a convergence study needs `exact`, `manufactured` or `reference`";
        return Err(binder.complain_key(&Path::top("suite"), message));
    }
    let observe = words.observe.as_ref().map(|words| observed(&binder, words, &scene));
    let scale = words.judge.scale.as_ref().map(|text| {
        binder.positive(&Path::top("judge").then("scale"), text, "the scale of the error")
    });
    let mut plan = ConvergencePlan {
        observe: observe.transpose()?,
        scene,
        exact,
        reference,
        cells,
        ppc,
        dt,
        instants,
        norm: words.judge.norm,
        of: words.judge.of,
        scale: scale.transpose()?,
        crossing_levels: words.judge.crossing_levels,
        cases: Vec::new(),
    };
    comparable::check(&binder, &words, &plan)?;
    size::check(&binder, &words, &plan)?;
    cases::check_steps(&binder, &plan, &until)?;
    plan.cases = cases::cases(&binder, &words, &plan, &until)?;
    binder.refuse_unused(&words.parameters, &words.functions)?;
    let head = [words.suite, words.title, words.source, words.about];
    Ok(assemble(head, parameters, &words.functions, StudyPlan::Convergence(Box::new(plan))))
}

fn internal_force(source: &Source) -> Result<Suite, Complaint> {
    let words: InternalForceWords = read(source)?;
    let (binder, parameters) = Binder::new(source, &words.parameters, &words.functions)?;
    name(&binder, &words.suite)?;
    let plan = force::plan(&binder, &words)?;
    binder.refuse_unused(&words.parameters, &words.functions)?;
    let head = [words.suite, words.title, words.source, words.about];
    Ok(assemble(head, parameters, &words.functions, StudyPlan::InternalForce(Box::new(plan))))
}

fn assemble(
    [name, title, source, about]: [String; 4],
    parameters: Vec<Parameter>,
    functions: &Ordered<String>,
    study: StudyPlan,
) -> Suite {
    let functions = functions.as_slice().to_vec();
    Suite { name, title, source, about, parameters, functions, study }
}

/// A name becomes part of test and file names.
fn name(binder: &Binder<'_>, name: &str) -> Result<(), Complaint> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.is_empty() && name.len() <= 64 && name.chars().all(plain) {
        return Ok(());
    }
    let complaint = binder.complain(&Path::top("suite"), "this is not a name for a suite");
    Err(complaint.with_label("expected lower-case letters, digits and hyphens, at most 64"))
}

fn refine(
    binder: &Binder<'_>,
    words: &RefineWords,
    dimension: usize,
) -> Result<(Vec<u64>, Option<u64>), Complaint> {
    let path = Path::top("refine");
    let at = |i: usize| binder.alternative(&path.then("cells"), i);
    let mut cells = Vec::new();
    for (i, text) in words.cells.as_slice().iter().enumerate() {
        let count = binder.count(&at(i), text, "the number of cells")?;
        if cells.contains(&count) {
            let message = format!("a level with {count} cells appears twice");
            return Err(binder.complain(&at(i), &message).with_label("the second time"));
        }
        cells.push(count);
    }
    cells.sort_unstable();
    let ppc_path = path.then("ppc");
    let ppc = words.ppc.as_ref().map(|text| {
        let ppc = binder.count(&ppc_path, text, "the number of particles per cell")?;
        super::dispatch::per_axis(ppc, dimension).ok_or_else(|| {
            let message = format!("{ppc} particles per cell cannot be equally spaced");
            let label = format!("expected n^{dimension} in {dimension}-D");
            binder.complain(&ppc_path, &message).with_label(&label)
        })?;
        Ok(ppc)
    });
    Ok((cells, ppc.transpose()?))
}

/// The place that is watched: one in the body.
fn observed(
    binder: &Binder<'_>,
    words: &ObserveWords,
    scene: &Scene,
) -> Result<Vec<f64>, Complaint> {
    let path = Path::top("observe").then("at");
    let place = binder.point(&path, &words.at, scene.dimension())?;
    for (axis, x) in place.iter().enumerate() {
        let (from, to) = (scene.from[axis], scene.to[axis]);
        if !(from..=to).contains(x) {
            let message = format!("{} is outside the body", shown(*x));
            let label = format!("expected a number from {} to {}", shown(from), shown(to));
            return Err(binder.complain(&path.then(axis), &message).with_label(&label));
        }
    }
    if scene.round.as_ref().is_some_and(|round| !round.holds(&place)) {
        let complaint = binder.complain(&path, "this place is outside the body");
        return Err(complaint.with_label("expected a place between the rims"));
    }
    Ok(place)
}

fn reference(
    binder: &Binder<'_>,
    words: &ReferenceWords,
    dimension: usize,
) -> Result<ReferencePlan, Complaint> {
    if dimension != 1 {
        let message = format!("the reference FEM is 1-D, the scene {dimension}-D");
        let complaint = binder.complain_key(&Path::top("reference"), &message);
        return Err(complaint.with_help("give this scene an `exact` solution"));
    }
    let path = Path::top("reference").then("fem");
    Ok(ReferencePlan {
        equation: words.equation,
        element: words.fem.element,
        mass: words.fem.mass,
        cells: binder.count(&path.then("cells"), &words.fem.cells, "the number of elements")?,
        dt: binder.formula(&path.then("dt"), &words.fem.dt, &["h"])?,
    })
}
