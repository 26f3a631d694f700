//! Keys and names that a suite contains.

use super::grammar::Node;
use serde_yaml::Value;

/// A key of a suite, or a key with a name.
pub(super) struct Word {
    pub(super) key: String,
    /// Name, if the value is one of several names.
    pub(super) name: Option<String>,
    /// Path of the number, if the value is a number.
    pub(super) number: Option<Place>,
}

/// Path from the top of the file: keys, and indices of list members.
pub(super) type Place = Vec<Value>;

/// Lists every key and name in a suite.
pub(super) fn words(grammar: &Node, study: &str, suite: &Value) -> Vec<Word> {
    let mut words = Vec::new();
    walk(grammar, suite, (study, ""), &mut Vec::new(), &mut words);
    words
}

fn walk(
    node: &Node,
    value: &Value,
    (study, key): (&str, &str),
    place: &mut Place,
    words: &mut Vec<Word>,
) {
    let choice =
        |name: &str| Word { key: shared(study, key), name: Some(name.to_owned()), number: None };
    match value {
        Value::Mapping(map) => {
            for (name, value) in map {
                let text = name.as_str().unwrap_or_default();
                let known = node.keys.iter().find(|(known, _)| known == text);
                if known.is_some() && node.is_choice {
                    words.push(choice(text));
                }
                let (below, key) = match (known, &node.named) {
                    (Some((_, below)), _) => (below, joined(key, text)),
                    (None, Some(below)) => (below.as_ref(), key.to_owned()),
                    // The expectation of a full run has the same keys.
                    (None, None) if text == "full" => (node, key.to_owned()),
                    (None, None) => continue,
                };
                place.push(name.clone());
                walk(below, value, (study, &key), place, words);
                place.pop();
            }
        }
        Value::Sequence(list) => {
            for (i, value) in list.iter().enumerate() {
                place.push(Value::from(i));
                // A key whose value is not a list may have a list of alternatives as its value.
                let below = node.member.as_deref().unwrap_or(node);
                walk(below, value, (study, key), place, words);
                place.pop();
            }
        }
        _ => match value.as_str().filter(|text| node.names.iter().any(|name| name == text)) {
            Some(name) => words.push(choice(name)),
            None if node.is_number => {
                let number = Some(place.clone());
                words.push(Word { key: shared(study, key), name: None, number });
            }
            None => {}
        },
    }
}

/// Returns the path of a key below another key.
pub(super) fn joined(key: &str, name: &str) -> String {
    if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") }
}

/// Returns the path of a key that several kinds of study, or several bodies, share.
pub(super) fn shared(study: &str, key: &str) -> String {
    let key = key.replace("scene.bodies.", "scene.");
    let first = key.split('.').next().unwrap_or(&key);
    // A gradient study has the problem and the levels of a convergence study.
    let is_of_convergence =
        study == "gradient" && ["exact", "equilibrium", "run", "refine"].contains(&first);
    let is_of_all = is_of_convergence || ["scene", "methods", "study"].contains(&first);
    if study == "convergence" || is_of_all || key.starts_with(study) {
        return key;
    }
    format!("{study}.{key}")
}

/// Change of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Change {
    Times(f64),
    /// Increases an integer by one.
    PlusOne,
}

impl Change {
    /// Describes the change, such as `1 %`, `x 2` or `+ 1`.
    pub(super) fn shown(self) -> String {
        match self {
            Self::PlusOne => "+ 1".to_owned(),
            Self::Times(factor) if (factor - 1.0).abs() < 0.2 => {
                let share = (1e6 * (factor - 1.0)).round() / 1e4;
                format!("{share} %")
            }
            Self::Times(factor) => format!("x {factor}"),
        }
    }

    fn of(self, value: &Value) -> Value {
        let text = serde_yaml::to_string(value).expect("YAML");
        let text = value.as_str().map_or(text.trim(), |formula| formula);
        match self {
            Self::Times(factor) => format!("{factor}*({text})").into(),
            // Some integers must not be formulas.
            Self::PlusOne => {
                value.as_u64().map_or_else(|| format!("1 + ({text})").into(), |n| (n + 1).into())
            }
        }
    }
}

/// Returns the text of a suite with the number at `place` changed.
pub(super) fn changed(suite: &Value, place: &Place, change: Change) -> String {
    let mut whole = suite.clone();
    let value = place.iter().fold(&mut whole, |value, step| match value {
        Value::Sequence(list) => &mut list[step.as_u64().expect("a number") as usize],
        Value::Mapping(map) => map.get_mut(step).expect("a key"),
        _ => panic!("no way through {value:?}"),
    });
    *value = change.of(value);
    serde_yaml::to_string(&whole).expect("YAML")
}
