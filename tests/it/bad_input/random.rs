//! Random typing errors: loading a suite with changed characters never panics.

use super::load;
use super::samples::{BAR, FORCE, PLATE};
use proptest::collection::vec;
use proptest::prelude::*;

/// Characters with a meaning in YAML or in formulas, and characters without one.
const KEYS: &str = "09.-+*/^()[]{}:,#'\"%&!|>~ \t\neXtLé\u{0}";

/// Replaces the character at `at` by `key`, inserts `key` before it, or removes it.
fn slip(text: &str, at: usize, key: char, kind: u8) -> String {
    let mut characters: Vec<char> = text.chars().collect();
    let at = at % characters.len();
    match kind % 3 {
        0 => drop(characters.remove(at)),
        1 => characters[at] = key,
        _ => characters.insert(at, key),
    }
    characters.into_iter().collect()
}

fn key() -> impl Strategy<Value = char> {
    prop::sample::select(KEYS.chars().collect::<Vec<_>>())
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(400)
    })]

    #[test]
    fn slips_never_panic(
        sound in prop::sample::select(vec![BAR, PLATE, FORCE]),
        slips in vec((any::<usize>(), key(), any::<u8>()), 1..6),
    ) {
        let wrong = slips.into_iter().fold(sound.to_owned(), |text, (at, key, kind)| {
            slip(&text, at, key, kind)
        });
        if let Err(diagnostic) = load(&wrong) {
            prop_assert!(diagnostic.to_string().contains("wrong.yaml"));
        }
    }
}
