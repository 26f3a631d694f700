//! Registration: one line defines the name of a material and the keys of its parameters.

/// Returns the suite key of a field: its name without `r#`, such as `yield` for `r#yield`.
pub(super) fn key(field: &'static str) -> &'static str {
    field.trim_start_matches("r#")
}

/// Declares the registry of materials. A line
///
/// `"hencky" => hencky::Hencky { young: YOUNG, poisson: POISSON };`
///
/// gives the name of the material in suites, its file and type, and the parameter keys in the
/// argument order of `new`. `#[serde(default)]` before a key makes it optional, with default zero.
/// The key of the density is added to the keys of every material. Laws do not receive this key,
/// because they compute the density from the masses.
macro_rules! materials {
    ($($name:literal => $file:ident::$member:ident {
        $($(#[$field_meta:meta])* $field:ident: $parameter:ident),* $(,)?
    };)+) => {
        $(
            mod $file;
            pub use $file::$member;
        )+

        /// A material as written in a suite: its name, parameters and density. `N` is the type of
        /// the values.
        #[derive(Debug, Clone, PartialEq, serde::Deserialize)]
        #[cfg_attr(
            feature = "schemas",
            derive(schemars::JsonSchema),
            schemars(bound = "N: Default + schemars::JsonSchema")
        )]
        #[serde(deny_unknown_fields)]
        pub enum MaterialSpec<N> {
            $(
                #[doc = concat!("`", $name, "`, see [`", stringify!($member), "`].")]
                #[serde(rename = $name)]
                $member {
                    $(
                        $(#[$field_meta])*
                        #[doc = concat!("See [`", stringify!($member), "::new`].")]
                        $field: N,
                    )*
                    /// Reference density (kg/m3), a number or a formula of the coordinates.
                    density: N,
                },
            )+
        }

        /// A material with evaluated parameters.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum MaterialPlan {
            $(
                #[doc = concat!("`", $name, "`, see [`", stringify!($member), "`].")]
                $member {
                    $(
                        #[doc = concat!("See [`", stringify!($member), "::new`].")]
                        $field: f64,
                    )*
                },
            )+
        }

        impl<N> MaterialSpec<N> {
            /// Returns the name in suite files and reports.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$member { .. } => $name,)+
                }
            }

            /// Converts every parameter to a number with `number`, and returns the material.
            ///
            /// # Errors
            /// The first error that `number` returns.
            pub fn numbers<E>(
                &self,
                mut number: impl FnMut(&'static str, &MaterialParameter, &N) -> Result<f64, E>,
            ) -> Result<MaterialPlan, E> {
                match self {
                    $(Self::$member { $($field,)* .. } => {
                        $(let $field = number(registry::key(stringify!($field)), &$parameter, $field)?;)*
                        Ok(MaterialPlan::$member { $($field),* })
                    })+
                }
            }

            /// Returns the reference density (kg/m3), a number or a formula of the coordinates.
            pub fn density(&self) -> &N {
                match self {
                    $(Self::$member { density, .. } => density,)+
                }
            }
        }

        impl MaterialPlan {
            /// Returns the name in suite files and reports.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$member { .. } => $name,)+
                }
            }

            /// Returns the properties of the law.
            pub fn properties(&self) -> Box<dyn MaterialProperties> {
                match *self {
                    $(Self::$member { $($field),* } => Box::new($member::new($($field),*)),)+
                }
            }

            /// Returns every parameter with its key in suite files.
            pub fn keyed_parameters(&self) -> Vec<(&'static str, f64)> {
                match *self {
                    $(Self::$member { $($field),* } => {
                        vec![$((registry::key(stringify!($field)), $field)),*]
                    })+
                }
            }

            /// Returns the value of the parameter with this key, if the material has such a
            /// parameter.
            pub fn parameter(&self, wanted: &str) -> Option<f64> {
                let mut all = self.keyed_parameters().into_iter();
                all.find(|(key, _)| *key == wanted).map(|(_, value)| value)
            }

            /// Whether the law has Young's modulus and Poisson's ratio as its only parameters. At
            /// small strains all such laws are Hooke's law.
            pub fn is_isotropic_elastic(&self) -> bool {
                self.keyed_parameters().iter().map(|(key, _)| *key).eq(["young", "poisson"])
            }

            /// Returns every parameter with its value, in registration order.
            pub fn parameters(&self) -> Vec<(MaterialParameter, f64)> {
                match self {
                    $(Self::$member { $($field),* } => vec![$(($parameter, *$field)),*],)+
                }
            }

            /// Builds the material for a stress-free body.
            // Not inlined, so that tests and other crates link to the laws compiled here.
            #[inline(never)]
            pub fn build<const D: usize>(&self) -> Box<dyn Material<D>> {
                match *self {
                    $(Self::$member { $($field),* } => Box::new($member::new($($field),*)),)+
                }
            }

            /// Returns one instance of every registered material, for tests of all materials.
            pub fn every(value: impl Fn(&MaterialParameter) -> f64) -> Vec<Self> {
                vec![$(Self::$member { $($field: value(&$parameter)),* }),+]
            }
        }
    };
}
pub(super) use materials;
