//! Small scenes. A scene is converted to the text of a suite, and the suite to a problem.

use super::course::{AffineField, Course};
use crate::external::{LevelProblem, ProblemNeeds, SMALL_STRAIN};
use crate::study::{level_problem, needs, subject};
use crate::subject::SubjectError;
use crate::suite::Suite;
use crate::suite::yaml::Source;
use nalgebra::Vector3;

pub(super) type Kind = (usize, &'static str);

/// Finite-strain elastic laws that are linear at small strains, starting with the simplest.
pub(super) const FINITE: [&str; 4] = ["linear_elastic", "neo_hookean", "corotated", "hencky"];

/// Laws that are linear elastic at small strains; `j2` has a yield stress that no scene reaches.
pub(super) const ELASTIC: [&str; 6] =
    ["linear_elastic", "neo_hookean", "corotated", "hencky", SMALL_STRAIN, "j2"];

/// All laws except those of soils, for scenes in which the law has no effect or is not examined.
pub(super) const ANY_LAW: [&str; 8] = [
    "linear_elastic",
    "neo_hookean",
    "corotated",
    "hencky",
    SMALL_STRAIN,
    "j2",
    "newtonian",
    "linear_fluid",
];

/// Cell size (m): a power of two, so lattice points can lie on cell faces without rounding.
pub(super) const H: f64 = 0.125;

/// Stiffness factor of a soft body; its forces are negligible even at nodes without real mass.
pub(super) const SOFT: f64 = 1e-24;

/// Coefficient of friction of a Drucker-Prager soil.
pub(super) const FRICTION: f64 = 0.3;

/// Friction angle (degrees) of a Mohr-Coulomb soil.
pub(super) const FRICTION_ANGLE: f64 = 30.0;

const GAS_EXPONENT: f64 = 1.4;

/// Slope M of the critical-state line of Cam-clay, `q = M p`.
pub(super) const CRITICAL_STATE_SLOPE: f64 = 1.2;

/// Slope kappa of the swelling line of Cam-clay, the logarithmic volume strain over ln p. The slope
/// is small, so that strains are small and do not depend on the strain measure.
pub(super) const SWELLING_SLOPE: f64 = 0.001;

/// Slope lambda of the compression line of Cam-clay.
pub(super) const COMPRESSION_SLOPE: f64 = 0.005;

/// Preconsolidation pressure of Cam-clay over its initial pressure. Below 2, the clay hardens in
/// shear at constant volume.
pub(super) const OVERCONSOLIDATION: f64 = 1.5;

/// A box of particles on a grid. Vectors have one number per dimension.
#[derive(Debug, Clone)]
pub(super) struct BoxScene {
    pub(super) dimension: usize,
    pub(super) law: &'static str,
    /// Particles per cell along each axis.
    pub(super) ppc: u64,
    /// Cell size (m).
    pub(super) h: f64,
    /// Lowest and highest corner of the body (m).
    pub(super) body: (Vec<f64>, Vec<f64>),
    /// Lowest and highest corner of the grid (m).
    pub(super) grid: (Vec<f64>, Vec<f64>),
    /// Young's modulus (Pa).
    pub(super) young: f64,
    pub(super) poisson: f64,
    /// Strength or cohesion (Pa) of a soil, initial pressure of Cam-clay, or yield stress of `j2`.
    pub(super) strength: f64,
    /// Friction of a soil, as a share of [`FRICTION`] or [`FRICTION_ANGLE`].
    pub(super) friction: f64,
    /// Dilation of a soil, as a share of its friction.
    pub(super) dilation: f64,
    /// Density (kg/m3).
    pub(super) density: f64,
    /// Initial velocity (m/s).
    pub(super) velocity: AffineField,
    /// Initial displacement (m).
    pub(super) displacement: AffineField,
    /// Gravity (m/s2), if any.
    pub(super) gravity: Option<Vec<f64>>,
    /// Total force (N) along the first axis, distributed over the body, if any.
    pub(super) force: Option<f64>,
    /// Names of faces and their conditions; all other faces are free.
    pub(super) faces: Vec<(&'static str, &'static str)>,
    pub(super) extras: Extras,
    pub(super) steps: u64,
    /// Step length (s).
    pub(super) dt: f64,
}

/// Parts of a scene that few examinations need.
#[derive(Debug, Clone, Default)]
pub(super) struct Extras {
    /// Names of faces and their conditions in suite notation, for conditions with a value.
    pub(super) walls: Vec<(&'static str, String)>,
    /// Loads in suite notation, such as `damping: 2`.
    pub(super) loads: Vec<String>,
    /// Formulas of the initial velocity, one for each axis, in place of the affine field.
    pub(super) velocity: Option<Vec<String>>,
    /// Further keys of the scene in suite notation, such as `plane: stress`.
    pub(super) keys: Vec<String>,
    /// Hardening modulus (Pa) of `j2`; `None` for a body that does not yield.
    pub(super) hardening: Option<f64>,
    /// Dynamic viscosity (Pa s) of a Newtonian fluid.
    pub(super) viscosity: f64,
    /// Whether the load is applied in load steps without time.
    pub(super) load_steps: bool,
    /// Second body: box, material and initial velocity of this scene.
    pub(super) second: Option<Box<BoxScene>>,
    /// Coefficient of friction between the bodies; `None` for bodies without contact.
    pub(super) contact: Option<f64>,
}

impl BoxScene {
    /// Creates a body at rest with `cells` cells along each axis and the lowest corner `from`,
    /// surrounded by `margin` empty cells.
    pub(super) fn of_cells(kind: Kind, from: [f64; 3], cells: f64, margin: f64) -> Self {
        let (dimension, law) = kind;
        let low = from[..dimension].to_vec();
        let high = low.iter().map(|x| x + cells * H).collect();
        // Nodes are at integer multiples of H.
        let node = |x: f64| libm::floor(x / H) * H;
        let grid_low: Vec<f64> = low.iter().map(|x| node(*x) - margin * H).collect();
        let grid_high = grid_low.iter().map(|x| x + (cells + 1.0 + 2.0 * margin) * H).collect();
        Self {
            dimension,
            law,
            ppc: 2,
            h: H,
            body: (low, high),
            grid: (grid_low, grid_high),
            young: 0.1,
            poisson: 0.3,
            strength: 1e-4,
            friction: 1.0,
            dilation: 1.0 / 3.0,
            // The density is no power, product or ratio of the other numbers, so that each possible
            // mistake changes accelerations by another factor (see `moduli::factors`).
            density: 1.7,
            velocity: AffineField::default(),
            displacement: AffineField::default(),
            gravity: None,
            force: None,
            faces: Vec::new(),
            extras: Extras::default(),
            steps: 20,
            dt: 0.04,
        }
    }

    pub(super) fn with_half_the_step(&self) -> Self {
        Self { dt: 0.5 * self.dt, steps: 2 * self.steps, ..self.clone() }
    }

    /// Returns this scene with `steps` steps, during which dilatational waves travel `cells` cells.
    pub(super) fn with_waves(self, cells: f64, steps: u64) -> Self {
        let dt = cells * self.h / self.wave_speed() / steps as f64;
        Self { steps, dt, ..self }
    }

    /// Returns the time of the last step (s).
    pub(super) fn end(&self) -> f64 {
        self.steps as f64 * self.dt
    }

    pub(super) fn soft(&self) -> Self {
        Self { young: SOFT * self.young, ..self.clone() }
    }

    pub(super) fn centre(&self) -> Vector3<f64> {
        let (low, high) = &self.body;
        Vector3::from_fn(|i, _| if i < self.dimension { 0.5 * (low[i] + high[i]) } else { 0.0 })
    }

    /// Returns the uniform field whose components are those of `value` in the space of the body.
    pub(super) fn uniform(&self, value: [f64; 3]) -> AffineField {
        let component = |i| if i < self.dimension { value[i] } else { 0.0 };
        AffineField { value: Vector3::from_fn(|i, _| component(i)), ..AffineField::default() }
    }

    /// Returns the field that is zero at the centre of the body and has this gradient.
    pub(super) fn linear(&self, gradient: impl Fn(usize, usize) -> f64) -> AffineField {
        let d = self.dimension;
        let slope = |i: usize, j: usize| if i < d && j < d { gradient(i, j) } else { 0.0 };
        let gradient = std::array::from_fn(|i| std::array::from_fn(|j| slope(i, j)));
        AffineField { gradient, centre: self.centre(), ..AffineField::default() }
    }

    /// Returns the field of [`Self::linear`] with the only slope of component `i` along axis `j`.
    pub(super) fn slope(&self, (i, j): (usize, usize), slope: f64) -> AffineField {
        self.linear(|a, b| if (a, b) == (i, j) { slope } else { 0.0 })
    }

    /// Returns the linear field of displacements with the deformation gradient `f`, row by row.
    pub(super) fn motion_to(&self, f: &[f64]) -> AffineField {
        self.linear(|i, j| f[i * self.dimension + j] - f64::from(u8::from(i == j)))
    }

    /// Whether a reference position is less than `reach` cells from the centre along each axis.
    pub(super) fn is_central(&self, label: &Vector3<f64>, reach: f64) -> bool {
        let centre = self.centre();
        let near = reach * self.h * (1.0 + 1e-9);
        (0..self.dimension).all(|i| (label[i] - centre[i]).abs() <= near)
    }

    /// Returns Lame's parameters lambda and mu (Pa).
    pub(super) fn lame(&self) -> (f64, f64) {
        let (young, poisson) = (self.young, self.poisson);
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        (lambda, young / (2.0 * (1.0 + poisson)))
    }

    /// Returns the speed of dilatational waves (m/s).
    pub(super) fn wave_speed(&self) -> f64 {
        let (lambda, mu) = self.lame();
        ((lambda + 2.0 * mu) / self.density).sqrt()
    }

    /// Multiplies all lengths of a scene without displacements and loads by this factor. Times and
    /// the density remain.
    pub(super) fn scaled(mut self, length: f64) -> Self {
        let (body, grid) = (&mut self.body, &mut self.grid);
        for end in [&mut body.0, &mut body.1, &mut grid.0, &mut grid.1] {
            for x in end.iter_mut() {
                *x *= length;
            }
        }
        self.h *= length;
        self.young *= length * length;
        self.velocity.value *= length;
        self.velocity.centre *= length;
        self
    }

    fn material(&self) -> String {
        let Self { law, young, poisson, density, .. } = self;
        let bulk = young / (3.0 * (1.0 - 2.0 * poisson));
        let (eta, phi) = (FRICTION * self.friction, FRICTION_ANGLE * self.friction);
        let parameters = match *law {
            "newtonian" => format!("bulk: {bulk:e}, viscosity: {:e}", self.extras.viscosity),
            "linear_fluid" => format!("bulk: {bulk:e}"),
            "polytropic" => format!(
                "stiffness: {:e}, exponent: {GAS_EXPONENT}",
                bulk / GAS_EXPONENT * libm::pow(*density, -GAS_EXPONENT)
            ),
            "j2" => format!(
                "young: {young:e}, poisson: {poisson}, yield: {:e}, hardening: {:e}",
                self.extras.hardening.map_or(10.0 * young, |_| self.strength),
                self.extras.hardening.unwrap_or(0.0)
            ),
            "drucker_prager" => format!(
                "young: {young:e}, poisson: {poisson}, friction: {eta}, dilation: {}, strength: \
                 {:e}",
                eta * self.dilation,
                self.strength
            ),
            "mohr_coulomb" => format!(
                "young: {young:e}, poisson: {poisson}, friction_angle: {phi}, dilation_angle: {}, \
                 cohesion: {:e}",
                phi * self.dilation,
                self.strength
            ),
            "cam_clay" => format!(
                "critical_state_slope: {CRITICAL_STATE_SLOPE}, swelling_slope: {SWELLING_SLOPE}, \
                 compression_slope: {COMPRESSION_SLOPE}, poisson: {poisson}, initial_pressure: \
                 {:e}, preconsolidation: {:e}",
                self.strength,
                OVERCONSOLIDATION * self.strength
            ),
            _ => format!("young: {young:e}, poisson: {poisson}"),
        };
        // Suites have no small-strain law: the law is replaced in the problem.
        let law = if *law == SMALL_STRAIN { "linear_elastic" } else { *law };
        format!("{{{law}: {{{parameters}, density: {density:e}}}}}")
    }

    fn body_keys(&self) -> String {
        let Self { body: (from, to), dimension, extras, .. } = self;
        let material = self.material();
        let keys = format!("body: {{box: {{from: {from:?}, to: {to:?}}}}}, material: {material}");
        if extras.load_steps {
            return keys;
        }
        let affine = || self.velocity.formulas(*dimension);
        let velocity = extras.velocity.clone().unwrap_or_else(affine);
        format!("{keys}, initial_velocity: {velocity:?}")
    }

    fn text(&self, method: &str) -> String {
        let Self { extras, grid: (low, high), dimension: d, .. } = self;
        let cells = libm::round((high[0] - low[0]) / self.h);
        let mut faces: Vec<String> =
            self.faces.iter().map(|(face, condition)| format!("{face}: {condition}")).collect();
        faces.extend(extras.walls.iter().map(|(face, wall)| format!("{face}: {wall}")));
        let gravity = self.gravity.iter().map(|g| format!("gravity: {g:?}"));
        let mut loads: Vec<String> = gravity.chain(extras.loads.iter().cloned()).collect();
        let mut keys = match &extras.second {
            Some(second) => {
                format!("bodies: [{{{}}}, {{{}}}]", self.body_keys(), second.body_keys())
            }
            None => self.body_keys(),
        };
        if let Some(force) = self.force {
            let (from, to) = &self.body;
            let value: Vec<f64> = (0..*d).map(|i| if i == 0 { force } else { 0.0 }).collect();
            keys.push_str(&format!(", sets: {{all: {{box: {{from: {from:?}, to: {to:?}}}}}}}"));
            loads.push(format!("force: {{on: all, value: {value:?}}}"));
        }
        if !faces.is_empty() {
            keys.push_str(&format!(", boundary: {{{}}}", faces.join(", ")));
        }
        if !loads.is_empty() {
            keys.push_str(&format!(", loads: [{{{}}}]", loads.join("}, {")));
        }
        if !self.displacement.is_zero() {
            let formulas = self.displacement.formulas(*d);
            keys.push_str(&format!(", initial_displacement: {formulas:?}"));
        }
        if let Some(friction) = extras.contact {
            keys.push_str(&format!(", contact: {{friction: {friction}}}"));
        }
        extras.keys.iter().for_each(|key| keys.push_str(&format!(", {key}")));
        let (steps, finer, ppc) = (self.steps, 4.0 * cells, self.ppc.pow(*d as u32));
        let (run, expectation) = if extras.load_steps {
            let run =
                format!("{{load_steps: {steps}}}\nreference: {{same_method: {{cells: {finer}}}}}");
            (run, "error_below: 1")
        } else {
            (format!("{{until: {:e}, dt: {:e}}}", self.end(), self.dt), "drift: {mass: 1e-13}")
        };
        format!(
            "suite: doctor\ntitle: a box\nsource: mpm-verify doctor\n\
             scene: {{dimension: {d}, grid: {{from: {low:?}, to: {high:?}}}, {keys}}}\n\
             run: {run}\nrefine: {{cells: {cells}, ppc: {ppc}}}\n\
             methods:\n  - mpm: {{{method}}}\n\
             expect:\n  - {expectation}\n    because: no step is made\n"
        )
    }

    /// Converts the scene to a problem. The state is sampled after every step.
    pub(super) fn problem(&self) -> Result<LevelProblem, SubjectError> {
        let suite = self.handed_over()?;
        let plan = suite.convergence().ok_or("not a convergence study")?;
        let level = plan.refine.levels.first().ok_or("no level")?;
        let case = plan.cases.first().ok_or("no case")?;
        let mut problem = level_problem(&suite.name, plan, case, *level)?;
        problem.instants = (1..=problem.steps).collect();
        if self.law == SMALL_STRAIN {
            problem.replace_by_small_strain();
        }
        Ok(problem)
    }

    /// Returns the capabilities that the scene requires of a solver.
    pub(super) fn needs(&self) -> Result<ProblemNeeds, SubjectError> {
        let suite = self.handed_over()?;
        let mut needs = needs(suite.convergence().ok_or("not a convergence study")?);
        if self.law == SMALL_STRAIN {
            needs.laws = vec![SMALL_STRAIN];
        }
        Ok(needs)
    }

    fn handed_over(&self) -> Result<Suite, SubjectError> {
        let in_time = "basis: linear, transfer: flip, scheme: musl";
        let quasi_static = "basis: linear, scheme: quasi_static";
        self.suite(if self.extras.load_steps { quasi_static } else { in_time })
    }

    fn suite(&self, method: &str) -> Result<Suite, SubjectError> {
        let source = Source::from_text("doctor.yaml", self.text(method));
        let suite = source.and_then(|source| Suite::load(&source));
        suite.map_err(|diagnostic| diagnostic.to_string().into())
    }

    /// Runs this crate's MPM with PIC, to measure how averaging changes velocities.
    pub(super) fn averaged(&self, basis: &str) -> Result<Course, SubjectError> {
        self.built_in(&format!("basis: {basis}, transfer: pic, scheme: usl"))
    }

    /// Runs the built-in MPM with `method`, in suite notation.
    pub(super) fn built_in(&self, method: &str) -> Result<Course, SubjectError> {
        let suite = self.suite(method)?;
        let plan = suite.convergence().ok_or("not a convergence study")?;
        let level = plan.refine.levels.first().ok_or("no level")?;
        let case = plan.cases.first().ok_or("no case")?;
        let mut subject = subject(plan, case.method, *level)?;
        let mut course = Course::new(&level_problem(&suite.name, plan, case, *level)?);
        course.look(0.0, subject.as_ref());
        for step in 1..=self.steps {
            subject.step(self.dt)?;
            course.look(step as f64 * self.dt, subject.as_ref());
        }
        Ok(course)
    }
}
