//! Finds the known name that is most similar to a misspelt one.

use strsim::damerau_levenshtein;

/// Maximum length of names that are compared. Longer names are not typing errors, and the cost of a
/// comparison is proportional to the product of both lengths.
const LONGEST: usize = 64;

/// One typing error is allowed per this number of letters.
const LETTERS: usize = 3;

/// Returns the nearest of the `known` names, if it is close enough. The first one is returned if
/// several are equally near.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    by_nearness(name, known).into_iter().next().filter(|known| is_near(name, known))
}

/// Sorts the `known` names by their distance from `name`, nearest first.
pub fn by_nearness<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut known: Vec<&str> = known.into_iter().collect();
    if name.len() <= LONGEST {
        known.sort_by_cached_key(|known| distance(name, known));
    }
    known
}

fn is_near(name: &str, known: &str) -> bool {
    let letters = name.chars().count().max(known.chars().count());
    name.len() <= LONGEST && distance(name, known) <= letters / LETTERS
}

/// Counts the typing errors between two names. Differences in capitals, spaces and hyphens do not
/// count.
fn distance(name: &str, known: &str) -> usize {
    let plain = |name: &str| name.to_lowercase().replace(['-', ' '], "_");
    damerau_levenshtein(&plain(name), &plain(known))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    const BARS: [&str; 4] = ["vibrating-bar-long", "vibrating-bar-of-two", "vibrating-bar", "bar"];

    #[rstest]
    #[case::not_the_first_that_is_near("vibratin-bar", Some("vibrating-bar"))]
    #[case::letters_swapped("vibrating-bra", Some("vibrating-bar"))]
    #[case::capitals_and_hyphens("Vibrating_Bar_Long", Some("vibrating-bar-long"))]
    #[case::one_letter_of_three("far", Some("bar"))]
    #[case::two_letters_of_three("fur", None)]
    #[case::nothing("", None)]
    fn the_nearest_name(#[case] name: &str, #[case] wanted: Option<&str>) {
        assert_eq!(nearest(name, BARS), wanted);
    }

    #[test]
    fn single_letters_are_no_misspellings_of_each_other() {
        assert_eq!(nearest("y", ["x"]), None);
        assert_eq!(nearest("x", ["X"]), Some("X"));
    }

    #[test]
    fn long_names_have_no_suggestion() {
        let name = "a".repeat(65);
        assert_eq!(nearest(&name, [name.as_str()]), None);
    }

    #[test]
    fn all_names_in_order() {
        let sorted = by_nearness("rhoo", ["young", "L", "rho", "rho0"]);
        assert_eq!(sorted, ["rho", "rho0", "L", "young"]);
    }
}
