//! Sample values of required keys, for error messages with text to paste.

use super::{ConvergenceSpec, Head, StudyName, SuiteSpec};
use crate::suite::yaml::{Diagnostic, Source, Step, parse};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde::de::value::{Error, StrDeserializer};

/// Required keys and their sample values; `owner.key` is only for keys of this owner.
pub(crate) const SAMPLES: &[(&str, &str)] = &[
    // Every study.
    ("suite", "my-suite"),
    ("title", "My suite"),
    ("source", "a textbook"),
    (
        "scene",
        "{dimension: 1, body: {box: {from: [0], to: [1]}}, material: {linear_elastic: \
         {young: 100, poisson: 0, density: 1}}}",
    ),
    ("run", "{until: 1, dt: 1e-3}"),
    ("refine", "{cells: [8, 16, 32, 64], ppc: 4}"),
    ("methods", "[{mpm: {basis: linear, transfer: flip, scheme: musl}}]"),
    ("because", "theory says so"),
    ("warning", "small_strain"),
    ("by", "t"),
    ("table", "[[0, 0], [1, 1]]"),
    // A scene.
    ("dimension", "1"),
    ("body", "{box: {from: [0], to: [1]}}"),
    ("from", "[0]"),
    ("to", "[1]"),
    ("corners", "[[0, 0], [1, 0], [1, 1], [0, 1]]"),
    ("centre", "[0, 0]"),
    ("inner", "0.5"),
    ("outer", "1"),
    ("radius", "1"),
    ("friction", "0.3"),
    ("convection.coefficient", "1"),
    ("ambient", "0"),
    // Materials.
    ("material", "{linear_elastic: {young: 100, poisson: 0, density: 1}}"),
    ("young", "100"),
    ("poisson", "0"),
    ("yield", "1"),
    ("bulk", "100"),
    ("stiffness", "1"),
    ("exponent", "2"),
    ("viscosity", "0"),
    ("dilation", "0"),
    ("strength", "1"),
    ("friction_angle", "30"),
    ("dilation_angle", "0"),
    ("cohesion", "1"),
    ("critical_state_slope", "1"),
    ("swelling_slope", "0.02"),
    ("compression_slope", "0.1"),
    ("initial_pressure", "1"),
    ("preconsolidation", "1"),
    ("density", "1"),
    // Loads.
    ("on", "right"),
    ("value", "[1]"),
    ("pressure.value", "1"),
    ("linear", "0.1"),
    ("quadratic", "1"),
    ("conductivity", "1"),
    ("capacity", "1"),
    ("coefficient", "1e-5"),
    ("reference", "0"),
    // Methods.
    ("basis", "linear"),
    ("scheme", "musl"),
    ("element", "linear"),
    ("mass", "lumped"),
    ("name", "my-solver"),
    // A convergence study.
    ("cells", "16"),
    ("dt", "1e-3"),
    ("courant", "0.5"),
    ("at", "[0.5]"),
    ("tolerance", "1e-6"),
    // A stability study.
    ("stability.run", "{dt: 1e-3, steps: 1000}"),
    ("particles", "{cells: 16, ppc: 4}"),
    ("ppc", "4"),
    ("steps", "1000"),
    ("sweep", "{C: [0.5, 1]}"),
    ("parameter", "C"),
    ("critical.from", "0.1"),
    ("critical.to", "2"),
    // A gradient study.
    ("gradient", "{of: {mean_displacement: {axis: 0}}, with_respect_to: {young: E}}"),
    ("of", "{mean_displacement: {axis: 0}}"),
    ("with_respect_to", "{young: E}"),
    ("axis", "0"),
    ("particle", "0"),
    ("sweep.parameter", "young"),
    ("within", "0.002"),
    ("points", "81"),
    // A spectrum study.
    ("spectrum", "{cells_per_wavelength: [8, 16], courant: 0.5}"),
    ("cells_per_wavelength", "[8, 16]"),
    // A study of the internal force.
    (
        "internal_force",
        "{cell: 1, ppc: 4, volume: 0.25, stress: 1, positions: 16, prediction: n_left - n_right}",
    ),
    ("internal_force.methods", "[{mpm: {basis: linear}}]"),
    ("cell", "1"),
    ("volume", "0.25"),
    ("stress", "1"),
    ("positions", "16"),
    ("prediction", "n_left - n_right"),
];

impl SuiteSpec {
    /// Parses the keys of a suite. The error for a missing key shows a sample value.
    pub(crate) fn read(source: &Source) -> Result<Self, Diagnostic> {
        match StudyName::of(source)? {
            StudyName::Convergence => read(source, "convergence").map(Self::Convergence),
            StudyName::InternalForce => read(source, "internal_force").map(Self::InternalForce),
            StudyName::Stability => read(source, "stability").map(Self::Stability),
            StudyName::Gradient => read(source, "gradient_study").map(Self::Gradient),
            StudyName::Spectrum => {
                read(source, "spectrum_study").map(Self::Spectrum).map_err(with_regular_particles)
            }
        }
    }
}

impl ConvergenceSpec {
    pub(crate) fn read(source: &Source) -> Result<Self, Diagnostic> {
        read(source, "convergence")
    }
}

impl StudyName {
    fn of(source: &Source) -> Result<Self, Diagnostic> {
        let path = [Step::from("study")];
        if source.value_at(&path).is_none() {
            return Ok(Self::default_study());
        }
        let name = source.text_at(&path).map(StrDeserializer::<Error>::new);
        let known = name.and_then(|name| Self::deserialize(name).ok());
        known.map_or_else(|| read::<Head>(source, "").map(|head| head.study), Ok)
    }
}

/// Explains an unknown key of a spectrum study that would make the particles irregular.
fn with_regular_particles(diagnostic: Diagnostic) -> Diagnostic {
    let is_irregular = ["perturb", "seed", "extra"]
        .iter()
        .any(|key| diagnostic.message().contains(&format!("`{key}`")));
    if is_irregular {
        diagnostic.with_help("a spectrum study needs regular particles")
    } else {
        diagnostic
    }
}

fn read<T: DeserializeOwned>(source: &Source, study: &str) -> Result<T, Diagnostic> {
    parse(source, &|owner, key| sample(if owner.is_empty() { study } else { owner }, key))
}

fn sample(owner: &str, key: &str) -> Option<&'static str> {
    let of =
        |wanted: &str| SAMPLES.iter().find(|(known, _)| *known == wanted).map(|(_, text)| *text);
    of(&format!("{owner}.{key}")).or_else(|| of(key))
}
