//! Small scenes, written as suites and handed over as those are.

use crate::external::{LevelProblem, ProblemNeeds};
use crate::study::{level_problem, needs};
use crate::suite::yaml::Source;
use crate::suite::{ConvergencePlan, Suite};

/// Laws that are linear elasticity where strains are small, the plainest first.
pub(super) const LAWS: [&str; 4] = ["linear_elastic", "neo_hookean", "corotated", "hencky"];

/// Size of a cell (m): a number without rounding, so that a lattice may lie on faces of cells.
pub(super) const H: f64 = 0.125;

/// Share of a stiffness that leaves none, also where a node's mass is nothing but rounding.
pub(super) const SOFT: f64 = 1e-24;

/// A box of particles on a grid. Vectors have as many numbers as the scene has dimensions.
#[derive(Debug, Clone)]
pub(super) struct BoxScene {
    pub(super) dimension: usize,
    pub(super) law: &'static str,
    /// Size of a cell (m).
    pub(super) h: f64,
    /// Ends of the body (m).
    pub(super) body: (Vec<f64>, Vec<f64>),
    /// Ends of the grid (m).
    pub(super) grid: (Vec<f64>, Vec<f64>),
    /// Young's modulus (Pa).
    pub(super) young: f64,
    pub(super) poisson: f64,
    /// Density (kg/m^D).
    pub(super) density: f64,
    /// Initial velocity (m/s): formulas of X, Y, Z.
    pub(super) velocity: Vec<String>,
    /// Gravity (m/s2), if it acts.
    pub(super) gravity: Option<Vec<f64>>,
    /// Faces by name, with their conditions; others are free.
    pub(super) faces: Vec<(&'static str, &'static str)>,
    /// Number and length (s) of the steps.
    pub(super) steps: u64,
    pub(super) dt: f64,
}

impl BoxScene {
    /// The same run in twice as many steps of half the length.
    pub(super) fn with_half_the_step(&self) -> Self {
        Self { dt: 0.5 * self.dt, steps: 2 * self.steps, ..self.clone() }
    }

    /// A body of so many cells along each axis, `from` on, with `room` cells around it. It is
    /// soft, and at rest.
    pub(super) fn of_cells(
        (dimension, law): (usize, &'static str),
        from: [f64; 3],
        cells: f64,
        room: f64,
    ) -> Self {
        let low = from[..dimension].to_vec();
        let plus = |by: f64| low.iter().map(|x| x + by * H).collect::<Vec<f64>>();
        // Nodes stand at whole numbers of cells from the origin of coordinates.
        let node = |x: f64| libm::floor(x / H) * H;
        let grid_low = low.iter().map(|x| node(*x) - room * H).collect::<Vec<f64>>();
        let grid_high = grid_low.iter().map(|x| x + (cells + 1.0 + 2.0 * room) * H).collect();
        Self {
            dimension,
            law,
            h: H,
            body: (low.clone(), plus(cells)),
            grid: (grid_low, grid_high),
            young: 0.1,
            poisson: 0.3,
            density: 2.0,
            velocity: vec!["0".to_owned(); dimension],
            gravity: None,
            faces: Vec::new(),
            steps: 20,
            dt: 0.04,
        }
    }

    /// Lame's parameters (Pa).
    pub(super) fn lame(&self) -> (f64, f64) {
        let (young, poisson) = (self.young, self.poisson);
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        (lambda, young / (2.0 * (1.0 + poisson)))
    }

    /// Speed of dilatational waves (m/s).
    pub(super) fn wave_speed(&self) -> f64 {
        let (lambda, mu) = self.lame();
        ((lambda + 2.0 * mu) / self.density).sqrt()
    }

    /// The same body, motion and forces with other units of length, time and mass.
    pub(super) fn scaled(&self, length: f64, time: f64, mass: f64) -> Self {
        let by = |all: &[f64]| all.iter().map(|x| x * length).collect::<Vec<f64>>();
        let d = self.dimension as i32;
        let volume = (0..d).fold(1.0, |product, _| product * length);
        // A formula of X is one of X/length, times the unit of speed.
        let velocity = self.velocity.iter().map(|formula| {
            let mut inner = formula.clone();
            for axis in ["X", "Y", "Z"] {
                inner = inner.replace(axis, &format!("({axis}*{:e})", 1.0 / length));
            }
            format!("({inner})*{:e}", length / time)
        });
        Self {
            h: self.h * length,
            body: (by(&self.body.0), by(&self.body.1)),
            grid: (by(&self.grid.0), by(&self.grid.1)),
            young: self.young * mass * length * length / (time * time * volume),
            density: self.density * mass / volume,
            velocity: velocity.collect(),
            gravity: self
                .gravity
                .as_ref()
                .map(|g| g.iter().map(|g| g * length / (time * time)).collect()),
            dt: self.dt * time,
            ..self.clone()
        }
    }

    /// The suite of the scene.
    fn text(&self) -> String {
        let (from, to) = &self.body;
        let (low, high) = &self.grid;
        let cells = libm::round((high[0] - low[0]) / self.h);
        let faces: Vec<String> =
            self.faces.iter().map(|(face, condition)| format!("{face}: {condition}")).collect();
        let boundary = if faces.is_empty() {
            String::new()
        } else {
            format!("  boundary: {{{}}}\n", faces.join(", "))
        };
        let loads = self
            .gravity
            .as_ref()
            .map_or(String::new(), |g| format!("  loads:\n    - gravity: {g:?}\n"));
        format!(
            "suite: doctor\ntitle: a box\nsource: mpm-verify doctor\n\
             scene:\n  dimension: {d}\n  body: {{box: {{from: {from:?}, to: {to:?}}}}}\n  \
             grid: {{from: {low:?}, to: {high:?}}}\n  \
             material: {{{law}: {{young: {young:e}, poisson: {poisson}, density: {density:e}}}}}\n\
             {boundary}{loads}  initial_velocity: {velocity:?}\n\
             run: {{until: {until:e}, dt: {dt:e}}}\nrefine: {{cells: {cells}, ppc: {ppc}}}\n\
             methods:\n  - mpm: {{basis: linear, transfer: flip, scheme: musl}}\n\
             expect:\n  - drift: {{mass: 1e-13}}\n    because: no step is made\n",
            d = self.dimension,
            law = self.law,
            young = self.young,
            poisson = self.poisson,
            density = self.density,
            velocity = self.velocity,
            until = self.steps as f64 * self.dt,
            dt = self.dt,
            ppc = 1 << self.dimension,
        )
    }

    /// The scene as a problem, with what it needs. The state is asked for after every step.
    ///
    /// # Errors
    /// One line that says why there is none.
    pub(super) fn problem(&self) -> Result<(LevelProblem, ProblemNeeds), String> {
        let source = Source::from_text("doctor.yaml", self.text());
        let suite = source.and_then(|source| Suite::load(&source));
        let suite = suite.map_err(|diagnostic| diagnostic.to_string())?;
        let plan = suite.plan::<ConvergencePlan>().ok_or("it is no convergence study")?;
        let level = plan.refine.levels.first().ok_or("it has no level")?;
        let case = plan.cases.first().ok_or("it has no case")?;
        let mut problem = level_problem(&suite.name, plan, case, *level)?;
        problem.instants = (1..=problem.steps).collect();
        Ok((problem, needs(plan)))
    }
}
