//! Abilities of solvers, and needs of problems.

use serde::{Deserialize, Serialize};

/// Abilities of a solver. What is not named is lacking.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(default)]
#[expect(clippy::struct_excessive_bools, reason = "independent abilities, each asked by name")]
pub struct Capabilities {
    /// Numbers of space dimensions.
    pub dimensions: Vec<usize>,
    /// Materials, by their names in suites.
    pub laws: Vec<String>,
    /// Conditions on faces, by their names in suites.
    pub conditions: Vec<String>,
    /// Loads and effects, by their names in suites.
    pub loads: Vec<String>,
    /// Columns of its state besides displacement and velocity.
    pub columns: Vec<String>,
    /// Whether it takes a body force that is known by its values only.
    pub manufactured: bool,
    /// Whether particles may start displaced, with F and stress.
    pub initial_deformation: bool,
    /// Whether there may be more than one body.
    pub several_bodies: bool,
    /// Whether columns may be raw bytes.
    pub binary: bool,
}

/// Needs of a problem, each by the name that suites and capabilities have for it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ProblemNeeds {
    /// Number of space dimensions.
    pub dimension: usize,
    /// Materials.
    pub laws: Vec<&'static str>,
    /// Conditions on faces.
    pub conditions: Vec<&'static str>,
    /// Loads and effects.
    pub loads: Vec<&'static str>,
    /// The column that is judged, if it is none that every solver gives.
    pub column: Option<&'static str>,
    /// Whether the body force is manufactured.
    pub manufactured: bool,
    /// Whether the body starts deformed.
    pub initial_deformation: bool,
    /// Whether there are several bodies.
    pub several_bodies: bool,
    /// Parts of the scene that no solver can be handed yet.
    pub beyond: Vec<&'static str>,
}

impl Capabilities {
    /// Abilities by their names in suites: numbers of dimensions, laws, conditions on faces, loads.
    pub fn of(dimensions: &[usize], laws: &[&str], conditions: &[&str], loads: &[&str]) -> Self {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        Self {
            dimensions: dimensions.to_vec(),
            laws: owned(laws),
            conditions: owned(conditions),
            loads: owned(loads),
            ..Self::default()
        }
    }

    /// Everything that is needed and not there, each as the entry that would be missing.
    pub fn lacking(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacking = Vec::new();
        if !self.dimensions.contains(&needs.dimension) {
            lacking.push(format!("dimensions: {}", needs.dimension));
        }
        let column: Vec<&str> = needs.column.into_iter().collect();
        for (capability, has, wanted) in [
            ("laws", &self.laws, &needs.laws),
            ("conditions", &self.conditions, &needs.conditions),
            ("loads", &self.loads, &needs.loads),
            ("columns", &self.columns, &column),
        ] {
            let missing = wanted.iter().filter(|name| !has.iter().any(|known| known == *name));
            lacking.extend(missing.map(|name| format!("{capability}: {name}")));
        }
        for (capability, has, wanted) in [
            ("manufactured", self.manufactured, needs.manufactured),
            ("initial_deformation", self.initial_deformation, needs.initial_deformation),
            ("several_bodies", self.several_bodies, needs.several_bodies),
        ] {
            if wanted && !has {
                lacking.push(capability.to_owned());
            }
        }
        let beyond = needs.beyond.iter();
        lacking.extend(beyond.map(|what| format!("{what}, which the protocol does not hand over")));
        lacking
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_is_not_named_is_lacking() {
        let needs = ProblemNeeds {
            dimension: 2,
            laws: vec!["neo_hookean"],
            conditions: vec!["free", "roller"],
            loads: vec!["gravity"],
            column: Some("stress"),
            manufactured: true,
            initial_deformation: true,
            several_bodies: true,
            beyond: vec!["heat"],
        };
        let all = [
            "dimensions: 2",
            "laws: neo_hookean",
            "conditions: free",
            "conditions: roller",
            "loads: gravity",
            "columns: stress",
            "manufactured",
            "initial_deformation",
            "several_bodies",
            "heat, which the protocol does not hand over",
        ];
        assert_eq!(Capabilities::default().lacking(&needs), all);
        let conditions = ["free", "fixed", "roller"];
        let able = Capabilities {
            columns: vec!["stress".to_owned()],
            manufactured: true,
            initial_deformation: true,
            several_bodies: true,
            ..Capabilities::of(&[1, 2], &["neo_hookean"], &conditions, &["gravity"])
        };
        assert_eq!(able.lacking(&needs), all[9..]);
    }
}
