//! Capabilities of solvers, requirements of problems, and the names that both use.

use mpm_subject::nearest;
use serde::{Deserialize, Serialize};

/// Declares the capabilities that a solver either has or lacks. Each line has the name of the
/// capability and of the requirement, then a description of each.
macro_rules! flags {
    ($($name:ident: $capability:literal, $need:literal;)+) => {
        /// Capabilities of a solver. A capability that is not listed is missing.
        #[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        #[serde(default)]
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
            #[doc = "Parameters for which the solver returns derivatives of functionals of the final \
                state."]
            pub gradients: Vec<String>,
            $(#[doc = $capability] pub $name: bool,)+
            /// Whether columns may be sent as raw bytes.
            pub binary: bool,
        }

        /// Requirements of a problem. Names are those in suites and capabilities.
        #[derive(Debug, Clone, Default, PartialEq, Eq)]
        #[non_exhaustive]
        pub struct ProblemNeeds {
            /// Number of space dimensions.
            pub dimension: usize,
            /// Names of the laws.
            pub laws: Vec<&'static str>,
            /// Names of the conditions on faces.
            pub conditions: Vec<&'static str>,
            /// Names of the loads and effects.
            pub loads: Vec<&'static str>,
            /// Optional columns from which the judged quantity is computed.
            pub columns: Vec<&'static str>,
            /// Parameters for which the study needs derivatives.
            pub gradients: Vec<&'static str>,
            #[doc = "Whether a solver with the law `small_strain` may replace `linear_elastic`: the \
                judged state is an exact solution of small-strain elasticity."]
            pub small_strain: bool,
            /// Whether the verdict depends on the velocities.
            pub velocity: bool,
            /// Whether the verdict depends on the number of particles that change cells.
            pub crossings: bool,
            $(#[doc = $need] pub $name: bool,)+
            /// Parts of the scene that the protocol does not support.
            pub beyond: Vec<&'static str>,
        }

        const FLAGS: &[&str] = &[$(stringify!($name)),+];

        #[cfg(feature = "external-programs")]
        const KEYS: &[&str] = &[
            "dimensions", "laws", "conditions", "loads", "columns", "gradients",
            $(stringify!($name),)+ "binary",
        ];

        impl Capabilities {
            fn flags(&self) -> [bool; FLAGS.len()] {
                [$(self.$name),+]
            }
        }

        impl ProblemNeeds {
            fn flags(&self) -> [bool; FLAGS.len()] {
                [$(self.$name),+]
            }
        }
    };
}

flags! {
    manufactured: "Whether the body force may be given by values only, without a formula.",
        "Whether the body force is manufactured.";
    initial_deformation:
        "Whether particles may start with a displacement, a deformation gradient and a stress.",
        "Whether the body starts deformed.";
    several_bodies: "Whether there may be more than one body.", "Whether there are several bodies.";
    contact: "Whether bodies may be in contact, with Coulomb friction.",
        "Whether bodies are in contact.";
    plane_stress: "Whether bodies in two dimensions may be plates in plane stress.",
        "Whether the bodies are plates in plane stress.";
    axisymmetric:
        "Whether bodies in two dimensions may be meridian planes of bodies of revolution.",
        "Whether the bodies are bodies of revolution.";
    initial_stress: "Whether there may be a stress in the reference configuration.",
        "Whether there is a stress in the reference configuration.";
    displacement_force: "Whether the body force may depend on the displacement.",
        "Whether the body force depends on the displacement.";
    varying_density:
        "Whether the reference density may vary over a body. The given particle masses include this\n\
        variation.",
        "Whether the reference density varies over a body.";
    loaded_rims: "Whether loads may act on the rims of disks and annuli.",
        "Whether a load acts on the rim of a disk or an annulus.";
    load_steps: "Whether the load may be applied in quasi-static load steps, without time.",
        "Whether the load is applied in load steps.";
}

impl Capabilities {
    /// Creates capabilities with these dimensions, laws, conditions and loads, named as in suites.
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

    /// Lists the missing capabilities, each as an entry to be added to `hello`.
    pub fn lacking(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacking = Vec::new();
        if !self.dimensions.contains(&needs.dimension) {
            lacking.push(format!("dimensions: {}", needs.dimension));
        }
        let wanted =
            [&needs.laws, &needs.conditions, &needs.loads, &needs.columns, &needs.gradients];
        for ((capability, has), wanted) in self.lists().into_iter().zip(wanted) {
            let replaces = |known: &str, name: &str| {
                needs.small_strain && name == "linear_elastic" && known == SMALL_STRAIN
            };
            let is_met = |name: &str| has.iter().any(|one| one == name || replaces(one, name));
            let missing = wanted.iter().filter(|name| !is_met(name));
            lacking.extend(missing.map(|name| match misspelt(capability, name, has) {
                Some(stated) => format!("{capability}: {name} (stated as `{stated}`)"),
                None => format!("{capability}: {name}"),
            }));
        }
        for ((capability, wanted), has) in FLAGS.iter().zip(needs.flags()).zip(self.flags()) {
            if wanted && !has {
                lacking.push((*capability).to_owned());
            }
        }
        let beyond = needs.beyond.iter();
        lacking.extend(beyond.map(|what| format!("{what}, which the protocol does not support")));
        lacking
    }

    /// Lists the capabilities as entries of `hello`, in the notation of [`Self::lacking`], such as
    /// `loads: gravity` and `contact`. Unknown names are omitted.
    pub fn entries(&self) -> Vec<String> {
        let dimensions = self.dimensions.iter().filter(|d| (1..=3).contains(*d));
        let mut all: Vec<String> = dimensions.map(|d| format!("dimensions: {d}")).collect();
        for (capability, stated) in self.lists() {
            let stated = stated.iter().filter(|name| known(capability).contains(&name.as_str()));
            all.extend(stated.map(|name| format!("{capability}: {name}")));
        }
        let flags = FLAGS.iter().zip(self.flags()).chain([(&"binary", self.binary)]);
        all.extend(flags.filter(|(_, has)| *has).map(|(name, _)| (*name).to_owned()));
        all
    }

    fn lists(&self) -> [(&'static str, &Vec<String>); 5] {
        [
            ("laws", &self.laws),
            ("conditions", &self.conditions),
            ("loads", &self.loads),
            ("columns", &self.columns),
            ("gradients", &self.gradients),
        ]
    }

    /// Returns a warning for each unknown name in the lists and each unknown key in `keys`.
    #[cfg(feature = "external-programs")]
    pub(super) fn unknown_names(&self, keys: &[String]) -> Vec<String> {
        let mut warnings = Vec::new();
        for key in keys.iter().filter(|key| !KEYS.contains(&key.as_str())) {
            let hint = hint(key, KEYS);
            warnings.push(format!("unknown capability `{key}`; {hint}"));
        }
        for (capability, stated) in self.lists() {
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
    /// Lists the capabilities that need version 2 of the protocol.
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
        let wanted = FLAGS.iter().zip(self.flags()).filter(|(_, wanted)| *wanted);
        let new = wanted.map(|(name, _)| *name).filter(|name| !old.contains(name));
        all.extend(new.map(ToOwned::to_owned));
        all
    }
}

/// Law of solvers with linear kinematics: `sigma = C : sym(grad u)` in the reference configuration.
/// The built-in MPM does not have this law, but it is the law of the exact solutions of suites with
/// `linear_elastic`.
pub const SMALL_STRAIN: &str = "small_strain";

const LAWS: &[&str] = &[
    "linear_elastic",
    "jaumann",
    "green_naghdi",
    "neo_hookean",
    "hencky",
    "corotated",
    "j2",
    "drucker_prager",
    "mohr_coulomb",
    "cam_clay",
    "newtonian",
    "linear_fluid",
    "polytropic",
    "rigid",
    SMALL_STRAIN,
];

const LOADS: &[&str] = &[
    "gravity",
    "body_force",
    "damping",
    "local_damping",
    "artificial_viscosity",
    "traction",
    "pressure",
    "force",
    "velocity",
    "heat",
    "thermal_expansion",
];

const CONDITIONS: &[&str] = &["free", "fixed", "roller", "periodic", "friction", "velocity"];

/// Names of the optional columns of a state.
const COLUMNS: &[&str] = &["stress", "stress_across", "deformation_gradient", "temperature"];

const GRADIENTS: &[&str] =
    &["young", "poisson", "density", "yield", "hardening", "friction", "initial_velocity"];

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
pub(super) fn hint(name: &str, known: &[&str]) -> String {
    match nearest(name, known.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("known: {}", known.join(", ")),
    }
}

/// Creates the capabilities of a solver that supports everything.
///
/// # Panics
/// If [`Capabilities`] has a field of an unknown type, which a test would find.
pub fn everything() -> Capabilities {
    let mut all = serde_json::to_value(Capabilities::default()).unwrap();
    for (key, value) in all.as_object_mut().unwrap() {
        *value = match key.as_str() {
            "dimensions" => vec![1, 2, 3].into(),
            "laws" | "conditions" | "loads" | "columns" | "gradients" => known(key).into(),
            _ => true.into(),
        };
    }
    serde_json::from_value(all).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_use_the_notation_of_missing_capabilities() {
        let needs = ProblemNeeds {
            dimension: 3,
            laws: vec!["j2"],
            loads: vec!["traction"],
            contact: true,
            ..ProblemNeeds::default()
        };
        let mut able = Capabilities::of(&[3, 4], &["j2", "glass"], &[], &["traction"]);
        able.contact = true;
        assert_eq!(able.entries(), Capabilities::default().lacking(&needs));
        assert_eq!(able.entries().len(), 4);
    }

    #[test]
    fn unlisted_capabilities_are_lacking() {
        let needs = ProblemNeeds {
            dimension: 2,
            laws: vec!["neo_hookean"],
            conditions: vec!["free", "roller"],
            loads: vec!["gravity"],
            columns: vec!["stress"],
            gradients: vec!["young"],
            small_strain: true,
            velocity: true,
            crossings: true,
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
        let lists = [
            "dimensions: 2",
            "laws: neo_hookean",
            "conditions: free",
            "conditions: roller",
            "loads: gravity",
            "columns: stress",
            "gradients: young",
        ];
        let beyond = ["heat, which the protocol does not support"];
        assert_eq!(Capabilities::default().lacking(&needs), [&lists[..], FLAGS, &beyond].concat());
        assert_eq!(everything().lacking(&needs), beyond);
        let others = Capabilities { dimensions: vec![1, 3], ..everything() };
        assert_eq!(others.lacking(&needs), ["dimensions: 2", beyond[0]]);
    }

    #[test]
    fn small_strain_replaces_linear_elastic_where_the_solution_permits() {
        let able = Capabilities::of(&[1], &[SMALL_STRAIN], &[], &[]);
        let of = |law, small_strain| ProblemNeeds {
            dimension: 1,
            laws: vec![law],
            small_strain,
            ..ProblemNeeds::default()
        };
        assert_eq!(able.lacking(&of("linear_elastic", true)), [""; 0]);
        assert_eq!(able.lacking(&of("linear_elastic", false)), ["laws: linear_elastic"]);
        assert_eq!(able.lacking(&of("hencky", true)), ["laws: hencky"]);
    }

    #[test]
    fn known_names_are_those_of_suites() {
        let materials = crate::mpm::MaterialPlan::every(|_| 0.5);
        let laws = materials.iter().map(crate::mpm::MaterialPlan::name).chain([SMALL_STRAIN]);
        assert!(laws.eq(LAWS.iter().copied()));
        let loads = crate::suite::EffectName::ALL.iter().map(|load| load.name());
        assert!(loads.eq(LOADS.iter().copied()));
        let gradients = crate::subject::GradientParameter::ALL.iter().map(|one| one.name());
        assert!(gradients.eq(GRADIENTS.iter().copied()));
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
