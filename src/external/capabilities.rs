//! Capabilities of solvers, requirements of problems, and the names that both use.

use crate::members::{each_effect, each_material};
use crate::nearest::nearest;
use serde::{Deserialize, Serialize};

/// Capabilities of a solver. A capability that is not listed is missing.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(default)]
#[expect(clippy::struct_excessive_bools, reason = "independent abilities, each asked by name")]
pub struct Capabilities {
    /// Supported numbers of space dimensions.
    pub dimensions: Vec<usize>,
    /// Materials, by their names in suites.
    pub laws: Vec<String>,
    /// Conditions on faces, by their names in suites.
    pub conditions: Vec<String>,
    /// Loads and effects, by their names in suites.
    pub loads: Vec<String>,
    /// Columns of the reported state in addition to displacement and velocity.
    pub columns: Vec<String>,
    /// Parameters for which the solver returns derivatives of functionals of the final state.
    pub gradients: Vec<String>,
    /// Whether the body force may be given by values only, without a formula.
    pub manufactured: bool,
    /// Whether particles may start with a displacement, a deformation gradient and a stress.
    pub initial_deformation: bool,
    /// Whether there may be more than one body.
    pub several_bodies: bool,
    /// Whether bodies may be in contact, with Coulomb friction.
    pub contact: bool,
    /// Whether bodies in two dimensions may be plates in plane stress.
    pub plane_stress: bool,
    /// Whether bodies in two dimensions may be meridian planes of bodies of revolution.
    pub axisymmetric: bool,
    /// Whether there may be a stress in the reference configuration.
    pub initial_stress: bool,
    /// Whether the body force may depend on the displacement.
    pub displacement_force: bool,
    /// Whether the reference density may vary over a body. The given particle masses include this
    /// variation.
    pub varying_density: bool,
    /// Whether loads may act on the rims of disks and annuli.
    pub loaded_rims: bool,
    /// Whether the load may be applied in quasi-static load steps, without time.
    pub load_steps: bool,
    /// Whether columns may be sent as raw bytes.
    pub binary: bool,
}

/// Requirements of a problem. Names are those in suites and capabilities.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
#[expect(clippy::struct_excessive_bools, reason = "independent needs, each with its ability")]
pub struct ProblemNeeds {
    /// Number of space dimensions.
    pub dimension: usize,
    /// Names of the laws.
    pub laws: Vec<&'static str>,
    /// Names of the conditions on faces.
    pub conditions: Vec<&'static str>,
    /// Names of the loads and effects.
    pub loads: Vec<&'static str>,
    /// Optional column with the quantity whose error is measured, if the study needs one.
    pub column: Option<&'static str>,
    /// Parameters for which the study needs derivatives.
    pub gradients: Vec<&'static str>,
    /// Whether the body force is manufactured.
    pub manufactured: bool,
    /// Whether the body starts deformed.
    pub initial_deformation: bool,
    /// Whether there are several bodies.
    pub several_bodies: bool,
    /// Whether bodies are in contact.
    pub contact: bool,
    /// Whether the bodies are plates in plane stress.
    pub plane_stress: bool,
    /// Whether the bodies are bodies of revolution.
    pub axisymmetric: bool,
    /// Whether there is a stress in the reference configuration.
    pub initial_stress: bool,
    /// Whether the body force depends on the displacement.
    pub displacement_force: bool,
    /// Whether the reference density varies over a body.
    pub varying_density: bool,
    /// Whether a load acts on the rim of a disk or an annulus.
    pub loaded_rims: bool,
    /// Whether the load is applied in load steps.
    pub load_steps: bool,
    /// Parts of the scene that the protocol does not support.
    pub beyond: Vec<&'static str>,
}

impl Capabilities {
    /// Creates capabilities with these dimensions, laws, face conditions and loads, named as in
    /// suites.
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

    /// Lists the missing capabilities, each as the entry that the solver would have to add to
    /// `hello`.
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
            ("gradients", &self.gradients, &needs.gradients),
        ] {
            let missing = wanted.iter().filter(|name| !has.iter().any(|known| known == *name));
            lacking.extend(missing.map(|name| match misspelt(capability, name, has) {
                Some(stated) => format!("{capability}: {name} (stated as `{stated}`)"),
                None => format!("{capability}: {name}"),
            }));
        }
        for ((capability, wanted), has) in needs.flags().into_iter().zip(self.flags()) {
            if wanted && !has {
                lacking.push(capability.to_owned());
            }
        }
        let beyond = needs.beyond.iter();
        lacking.extend(beyond.map(|what| format!("{what}, which the protocol does not support")));
        lacking
    }
}

