//! Rules for words: no two types have one name, and prose is in plain English.

use crate::rules::Breach;
use crate::source::Source;
use crate::token::Token;
use std::collections::BTreeMap;

/// Maximum width of a comment line (columns), as for code in `.rustfmt.toml`.
pub(crate) const LONGEST_COMMENT: usize = 100;

/// Folders whose prose has none of the `UNCLEAR_PHRASES`, with the end of the names of their files.
pub(crate) const PLAIN_FILES: &[(&str, &str)] =
    &[("verification", ".yaml"), ("verification", ".md")];

/// Folders whose comments have none of the `UNCLEAR_PHRASES` and `UNCLEAR_BEGINNINGS`.
pub(crate) const PLAIN_SOURCES: &[&str] = &["src", "crates", "benches", "tests", "examples"];

/// Beginnings of comments that point at a neighbouring item or name no limit, each with a better
/// one.
pub(crate) const UNCLEAR_BEGINNINGS: &[(&str, &str)] = &[
    ("What", "a noun phrase"),
    ("Whatever", "a noun phrase"),
    ("The same", "the name of the item"),
    ("Those", "the name of the items"),
    ("That of", "the name of the item"),
    ("Most", "Maximum number of"),
    ("Fewest", "Minimum number of"),
    ("Longest", "Maximum length of"),
    ("Shortest", "Minimum length of"),
    ("Least", "Minimum"),
];

/// Idioms and archaic phrases that a reader must decode, in lower case, each with a plain one.
pub(crate) const UNCLEAR_PHRASES: &[(&str, &str)] = &[
    ("of which", "whose, with, or two sentences"),
    ("is told", "is determined, is reported"),
    ("are told", "are determined, are reported"),
    ("be told", "be determined, be reported"),
    ("tells", "describes, reports"),
    ("the words", "keys, arguments, names"),
    ("words of", "keys, arguments, names"),
    ("words for", "keys, arguments, names"),
    ("words that", "keys, arguments, names"),
    ("held to", "checked against, compared with"),
    ("held against", "compared with"),
    ("put to", "applied to, run on"),
    ("put under", "run on"),
    ("beside", "next to"),
    ("besides", "in addition"),
    ("but for", "except"),
    ("anew", "again"),
    ("once more", "again"),
    ("for ever", "permanently"),
    ("room", "module"),
    ("rooms", "modules"),
    ("house", "module"),
    ("that is not of", "external, another"),
    ("that are not of", "external, other"),
    ("of others", "of other programs, of other methods"),
    ("of one's own", "own"),
    ("whatever", "any, for any"),
    ("at a stroke", "abruptly"),
    ("stands in for", "is used as"),
    ("part and overlap", "separate and overlap"),
    ("turn round", "stop converging"),
    ("turns round", "stops converging"),
    ("without ends", "periodic, infinite"),
    ("by rule", "automatic"),
    ("does not care", "does not depend on"),
    ("do not care", "do not depend on"),
    ("what is left", "the rest, the remaining error"),
    ("as expected", "pass, known limit"),
    ("expected failure", "known limit"),
    ("unexpected result", "FAIL, failing case"),
    ("not gated", "explored, or `run --gate` exempts it"),
];

/// Names of types that several files may define, each with the reason.
pub(crate) const TWICE: &[(&str, &str)] = &[
    ("Value", "serde's visitors must call their result so"),
    ("Output", "so must operators"),
    ("Patch", "each basis says which patch it gives: an associated type of that trait"),
    ("Batch", "each patch says how it comes in batches: an associated type of that trait"),
    ("F64x4", "each processor level says which register it has: an associated type of that trait"),
];

/// Path and text of a file, with its comments.
pub(crate) type Text = (String, String);

