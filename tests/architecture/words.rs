//! Rules for words: old names stay away, no two types have one name, and prose is in plain English.

use crate::rules::Breach;
use crate::source::Source;
use crate::token::Token;
use std::collections::BTreeMap;

/// Maximum width of a comment line (columns), as for code in `.rustfmt.toml`.
pub(crate) const LONGEST_COMMENT: usize = 100;

/// Former names of types, each with the name in its place.
pub(crate) const OLD_TYPES: &[(&str, &str)] = &[
    ("Whereabouts", "CellTracker"),
    ("Touch", "ContactState"),
    ("Kept", "ResultCache"),
    ("Shown", "ParticleField"),
    ("Sight", "ParticleBatches"),
    ("Seen", "NodeWeight"),
    ("Several", "PatchBatch"),
    ("Patches", "PatchBatch"),
    ("Along", "Weights1d"),
    ("Alongs", "Weights1dBatch"),
    ("Alone", "Domain1d"),
    ("Room", "Workspace"),
    ("Sink", "NodeAccumulator"),
    ("Spread", "WeightMoments"),
    ("Inertia", "InertiaTensor"),
    ("Conductor", "HeatSolver"),
    ("Census", "RunCounters"),
    ("Claim", "OrderHypothesis"),
    ("Yardstick", "ErrorScale"),
    ("Contender", "MethodCost"),
    ("Tried", "Sample"),
    ("Priced", "TimedSuite"),
    ("Binder", "Evaluator"),
    ("Complaint", "Diagnostic"),
    ("Hold", "BoundaryCondition"),
    ("Met", "Interface"),
    ("Rub", "InterfaceTraction"),
    ("Watch", "RunMonitor"),
    ("Recipe", "P2gRequest, G2pRequest"),
    ("Wanted", "P2gRequest, G2pRequest"),
    ("Gathered", "P2gRequest, G2pRequest"),
    ("Visited", "P2gRequest, G2pRequest"),
    ("Taken", "P2gRequest, G2pRequest"),
    ("Maps", "P2gRequest"),
    ("Takes", "G2pRequest"),
    ("Also", "P2gRequest, G2pRequest"),
];

/// Former names of functions, fields, variables and types, each with the name in its place.
pub(crate) const OLD_NAMES: &[(&str, &str)] = &[
    ("whereabouts", "cell_tracker"),
    ("drive_velocity", "modify_velocity"),
    ("oppose_motion", "modify_force"),
    ("g2p_velocity", "g2p"),
    ("safe_step", "stable_time_step"),
    ("unrest", "residual_speed"),
    ("spot", "point"),
    ("spots", "points, quadrature_points"),
    ("meeting", "interface"),
    ("carried", "advected"),
    ("touches", "states"),
    ("census", "counters"),
    ("yardstick", "error_scale"),
    ("yardsticks", "error_scales"),
    ("contender", "method"),
    ("contenders", "methods"),
    ("complaint", "diagnostic"),
    ("complaints", "diagnostics"),
    ("meetings", "interface"),
    ("pricing", "cost"),
    ("dear", "expensive, costly"),
    ("dearer", "more expensive"),
    ("FOUR", "LANES"),
    ("Four", "F64x4"),
];

/// Former phrases of reports and documents, each with the phrase in its place; those in quotes are
/// heads, keys and columns.
pub(crate) const OLD_PHRASES: &[(&str, &str)] = &[
    ("\"carried\"", "advected x"),
    ("\"x moved\"", "current x"),
    ("\"meeting\"", "interface node"),
    ("\"spots\"", "quadrature point"),
    ("\"touch\"", "contact state"),
    ("\"driven\"", "prescribed"),
    ("\"seen\"", "mapped v"),
    ("\"bid\"", "best_candidate"),
    ("\"front\":", "pareto_front"),
    ("unrest", "residual_speed"),
    ("safe_step", "stable_time_step"),
    ("dt/safe", "dt/stable"),
    ("safe step", "stable time step"),
    ("safe steps", "stable time steps"),
    ("longest safe", "stable"),
    ("a particle  ", "particle memory"),
    ("a node  ", "node memory"),
    ("in full also", "further levels"),
    ("g2p slope", "g2p scalar gradient"),
    ("p2g flow", "p2g scalar flux"),
    ("p2g amount", "p2g scalar source"),
    ("leaves at", "critical eigenvalue"),
    ("speed at rest over", "residual speed divided by"),
    ("never beyond them", "interpolated, never extrapolated"),
];

