//! Methods of a suite, and the accuracy that `run --gate` may require of external solvers.

use crate::fem::{Element, Mass, Sampling};
use crate::mpm::input::MpmMethod;
use crate::mpm::{BasisName, FrameName, MassName, VolumeName};
use crate::subject::{Precision, Start};
use crate::suite::grammar::EquationName;

/// A method, described by the names of its components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The MPM of this crate.
    Mpm(MpmMethod),
    /// The MPM of this crate with quasi-static load steps.
    QuasiStatic {
        /// Basis functions.
        basis: BasisName,
        /// Number of load steps.
        load_steps: u64,
    },
    /// The MPM of this crate for heat conduction in a body at rest, without mechanics.
    Heat {
        /// Basis functions.
        basis: BasisName,
    },
    /// The FEM of this crate.
    Fem {
        /// Shape functions.
        element: Element,
        /// Mass matrix.
        mass: Mass,
        /// Stress-strain law.
        law: EquationName,
        /// Treatment of the initial velocity.
        start: Start,
        /// Points at which the error is measured.
        sampling: Sampling,
    },
    /// An external solver.
    External {
        /// Theoretical order of the displacements in h, as stated by the solver.
        formal_order: f64,
        /// Precision, as stated by the solver.
        precision: Precision,
    },
}

impl Method {
    /// Returns the kind of solver: `mpm`, `fem` or `external`.
    pub fn subject(&self) -> &'static str {
        match self {
            Self::Mpm(_) | Self::QuasiStatic { .. } | Self::Heat { .. } => "mpm",
            Self::Fem { .. } => "fem",
            Self::External { .. } => "external",
        }
    }

    /// Whether the method computes in single precision.
    pub fn is_single_precision(&self) -> bool {
        matches!(
            self,
            Self::Mpm(MpmMethod { precision: Precision::Single, .. })
                | Self::External { precision: Precision::Single, .. }
        )
    }

    pub(crate) fn averages_volume(&self) -> bool {
        matches!(self, Self::Mpm(MpmMethod { volume: VolumeName::Averaged, .. }))
    }

    /// Returns the theoretical order of the displacement error on a smooth solution. This is p + 1
    /// for a basis of degree p, but at most 2 with the lumped mass matrix of MPM. The nodal values
    /// of superconvergent elements have the order 2p (Strang & Fix 1973, section 1.6).
    pub fn formal_order(&self) -> f64 {
        match self {
            Self::Mpm(MpmMethod { basis, mass: MassName::Consistent, .. }) => basis.formal_order(),
            Self::Mpm(MpmMethod { basis, .. })
            | Self::QuasiStatic { basis, .. }
            | Self::Heat { basis } => basis.formal_order().min(2.0),
            Self::Fem { element, sampling: Sampling::Inside, .. } => element.degree() as f64 + 1.0,
            Self::Fem { element, sampling: Sampling::Nodes, .. } => 2.0 * element.degree() as f64,
            Self::External { formal_order, .. } => *formal_order,
        }
    }

    #[must_use]
    pub(crate) fn with_load_steps(self, steps: u64) -> Self {
        match self {
            Self::QuasiStatic { basis, .. } => Self::QuasiStatic { basis, load_steps: steps },
            other => other,
        }
    }

    /// Returns the settings of the method, as pairs of name and value.
    pub fn settings(&self) -> Vec<(String, String)> {
        let owned = |rows: Vec<(&str, &str)>| -> Vec<(String, String)> {
            rows.into_iter().map(|(key, value)| (key.to_owned(), value.to_owned())).collect()
        };
        match self {
            Self::Mpm(method) => {
                let transfer = method.transfer.name();
                let mut rows = vec![
                    ("basis", method.basis.name()),
                    ("transfer", transfer.as_str()),
                    ("scheme", method.scheme.name()),
                    ("mass matrix", method.mass.name()),
                    ("start", method.start.name()),
                ];
                // The default frame is omitted.
                if method.frame == FrameName::Total {
                    rows.push(("frame", method.frame.name()));
                }
                if method.volume == VolumeName::Averaged {
                    rows.push(("volume ratio", method.volume.name()));
                }
                if method.precision == Precision::Single {
                    rows.push(("precision", "single, with the state rounded after each pass"));
                }
                owned(rows)
            }
            Self::QuasiStatic { basis, .. } => owned(vec![
                ("basis", basis.name()),
                ("scheme", "quasi_static, by Newton's method with the consistent tangent"),
            ]),
            Self::Heat { basis } => owned(vec![
                ("basis", basis.name()),
                (
                    "temperature transfer",
                    "to nodes with its gradient, and to particles as increments",
                ),
                ("capacity matrix", "lumped"),
                ("time integration", "forward Euler"),
            ]),
            Self::Fem { element, mass, law, start, sampling } => owned(vec![
                ("element", element.name()),
                ("mass matrix", mass.name()),
                ("law", law.name()),
                ("start", start.name()),
                (
                    "errors computed",
                    match sampling {
                        Sampling::Inside => "at points inside the elements",
                        Sampling::Nodes => "at the nodes",
                    },
                ),
            ]),
            // The factory of an external solver provides its settings.
            Self::External { .. } => Vec::new(),
        }
    }
}

/// Properties of an external solver, as stated by the solver.
#[derive(Debug, Clone, Copy)]
pub struct ExternalMethod<'a> {
    /// Solver name, which is also the name of its cases.
    pub name: &'a str,
    /// Theoretical order of the displacements in h.
    pub formal_order: f64,
    /// Precision of the numbers.
    pub precision: Precision,
}

/// The key `any_method`: the accuracy that any method can reach on the problem of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct AnyMethod {
    /// Highest order along the refined axis that the regularity of the solution allows.
    pub order: Option<f64>,
    /// Errors at or below this bound are accepted for any observed order.
    pub error_below: Option<f64>,
    /// Laws that a solver may use.
    pub law: LawChoice,
    /// Whether `run --gate` checks external solvers on this suite.
    pub gated: bool,
    /// The reason; empty if the key is absent.
    pub because: String,
}

/// Laws with which a solver may run a suite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawChoice {
    /// The law of the scene.
    Stated,
    /// Any isotropic elastic law with the same moduli, because strains are small.
    SameModuli,
    /// Any law, because no body deforms.
    Any,
}

/// Without the key `any_method`, `run --gate` requires the solver's order and the scene's law.
impl Default for AnyMethod {
    fn default() -> Self {
        let (order, error_below, because) = (None, None, String::new());
        Self { order, error_below, law: LawChoice::Stated, gated: true, because }
    }
}

/// Requirements of `run --gate` on one suite, from the configuration file of the solver.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GateTerms {
    /// Formal order that replaces the order stated by the solver.
    pub formal_order: Option<f64>,
    /// Required order on this suite.
    pub order: Option<f64>,
    /// Errors at or below this bound are accepted for any observed order.
    pub error_below: Option<f64>,
    /// Reason for not running this suite.
    pub skip: Option<String>,
    /// Reason for `order` and `error_below`.
    pub because: String,
}
