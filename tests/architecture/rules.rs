//! Rules for the sources, each with its reason; a breach has a file and a line.

use crate::graph::Edge;
use crate::source::Source;
use crate::token::Token;

/// Maximum number of lines of a file, without its tests.
pub(crate) const MOST_LINES: usize = 500;

/// Files that may be longer, each with its reason.
pub(crate) const LONGER: [(&str, &str); 0] = [];

/// Files whose unit tests may load suites, each with its reason.
pub(crate) const LOADS_SUITES: [(&str, &str); 1] = [(
    "crates/suites/src/external/program/tests.rs",
    "messages are private, their problems come from suites, and no solver runs",
)];

/// A folder (or file) of `src/`, and the other modules that it may import, as paths.
pub(crate) struct ImportRule {
    pub(crate) module: &'static str,
    pub(crate) may: &'static [&'static str],
    pub(crate) why: &'static str,
}

/// `study` may import every module: it builds and runs all that suites describe.
pub(crate) const IMPORT_RULES: &[ImportRule] = &[
    ImportRule {
        module: "mpm",
        may: &["subject"],
        why: "the solvers are independent of each other; packages separate them from the judge",
    },
    ImportRule {
        module: "fem",
        may: &["subject"],
        why: "the solvers are independent of each other; packages separate them from the judge",
    },
    ImportRule {
        module: "exact",
        may: &["subject"],
        why: "an exact solution does not depend on how a solver is judged",
    },
    ImportRule { module: "vtk", may: &["subject"], why: "a file shows fields of any solver" },
    ImportRule {
        module: "external",
        may: &["subject", "vtk", "suite::yaml"],
        why: "an external solver receives a problem, and must not see how it is judged",
    },
    ImportRule {
        module: "report",
        may: &["verify", "exact", "subject"],
        why: "a report shows results and must not be able to change them",
    },
    ImportRule {
        module: "suite",
        may: &["mpm", "fem", "exact", "verify", "report", "subject"],
        why: "it describes runs, and must be usable without the code that runs them",
    },
    ImportRule {
        module: "suite::yaml",
        may: &[],
        why: "it turns text into values with their place, independent of their meaning",
    },
    ImportRule {
        module: "suite::evaluator",
        may: &["suite::yaml", "exact"],
        why: "numbers and formulas do not depend on the keys that hold them",
    },
    ImportRule {
        module: "suite::scene",
        may: &["suite::yaml", "suite::evaluator", "mpm", "fem", "exact", "subject"],
        why: "a load or condition has its keys and its checked value in one file",
    },
    ImportRule {
        module: "suite::grammar",
        may: &[
            "suite::yaml",
            "suite::evaluator",
            "suite::scene",
            "mpm",
            "fem",
            "exact",
            "verify",
            "subject",
        ],
        why: "it defines the allowed contents of a file, and computes nothing",
    },
    ImportRule {
        module: "suite::model",
        may: &[
            "suite::yaml",
            "suite::scene",
            "suite::grammar",
            "mpm",
            "fem",
            "exact",
            "verify",
            "subject",
        ],
        why: "a checked value does not depend on how it was checked",
    },
];

/// Functions of `f64` whose bits depend on the platform in the standard library.
const PLATFORM: &str = "sin cos tan sin_cos asin acos atan atan2 sinh cosh tanh asinh acosh atanh \
    exp exp2 exp_m1 ln ln_1p log log2 log10 powf powi cbrt hypot gamma ln_gamma erf erfc";

/// Folder in which methods of `Number` have the names of those of `f64`, and use `libm`.
const NUMBERS: &str = "crates/judge/src/exact/formula/";

/// Where a rule is broken, and how.
#[derive(Debug)]
pub(crate) struct Breach {
    pub(crate) file: String,
    pub(crate) line: usize,
    pub(crate) what: String,
}

impl Breach {
    fn at(source: &Source, line: usize, what: impl Into<String>) -> Self {
        Self { file: source.file.clone(), line, what: what.into() }
    }
}

/// Imports that `rule` does not allow.
pub(crate) fn forbidden_imports(rule: &ImportRule, edges: &[Edge]) -> Vec<Breach> {
    let outward = edges.iter().filter(|edge| is_in(&edge.from, rule.module));
    let free = rule.may.iter().chain([&rule.module]);
    outward
        .filter(|edge| !free.clone().any(|part| is_in(&edge.to, part)))
        .map(|edge| Breach {
            file: edge.file.clone(),
            line: edge.line,
            what: format!("imports `{}` of `{}`", edge.path, edge.to.join("::")),
        })
        .collect()
}

