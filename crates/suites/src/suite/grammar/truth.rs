//! Keys of an exact solution or a manufactured motion, given by formulas.

use crate::exact::Equation;
use crate::fem::BarLaw;
use crate::suite::yaml::NumberText;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

/// An exact solution of the motion, or an equilibrium at the end of the run.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ExactSpec {
    /// Equation of motion, named after its law. Required with `displacement`.
    pub(crate) equation: Option<EquationName>,
    /// Displacement (m), formulas of `X`, `Y`, `Z` and `t`.
    pub(crate) displacement: Option<Vec<NumberText>>,
    /// Temperature (K), in a body that conducts heat.
    pub(crate) temperature: Option<NumberText>,
    /// Maximum residual of a condition, relative to its terms; at most 1e-2, default: 1e-8.
    pub(crate) tolerance: Option<NumberText>,
    /// Accepted residual of a formula that solves only the linearised problem.
    pub(crate) linearised: Option<LinearisedSpec>,
}

/// The accepted residual of a linearised solution, and the reason.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct LinearisedSpec {
    /// Maximum residual of the equation of motion and of tractions, relative to their terms.
    pub(crate) tolerance: NumberText,
    /// Reason for accepting the residual.
    pub(crate) because: String,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ManufacturedSpec {
    /// Displacement (m), formulas of `X`, `Y`, `Z` and `t`.
    pub(crate) displacement: Option<Vec<NumberText>>,
    /// Temperature (K), a formula of the coordinates and `t`.
    pub(crate) temperature: Option<NumberText>,
}

/// An equation of motion, named after its constitutive law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EquationName(&'static str);

impl EquationName {
    /// Returns the equation whose law is called `name`, if known.
    pub fn find(name: &str) -> Option<Self> {
        Self::all().find(|known| known.0 == name)
    }

    /// Returns the name in suites and reports.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// Returns all laws of exact solutions, then the laws that only FEM bars support.
    fn all() -> impl Iterator<Item = Self> {
        let of_bar = BarLaw::ALL.iter().map(|law| law.name());
        let of_bar_alone = of_bar.filter(|name| !Equation::NAMES.contains(name));
        Equation::NAMES.iter().copied().chain(of_bar_alone).map(Self)
    }
}

/// The default is the small-strain law, to which every material reduces at first order.
impl Default for EquationName {
    fn default() -> Self {
        Self(BarLaw::SmallStrain.name())
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for EquationName {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "EquationName".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let names: Vec<&str> = Self::all().map(Self::name).collect();
        schemars::json_schema!({"type": "string", "enum": names})
    }
}

impl<'de> Deserialize<'de> for EquationName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::find(&name).ok_or_else(|| {
            let known: Vec<String> = Self::all().map(|name| format!("`{}`", name.0)).collect();
            let known = known.join(", ");
            D::Error::custom(format!("unknown variant `{name}`, expected one of {known}"))
        })
    }
}
