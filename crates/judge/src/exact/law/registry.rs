//! Assigns laws of exact solutions to materials.

/// Declares `Equation` with a variant for each law. A line
///
/// `"hencky" => hencky::HenckyLaw["young", "poisson"];`
///
/// gives the name of the material in suites, the file and type of its law, and the keys of the
/// material parameters in the argument order of `new`.
macro_rules! laws {
    ($($material:literal => $file:ident::$law:ident[$($key:literal),*];)+) => {
        $(
            mod $file;
            pub use $file::$law;
        )+

        /// The equation of motion `rho0 u_tt = Div P(grad u) + rho0 b` with one of the laws.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Equation {
            $(
                #[doc = concat!("Of a `", $material, "` body.")]
                $law($law),
            )+
        }

        $(impl From<$law> for Equation {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        })+

        impl Equation {
            /// Names of all laws in suites.
            pub const NAMES: &[&'static str] = &[$($law::NAME,)+];

            /// Returns the equation for the name and parameters of a material, if there is a law.
            pub fn of_material(
                material: &str,
                parameter: impl Fn(&str) -> Option<f64>,
            ) -> Option<Self> {
                Some(match material {
                    $($material => Self::$law($law::new($(parameter($key)?),*)),)+
                    _ => return None,
                })
            }

            /// Returns the name of the law in suites.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $law::NAME,)+
                }
            }

            /// Returns the equation of motion as reports print it.
            pub fn text(&self) -> &'static str {
                match self {
                    $(Self::$law(_) => $law::EQUATION,)+
                }
            }

            pub(super) fn has_history(&self) -> bool {
                match self {
                    $(Self::$law(_) => $law::HAS_HISTORY,)+
                }
            }

            /// Computes P (Pa) for `grad[i][j] = du_i/dX_j`, at unit density if the law depends on
            /// the density, see [`Equation::density_factor`].
            pub fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
                match self {
                    $(Self::$law(law) => law.piola(grad),)+
                }
            }

            /// Computes the energy W (J/m3) whose derivative is P, for unit density like P; `None`
            /// for a law without energy.
            pub fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
                match self {
                    $(Self::$law(law) => law.energy(grad),)+
                }
            }

            /// Returns the scale of stress per strain (Pa) at rest, for unit density like P.
            pub fn modulus(&self) -> f64 {
                match self {
                    $(Self::$law(law) => law.modulus(),)+
                }
            }

            /// Returns the ratio of P, energy and modulus at `density` (kg/m3) to those at unit
            /// density.
            pub fn density_factor<T: Number>(&self, density: T) -> T {
                match self {
                    $(Self::$law(law) => law.density_factor(density),)+
                }
            }

            pub(super) fn small_strain_modulus(&self) -> Option<f64> {
                match self {
                    $(Self::$law(law) => law.small_strain_modulus(),)+
                }
            }

            pub(super) fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
                match self {
                    $(Self::$law(law) => law.free_gradient(grad),)+
                }
            }

            pub(super) fn piola_from<T: Number>(
                &self,
                grad: &Tensor<T>,
                initial: &Tensor<T>,
            ) -> Option<Tensor<T>> {
                match self {
                    $(Self::$law(law) => law.piola_from(grad, initial),)+
                }
            }

            pub(super) fn flows(&self, grad: f64, initial: &Tensor<f64>) -> bool {
                match self {
                    $(Self::$law(law) => law.flows(grad, initial),)+
                }
            }

            /// Checks that the law is valid in `dimension` dimensions, or for a body `at_rest`.
            ///
            /// # Errors
            /// The reason why the law is not valid, and an alternative for the suite.
            pub fn admits(&self, dimension: usize, at_rest: bool) -> Result<(), [&'static str; 2]> {
                match self {
                    $(Self::$law(law) => law.admits(dimension, at_rest),)+
                }
            }
        }
    };
}
pub(super) use laws;
