//! Converts entries of `methods` to named methods, one for each combination of list values.

use crate::exact::Equation;
use crate::fem::{BarLaw, Sampling};
use crate::mpm::input::MpmMethod;
use crate::mpm::{FrameName, MassName, MaterialPlan, TransferName, VolumeName};
use crate::subject::{HIGHEST_ORDER, LONGEST_NAME, Precision, Start, is_solver_name};
use crate::suite::evaluator::{Evaluator, SuitePath, shown};
use crate::suite::grammar::{EquationName, MethodSpec, TransferSpec};
use crate::suite::model::method::Method;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany};
use std::collections::BTreeMap;

/// A method of a study, which is the first part of the names of its cases.
pub(crate) struct NamedMethod {
    entry: usize,
    pub(crate) method: Method,
    /// Name of the solver; `None` for built-in methods.
    pub(crate) solver: Option<String>,
    /// Whether each setting appears in the name, in the order of [`settings`].
    said: Vec<bool>,
}

/// Compiles the entries of `methods`, one method for each combination of list values. `material`
/// determines the default law of FEM cases. There may be at most `most` cases, `of_each_method` for
/// each method.
pub(crate) fn methods(
    evaluator: &Evaluator<'_>,
    specs: &[MethodSpec],
    material: &MaterialPlan,
    most: usize,
    of_each_method: usize,
) -> Result<Vec<NamedMethod>, Diagnostic> {
    // Materials without an FEM law are refused later.
    let own_law = law_of_bar(material).unwrap_or_default();
    // Too many combinations are refused before they are computed.
    let mut all = 0_usize;
    for (entry, spec) in specs.iter().enumerate() {
        let count = lengths(spec, own_law).into_iter().fold(1, usize::saturating_mul);
        all = all.saturating_add(count.saturating_mul(of_each_method));
        if all > most {
            let message = format!("these lists give {all} cases");
            let diagnostic = evaluator.top("methods").then(entry).diagnostic(&message);
            return Err(diagnostic.with_label(&format!("expected at most {most} in a suite")));
        }
    }
    let mut drafts = Vec::new();
    for (entry, spec) in specs.iter().enumerate() {
        drafts.extend(combinations(evaluator, entry, spec, own_law)?);
    }
    named(evaluator, drafts)
}

pub(crate) fn law_of_bar(material: &MaterialPlan) -> Option<EquationName> {
    let name = Equation::of_material(material.name(), |key| material.parameter(key))?.name();
    BarLaw::find(name).and(EquationName::find(name))
}

impl NamedMethod {
    pub(crate) fn path<'a>(&self, evaluator: &'a Evaluator<'a>) -> SuitePath<'a> {
        evaluator.top("methods").then(self.entry)
    }

    pub(crate) fn name(&self) -> String {
        let (subject, settings) = settings(&self.method);
        let subject = self.solver.as_deref().unwrap_or(subject);
        let said = settings.iter().zip(&self.said).filter(|(_, said)| **said);
        let parts = said.map(|(setting, _)| format!("-{}", setting.replace('_', "-")));
        parts.fold(subject.to_owned(), |name, part| name + &part)
    }
}

/// Returns the first part of the name of `method`, and the settings that may follow, in order.
fn settings(method: &Method) -> (&'static str, Vec<String>) {
    match *method {
        Method::Mpm(method) => {
            let always = [method.scheme.name(), method.start.name(), method.mass.name()];
            let others = [method.frame.name(), method.volume.name(), method.precision.name()];
            let mut settings = vec![method.basis.name().to_owned(), method.transfer.name()];
            settings.extend(always.into_iter().chain(others).map(ToOwned::to_owned));
            ("mpm", settings)
        }
        Method::QuasiStatic { basis, .. } => {
            ("mpm", vec![basis.name().to_owned(), "quasi_static".to_owned()])
        }
        Method::Heat { basis } => ("heat", vec![basis.name().to_owned()]),
        // An external method is named after its solver.
        Method::External { .. } => ("external", Vec::new()),
        Method::Fem { element, mass, law, start, sampling } => {
            let settings = [element.name(), mass.name(), law.name(), start.name(), sampling.name()];
            ("fem", settings.map(ToOwned::to_owned).to_vec())
        }
    }
}

