//! Reasons why no gate notices a change of a number by 1 %, or why no suite uses a name.

use super::page::{Line, Names};
use super::search::is_of_solver;
use std::collections::BTreeMap;

/// Changes that count as small.
const SMALL: [&str; 4] = ["0.01 %", "0.1 %", "1 %", "+ 1"];

/// Keys, or keys with names as `key: name`, and their reasons.
const REASONS: &[(&str, &str)] = &[
    ("scene.material.jaumann.density", "its suite has no acceleration"),
    ("scene.material.green_naghdi.density", "its suite has no acceleration"),
    ("scene.dimension", "with another dimension, vectors have the wrong number of components"),
    ("particles.perturb", "errors are measured at the particles, for any positions of them"),
    ("particles.shift", "errors are measured at the particles, for any positions of them"),
    ("internal_force.positions", "the prediction holds for any position of the particle"),
    ("any_method.error_below", "only for external solvers: tests/it/external"),
    ("any_method.order", "only for external solvers: tests/it/external"),
    ("methods.external.formal_order", "only for external solvers: tests/it/external"),
    ("equilibrium.linearised.tolerance", "one check serves this and exact"),
    ("equilibrium.temperature", "refused: a body that conducts heat is not in equilibrium"),
    ("equilibrium.tolerance", "one check serves this and exact"),
    ("reference.same_method.cells", "a finer run is an equivalent reference"),
    ("stability.run.full_steps", "only for full runs, which are longer than those of the gate"),
    ("expect.drift.mass", "masses do not change: the drift is zero and meets any bound"),
    ("internal_force.expect.agrees_within", "linear functions meet the prediction to the last bit"),
    ("spectrum.cells_per_wavelength", "the prediction is that of the same wave"),
    ("spectrum.particles.cells", "waves do not depend on the length of a periodic row"),
    ("spectrum.particles.ppc", "the prediction is that of the same particles"),
    ("spectrum.particles.shift", "the prediction is that of the same particles"),
    (
        "spectrum.expect.damping_within",
        "damping agrees with the prediction to a thousandth of the bound",
    ),
    ("run.dt.courant", "any stable step is valid, and the expectation has a margin for its error"),
    ("acknowledge.warning: few_levels", "only for suites that intend it: tests/it/cli/check.rs"),
    ("acknowledge.warning: leaves_grid", "only for suites that intend it: tests/it/cli/check.rs"),
    (
        "acknowledge.warning: single_precision",
        "only for suites that intend it: tests/it/cli/check.rs",
    ),
    ("acknowledge.warning: inside_cell", "only for suites that intend it: tests/it/cli/check.rs"),
    ("acknowledge.warning: undamped", "only for suites that intend it: tests/it/cli/check.rs"),
    (
        "acknowledge.warning: loose_tolerance",
        "only for suites that intend it: tests/it/cli/check.rs",
    ),
    ("acknowledge.warning: end_on_node", "only for suites that intend it: tests/it/cli/check.rs"),
    ("equilibrium.equation: corotated", "one check serves this and exact"),
    ("equilibrium.equation: cam_clay", "one check serves this and exact"),
    ("equilibrium.equation: j2", "one check serves this and exact"),
    ("equilibrium.equation: linear_fluid", "one check serves this and exact"),
    ("equilibrium.equation: small_strain", "one check serves this and exact"),
    ("equilibrium.equation: polytropic", "one check serves this and exact"),
    ("equilibrium.equation: log_strain", "refused: a law of the FEM bar only"),
    ("exact.equation: log_strain", "refused: a law of the FEM bar only"),
    ("judge.crossing_levels: counted", "the default"),
    ("methods.external.precision: double", "only for external solvers: tests/it/external"),
    ("methods.external.precision: single", "only for external solvers: tests/it/external"),
    ("methods.fem.law: corotated", "refused: the built-in FEM does not support this law"),
    ("reference.equation: corotated", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: jaumann", "refused: the built-in FEM does not support this law"),
    ("reference.equation: jaumann", "refused: the built-in FEM does not support this law"),
    ("equilibrium.equation: jaumann", "one check serves this and exact"),
    ("methods.fem.law: green_naghdi", "refused: the built-in FEM does not support this law"),
    ("reference.equation: green_naghdi", "refused: the built-in FEM does not support this law"),
    ("equilibrium.equation: green_naghdi", "one check serves this and exact"),
    ("methods.fem.law: j2", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: drucker_prager", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: mohr_coulomb", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: cam_clay", "refused: the built-in FEM does not support this law"),
    ("reference.equation: j2", "refused: the built-in FEM does not support this law"),
    ("reference.equation: drucker_prager", "refused: the built-in FEM does not support this law"),
    ("reference.equation: mohr_coulomb", "refused: the built-in FEM does not support this law"),
    ("reference.equation: cam_clay", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: linear_fluid", "refused: the built-in FEM does not support this law"),
    ("reference.equation: linear_fluid", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: tait", "refused: the built-in FEM does not support this law"),
    ("reference.equation: tait", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: polytropic", "refused: the built-in FEM does not support this law"),
    ("reference.equation: polytropic", "refused: the built-in FEM does not support this law"),
    ("methods.fem.law: hencky", "by default, of a bar of this material"),
    ("methods.fem.law: neo_hookean", "by default, of a bar of this material"),
    ("reference.equation: hencky", "the bar of methods.fem"),
    ("reference.equation: neo_hookean", "the bar of methods.fem"),
    ("reference.equation: small_strain", "the bar of methods.fem"),
    ("scene.loads.pressure.at: particles", "the default"),
    ("scene.loads.traction.at: particles", "the default"),
    ("scene.plane: strain", "the default"),
    ("study: convergence", "the default"),
    ("stability.show: angular_momentum", "shown wherever it is expected"),
    ("stability.show: constraints", "shown wherever it is expected"),
    ("stability.show: effects", "shown wherever it is expected"),
    ("stability.show: external_force", "shown wherever it is expected"),
    ("stability.show: grid_to_particle", "shown wherever it is expected"),
    ("stability.show: internal_force", "shown wherever it is expected"),
    ("stability.show: momentum", "shown wherever it is expected"),
    ("stability.show: motion", "shown wherever it is expected"),
    ("stability.show: nodal_velocity", "shown wherever it is expected"),
    ("stability.show: particle_to_grid", "shown wherever it is expected"),
    ("stability.show: particle_velocity", "shown wherever it is expected"),
    ("stability.show: speed", "shown wherever it is expected"),
    ("stability.show: steps", "shown wherever it is expected"),
    ("stability.show: stored_energy", "shown wherever it is expected"),
    ("stability.show: stress_work_error", "shown wherever it is expected"),
    ("stability.show: transfer_gain", "shown wherever it is expected"),
];

/// Returns the known reason for a key, or for a key with a name.
pub(super) fn reason(word: &str) -> Option<&'static str> {
    REASONS.iter().find(|(known, _)| *known == word).map(|(_, reason)| *reason)
}

/// Lists keys and names without a gate or a reason, and reasons that do not hold.
pub(super) fn wrong(numbers: &BTreeMap<String, Line>, names: &Names) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut hold = |word: &str, is_held: bool, shown: &str| {
        let known = reason(word);
        match known {
            None if !is_held => wrong.push(format!("{word}: no gate and no reason")),
            Some(_) if is_held => wrong.push(format!("{word}: a gate, and a reason for none")),
            _ if known.unwrap_or_default() != shown => {
                wrong.push(format!("{word}: another reason in docs/keys.md; run ci/keys"));
            }
            _ => {}
        }
    };
    for (key, line) in numbers {
        let is_small = SMALL.contains(&line.least.as_str());
        let is_noticed = is_small || (!is_of_solver(key) && !line.least.is_empty());
        hold(key, is_noticed, &line.reason);
    }
    for ((key, name), (suites, shown)) in names {
        hold(&format!("{key}: {name}"), *suites > 0, shown);
    }
    let is_word = |word: &str| {
        let name = word.split_once(": ");
        numbers.contains_key(word)
            || name
                .is_some_and(|(key, name)| names.contains_key(&(key.to_owned(), name.to_owned())))
    };
    let gone = REASONS.iter().filter(|(word, _)| !is_word(word));
    let gone: Vec<String> = gone.map(|(word, _)| format!("{word}: no such word")).collect();
    wrong.into_iter().chain(gone).collect()
}
