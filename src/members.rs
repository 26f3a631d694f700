//! Lists the materials and effects, one line each. The modules of materials, laws, loads and
//! effects declare their files from these lists.

/// Calls the macro `declare` with every material. A line
///
/// `"hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON }, truth hencky::HenckyLaw;`
///
/// gives the name of the material in suites; its file and type in `mpm/material`, with the
/// parameter keys in the argument order of `new`; and the file and type of its law in `exact/law`,
/// whose `new` takes the same arguments. `#[serde(default)]` before a key makes it optional, with
/// default zero. Suites cannot contain an exact solution for a material without `truth`.
macro_rules! each_material {
    ($declare:ident) => {
        $declare! {
            "linear_elastic" => linear_elastic::LinearElastic { young: YOUNG, poisson: POISSON },
                truth small_strain::SmallStrainLaw;
            "jaumann" => jaumann::Jaumann { young: YOUNG, poisson: POISSON },
                truth jaumann::JaumannLaw;
            "green_naghdi" => green_naghdi::GreenNaghdi { young: YOUNG, poisson: POISSON },
                truth green_naghdi::GreenNaghdiLaw;
            "neo_hookean" => neo_hookean::NeoHookean { young: YOUNG, poisson: POISSON },
                truth neo_hookean::NeoHookeanLaw;
            "hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON },
                truth hencky::HenckyLaw;
            "corotated" => corotated::Corotated { young: YOUNG, poisson: POISSON },
                truth corotated::CorotatedLaw;
            "j2" => j2::J2 {
                young: YOUNG, poisson: POISSON, r#yield: YIELD, #[serde(default)] hardening: HARDENING
            }, truth j2::J2Law;
            "drucker_prager" => drucker_prager::DruckerPrager {
                young: YOUNG, poisson: POISSON, friction: FRICTION, dilation: DILATION, strength: STRENGTH
            }, truth drucker_prager::DruckerPragerLaw;
            "mohr_coulomb" => mohr_coulomb::MohrCoulomb {
                young: YOUNG, poisson: POISSON, friction_angle: FRICTION_ANGLE,
                dilation_angle: DILATION_ANGLE, cohesion: COHESION
            }, truth mohr_coulomb::MohrCoulombLaw;
            "cam_clay" => cam_clay::CamClay {
                critical_state_slope: CRITICAL_SLOPE, swelling_slope: SWELLING,
                compression_slope: COMPRESSION, poisson: POISSON,
                initial_pressure: INITIAL_PRESSURE, preconsolidation: PRECONSOLIDATION
            }, truth cam_clay::CamClayLaw;
            "newtonian" => newtonian::Newtonian { bulk: BULK, viscosity: VISCOSITY },
                truth tait::TaitLaw;
            "linear_fluid" => linear_fluid::LinearFluid { bulk: BULK },
                truth linear_fluid::LinearFluidLaw;
            "polytropic" => polytropic::Polytropic { stiffness: STIFFNESS, exponent: EXPONENT },
                truth polytropic::PolytropicLaw;
            "rigid" => rigid::Rigid {};
        }
    };
}
pub(crate) use each_material;

/// Calls the macro `declare` with every load and effect of a scene. A line
///
/// `ThermalExpansion = "thermal_expansion" => thermal_expansion::ExpansionSpec,`
/// `effect thermal_expansion::ThermalExpansion, needs [Heat];`
///
/// gives the member of `EffectName`, its name in suites, and the file and type of its keys in
/// `suite/scene/load`. The file and type of the effect in `mpm/effect` and the list of required
/// effects are optional.
macro_rules! each_effect {
    ($declare:ident) => {
        $declare! {
            /// A uniform acceleration, constant or a function of time.
            Gravity = "gravity" => gravity::GravitySpec, effect gravity::Gravity;
            /// A force per unit mass that depends on the particle, declared or manufactured.
            BodyForce = "body_force" => body_force::BodyForceSpec, effect body_force::BodyForce;
            /// Damping in proportion to mass.
            Damping = "damping" => damping::DampingSpec, effect damping::Damping;
            /// A damping force against the motion, proportional to the unbalanced force.
            LocalDamping = "local_damping" => local_damping::LocalDampingSpec,
                effect local_damping::LocalDamping;
            /// A viscous pressure against compression, which smooths shocks.
            ArtificialViscosity = "artificial_viscosity" => artificial_viscosity::ViscositySpec,
                effect artificial_viscosity::ArtificialViscosity;
            /// A traction on a face of the body, carried by the layer of particles at that face.
            Traction = "traction" => traction::TractionSpec, effect traction::Traction;
            /// A pressure on a face of the body, which follows the moving face.
            Pressure = "pressure" => pressure::PressureSpec, effect pressure::Pressure;
            /// A total force on a set of particles.
            SetForce = "force" => set_force::SetForceSpec, effect set_force::SetForce;
            /// A prescribed velocity of a set of particles.
            PrescribedVelocity = "velocity" => set_velocity::SetVelocitySpec,
                effect prescribed_velocity::PrescribedVelocity;
            /// Heat conduction, with a temperature on particles and additional grid fields.
            Heat = "heat" => heat::HeatSpec, effect heat::Heat;
            /// Thermal strain.
            ThermalExpansion = "thermal_expansion" => thermal_expansion::ExpansionSpec,
                effect thermal_expansion::ThermalExpansion, needs [Heat];
        }
    };
}
pub(crate) use each_effect;

/// Returns the suite key of a field: its name without `r#`, such as `yield` for `r#yield`.
pub(crate) fn key(field: &'static str) -> &'static str {
    field.trim_start_matches("r#")
}
