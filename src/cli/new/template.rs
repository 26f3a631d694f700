//! Creates the text of a new suite from templates: one for each kind of exact solution, and one for
//! the method.

use clap::ValueEnum;
use std::path::Path;

const MANUFACTURED: &str = include_str!("manufactured.yaml");
const STANDING_WAVE: &str = include_str!("standing_wave.yaml");
const METHOD: &str = include_str!("method.yaml");

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(in crate::cli) enum LawChoice {
    /// Small strain, integrated in rate form
    LinearElastic,
    /// Finite strain
    NeoHookean,
    /// Finite strain, linear in the logarithmic strain
    Hencky,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(in crate::cli) enum TruthChoice {
    /// Prescribed motion along the axes, with a manufactured body force
    Manufactured,
    /// Standing wave of small strain
    StandingWave,
}

impl LawChoice {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::LinearElastic => "linear_elastic",
            Self::NeoHookean => "neo_hookean",
            Self::Hencky => "hencky",
        }
    }

    pub(super) fn truth(self) -> TruthChoice {
        match self {
            Self::LinearElastic => TruthChoice::StandingWave,
            Self::NeoHookean | Self::Hencky => TruthChoice::Manufactured,
        }
    }
}

impl TruthChoice {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Manufactured => "manufactured",
            Self::StandingWave => "standing_wave",
        }
    }

    /// Lists the materials with a known solution of this kind. The first one is the default.
    pub(super) fn laws(self) -> &'static [LawChoice] {
        match self {
            Self::Manufactured => &[LawChoice::NeoHookean, LawChoice::Hencky],
            Self::StandingWave => &[LawChoice::LinearElastic],
        }
    }
}

pub(super) struct Choices {
    pub(super) name: String,
    pub(super) dimension: String,
    pub(super) law: LawChoice,
    pub(super) basis: NamedChoice,
    pub(super) transfer: NamedChoice,
    pub(super) scheme: NamedChoice,
}

pub(super) struct NamedChoice {
    pub(super) value: String,
    pub(super) known: Vec<&'static str>,
}

/// Template variables for each dimension. The 3-D levels are coarse, so that every level runs
/// within seconds. Each axis has a different phase of the motion, so parts of the body are
/// stretched while others are compressed.
const SHAPES: [[(&str, &str); 9]; 3] = [
    [
        ("body", "bar"),
        ("zeros", ""),
        ("edges", ""),
        ("condition", "a face that is not named is free"),
        ("boundary", "left: fixed, right: fixed"),
        ("cells", "[8, 16, 32, 64]"),
        ("ppc", "4"),
        ("instants", "8"),
        ("transverse", ""),
    ],
    [
        ("body", "square"),
        ("zeros", ", 0"),
        ("edges", ", L"),
        ("condition", "a roller holds along its normal; a face that is not named is free"),
        ("boundary", "left: roller, right: roller, bottom: roller, top: roller"),
        ("cells", "[8, 12, 16, 24]"),
        ("ppc", "4"),
        ("instants", "8"),
        ("transverse", "\n    - \"A*sin(pi*Y/L)*sin(omega*t + pi)\""),
    ],
    [
        ("body", "cube"),
        ("zeros", ", 0, 0"),
        ("edges", ", L, L"),
        ("condition", "a roller holds along its normal; a face that is not named is free"),
        (
            "boundary",
            "left: roller, right: roller, bottom: roller, top: roller, back: roller, front: roller",
        ),
        ("cells", "[8, 10, 12, 16]"),
        ("ppc", "8"),
        ("instants", "4"),
        (
            "transverse",
            "\n    - \"A*sin(pi*Y/L)*sin(omega*t + 2*pi/3)\"\n    - \"A*sin(pi*Z/L)*sin(omega*t + 4*pi/3)\"",
        ),
    ],
];

/// Creates the text of the suite, with a comment for each key. `path` is the path of its file.
pub(super) fn text(choices: &Choices, path: &Path) -> String {
    let Choices { name, dimension, law, basis, transfer, scheme } = choices;
    let [bar, square, cube] = &SHAPES;
    let shape = match dimension.as_str() {
        "1" => bar,
        "2" => square,
        _ => cube,
    };
    let problem = match law.truth() {
        TruthChoice::Manufactured => MANUFACTURED,
        TruthChoice::StandingWave => STANDING_WAVE,
    };
    let name = serde_json::Value::from(name.as_str()).to_string();
    let path = path.display().to_string();
    let known = [basis, transfer, scheme].map(|setting| setting.known.join(", "));
    let chosen = [
        ("name", name.as_str()),
        ("dimension", dimension),
        ("law", law.name()),
        ("bases", &known[0]),
        ("basis", &basis.value),
        ("transfers", &known[1]),
        ("transfer", &transfer.value),
        ("schemes", &known[2]),
        ("scheme", &scheme.value),
        ("path", &path),
    ];
    substitute(&[problem, METHOD].concat(), &[&chosen, shape.as_slice()].concat())
}

/// Replaces each `$variable` of the template by its value. Values may contain `$`.
fn substitute(template: &str, values: &[(&str, &str)]) -> String {
    let mut parts = template.split('$');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_lowercase()).unwrap_or(part.len());
        let (variable, rest) = part.split_at(end);
        let value = values.iter().find(|(name, _)| *name == variable).map(|(_, value)| *value);
        text += value.unwrap_or_default();
        text += rest;
    }
    text
}
