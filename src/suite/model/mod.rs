//! A suite whose every word has been checked and every number computed.

pub(crate) mod boundary;
pub(crate) mod fingerprint;
pub(crate) mod grid_size;
pub(crate) mod heat;
pub(crate) mod internal_force;
pub(crate) mod lattice;
pub(crate) mod method;
pub(crate) mod refine_plan;
pub(crate) mod stability;
pub(crate) mod study_plan;

pub use internal_force::{ForceCase, ForceExpectation, ForcePlan};

use self::{
    boundary::BoundaryCondition, heat::SceneHeat, method::Method, refine_plan::RefinePlan,
    study_plan::StudyPlan,
};
use super::grammar::{CrossingLevels, EquationName, NormName};
use crate::{
    exact::{Expansion, Problem, Region, Round, formula::Formula, heat::Conduction},
    fem::{Element, Mass},
    mpm::{MaterialPlan, Placement, Quadrilateral},
    verify::{Expectation, Quantity},
};
use std::{any::Any, sync::Arc};

/// A suite, ready to run.
#[derive(Debug, Clone)]
pub struct Suite {
    /// Its name, unique among suites.
    pub name: String,
    /// Headline.
    pub title: String,
    /// Where the problem comes from.
    pub source: String,
    /// What a reader should know, as the author put it.
    pub about: String,
    /// Every parameter: name, what the file says, value.
    pub parameters: Vec<(String, String, f64)>,
    /// User functions: head and body.
    pub functions: Vec<(String, String)>,
    /// Plan of its study.
    pub study: Arc<dyn StudyPlan>,
    /// Of the text of the file.
    pub(crate) fingerprint: u64,
}

/// Everything about a convergence study but the methods.
#[derive(Debug, Clone)]
pub struct ConvergencePlan {
    /// The body and what acts on it.
    pub scene: Scene,
    /// The problem that the formulas solve, already checked; absent if only a reference is given.
    pub exact: Option<Problem>,
    /// The heat problem that a temperature solves in a body at rest, already checked.
    pub conduction: Option<Conduction>,
    /// A fine computation to compare with.
    pub reference: Option<ReferencePlan>,
    /// Time step (s) of the same method, to compare with in a study of time steps.
    pub same_method_dt: Option<f64>,
    /// What is refined, level by level.
    pub refine: RefinePlan,
    /// Instants at which the error is taken.
    pub instants: u64,
    /// The error that is judged.
    pub norm: NormName,
    /// What it is an error of.
    pub of: Quantity,
    /// What it is divided by, if anything.
    pub scale: Option<f64>,
    /// Whether levels with crossings may count.
    pub crossing_levels: CrossingLevels,
    /// Place to be observed (m).
    pub observe: Option<Vec<f64>>,
    /// The cases, in the order of the product.
    pub cases: Vec<Case>,
}

/// One case of a convergence study.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name, unique in the suite.
    pub name: String,
    /// The method.
    pub method: Method,
    /// End of the run (s).
    pub until: f64,
    /// What the errors are taken against.
    pub against: Against,
    /// What is expected.
    pub expectation: Expectation,
    /// What is expected of a full run, if that differs.
    pub expectation_in_full: Option<Expectation>,
}

/// Which truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The formulas.
    Exact,
    /// The fine computation.
    Reference,
    /// The same method with shorter steps.
    SameMethod,
    /// None: only what a run keeps is bound.
    Nothing,
}

/// The body and what acts on it.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Lowest corner of the body, or of the box around it (m); its length is the number of dimensions.
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// The body, if it is round.
    pub round: Option<Round>,
    /// The same, if it is a panel with four sides.
    pub quadrilateral: Option<Quadrilateral>,
    /// Grid that the suite asks for, lowest and highest corner (m).
    pub grid: Option<(Vec<f64>, Vec<f64>)>,
    /// The material, but for its density.
    pub material: MaterialPlan,
    /// Reference density (kg/m^D).
    pub density: f64,
    /// The 2 D faces of a box: low and high, axis by axis. A round body has none.
    pub faces: Vec<SceneFace>,
    /// Sets of particles, each with what acts on it.
    pub sets: Vec<Region>,
    /// Uniform acceleration (m/s2), formulas of t.
    pub gravity: Option<Vec<Formula>>,
    /// Force per unit mass (m/s2), formulas of the coordinates and t.
    pub body_force: Option<Vec<Formula>>,
    /// Rate (1/s) at which velocities decay, a formula of t.
    pub damping: Option<Formula>,
    /// Share of the force out of balance that opposes the motion.
    pub local_damping: Option<f64>,
    /// Artificial viscosity: coefficients of the linear and of the quadratic term.
    pub viscosity: Option<[f64; 2]>,
    /// Several bodies, each a scene of its own with the grid, the faces and the loads of this one;
    /// empty where there is one. Then this is the box around all of them, with the first one's
    /// material.
    pub bodies: Vec<Self>,
    /// Coefficient of friction between bodies that are in contact; absent: they share one velocity
    /// field.
    pub contact: Option<f64>,
    /// Conduction of heat.
    pub heat: Option<SceneHeat>,
    /// What temperature does to the body.
    pub expansion: Option<Expansion>,
    /// Initial displacement (m), formulas of the coordinates and t; empty: not stated.
    pub initial_displacement: Vec<Formula>,
    /// Initial velocity (m/s), formulas of the coordinates and t; empty: not stated.
    pub initial_velocity: Vec<Formula>,
}

/// One face of the body.
#[derive(Debug, Clone)]
pub struct SceneFace {
    /// What suites call it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// What holds it.
    pub hold: BoundaryCondition,
    /// Traction (Pa, per reference area), formulas of the coordinates and t.
    pub traction: Option<Vec<Formula>>,
    /// Pressure (Pa, per present area), a formula of the coordinates and t.
    pub pressure: Option<Formula>,
    /// Where such a load is put.
    pub placement: Placement,
}

/// A fine FEM computation that serves as truth where no formula is known.
#[derive(Debug, Clone)]
pub struct ReferencePlan {
    /// Law between stress and strain.
    pub equation: EquationName,
    /// Shape functions.
    pub element: Element,
    /// Mass matrix.
    pub mass: Mass,
    /// Elements.
    pub cells: u64,
    /// Wanted time step (s), a formula of h.
    pub dt: Formula,
}

impl Suite {
    /// Names of the cases, in order.
    pub fn case_names(&self) -> Vec<&str> {
        self.study.case_names()
    }

    /// The plan, if the study is of this kind.
    pub fn plan<P: StudyPlan>(&self) -> Option<&P> {
        let plan: &dyn Any = self.study.as_ref();
        plan.downcast_ref()
    }
}

impl StudyPlan for ConvergencePlan {
    fn case_names(&self) -> Vec<&str> {
        self.cases.iter().map(|case| case.name.as_str()).collect()
    }

    fn expectation(&self, case: usize) -> (String, &str) {
        let expectation = &self.cases[case].expectation;
        (expectation.summary(), &expectation.because)
    }
}

impl ConvergencePlan {
    /// The problem whose force is manufactured, if it is.
    pub fn manufactured(&self) -> Option<&Problem> {
        self.exact.as_ref().filter(|problem| problem.manufactured)
    }

    /// Whether the truth is given by formulas.
    pub fn has_formulas(&self) -> bool {
        self.exact.is_some() || self.conduction.is_some()
    }

    /// The heat problem that the formulas solve, of a body at rest or in motion.
    pub fn heat_problem(&self) -> Option<&Conduction> {
        self.conduction.as_ref().or_else(|| self.exact.as_ref()?.heat.as_ref())
    }
}
