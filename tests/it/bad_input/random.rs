//! Random typing errors: loading a suite with one changed character never panics.

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
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn one_slip_never_panics(
        sound in prop::sample::select(vec![BAR, PLATE, FORCE]),
        at in any::<usize>(),
        key in key(),
        kind in any::<u8>(),
    ) {
        if let Err(diagnostic) = load(&slip(sound, at, key, kind)) {
            prop_assert!(diagnostic.to_string().contains("wrong.yaml"));
        }
    }

    #[test]
    fn several_slips_never_panic(slips in vec((any::<usize>(), key(), any::<u8>()), 2..6)) {
        let wrong = slips.into_iter().fold(BAR.to_owned(), |text, (at, key, kind)| {
            slip(&text, at, key, kind)
        });
        if let Err(diagnostic) = load(&wrong) {
            prop_assert!(diagnostic.to_string().contains("wrong.yaml"));
        }
    }
}