/// Compiles entry number `entry` to methods, one for each combination of list values. A setting
/// appears in the name if the entry lists several values, or if the setting has no default.
fn combinations(
    evaluator: &Evaluator<'_>,
    entry: usize,
    spec: &MethodSpec,
    own_law: EquationName,
) -> Result<Vec<NamedMethod>, Diagnostic> {
    let path = evaluator.top("methods").then(entry);
    let (mut solver, mut order) = (None, 2.0);
    // The first `shown` settings have no default.
    let shown = match spec {
        MethodSpec::Mpm { .. } if spec.is_quasi_static() => {
            refuse_keys_of_dynamics(&path.then("mpm"), spec)?;
            2
        }
        MethodSpec::Mpm { transfer: None, .. } => {
            let message = "a scheme with time steps needs a `transfer`";
            return path.then("mpm").refuse_key(message, "add `transfer: flip` in `mpm`");
        }
        MethodSpec::Mpm { .. } => 3,
        MethodSpec::Heat { .. } => 1,
        MethodSpec::Fem { .. } => 2,
        MethodSpec::External { name, formal_order, .. } => {
            let path = path.then("external");
            order = stated_order(&path, formal_order.as_ref())?;
            solver = Some(solver_name(&path, name)?);
            0
        }
    };
    let lengths = lengths(spec, own_law);
    let is_said = |(k, length): (usize, &usize)| k < shown || *length > 1;
    let said: Vec<bool> = lengths.iter().enumerate().map(is_said).collect();
    let method = |number| {
        let mut method = method(spec, own_law, &mut Combination { number, lengths: Vec::new() });
        if let Method::External { formal_order, .. } = &mut method {
            *formal_order = order;
        }
        NamedMethod { entry, method, solver: solver.clone(), said: said.clone() }
    };
    Ok((0..lengths.iter().product()).map(method).collect())
}

/// Returns the method with one value of each list. An external method gets a preliminary order.
fn method(spec: &MethodSpec, own_law: EquationName, values: &mut Combination) -> Method {
    match spec {
        MethodSpec::Mpm { basis, transfer, scheme, start, mass, frame, volume, precision } => {
            let precision = values.one_of(precision.as_ref(), Precision::Double);
            let volume = values.one_of(volume.as_ref(), VolumeName::Particle);
            let frame = values.one_of(frame.as_ref(), FrameName::Updated);
            let mass = values.one_of(mass.as_ref(), MassName::Lumped);
            let start = values.one_of(start.as_ref(), Start::AtZero);
            let scheme = values.next(scheme).explicit();
            let transfer =
                values.one_of(transfer.as_ref(), TransferSpec(TransferName::Flip.into())).0;
            let basis = values.next(basis);
            let Some(scheme) = scheme else { return Method::QuasiStatic { basis, load_steps: 1 } };
            Method::Mpm(MpmMethod {
                basis,
                transfer,
                scheme,
                start,
                mass,
                frame,
                volume,
                precision,
            })
        }
        MethodSpec::Heat { basis } => Method::Heat { basis: values.next(basis) },
        MethodSpec::Fem { element, mass, law, start, sampling } => Method::Fem {
            sampling: values.one_of(sampling.as_ref(), Sampling::Inside),
            start: values.one_of(start.as_ref(), Start::AtZero),
            law: values.one_of(law.as_ref(), own_law),
            mass: values.next(mass),
            element: values.next(element),
        },
        MethodSpec::External { precision, .. } => {
            Method::External { formal_order: 2.0, precision: precision.unwrap_or_default() }
        }
    }
}

fn refuse_keys_of_dynamics(path: &SuitePath<'_>, spec: &MethodSpec) -> Result<(), Diagnostic> {
    let MethodSpec::Mpm { basis: _, transfer, scheme, start, mass, frame, volume, precision } =
        spec
    else {
        return Ok(());
    };
    let own = "list the other schemes in a separate entry of `methods`";
    if scheme.as_slice().len() > 1 {
        let message = "`quasi_static` cannot be listed with time-stepping schemes: only `basis` \
                       applies to both";
        return path.then("scheme").refuse_key(message, own);
    }
    let refused = [
        ("transfer", transfer.is_some(), "there are no velocities to transfer"),
        ("start", start.is_some(), "there is no initial velocity"),
        ("mass", mass.is_some(), "there is no inertia"),
        ("frame", frame.is_some(), "load steps are updated-Lagrangian"),
        ("volume", volume.is_some(), "the tangent of an averaged volume is not implemented"),
        ("precision", precision.is_some(), "load steps are computed in double precision"),
    ];
    match refused.into_iter().find(|(_, is_stated, _)| *is_stated) {
        Some((key, _, reason)) => {
            let message = format!("`quasi_static` does not support `{key}`: {reason}");
            path.then(key).refuse_key(&message, "remove it")
        }
        None => Ok(()),
    }
}

