//! Registration: one line assigns a law of exact solutions to a material.

/// Declares the family of laws, from the lines of [`each_material`](crate::members) that have one.
macro_rules! laws {
    (@new $law:ident, $value:ident, {
        $($(#[$field_meta:meta])* $field:ident: $parameter:ident),* $(,)?
    }) => {
        $law::new($($value($crate::members::key(stringify!($field)))?),*)
    };
    ($($material:literal => $solver_file:ident::$solver:ident $parameters:tt
        $(, truth $file:ident::$law:ident)?;)+
    ) => {
        $($(
            mod $file;
            pub use $file::$law;
        )?)+

        /// The equation of motion `rho0 u_tt = Div P(grad u) + rho0 b`, by its constitutive law.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Equation {
            $($(
                #[doc = concat!("Of a `", $material, "` body.")]
                $law($law),
            )?)+
        }

        $($(impl From<$law> for Equation {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        })?)+

        impl Equation {
            /// Names of all laws, as in suites.
            pub const NAMES: &[&'static str] = &[$($($law::NAME,)?)+];

            /// The equation of a body of a material, from the name of the material and its
            /// parameters by key; `None` if there is no law for it.
            pub fn of_material(
                material: &str,
                parameter: impl Fn(&str) -> Option<f64>,
            ) -> Option<Self> {
                Some(match material {
                    $($($material => {
                        Self::$law($crate::exact::law::laws!(@new $law, parameter, $parameters))
                    })?)+
                    _ => return None,
                })
            }

            /// Name of the law, as in suites.
            pub fn name(&self) -> &'static str {
                match self {
                    $($(Self::$law(_) => $law::NAME,)?)+
                }
            }

            /// The equation as reports write it.
            pub fn text(&self) -> &'static str {
                match self {
                    $($(Self::$law(_) => $law::EQUATION,)?)+
                }
            }

            /// Whether the stress depends on the history of the motion, unless loading never
            /// reverses.
            pub(super) fn has_history(&self) -> bool {
                match self {
                    $($(Self::$law(_) => $law::HAS_HISTORY,)?)+
                }
            }

            /// P (Pa) for the displacement gradient `grad[i][j] = du_i/dX_j`, at unit reference
            /// density if the law depends on it, see [`Equation::density_factor`].
            pub fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
                match self {
                    $($(Self::$law(law) => law.piola(grad),)?)+
                }
            }

            /// The energy W (J/m3) whose derivative is P, zero at rest or, in a gas, in the limit
            /// of infinite expansion; `None` for a law without energy. At unit reference density,
            /// as P.
            pub fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
                match self {
                    $($(Self::$law(law) => law.energy(grad),)?)+
                }
            }

            /// Stiffest modulus at rest (Pa): a bound for stresses of a given strain. At unit
            /// reference density, as P.
            pub fn modulus(&self) -> f64 {
                match self {
                    $($(Self::$law(law) => law.modulus(),)?)+
                }
            }

            /// Factor of P, of the energy and of the modulus at the reference density `density`
            /// (kg/m3), 1 for a law that does not depend on it.
            pub fn density_factor<T: Number>(&self, density: T) -> T {
                match self {
                    $($(Self::$law(law) => law.density_factor(density),)?)+
                }
            }

            /// `3 lambda + 2 mu` (Pa) of a law of small strains; `None` for finite strains.
            pub(super) fn small_strain_modulus(&self) -> Option<f64> {
                match self {
                    $($(Self::$law(law) => law.small_strain_modulus(),)?)+
                }
            }

            /// `F_33 - 1` of a plate in plane stress, sigma_33 = 0, for the displacement gradient
            /// in its plane; `None` if the law is not implemented there.
            pub(super) fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
                match self {
                    $($(Self::$law(law) => law.free_gradient(grad),)?)+
                }
            }

            /// Whether a body in uniaxial strain flows plastically at the displacement gradient
            /// `grad`.
            pub(super) fn flows(&self, grad: f64) -> bool {
                match self {
                    $($(Self::$law(law) => law.flows(grad),)?)+
                }
            }

            /// Whether the law holds of a motion in `dimension` dimensions, or of a state
            /// `at_rest`.
            ///
            /// # Errors
            /// The reason why not, and what a suite can state instead.
            pub fn admits(&self, dimension: usize, at_rest: bool) -> Result<(), [&'static str; 2]> {
                match self {
                    $($(Self::$law(law) => law.admits(dimension, at_rest),)?)+
                }
            }
        }
    };
}
pub(super) use laws;