/// Whether `module` is `part` or below it.
pub(crate) fn is_in(module: &[String], part: &str) -> bool {
    let mut names = module.iter();
    part.split("::").all(|wanted| names.next().is_some_and(|name| name == wanted))
}

/// Breaches by files outside `allowed` (a file, or a folder that ends in `/`) with all sequences of
/// tokens in `wanted`.
pub(crate) fn mentions(sources: &[Source], wanted: &[&[&str]], allowed: &str) -> Vec<Breach> {
    let elsewhere = sources.iter().filter(|source| !source.file.starts_with(allowed));
    elsewhere
        .filter_map(|source| {
            let lines: Option<Vec<usize>> =
                wanted.iter().map(|run| line_of(&source.code, run)).collect();
            let names: Vec<String> = wanted.iter().map(|run| run.concat()).collect();
            let what = format!("mentions `{}`", names.join("`, `"));
            Some(Breach::at(source, lines?.into_iter().max()?, what))
        })
        .collect()
}

/// Unit tests that mention one of the `unwanted` runs of tokens.
pub(crate) fn tests_with(sources: &[Source], unwanted: &[&[&str]]) -> Vec<Breach> {
    let of_run = |source: &Source, run: &[&str]| {
        let line = line_of(&source.tests, run)?;
        Some(Breach::at(source, line, format!("a test mentions `{}`", run.concat())))
    };
    let of_source = |source| unwanted.iter().filter_map(move |run| of_run(source, run));
    sources.iter().flat_map(of_source).collect()
}

fn line_of(code: &[Token], run: &[&str]) -> Option<usize> {
    let same = |window: &&[Token]| window.iter().zip(run).all(|(token, text)| token.text == *text);
    code.windows(run.len()).find(same).map(|window| window[0].line)
}

/// Files that are too long and are not on the list.
pub(crate) fn long(sources: &[Source], longer: &[(&str, &str)]) -> Vec<Breach> {
    let listed = |source: &Source| longer.iter().any(|(file, _)| *file == source.file);
    sources
        .iter()
        .filter(|source| source.lines > MOST_LINES && !listed(source))
        .map(|s| Breach::at(s, MOST_LINES + 1, format!("has {} lines that are no tests", s.lines)))
        .collect()
}

/// Breaches by modules with meaningless names.
pub(crate) fn nameless(sources: &[Source]) -> Vec<Breach> {
    let empty = ["util", "utils", "helper", "helpers", "misc", "common"];
    let bad = |source: &&Source| source.module.iter().any(|name| empty.contains(&name.as_str()));
    sources
        .iter()
        .filter(bad)
        .map(|source| Breach::at(source, 1, "has a name that does not say what is inside"))
        .collect()
}

/// Modules inside a file: imports are followed from file to file only.
pub(crate) fn nested(sources: &[Source]) -> Vec<Breach> {
    windows(sources, |words| match words {
        ["mod", name, "{"] => Some(format!("holds the module `{name}`, which has no file")),
        _ => None,
    })
}

/// Calls whose bits depend on the platform.
pub(crate) fn platform_calls(sources: &[Source]) -> Vec<Breach> {
    let mut breaches = windows(sources, |words| match words {
        [".", name, "("] if is_platform(name) => Some(format!("calls the method `.{name}()`")),
        ["f64", "::", name] if is_platform(name) => Some(format!("calls `f64::{name}`")),
        _ => None,
    });
    breaches.retain(|breach| !breach.file.starts_with(NUMBERS) || breach.what.contains("f64::"));
    breaches
}

fn is_platform(name: &str) -> bool {
    PLATFORM.split_whitespace().any(|known| known == name)
}

/// Fused operations outside the registers, which have the one that all may use.
pub(crate) fn fused(sources: &[Source]) -> Vec<Breach> {
    let names = ["mul_add", "mul_add_precise", "fma"];
    names
        .iter()
        .flat_map(|name| mentions(sources, &[&[name]], "crates/solvers/src/mpm/foundation/simd/"))
        .collect()
}

/// Looks at every three tokens in a row.
fn windows(sources: &[Source], rule: impl Fn(&[&str; 3]) -> Option<String>) -> Vec<Breach> {
    let triples =
        sources.iter().flat_map(|source| source.code.windows(3).map(move |t| (source, t)));
    triples
        .filter_map(|(source, t)| {
            let what = rule(&[&t[0].text, &t[1].text, &t[2].text])?;
            Some(Breach::at(source, t[1].line, what))
        })
        .collect()
}
