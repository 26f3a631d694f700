//! Loads and effects of a scene. A new load needs a file in this folder and a line in `members`. If
//! the solver has no corresponding effect yet, that effect also needs a file in the solver.

mod contract;
mod entry;
mod name;

pub(crate) use contract::{BodySite, ListedLoad, LoadTarget};
pub(crate) use entry::{LoadEntry, LoadKeys, StudyFacts};
pub use name::EffectName;

use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::scene::Scene;
use crate::suite::yaml::Diagnostic;

/// Declares the loads and effects of scenes. A line
///
/// `Gravity = "gravity" => gravity::GravitySpec;`
///
/// gives the member of [`EffectName`], its name in suites, and the file and type of its keys, which
/// implement [`LoadKeys`].
macro_rules! loads {
    ($(
        $(#[$meta:meta])*
        $member:ident = $text:literal => $file:ident::$spec:ident;
    )+) => {
        $(mod $file;)+

        /// One entry of `loads`.
        #[derive(Debug, Clone, serde::Deserialize)]
        #[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
        pub(crate) enum LoadSpec {
            $($(#[$meta])* #[serde(rename = $text)] $member($file::$spec),)+
        }

        impl EffectName {
            /// Returns an example entry of `loads` with this effect and the strength `s`, in
            /// `dimension` dimensions. The effect acts on the body, the face `right` or the set
            /// `some`.
            pub fn example(self, dimension: usize) -> String {
                let vector = vec!["s*(1 + t)"; dimension].join(", ");
                let vector = format!("[{vector}]");
                let keys = match self {
                    $(Self::$member => $file::$spec::example(&vector),)+
                };
                format!("{}: {keys}", self.name())
            }
        }

        impl LoadSpec {
            pub(crate) fn effect(&self) -> EffectName {
                match self {
                    $(Self::$member(_) => EffectName::$member,)+
                }
            }

            pub(crate) fn keys(&self) -> &dyn LoadKeys {
                match self {
                    $(Self::$member(keys) => keys,)+
                }
            }
        }
    };
}

loads! {
    /// A uniform acceleration, constant or a function of time.
    Gravity = "gravity" => gravity::GravitySpec;
    /// A force per unit mass that depends on the particle, declared or manufactured.
    BodyForce = "body_force" => body_force::BodyForceSpec;
    /// Damping in proportion to mass.
    Damping = "damping" => damping::DampingSpec;
    /// A damping force against the motion, proportional to the unbalanced force.
    LocalDamping = "local_damping" => local_damping::LocalDampingSpec;
    /// A viscous pressure against compression, which smooths shocks.
    ArtificialViscosity = "artificial_viscosity" => artificial_viscosity::ViscositySpec;
    /// A traction on a face of the body, carried by the layer of particles at that face.
    Traction = "traction" => traction::TractionSpec;
    /// A pressure on a face of the body, which follows the moving face.
    Pressure = "pressure" => pressure::PressureSpec;
    /// A total force on a set of particles.
    SetForce = "force" => set_force::SetForceSpec;
    /// A prescribed velocity of a set of particles.
    PrescribedVelocity = "velocity" => set_velocity::SetVelocitySpec;
    /// Heat conduction, with a temperature on particles and additional grid fields.
    Heat = "heat" => heat::HeatSpec;
    /// Thermal strain.
    ThermalExpansion = "thermal_expansion" => thermal_expansion::ExpansionSpec;
}

impl LoadSpec {
    pub(crate) fn path<'a>(&self, evaluator: &'a Evaluator<'a>, number: usize) -> SuitePath<'a> {
        evaluator.top("scene.loads").then(number).then(self.effect().name())
    }
}

fn refuse_incomplete(evaluator: &Evaluator<'_>, loads: &[LoadSpec]) -> Result<(), Diagnostic> {
    let listed: Vec<EffectName> = loads.iter().map(LoadSpec::effect).collect();
    EffectName::combine(&listed).map_err(|(effect, message)| {
        let at = listed.iter().position(|listed| *listed == effect).unwrap_or(0);
        loads[at].path(evaluator, at).diagnostic_at_key(&message)
    })
}

/// Adds the loads to a scene without loads, in the order in which solvers apply them.
pub(crate) fn add(
    evaluator: &Evaluator<'_>,
    spec: &[LoadSpec],
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    refuse_incomplete(evaluator, spec)?;
    for (i, load) in spec.iter().enumerate() {
        let effect = load.effect();
        let entry = LoadEntry { effect, path: load.path(evaluator, i), scene };
        let load = load.keys().compile(&entry)?;
        scene.loads.push(ListedLoad { effect, load });
    }
    scene.loads.sort_by_key(|load| (load.target(), load.effect));
    Ok(())
}