impl Capabilities {
    /// Returns the boolean capabilities, in the order of [`ProblemNeeds::flags`].
    fn flags(&self) -> [bool; 11] {
        [
            self.manufactured,
            self.initial_deformation,
            self.several_bodies,
            self.contact,
            self.plane_stress,
            self.axisymmetric,
            self.initial_stress,
            self.displacement_force,
            self.varying_density,
            self.loaded_rims,
            self.load_steps,
        ]
    }
}

impl Capabilities {
    /// Returns warnings, one line for each unknown name in the lists and each unknown key in
    /// `keys`.
    #[cfg(feature = "external-programs")]
    pub(super) fn unknown_names(&self, keys: &[String]) -> Vec<String> {
        let mut warnings = Vec::new();
        for key in keys.iter().filter(|key| !KEYS.contains(&key.as_str())) {
            let hint = hint(key, KEYS);
            warnings.push(format!("unknown capability `{key}`; {hint}"));
        }
        for (capability, stated) in [
            ("laws", &self.laws),
            ("conditions", &self.conditions),
            ("loads", &self.loads),
            ("columns", &self.columns),
            ("gradients", &self.gradients),
        ] {
            let known = known(capability);
            for name in stated.iter().filter(|name| !known.contains(&name.as_str())) {
                let hint = hint(name, known);
                warnings.push(format!("unknown name `{name}` in {capability}; {hint}"));
            }
        }
        for dimension in self.dimensions.iter().filter(|d| !(1..=3).contains(*d)) {
            warnings.push(format!("there are no suites in {dimension} dimensions"));
        }
        warnings
    }
}

impl ProblemNeeds {
    /// Returns the boolean requirements, with the names of the corresponding capabilities.
    fn flags(&self) -> [(&'static str, bool); 11] {
        [
            ("manufactured", self.manufactured),
            ("initial_deformation", self.initial_deformation),
            ("several_bodies", self.several_bodies),
            ("contact", self.contact),
            ("plane_stress", self.plane_stress),
            ("axisymmetric", self.axisymmetric),
            ("initial_stress", self.initial_stress),
            ("displacement_force", self.displacement_force),
            ("varying_density", self.varying_density),
            ("loaded_rims", self.loaded_rims),
            ("load_steps", self.load_steps),
        ]
    }

    /// Lists the requirements that need version 2 of the protocol, each as the corresponding entry
    /// of the capabilities.
    #[cfg(feature = "external-programs")]
    pub(crate) fn beyond_version_1(&self) -> Vec<String> {
        let by_name = |capability: &'static str, names: &[&'static str], handed: &[&str]| {
            let missing = names.iter().filter(|name| !handed.contains(*name));
            missing.map(|name| format!("{capability}: {name}")).collect::<Vec<_>>()
        };
        let mut all = by_name("loads", &self.loads, &["gravity", "body_force"]);
        let plain = ["free", "fixed", "roller", "periodic"];
        all.extend(by_name("conditions", &self.conditions, &plain));
        let old = ["manufactured", "initial_deformation", "several_bodies"];
        let flags =
            self.flags().into_iter().filter(|(name, wanted)| *wanted && !old.contains(name));
        all.extend(flags.map(|(name, _)| name.to_owned()));
        all
    }
}

/// Declares the names of the materials, from the lines of [`each_material`](crate::members).
macro_rules! laws {
    ($($name:literal => $file:ident::$law:ident {$($parameters:tt)*}
        $(, truth $truth_file:ident::$truth:ident)?;)+
    ) => {
        const LAWS: &[&str] = &[$($name),+];
    };
}

each_material!(laws);

/// Declares the names of the loads and effects, from the lines of [`each_effect`](crate::members).
macro_rules! loads {
    ($($(#[$meta:meta])* $member:ident = $name:literal => $file:ident::$spec:ident
        $(, effect $effect_file:ident::$effect:ident)? $(, needs [$($need:ident),+])?;)+
    ) => {
        const LOADS: &[&str] = &[$($name),+];
    };
}

each_effect!(loads);

const CONDITIONS: &[&str] = &["free", "fixed", "roller", "periodic", "friction", "velocity"];

/// Names of the optional columns of a state.
const COLUMNS: &[&str] = &["stress", "deformation_gradient", "temperature"];

const GRADIENTS: &[&str] =
    &["young", "poisson", "density", "yield", "hardening", "friction", "initial_velocity"];

#[cfg(feature = "external-programs")]
const KEYS: &[&str] = &[
    "dimensions",
    "laws",
    "conditions",
    "loads",
    "columns",
    "gradients",
    "manufactured",
    "initial_deformation",
    "several_bodies",
    "contact",
    "plane_stress",
    "axisymmetric",
    "initial_stress",
    "displacement_force",
    "varying_density",
    "loaded_rims",
    "load_steps",
    "binary",
];

fn known(capability: &str) -> &'static [&'static str] {
    match capability {
        "laws" => LAWS,
        "conditions" => CONDITIONS,
        "loads" => LOADS,
        "gradients" => GRADIENTS,
        _ => COLUMNS,
    }
}