/// Folders whose prose has none of the `UNCLEAR_PHRASES`, with the end of the names of their files.
pub(crate) const PLAIN_FILES: &[(&str, &str)] =
    &[("verification", ".yaml"), ("verification", ".md")];

/// Folders whose comments have none of the `UNCLEAR_PHRASES` and `UNCLEAR_BEGINNINGS`.
pub(crate) const PLAIN_SOURCES: &[&str] = &["src", "benches", "tests", "examples"];

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
];

/// Former names of files and folders, each with the name in its place.
pub(crate) const OLD_FILES: &[(&str, &str)] = &[
    ("whereabouts", "cell_tracker"),
    ("touch", "contact_state"),
    ("kept", "cache"),
    ("shown", "run_result"),
    ("moved", "changes"),
    ("visits", "schedule"),
    ("soundness", "finite_check"),
    ("conductor", "heat_solver"),
    ("spots", "quadrature_points"),
    ("nature", "methods of `Scene`"),
    ("truthless", "conservation_only"),
    ("filling", "seeding"),
    ("secular", "energy_rate"),
    ("beta", "variance_ratio"),
    ("student", "t_quantile"),
    ("figures", "format_number"),
    ("priced", "timed_suite"),
    ("pricing", "cost"),
    ("contrast", "a word for the test"),
    ("dark", "a word for the theme"),
    ("fine_steps", "small_step_reference"),
    ("comparable", "subject_support"),
    ("bar_limits", "subject_support"),
    ("meetings", "interface"),
    ("judged", "outcome"),
    ("execute", "runner"),
    ("words", "grammar"),
    ("four", "simd"),
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

/// Breaches by types with an old name, and by old names anywhere in code.
pub(crate) fn old(sources: &[Source]) -> Vec<Breach> {
    let of_source = |source: &Source| -> Vec<Breach> {
        let types = definitions(&source.code).into_iter().map(|token| (token, OLD_TYPES));
        let names = source.code.iter().map(|token| (token, OLD_NAMES));
        let found = types.chain(names).filter_map(|(token, list)| {
            let (_, better) = list.iter().find(|(name, _)| *name == token.text)?;
            let what = format!("has the old word `{}`: say `{better}`", token.text);
            Some(Breach { file: source.file.clone(), line: token.line, what })
        });
        found.collect()
    };
    sources.iter().flat_map(of_source).collect()
}

/// Breaches by texts with an old phrase of reports, as whole words.
pub(crate) fn old_phrases(texts: &[Text]) -> Vec<Breach> {
    let of_text = |(file, text): &Text| -> Vec<Breach> {
        let lines = text.lines().enumerate();
        let of_line = |(at, line): (usize, &str)| {
            let (phrase, better) = OLD_PHRASES.iter().find(|(phrase, _)| has(line, phrase))?;
            let what = format!("has the old words `{}`: say `{better}`", phrase.trim_end());
            Some(Breach { file: file.clone(), line: at + 1, what })
        };
        lines.filter_map(of_line).collect()
    };
    texts.iter().flat_map(of_text).collect()
}

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

/// Files and folders with an old name.
pub(crate) fn old_files(files: &[String]) -> Vec<Breach> {
    let of_file = |file: &String| -> Option<Breach> {
        let mut parts = file.trim_end_matches(".rs").split('/');
        let (name, better) =
            parts.find_map(|part| OLD_FILES.iter().find(|(name, _)| *name == part))?;
        let what = format!("has the old name `{name}`: say `{better}`");
        Some(Breach { file: file.clone(), line: 1, what })
    };
    files.iter().filter_map(of_file).collect()
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
