//! Rows of a table by name, of which those that show the same are one.

use crate::report::grouping::{distinct, grouped};

/// Longest name that rows are given together.
const LONGEST: usize = 44;

/// Rows whose first cell is a name: where all other cells are the same, one row under both names.
pub(crate) fn merged(rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    let mut kept: Vec<(Vec<String>, Vec<String>)> = Vec::new();
    for mut row in rows {
        let cells = row.split_off(1);
        let name = row.pop().unwrap_or_default();
        let fits = |names: &[String]| {
            let names: Vec<&str> = names.iter().chain([&name]).map(String::as_str).collect();
            together(&names).chars().count() <= LONGEST
        };
        match kept.iter_mut().rev().find(|(names, shown)| *shown == cells && fits(names)) {
            Some((names, _)) => names.push(name),
            None => kept.push((vec![name], cells)),
        }
    }
    let row = |(names, cells): (Vec<String>, Vec<String>)| {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        std::iter::once(together(&names)).chain(cells).collect()
    };
    kept.into_iter().map(row).collect()
}

/// Different values, each with the names of those that have it in brackets, where not all do.
pub(crate) fn shared<'a>(
    values: impl Iterator<Item = (&'a str, String)>,
) -> impl Iterator<Item = (String, String)> {
    let found = grouped(values.map(|(name, value)| (value, name)));
    let most = found.iter().map(|(_, names)| names.len()).max().unwrap_or(0);
    let single = found.len() == 1;
    found.into_iter().map(move |(value, names)| {
        let of = match names.len() {
            _ if single => String::new(),
            count if count == most && count > 2 => " (all others)".to_owned(),
            _ => format!(" ({})", together(&names)),
        };
        (value, of)
    })
}

/// Names as one, with what differs between braces: `mpm-{linear,ugimp}-flip-usl`.
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
        let middle = names.iter().map(|name| name[start..name.len() - end].join("-"));
        let middle = format!("{{{}}}", middle.collect::<Vec<_>>().join(","));
        let (head, tail) = (&first[..start], &first[first.len() - end..]);
        [head, &[middle], tail].concat().join("-")
    })
}

/// Names of all combinations of words: `mpm-{linear,ugimp}-{flip,apic}`.
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

/// The words of a name; the degree of a spline is one with it.
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
    #[case(&["mpm-flip", "mpm-flip-consistent"], "mpm-flip-{,consistent}")]
    fn names_together(#[case] names: &[&str], #[case] expected: &str) {
        assert_eq!(together(names), expected);
    }

    #[test]
    fn rows_that_show_the_same_are_one() {
        let rows = [["a-x", "1"], ["a-y", "2"], ["a-z", "1"], ["b-x", "1"]];
        let rows = rows.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        assert_eq!(merged(rows), [vec!["{a-x,a-z,b-x}", "1"], vec!["a-y", "2"]]);
        let long = |k: usize| vec![format!("{}-{k}", "word".repeat(6)), String::new()];
        let rows = merged((0..20).map(long).collect());
        assert!(rows.len() > 1 && rows.iter().all(|row| row[0].len() <= LONGEST));
    }
}
