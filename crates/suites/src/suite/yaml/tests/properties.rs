//! Property tests: no text causes a panic, and diagnostics are printable.

use super::{SAMPLE, Suite};
use crate::suite::yaml::{Source, Step, read};
use proptest::prelude::*;
use serde_yaml::Value;

fn survives(text: &str) {
    let outcome = Source::from_text("any.yaml", text).and_then(|source| {
        source.value_at(&["suite".into()]);
        source.within(&["scene".into()], 0..3);
        read::<Suite>(&source)
    });
    if let Err(diagnostic) = outcome {
        let shown = diagnostic.to_string();
        assert!(shown.starts_with("error: "));
        assert!(shown.contains("--> any.yaml"));
        assert!(!diagnostic.one_line().contains('\n'));
    }
}

fn yaml_like() -> impl Strategy<Value = String> {
    let token = prop_oneof![
        8 => prop::sample::select(vec![
            "a", "b: ", "c:", "- ", "-", "? ", ": ", ":", ", ", "[", "]", "{", "}", "\"", "'", "#",
            " # ", "|", "|-\n", ">2\n", "!", "%", "\t", "\n", "\n ", "\n  ", "\n    ", "\r\n", "é",
            "\\", "''", "1", ".nan", "~", "---", "...", "\n---\n", "x y", "<<: ", "😀", "%YAML 1.2\n", "%é",
        ]).prop_map(str::to_owned),
        1 => "[a-c]{1,3}",
    ];
    prop::collection::vec(token, 0..40).prop_map(|tokens| tokens.concat())
}

fn mutated() -> impl Strategy<Value = String> {
    let change = (any::<prop::sample::Index>(), 0usize..6, yaml_like());
    prop::collection::vec(change, 1..4).prop_map(|changes| {
        let mut chars: Vec<char> = SAMPLE.chars().collect();
        for (at, length, new) in changes {
            let start = at.index(chars.len() + 1);
            let end = (start + length).min(chars.len());
            chars.splice(start..end, new.chars().take(4));
        }
        chars.into_iter().collect()
    })
}

fn is_finite(value: &Value) -> bool {
    match value {
        Value::Mapping(map) => map.values().all(is_finite),
        Value::Sequence(list) => list.iter().all(is_finite),
        Value::Number(number) => number.as_f64().is_none_or(f64::is_finite),
        _ => true,
    }
}

fn paths(value: &Value, path: &mut Vec<Step>, all: &mut Vec<Vec<Step>>) {
    match value {
        Value::Mapping(map) => {
            for (key, value) in map {
                let Some(key) = key.as_str() else { continue };
                path.push(key.into());
                paths(value, path, all);
                path.pop();
            }
        }
        Value::Sequence(list) => {
            for (index, value) in list.iter().enumerate() {
                path.push(index.into());
                paths(value, path, all);
                path.pop();
            }
        }
        Value::Null => {}
        _ => all.push(path.clone()),
    }
}

/// Whether the message refuses YAML that suites may not use, or text that only YAML 1.1 allows.
fn refused_on_purpose(message: &str) -> bool {
    let reasons = "not supported|second document|not allowed|tab used|expected a finite number|\
                   expected a name as key|given twice|not closed before line|needs more indentation|\
                   expected a blank|expected a space|expected `:` after the key|before the comment|\
                   directives|not valid YAML|plain scalar cannot start with|\
                   block of text is unclear|this quote is";
    reasons.split('|').any(|reason| message.contains(reason))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_text_panics(texts in (any::<String>(), yaml_like(), mutated())) {
        for text in [texts.0, texts.1, texts.2] {
            survives(&text);
        }
    }

    /// The parser of positions refuses only unsupported features and text that YAML 1.2 does not
    /// allow, and finds every scalar that the parser of values finds.
    #[test]
    fn both_parsers_agree(text in prop_oneof![yaml_like(), mutated()]) {
        if let Ok(value) = serde_yaml::from_str::<Value>(&text) {
            match Source::from_text("any.yaml", text.as_str()) {
                Err(diagnostic) => prop_assert!(refused_on_purpose(diagnostic.message()), "{diagnostic}"),
                Ok(source) if source.is_empty() => {}
                Ok(source) => {
                    prop_assert!(is_finite(&value), "{value:?}");
                    let mut all = Vec::new();
                    paths(&value, &mut Vec::new(), &mut all);
                    for path in all {
                        let place = source.value_at(&path).expect("the value is there");
                        prop_assert!(source.scalar_at(place.bytes().start).is_some(), "{path:?}");
                    }
                }
            }
        }
    }

    /// Parts of a verbatim text are located correctly in any quotation style.
    #[test]
    fn part_of_a_formula_is_located(
        style in prop::sample::select(vec!["", "'", "\""]),
        words in "[a-zé][a-z0-9*/()+é]{0,12}[a-z)]",
        from in 0usize..14,
    ) {
        let from = (0..=from.min(words.len())).rfind(|at| words.is_char_boundary(*at)).unwrap();
        let text = format!("k:  [{style}{words}{style}, 1]");
        let source = Source::from_text("any.yaml", text.as_str()).unwrap();
        let place = source.within(&["k".into(), 0.into()], from..words.len()).unwrap();
        prop_assert_eq!(&text[place.bytes()], &words[from..]);
    }
}
