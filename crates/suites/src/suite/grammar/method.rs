//! Keys of a method and of a time step.

use super::EquationName;
use crate::fem::{Element, Mass, Sampling};
use crate::mpm::{
    BasisName, FrameName, MassName, SchemeName, TransferChoice, TransferName, VolumeName,
    WithParameter,
};
use crate::subject::{Precision, Start};
use crate::suite::yaml::{InPlaceOfNumber, NumberOr, NumberText, OneOrMany, refuse};
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use std::fmt;

/// A method. If settings are lists, each combination of their values is a method.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MethodSpec {
    /// Material Point Method.
    Mpm {
        /// Basis functions.
        basis: OneOrMany<BasisName>,
        /// Velocity transfer between particles and grid. Not allowed with `quasi_static`.
        transfer: Option<OneOrMany<TransferSpec>>,
        /// Time scheme: when stresses are updated, or quasi-static load steps.
        scheme: OneOrMany<SchemeKey>,
        /// Time at which the initial velocity applies; default: `at_zero`.
        start: Option<OneOrMany<Start>>,
        /// Mass matrix; default: `lumped`.
        mass: Option<OneOrMany<MassName>>,
        /// Frame in which basis functions are defined; default: `updated_lagrangian`.
        frame: Option<OneOrMany<FrameName>>,
        /// Volume ratio at which the law computes its stress; default: `particle`.
        volume: Option<OneOrMany<VolumeName>>,
        /// Floating-point precision of the state; default: `double`.
        precision: Option<OneOrMany<Precision>>,
    },
    /// Finite elements in one dimension.
    Fem {
        /// Finite element.
        element: OneOrMany<Element>,
        /// Mass matrix.
        mass: OneOrMany<Mass>,
        /// Equation of motion; default: the equation of the exact solution.
        law: Option<OneOrMany<EquationName>>,
        /// Time at which the initial velocity applies; default: `at_zero`.
        start: Option<OneOrMany<Start>>,
        /// Points at which the error is measured; default: `inside`.
        sampling: Option<OneOrMany<Sampling>>,
    },
    /// MPM for heat conduction in a body at rest.
    Heat {
        /// Basis functions.
        basis: OneOrMany<BasisName>,
    },
    /// An external solver that the command line starts.
    External {
        /// Name of the solver; part of the case name.
        #[cfg_attr(
            feature = "schemas",
            schemars(extend("type" = ["string", "number", "boolean"]))
        )]
        name: String,
        /// Theoretical order of the displacements; default: 2.
        formal_order: Option<NumberText>,
        /// Floating-point precision of the solver.
        precision: Option<Precision>,
    },
}

/// Names of time schemes in suites.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum SchemeKey {
    /// Update stress first.
    Usf,
    /// Update stress last.
    Usl,
    /// Modified update stress last.
    Musl,
    /// Quasi-static load steps: each step solves for an equilibrium, without time integration.
    QuasiStatic,
}

impl SchemeKey {
    /// Returns the explicit scheme; `None` for load steps.
    pub(crate) fn explicit(self) -> Option<SchemeName> {
        match self {
            Self::Usf => Some(SchemeName::Usf),
            Self::Usl => Some(SchemeName::Usl),
            Self::Musl => Some(SchemeName::Musl),
            Self::QuasiStatic => None,
        }
    }
}

impl From<SchemeName> for SchemeKey {
    fn from(scheme: SchemeName) -> Self {
        match scheme {
            SchemeName::Usf => Self::Usf,
            SchemeName::Usl => Self::Usl,
            SchemeName::Musl => Self::Musl,
        }
    }
}

impl MethodSpec {
    /// Whether the method uses quasi-static load steps.
    pub(crate) fn is_quasi_static(&self) -> bool {
        match self {
            Self::Mpm { scheme, .. } => scheme.as_slice().contains(&SchemeKey::QuasiStatic),
            _ => false,
        }
    }
}

/// A transfer: its name, or a series with its number of terms.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TransferSpec(pub(crate) TransferChoice);

impl<'de> Deserialize<'de> for TransferSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrParameter).map(Self)
    }
}

#[cfg(feature = "schemas")]
impl schemars::JsonSchema for TransferSpec {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "TransferChoice".into()
    }

    fn json_schema(all: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let series = WithParameter::ALL.iter().map(|name| {
            let (least, most) = name.parameter().range;
            let terms = schemars::json_schema!({
                "type": "integer", "minimum": least, "maximum": most,
                "description": "Number of terms."
            });
            schemars::json_schema!({
                "type": "object", "properties": {name.name(): terms},
                "required": [name.name()], "additionalProperties": false
            })
        });
        let name = all.subschema_for::<TransferName>();
        schemars::json_schema!({"anyOf": std::iter::once(name).chain(series).collect::<Vec<_>>()})
    }
}

struct NameOrParameter;

impl<'de> Visitor<'de> for NameOrParameter {
    type Value = TransferChoice;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a transfer, or a series with its number of terms")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<TransferChoice, E> {
        TransferName::deserialize(StrDeserializer::new(name)).map(TransferChoice::Named)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<TransferChoice, A::Error> {
        let Some(name) = map.next_key::<WithParameter>()? else {
            return Err(A::Error::invalid_length(0, &self));
        };
        let (value, parameter) = (map.next_value::<u32>()?, name.parameter());
        let ((least, most), (before, after)) = (parameter.range, parameter.words);
        if !(least..=most).contains(&value) {
            let message = format!("{before} {value} {after}");
            let label = format!("expected a whole number from {least} to {most}");
            return Err(refuse(&message, &label, ""));
        }
        if map.next_key::<WithParameter>()?.is_some() {
            return Err(A::Error::invalid_length(2, &self));
        }
        Ok(TransferChoice::With(name, value))
    }
}

/// Length of a time step.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(from = "NumberOr<Rule>")]
pub(crate) enum StepSpec {
    /// A number (s), or a formula.
    Length(NumberText),
    /// A fraction of the stable time step.
    Courant(NumberText),
    /// Half of the stable time step, which leaves a margin for changes during the run.
    Auto,
}

/// Fraction of the stable time step, as in `{courant: 0.5}`.
#[derive(Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct Rule {
    /// The fraction.
    courant: NumberText,
}

impl InPlaceOfNumber for Rule {
    const EXPECTED: &'static str = "a time step, `auto`, or `{courant: ...}`";
}

impl From<NumberOr<Rule>> for StepSpec {
    fn from(step: NumberOr<Rule>) -> Self {
        match step {
            NumberOr::Number(NumberText::Formula(text)) if text == "auto" => Self::Auto,
            NumberOr::Number(length) => Self::Length(length),
            NumberOr::Map(rule) => Self::Courant(rule.courant),
        }
    }
}
