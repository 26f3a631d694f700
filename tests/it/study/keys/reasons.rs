//! Why no gate can notice a hundredth of a number, or no suite has a name.

use super::page::{Line, Names};
use super::search::is_of_solver;
use std::collections::BTreeMap;

/// Changes that are small enough.
const SMALL: [&str; 4] = ["0.01 %", "0.1 %", "1 %", "+ 1"];

/// Keys, or keys and names as `key: name`, with their reasons.
const REASONS: &[(&str, &str)] = &[
    ("scene.material.jaumann.density", "its suite has no acceleration"),
    ("scene.material.green_naghdi.density", "its suite has no acceleration"),
    ("scene.dimension", "another dimension is another text: vectors lack components"),
    ("particles.perturb", "any place of a particle is right: errors are taken where it is"),
    ("particles.shift", "any place of a particle is right: errors are taken where it is"),
    ("internal_force.positions", "what is predicted holds wherever the particle is"),
    ("any_method.error_below", "of an external solver: tests/it/external"),
    ("any_method.order", "of an external solver: tests/it/external"),
    ("methods.external.formal_order", "of a solver of somebody else: tests/it/external"),
    ("equilibrium.linearised.tolerance", "one check serves this and exact"),
    ("equilibrium.temperature", "refused: a body in which heat flows is not at rest"),
    ("equilibrium.tolerance", "one check serves this and exact"),
    ("reference.same_method.cells", "a finer computation is the same truth"),
    ("stability.run.full_steps", "of a full run, which is longer than that of the gate"),
    ("expect.drift.mass", "masses are never written: the drift is zero, whatever the bound"),
    ("internal_force.expect.agrees_within", "linear functions meet the prediction to the last bit"),
    ("run.dt.courant", "any stable step is right, and what is expected has room for its error"),
    ("acknowledge.warning: few_levels", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: leaves_grid", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: single_precision", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: inside_cell", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: undamped", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: loose_tolerance", "of a suite that intends it: tests/it/cli/check.rs"),
    ("acknowledge.warning: end_on_node", "of a suite that intends it: tests/it/cli/check.rs"),
    ("equilibrium.equation: corotated", "one check serves this and exact"),
    ("equilibrium.equation: cam_clay", "one check serves this and exact"),
    ("equilibrium.equation: j2", "one check serves this and exact"),
    ("equilibrium.equation: linear_fluid", "one check serves this and exact"),
    ("equilibrium.equation: small_strain", "one check serves this and exact"),
    ("equilibrium.equation: log_strain", "refused: a law of the FEM bar alone"),
    ("exact.equation: log_strain", "refused: a law of the FEM bar alone"),
    ("judge.crossing_levels: counted", "the default"),
    ("methods: external", "of a solver of somebody else: tests/it/external"),
    ("methods.external.precision: double", "of a solver of somebody else: tests/it/external"),
    ("methods.external.precision: single", "of a solver of somebody else: tests/it/external"),
    ("methods.fem.law: corotated", "refused: the reference FEM has none"),
    ("reference.equation: corotated", "refused: the reference FEM has none"),
    ("methods.fem.law: jaumann", "refused: the reference FEM has none"),
    ("reference.equation: jaumann", "refused: the reference FEM has none"),
    ("equilibrium.equation: jaumann", "one check serves this and exact"),
    ("methods.fem.law: green_naghdi", "refused: the reference FEM has none"),
    ("reference.equation: green_naghdi", "refused: the reference FEM has none"),
    ("equilibrium.equation: green_naghdi", "one check serves this and exact"),
    ("methods.fem.law: j2", "refused: the reference FEM has none"),
    ("methods.fem.law: drucker_prager", "refused: the reference FEM has none"),
    ("methods.fem.law: mohr_coulomb", "refused: the reference FEM has none"),
    ("methods.fem.law: cam_clay", "refused: the reference FEM has none"),
    ("reference.equation: j2", "refused: the reference FEM has none"),
    ("reference.equation: drucker_prager", "refused: the reference FEM has none"),
    ("reference.equation: mohr_coulomb", "refused: the reference FEM has none"),
    ("reference.equation: cam_clay", "refused: the reference FEM has none"),
    ("methods.fem.law: linear_fluid", "refused: the reference FEM has none"),
    ("reference.equation: linear_fluid", "refused: the reference FEM has none"),
    ("methods.fem.law: tait", "refused: the reference FEM has none"),
    ("reference.equation: tait", "refused: the reference FEM has none"),
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
    ("stability.show: kinetic_kept", "shown wherever it is expected"),
    ("stability.show: momentum", "shown wherever it is expected"),
    ("stability.show: speed", "shown wherever it is expected"),
    ("stability.show: steps", "shown wherever it is expected"),
    ("stability.show: stress", "shown wherever it is expected"),
];

/// The reason that is known for a key, or a key and a name.
pub(super) fn reason(word: &str) -> Option<&'static str> {
    REASONS.iter().find(|(known, _)| *known == word).map(|(_, reason)| *reason)
}

/// Words without a gate or a reason, and reasons that do not hold.
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
