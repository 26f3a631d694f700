//! The grammar of a suite, derived from error messages: an invalid value is inserted at a path, and
//! the error lists the allowed keys or names. Every name therefore comes from its registration.

use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use serde_yaml::Value;

/// A name that is not registered and not similar to a registered name.
const STRANGE: &str = "qqqqqqqq";
const STRANGER: &str = "jjjjjjjj";

/// Kinds of study.
pub(super) const STUDIES: [&str; 5] =
    ["convergence", "stability", "internal_force", "gradient", "spectrum"];

/// Keys of the whole file for which the author chooses the sub-keys.
const OF_AUTHORS: [&str; 2] = ["parameters", "functions"];

/// All allowed values at one path.
#[derive(Debug, Default)]
pub(super) struct Node {
    /// Whether the value may be a number.
    pub(super) is_number: bool,
    /// Keys of a map, or names that have settings, each with its node.
    pub(super) keys: Vec<(String, Node)>,
    /// Whether the keys are names to choose from.
    pub(super) is_choice: bool,
    /// Allowed names that have no settings.
    pub(super) names: Vec<String>,
    /// Node of the values of a map whose keys the author chooses.
    pub(super) named: Option<Box<Node>>,
    /// Node of the members of a list.
    pub(super) member: Option<Box<Node>>,
}

/// A step of a path: a key, or the only member of a list.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step<'a> {
    Key(&'a str),
    Member,
}

impl Node {
    /// Derives the grammar of a kind of study.
    pub(super) fn of_study(study: &str) -> Self {
        let (text, top) = (base(study), format!("study: {study}\n{STRANGE}: 1\n"));
        let keys = listed(&refusal(&top), "possible keys: ").expect("the keys of a suite");
        let node = |key: String| {
            let known = OF_AUTHORS.contains(&key.as_str()).then(Self::default);
            let node = known.unwrap_or_else(|| Self::at(&text, &[Step::Key(&key)]));
            (key, node)
        };
        Self { keys: keys.into_iter().map(node).collect(), ..Self::default() }
    }

