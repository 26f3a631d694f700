//! Finds common words in the names of worse cases, as a hint to the cause.

use std::cmp::Reverse;
use std::collections::BTreeSet;

/// Two fractions must exceed this value: the fraction of worse cases among all cases with a word,
/// and the fraction of cases with a shared word among all worse cases.
const MOST: f64 = 0.5;

/// Minimum number of worse cases with a shared word.
const FEWEST: usize = 3;

/// A word with the number of worse cases, and of all cases, whose names contain it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SharedWord {
    pub(super) word: String,
    pub(super) worse: usize,
    pub(super) all: usize,
}

/// Finds words common to the names of several worse cases. Each of `cases` consists of the name
/// `SUITE::CASE`, and of a flag that is true if the case became worse.
///
/// Words in more worse cases come first, then words in fewer cases overall. A case counts only for
/// the first of its words. The result is empty if at most half of the worse cases have a shared
/// word.
pub(super) fn shared_words(cases: &[(&str, bool)]) -> Vec<SharedWord> {
    let words = |name: &str| -> BTreeSet<String> {
        let case = name.rsplit("::").next().unwrap_or_default();
        case.split('-').map(str::to_owned).collect()
    };
    let cases: Vec<_> = cases.iter().map(|(name, worse)| (words(name), *worse)).collect();
    let mut left: Vec<&BTreeSet<String>> =
        cases.iter().filter(|(_, worse)| *worse).map(|(words, _)| words).collect();
    let total = left.len();
    let mut found = Vec::new();
    loop {
        let known: BTreeSet<&String> = left.iter().copied().flatten().collect();
        let count = |word: &String| SharedWord {
            word: word.clone(),
            worse: left.iter().filter(|words| words.contains(word)).count(),
            all: cases.iter().filter(|(words, _)| words.contains(word)).count(),
        };
        let tells = |shared: &SharedWord| {
            // A word in the names of all cases does not distinguish the worse ones.
            shared.all < cases.len()
                && shared.worse >= FEWEST
                && shared.worse as f64 > MOST * shared.all as f64
        };
        let next = known.into_iter().map(count).filter(tells);
        let Some(next) = next.max_by_key(|shared| (shared.worse, Reverse(shared.all))) else {
            break;
        };
        left.retain(|words| !words.contains(&next.word));
        found.push(next);
    }
    let told = (total - left.len()) as f64 > MOST * total as f64;
    if told { found } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::one_transfer(&["linear-apic", "cubic-apic", "cpdi-apic"], &["linear-flip"], "apic 3 of 3")]
    #[case::most_of_them(
        &["linear-apic", "cubic-apic", "cpdi-apic", "linear-pic"], &["fem-apic"], "apic 3 of 4")]
    #[case::two_transfers(
        &["a-apic", "b-apic", "c-apic", "d-apic", "a-mls", "b-mls", "c-mls"], &["a", "b", "c", "d"],
        "apic 4 of 4, mls 3 of 3")]
    #[case::a_word_of_all(&["mpm-a", "mpm-b", "mpm-c"], &["mpm-d", "mpm-e", "mpm-f"], "")]
    #[case::a_word_of_all_among_mostly_worse(
        &["mpm-a-vs-x", "mpm-b-vs-x", "mpm-c-vs-x"], &["fem-d-vs-x", "fem-e-vs-x"], "mpm 3 of 3")]
    #[case::the_word_that_fewest_others_have(
        &["mpm-a-apic", "mpm-b-apic", "mpm-c-apic"], &["mpm-a-flip", "fem"], "apic 3 of 3")]
    #[case::too_few(&["linear-apic", "cubic-apic"], &["linear-flip"], "")]
    #[case::told_of_few(&["a-x", "b-x", "c-x", "d", "e", "f", "g"], &["a"], "")]
    #[case::none_worse(&[], &["a", "b"], "")]
    fn words(#[case] worse: &[&str], #[case] others: &[&str], #[case] expected: &str) {
        let named = |cases: &[&str]| -> Vec<String> {
            cases.iter().map(|case| format!("suite-apic::{case}")).collect()
        };
        let (worse, others) = (named(worse), named(others));
        let cases = worse.iter().map(|name| (name.as_str(), true));
        let cases: Vec<_> = cases.chain(others.iter().map(|name| (name.as_str(), false))).collect();
        let said: Vec<String> = shared_words(&cases)
            .iter()
            .map(|SharedWord { word, worse, all }| format!("{word} {worse} of {all}"))
            .collect();
        assert_eq!(said.join(", "), expected);
    }
}