/// Returns the number of values of each setting, in the order of [`settings`].
fn lengths(spec: &MethodSpec, own_law: EquationName) -> Vec<usize> {
    let mut first = Combination { number: 0, lengths: Vec::new() };
    method(spec, own_law, &mut first);
    first.lengths.reverse();
    first.lengths
}

/// A combination of list values. Those of the list that is read first vary fastest.
struct Combination {
    number: usize,
    /// Lengths of the lists that have been read.
    lengths: Vec<usize>,
}

impl Combination {
    fn next<T: Copy>(&mut self, list: &OneOrMany<T>) -> T {
        let list = list.as_slice();
        let value = list[self.number % list.len()];
        self.number /= list.len();
        self.lengths.push(list.len());
        value
    }

    /// Returns the next value of an optional list, or `default` if the list is absent.
    fn one_of<T: Copy>(&mut self, list: Option<&OneOrMany<T>>, default: T) -> T {
        let Some(list) = list else {
            self.lengths.push(1);
            return default;
        };
        self.next(list)
    }
}

/// Assigns final names to the methods. Refuses an empty list and duplicate methods.
fn named(
    evaluator: &Evaluator<'_>,
    mut drafts: Vec<NamedMethod>,
) -> Result<Vec<NamedMethod>, Diagnostic> {
    let path = evaluator.top("methods");
    if drafts.is_empty() {
        return Err(path.diagnostic("the suite has no cases: `methods` is empty"));
    }
    while say_differences(&mut drafts) {}
    let names: Vec<String> = drafts.iter().map(NamedMethod::name).collect();
    if let Some(i) = (1..names.len()).find(|i| names[..*i].contains(&names[*i])) {
        let message = format!("the case `{}` appears twice", names[i]);
        let diagnostic = path.then(drafts[i].entry).diagnostic(&message);
        return Err(diagnostic.with_label("the second time"));
    }
    Ok(drafts)
}

/// Adds differing settings to equal names, and returns whether a name has changed. A new name may
/// equal another one, so the caller repeats the call.
fn say_differences(drafts: &mut [NamedMethod]) -> bool {
    let mut of_one_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, draft) in drafts.iter().enumerate() {
        of_one_name.entry(draft.name()).or_default().push(i);
    }
    let mut longer = false;
    for same in of_one_name.values().filter(|same| same.len() > 1) {
        let all: Vec<_> = same.iter().map(|i| settings(&drafts[*i].method).1).collect();
        for k in 0..all[0].len() {
            if all.iter().any(|settings| settings[k] != all[0][k]) {
                for i in same {
                    longer |= !drafts[*i].said[k];
                    drafts[*i].said[k] = true;
                }
            }
        }
    }
    longer
}

fn solver_name(path: &SuitePath<'_>, name: &str) -> Result<String, Diagnostic> {
    if is_solver_name(name) {
        return Ok(name.to_owned());
    }
    let diagnostic = path.then("name").diagnostic("this is not a name for a solver");
    let label = format!("expected up to {LONGEST_NAME} letters, digits, `-`, `_` or `.`");
    Err(diagnostic.with_label(&label))
}

fn stated_order(path: &SuitePath<'_>, text: Option<&NumberText>) -> Result<f64, Diagnostic> {
    let (Some(text), path) = (text, path.then("formal_order")) else { return Ok(2.0) };
    let order = path.positive(text, "the formal order")?;
    if order <= HIGHEST_ORDER {
        return Ok(order);
    }
    let message = format!("the formal order is {}", shown(order));
    path.expected(&format!("one up to {HIGHEST_ORDER}"), &message)
}