    /// Derives the values that are allowed at `path` of the suite `base`.
    fn at(base: &Value, path: &[Step<'_>]) -> Self {
        let answer = |text: &str| {
            let value = serde_yaml::from_str(text).expect("YAML");
            let text = serde_yaml::to_string(&put(base.clone(), path, value)).expect("YAML");
            refusal(&text)
        };
        let then = |step: Step<'_>| Self::at(base, &[path, &[step]].concat());
        let map = answer(&format!("{{{STRANGE}: {{{STRANGER}: 0}}}}"));
        let about = |name: &str| map.message().contains(&format!("`{name}`"));
        let word = answer(STRANGE);
        // A name alone is refused, unless a number is allowed: it is then a formula.
        let is_refused = word.message().contains(STRANGE);
        let names = listed(&word, "possible names: ").filter(|_| is_refused);
        let mut names = names.unwrap_or_default();
        let is_number = |found: &Diagnostic| {
            let message = found.message();
            ["a finite number", "a number, a formula", "a time step", "a whole number"]
                .iter()
                .any(|known| message.starts_with(&format!("expected {known}")))
        };
        let mut node = Self::default();
        if about(STRANGER) {
            node.named = Some(Box::new(then(Step::Key(STRANGE))));
        } else if is_number(&map) {
            let flat = answer(&format!("{{{STRANGE}: 0}}"));
            node.is_number = is_number(&flat);
            if !node.is_number {
                node.named = Some(Box::new(Self { is_number: true, ..Self::default() }));
            }
        } else if map.message() == "expected a list, found a map (`key: value`)" {
            node.member = Some(Box::new(then(Step::Member)));
        } else if !about(STRANGE) {
            // The value is neither a map nor a name with settings.
        } else if let Some(keys) = listed(&map, "possible keys: ") {
            // If the value may be a map or a number, the name is parsed as a formula.
            node.is_number = !word.message().starts_with("expected a map");
            // The expectation of a full run has the same keys.
            let keys = keys.into_iter().filter(|key| key != "full");
            node.keys = keys.map(|key| (key.clone(), then(Step::Key(&key)))).collect();
        } else if let Some(with_settings) = listed(&map, "possible names: ") {
            names.extend(with_settings);
            names.sort();
            names.dedup();
            for name in std::mem::take(&mut names) {
                match then(Step::Key(&name)) {
                    Self {
                        is_number: false,
                        member: None,
                        named: None,
                        keys,
                        names: alone,
                        ..
                    } if keys.is_empty() && alone.is_empty() => {
                        names.push(name);
                    }
                    settings => node.keys.push((name, settings)),
                }
            }
            node.is_choice = true;
        }
        node.is_choice |= !names.is_empty();
        Self { names, ..node }
    }
}

/// Returns a valid suite of the kind. Other keys of its scene are read after the tested key.
fn base(study: &str) -> Value {
    let scene = "scene: {dimension: 1, body: {box: {from: [0], to: [1]}}, material: \
                 {linear_elastic: {young: 100, poisson: 0, density: 1}}}\n";
    let methods = "methods: [{mpm: {basis: linear, transfer: flip, scheme: musl}}]\n";
    let rest = match study {
        "convergence" => {
            format!(
                "{scene}{methods}run: {{until: 1, dt: 1e-3}}\nrefine: {{cells: [8, 16], ppc: 4}}\n"
            )
        }
        "stability" => format!(
            "{scene}{methods}parameters: {{C: 1}}\nparticles: {{cells: 4, ppc: 4}}\n\
             run: {{dt: C, steps: 9}}\nsweep: {{C: [1]}}\n"
        ),
        "spectrum" => format!(
            "{scene}{methods}particles: {{cells: 4, ppc: 2}}\n\
             spectrum: {{cells_per_wavelength: 4, courant: 0.4}}\n"
        ),
        "gradient" => format!(
            "{scene}parameters: {{E: 1}}\nexact: {{equation: corotated, displacement: [t]}}\n\
             gradient: {{of: kinetic_energy, with_respect_to: {{young: E}}}}\n\
             run: {{until: 1, dt: 1e-3}}\nrefine: {{cells: [8, 16], ppc: 4}}\n"
        ),
        _ => "internal_force: {cell: 1, ppc: 4, volume: 0.25, stress: 1, positions: 16, \
              prediction: n_left}\nmethods: [{mpm: {basis: linear}}]\n"
            .to_owned(),
    };
    let text = format!("suite: a\nstudy: {study}\ntitle: t\nsource: s\n{rest}");
    serde_yaml::from_str(&text).expect("YAML")
}

/// Inserts `value` into `whole` at `path`. Sibling keys are kept only at the top level and in the
/// scene.
fn put(whole: Value, path: &[Step<'_>], value: Value) -> Value {
    let Some((first, rest)) = path.split_first() else { return value };
    match first {
        Step::Member => Value::Sequence(vec![put(Value::Null, rest, value)]),
        Step::Key(key) => {
            let mut map = match whole {
                Value::Mapping(map) => map,
                _ => serde_yaml::Mapping::new(),
            };
            let below = map.remove(*key).filter(|_| *key == "scene").unwrap_or(Value::Null);
            map.insert((*key).into(), put(below, rest, value));
            Value::Mapping(map)
        }
    }
}

/// Returns the diagnostic of an invalid suite.
fn refusal(text: &str) -> Diagnostic {
    let source = Source::from_text("keys.yaml", text).unwrap_or_else(|found| panic!("{found}"));
    let found = Suite::load(&source).err();
    found.unwrap_or_else(|| Diagnostic::about("keys.yaml", "nothing is wrong"))
}

/// Returns the names in a list after the text `before` in the help of a diagnostic.
fn listed(found: &Diagnostic, before: &str) -> Option<Vec<String>> {
    let list = found.help()?.strip_prefix(before)?;
    Some(list.split('`').skip(1).step_by(2).map(str::to_owned).collect())
}
