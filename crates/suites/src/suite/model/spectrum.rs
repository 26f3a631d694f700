//! A spectrum study whose suite has passed all checks.

use super::Scene;
use super::method::{ExternalMethod, GateTerms, Method};
use super::refine_plan::LevelPlan;
use super::stability::LatticeEdits;
use crate::exact::formula::Formula;
use crate::mpm::WaveMethod;
use crate::verify::{Gating, SpectrumExpectation};

/// A study of the phase speed and damping of waves.
#[derive(Debug, Clone)]
pub struct SpectrumPlan {
    /// The body at rest.
    pub scene: Scene,
    /// Number of cells.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Particles per cell.
    pub ppc: u64,
    /// Translation of every particle (m).
    pub shift: f64,
    /// The waves, one for each report row.
    pub waves: Vec<Wave>,
    /// External solvers, each with the case that predicts its results.
    pub solvers: Vec<(String, String)>,
    /// The cases, one for each combination of the lists under the key `methods`, in order.
    pub cases: Vec<SpectrumCase>,
}

/// A standing wave of small amplitude, with the time step of its run.
#[derive(Debug, Clone)]
pub struct Wave {
    /// Wavelength (cells).
    pub cells: f64,
    /// Courant number `c dt/h`.
    pub courant: f64,
    /// Initial velocity (m/s), a formula of X and t.
    pub velocity: Formula,
}

/// One case of a spectrum study.
#[derive(Debug, Clone)]
pub struct SpectrumCase {
    /// Case name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// Closed formulas for phase speed and damping; `None` for a solver whose method is unknown.
    pub curve: Option<WaveMethod>,
    /// Stability limit of the Courant number, from `curve`.
    pub limit: Option<f64>,
    /// Expectation and its reason; `None` if the suite states no expectations.
    pub expected: Option<(SpectrumExpectation, String)>,
    /// Role in `run --gate` (required, exempt or excepted), for an external solver.
    pub gating: Option<Gating>,
}

impl SpectrumPlan {
    pub(crate) fn level(&self, wave: &Wave) -> LevelPlan {
        let dt = wave.courant * self.h / self.scene.wave_speed();
        LevelPlan { cells: self.cells, h: self.h, dt, ppc: Some(self.ppc) }
    }

    pub(crate) fn started(&self, wave: &Wave) -> Scene {
        Scene { initial_velocity: vec![wave.velocity.clone()], ..self.scene.clone() }
    }

    pub(crate) fn lattice(&self) -> LatticeEdits {
        LatticeEdits { shift: vec![self.shift], ..LatticeEdits::default() }
    }

    /// Returns the case that predicts the solver `name`: as assigned, or with the same name.
    fn case_of(&self, name: &str) -> Option<&SpectrumCase> {
        let stated = self.solvers.iter().find(|(solver, _)| solver == name);
        let case = stated.map_or(name, |(_, case)| case);
        self.cases.iter().find(|known| known.name == case)
    }

    pub(crate) fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let (expected, because) = self.cases[case].expected.as_ref()?;
        Some((expected.summary(), because))
    }

    pub(super) fn under(&self, solver: ExternalMethod<'_>, terms: Option<&GateTerms>) -> Self {
        let ExternalMethod { name, formal_order, precision } = solver;
        let same = self.case_of(name);
        let unknown = || {
            let message = "the suite does not state the method of the solver, so there is no \
                           prediction";
            Gating::NotGated(message.to_owned())
        };
        let gating = terms.and_then(|terms| match &terms.skip {
            Some(reason) => Some(Gating::Excepted(reason.clone())),
            None => same.is_none().then(unknown),
        });
        let case = SpectrumCase {
            name: name.to_owned(),
            method: Method::External { formal_order, precision },
            curve: same.and_then(|case| case.curve),
            limit: same.and_then(|case| case.limit),
            expected: same.and_then(|case| case.expected.clone()),
            gating,
        };
        Self { cases: vec![case], ..self.clone() }
    }
}
