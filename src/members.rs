//! Members of the families that have files on both sides of a wall, one line each. Every room reads
//! its own part of the lines: it declares the modules of its files by them, and names no other's.

/// Calls the macro `declare` with every material. A line
///
/// `"hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON }, truth hencky::HenckyLaw;`
///
/// gives the name of the material in suites; its file and type in `mpm/material`, with the keys of
/// its parameters in the order in which `new` takes them; and the file and type of its law in
/// `exact/law`, whose `new` takes the same. `#[serde(default)]` before a key makes it optional and
/// zero. A material without `truth` has no stated solutions.
macro_rules! each_material {
    ($declare:ident) => {
        $declare! {
            "linear_elastic" => linear_elastic::LinearElastic { young: YOUNG, poisson: POISSON },
                truth small_strain::SmallStrainLaw;
            "neo_hookean" => neo_hookean::NeoHookean { young: YOUNG, poisson: POISSON },
                truth neo_hookean::NeoHookeanLaw;
            "hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON },
                truth hencky::HenckyLaw;
            "j2" => j2::J2 {
                young: YOUNG, poisson: POISSON, r#yield: YIELD, #[serde(default)] hardening: HARDENING
            }, truth j2::J2Law;
            "newtonian" => newtonian::Newtonian { bulk: BULK, viscosity: VISCOSITY },
                truth tait::TaitLaw;
            "rigid" => rigid::Rigid {};
        }
    };
}
pub(crate) use each_material;

/// The key of a field: `yield` for `r#yield`.
pub(crate) fn key(field: &'static str) -> &'static str {
    field.trim_start_matches("r#")
}
