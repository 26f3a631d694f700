//! Combined names of several cases, for tables and legends.

use crate::verify::distinct;

/// Combines several names into one, with the differences in braces: `mpm-{linear,ugimp}-flip-usl`.
pub(crate) fn together(names: &[&str]) -> String {
    let names: Vec<Vec<String>> = names.iter().map(|name| words(name)).collect();
    let Some((first, others)) = names.split_first() else { return String::new() };
    product(first, &names).unwrap_or_else(|| {
        let common = |a: &mut dyn Iterator<Item = &String>,
                      b: &mut dyn Iterator<Item = &String>| {
            a.zip(b).take_while(|(a, b)| a == b).count()
        };
        let shortest = names.iter().map(Vec::len).min().unwrap_or(0);
        let start = others.iter().map(|name| common(&mut first.iter(), &mut name.iter())).min();
        let start = start.unwrap_or(0);
        let end = others.iter().map(|name| common(&mut first.iter().rev(), &mut name.iter().rev()));
        let end = end.min().unwrap_or(0).min(shortest - start);
        // An empty alternative, as in `flip-{,95}`, would be hard to read.
        let (start, end) = if start + end < shortest {
            (start, end)
        } else if start > 0 {
            (start - 1, end)
        } else {
            (start, end.saturating_sub(1))
        };
        let middle = names.iter().map(|name| name[start..name.len() - end].join("-"));
        let middle = format!("{{{}}}", middle.collect::<Vec<_>>().join(","));
        let (head, tail) = (&first[..start], &first[first.len() - end..]);
        [head, &[middle], tail].concat().join("-")
    })
}

/// Merges names that are all combinations of some words, such as `mpm-{linear,ugimp}-{flip,apic}`;
/// `None` for other names.
fn product(first: &[String], names: &[Vec<String>]) -> Option<String> {
    let at = |k: usize| {
        names.iter().map(|name| name.get(k)).collect::<Option<Vec<&String>>>().map(distinct)
    };
    let choices: Vec<Vec<&String>> = (0..first.len()).map(at).collect::<Option<_>>()?;
    let is_whole = names.iter().all(|name| name.len() == first.len())
        && choices.iter().map(Vec::len).product::<usize>() == names.len();
    let word = |choice: &Vec<&String>| {
        let all: Vec<&str> = choice.iter().map(|word| word.as_str()).collect();
        if let [only] = all[..] { only.to_owned() } else { format!("{{{}}}", all.join(",")) }
    };
    is_whole.then(|| choices.iter().map(word).collect::<Vec<_>>().join("-"))
}

/// Splits a name into its words. `bspline` and its degree form one word.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in name.split('-') {
        match words.last_mut() {
            Some(degree) if word == "bspline" => *degree += "-bspline",
            _ => words.push(word.to_owned()),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(&["bar"], "bar")]
    #[case(&["mpm-linear-usf", "mpm-linear-musl"], "mpm-linear-{usf,musl}")]
    #[case(&["a-x", "a-y", "b-x", "b-y"], "{a,b}-{x,y}")]
    #[case(&["a-x", "b-y"], "{a-x,b-y}")]
    #[case(&["mpm-linear-pic", "mpm-cubic-bspline-pic"], "mpm-{linear,cubic-bspline}-pic")]
    #[case(&["mpm-flip", "mpm-flip-consistent"], "mpm-{flip,flip-consistent}")]
    #[case(&["flip-musl", "flip-95-musl"], "{flip,flip-95}-musl")]
    #[case(&["musl", "flip-musl"], "{musl,flip-musl}")]
    fn names_together(#[case] names: &[&str], #[case] expected: &str) {
        assert_eq!(together(names), expected);
    }
}