/// Breaches by texts with an unclear phrase, in upper or lower case, also across the end of a line.
pub(crate) fn unclear_phrases(texts: &[Text]) -> Vec<Breach> {
    let of_text = |(file, text): &Text| -> Vec<Breach> {
        let lowered = text.to_lowercase();
        let lines: Vec<&str> =
            lowered.lines().map(|line| line.trim().trim_start_matches(['#', ' '])).collect();
        let of_line = |at: usize| {
            let next = lines.get(at + 1).copied().unwrap_or_default();
            let joined = format!("{} {next}", lines[at]);
            let begins_here = |phrase: &str| {
                has(lines[at], phrase) || (has(&joined, phrase) && !has(next, phrase))
            };
            let (phrase, better) =
                UNCLEAR_PHRASES.iter().find(|(phrase, _)| begins_here(phrase))?;
            let what = format!("has the unclear phrase `{phrase}`: write `{better}`");
            Some(Breach { file: file.clone(), line: at + 1, what })
        };
        (0..lines.len()).filter_map(of_line).collect()
    };
    texts.iter().flat_map(of_text).collect()
}

/// Whether `phrase` occurs in `line` as whole words.
fn has(line: &str, phrase: &str) -> bool {
    let is_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    line.match_indices(phrase).any(|(at, _)| {
        let (before, after) = (&line[..at], &line[at + phrase.len()..]);
        !is_word(before.chars().next_back()) && !is_word(after.chars().next())
    })
}

/// Breaches by types whose name another file defines too.
pub(crate) fn twice(sources: &[Source], allowed: &[(&str, &str)]) -> Vec<Breach> {
    let mut first: BTreeMap<&str, &str> = BTreeMap::new();
    let mut breaches = Vec::new();
    for source in sources {
        for token in definitions(&source.code) {
            let other = *first.entry(&token.text).or_insert(&source.file);
            if other != source.file && !allowed.iter().any(|(name, _)| *name == token.text) {
                let what = format!("defines `{}`, as {other} does", token.text);
                breaches.push(Breach { file: source.file.clone(), line: token.line, what });
            }
        }
    }
    breaches
}

/// The names of the types that `code` defines, and of the associated types that its traits declare.
/// Associated types in an `impl` are excluded: their trait declares the name.
fn definitions(code: &[Token]) -> Vec<&Token> {
    let mut found = Vec::new();
    let (mut depth, mut implementation) = (0_usize, None);
    for (at, token) in code.iter().enumerate() {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => {
                depth = depth.saturating_sub(1);
                implementation = implementation.filter(|outside| depth > *outside);
            }
            "impl" if depth == 0 => implementation = Some(depth),
            "struct" | "enum" | "trait" => found.extend(code.get(at + 1).filter(|t| is_type(t))),
            "type" if implementation.is_none() => {
                found.extend(code.get(at + 1).filter(|t| is_type(t)));
            }
            _ => {}
        }
    }
    found
}

fn is_type(token: &Token) -> bool {
    token.text.starts_with(|c: char| c.is_uppercase())
}

/// The comments of sources, line by line: a line without a comment is empty.
pub(crate) fn of_comments(texts: &[Text]) -> Vec<Text> {
    let comment = |line: &str| line.trim_start().strip_prefix("//").map(str::to_owned);
    let prose = |line: &str| {
        comment(line).unwrap_or_default().trim_start_matches(['/', '!']).trim().to_owned() + "\n"
    };
    texts.iter().map(|(file, text)| (file.clone(), text.lines().map(prose).collect())).collect()
}

/// Breaches by lines of comments with an unclear beginning, and by those that are too long.
pub(crate) fn comments(texts: &[Text]) -> Vec<Breach> {
    let of_line = |file: &String, at: usize, (line, prose): (&str, &str)| -> Option<Breach> {
        let begins = |word: &str| {
            prose.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
        };
        let unclear = UNCLEAR_BEGINNINGS.iter().find(|(word, _)| begins(word));
        let columns = line.chars().count();
        let what = match unclear {
            Some((word, better)) => format!("begins with \"{word}\": write `{better}`"),
            None if !prose.is_empty() && columns > LONGEST_COMMENT => {
                format!("is a comment of {columns} columns")
            }
            None => return None,
        };
        Some(Breach { file: file.clone(), line: at + 1, what })
    };
    let of_text = |((file, text), (_, prose)): (&Text, &Text)| -> Vec<Breach> {
        let lines = text.lines().zip(prose.lines()).enumerate();
        lines.filter_map(|(at, line)| of_line(file, at, line)).collect()
    };
    texts.iter().zip(&of_comments(texts)).flat_map(of_text).collect()
}