/// Returns the first unknown name in `stated` that is probably a misspelling of `name`.
fn misspelt<'a>(capability: &str, name: &str, stated: &'a [String]) -> Option<&'a str> {
    let known = known(capability);
    let unknown = stated.iter().map(String::as_str).filter(|stated| !known.contains(stated));
    unknown.into_iter().find(|stated| nearest(stated, known.iter().copied()) == Some(name))
}

/// Suggests the known name that is most similar to a mistyped name, or lists all known names.
#[cfg(feature = "external-programs")]
fn hint(name: &str, known: &[&'static str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("known: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unlisted_capabilities_are_lacking() {
        let needs = ProblemNeeds {
            dimension: 2,
            laws: vec!["neo_hookean"],
            conditions: vec!["free", "roller"],
            loads: vec!["gravity"],
            column: Some("stress"),
            gradients: vec!["young"],
            manufactured: true,
            initial_deformation: true,
            several_bodies: true,
            contact: true,
            plane_stress: true,
            axisymmetric: true,
            initial_stress: true,
            displacement_force: true,
            varying_density: true,
            loaded_rims: true,
            load_steps: true,
            beyond: vec!["heat"],
        };
        let all = [
            "dimensions: 2",
            "laws: neo_hookean",
            "conditions: free",
            "conditions: roller",
            "loads: gravity",
            "columns: stress",
            "gradients: young",
            "manufactured",
            "initial_deformation",
            "several_bodies",
            "contact",
            "plane_stress",
            "axisymmetric",
            "initial_stress",
            "displacement_force",
            "varying_density",
            "loaded_rims",
            "load_steps",
            "heat, which the protocol does not support",
        ];
        assert_eq!(Capabilities::default().lacking(&needs), all);
        let conditions = ["free", "fixed", "roller"];
        let able = Capabilities {
            columns: vec!["stress".to_owned()],
            gradients: vec!["young".to_owned()],
            manufactured: true,
            initial_deformation: true,
            several_bodies: true,
            contact: true,
            plane_stress: true,
            axisymmetric: true,
            initial_stress: true,
            displacement_force: true,
            varying_density: true,
            loaded_rims: true,
            load_steps: true,
            ..Capabilities::of(&[1, 2], &["neo_hookean"], &conditions, &["gravity"])
        };
        assert_eq!(able.lacking(&needs), all[18..]);
    }

    #[test]
    fn known_gradients_are_the_parameters() {
        let names = crate::subject::GradientParameter::ALL.iter().map(|parameter| parameter.name());
        assert!(names.eq(GRADIENTS.iter().copied()));
    }

    #[test]
    #[cfg(feature = "external-programs")]
    fn known_keys_are_the_fields_of_the_capabilities() {
        let all = serde_json::to_value(Capabilities::default()).unwrap();
        let mut fields: Vec<&str> = all.as_object().unwrap().keys().map(String::as_str).collect();
        let mut keys = KEYS.to_vec();
        fields.sort_unstable();
        keys.sort_unstable();
        assert_eq!(keys, fields);
    }

    #[test]
    #[cfg(feature = "external-programs")]
    fn unknown_names_have_hints() {
        let laws = ["linear-elastic", "hencky"];
        let stated = Capabilities::of(&[2, 4], &laws, &["clamped", "Roller"], &["bodyforce"]);
        let keys = ["periodic_axes", "contacts", "laws"].map(str::to_owned);
        let warnings = stated.unknown_names(&keys);
        let expected = [
            "unknown capability `periodic_axes`; known: dimensions, ",
            "unknown capability `contacts`; did you mean `contact`?",
            "unknown name `linear-elastic` in laws; did you mean `linear_elastic`?",
            "unknown name `clamped` in conditions; known: free, fixed, ",
            "unknown name `Roller` in conditions; did you mean `roller`?",
            "unknown name `bodyforce` in loads; did you mean `body_force`?",
            "there are no suites in 4 dimensions",
        ];
        assert_eq!(warnings.len(), expected.len(), "{warnings:#?}");
        for (warning, expected) in warnings.iter().zip(expected) {
            assert!(warning.starts_with(expected), "{warning}");
        }
        let misspelt = |name| misspelt("laws", name, &stated.laws);
        assert_eq!(misspelt("linear_elastic"), Some("linear-elastic"));
        assert_eq!(misspelt("hencky"), None);
    }
}
