//! Changes of a problem that must not affect its solution: other units, axes, positions, and
//! another order of the particles. [`Changed`] runs a solver on the changed problem, and converts
//! its results back.

use crate::external::{
    BodyForceField, FieldError, FieldName, FieldPlaces, HandedNumber, HandedValues, LevelProblem,
    ProblemFields, ProblemMaterial, ProblemNeeds, SMALL_STRAIN, SolverFactory,
};
use crate::mpm::MaterialPlan;
use crate::subject::{Failure, PlaneState, Precision, RunCounters, Samples, Subject};
use crate::subject::{SubjectError, Totals};
use std::cmp::Reverse;
use std::sync::Arc;

/// Names of the lower and the higher face of a box for each axis.
pub(super) const FACES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];

/// A change of units, axes, positions and order. Axes change within the extent of the grid, whose
/// lowest corner remains the lowest corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Name in reports.
    pub name: &'static str,
    /// Value in the changed problem of a length of 1 in the original problem.
    pub length: f64,
    /// Value in the changed problem of a mass of 1.
    pub mass: f64,
    /// Value in the changed problem of a time of 1.
    pub time: f64,
    /// Whether the direction of each axis is reversed.
    pub mirrored: bool,
    /// Whether the order of the axes is reversed.
    pub exchanged: bool,
    /// Whether each axis takes the place of the next one: a rotation, by 90 degrees in 2-D.
    pub turned: bool,
    /// Translation of body, grid and walls along each axis, in cells.
    pub moved: f64,
    /// Translation of the grid relative to the body along each axis, in cells.
    pub shifted: f64,
    /// Number of interleaved series in which the particles are listed; 1 keeps their order.
    pub series: usize,
}

impl Change {
    /// The change that changes nothing.
    pub const NONE: Self = Self {
        name: "nothing",
        length: 1.0,
        mass: 1.0,
        time: 1.0,
        mirrored: false,
        exchanged: false,
        turned: false,
        moved: 0.0,
        shifted: 0.0,
        series: 1,
    };

    /// Returns the place of axis `i` of `d` among the changed axes, and its sign.
    fn axis(&self, i: usize, d: usize) -> (usize, f64) {
        let axis = if self.exchanged { d - 1 - i } else { i };
        let is_reversed = self.mirrored != (self.turned && axis > 0);
        let axis = if self.turned { (axis + 1) % d } else { axis };
        (axis, if is_reversed { -1.0 } else { 1.0 })
    }

    /// Returns the value of a unit of volume in `d` dimensions.
    fn volume(&self, d: usize) -> f64 {
        (0..d).fold(1.0, |volume, _| volume * self.length)
    }

    /// Returns the value of a unit of stress in `d` dimensions.
    fn stress(&self, d: usize) -> f64 {
        self.mass * self.acceleration() * self.length / self.volume(d)
    }

    fn acceleration(&self) -> f64 {
        self.length / (self.time * self.time)
    }

    /// Returns the index in the original problem of each particle of the changed problem.
    fn order(&self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        if self.series > 1 {
            order.sort_by_key(|p| Reverse((p % self.series, *p)));
        }
        order
    }

    /// Returns the reason why this change affects a problem, or is not defined for it.
    fn excluded(&self, problem: &LevelProblem) -> Option<&'static str> {
        let faces = &problem.faces;
        if self.shifted != 0.0 && faces.iter().any(|face| face.condition != "free") {
            return Some("walls lie on nodes");
        }
        if (self.exchanged || self.turned) && problem.dimension == 1 {
            return Some("one axis");
        }
        let is_unknown = faces.iter().any(|face| face.numbers != HandedValues::default())
            || problem.loads.iter().any(|load| !["gravity", "body_force"].contains(&load.load))
            || problem.materials.iter().any(|material| material.varying_density.is_some())
            || problem.plane == PlaneState::Axisymmetric;
        is_unknown.then_some("changes of its loads, walls or densities are not defined")
    }

    fn convert_parameters(&self, material: &mut ProblemMaterial, d: usize) {
        let law = if material.law == SMALL_STRAIN { "linear_elastic" } else { material.law };
        let plans = MaterialPlan::every(|_| 1.0);
        let Some(plan) = plans.iter().find(|plan| plan.name() == law) else { return };
        let exponent = material.parameter("exponent");
        let keys = plan.keyed_parameters().into_iter().zip(plan.parameters());
        for ((key, _), (parameter, _)) in keys {
            let per_mass = self.volume(d) / self.mass;
            let unit = match parameter.unit {
                "Pa" => self.stress(d),
                "Pa s" => self.stress(d) * self.time,
                "Pa (m3/kg)^g" => self.stress(d) * libm::pow(per_mass, exponent),
                _ => 1.0,
            };
            let values = material.parameters.iter_mut().filter(|(name, _)| *name == key);
            values.for_each(|(_, value)| *value *= unit);
        }
    }
}

/// Returns the entries of a column in another order; an empty column remains empty.
fn arranged(column: &[f64], order: &[usize]) -> Vec<f64> {
    let size = column.len() / order.len().max(1);
    let entries = order.iter().filter_map(|p| column.get(p * size..(p + 1) * size));
    entries.flatten().copied().collect()
}

/// Coordinates of a changed problem, and its original coordinates.
#[derive(Clone)]
struct ChangedAxes {
    change: Change,
    dimension: usize,
    /// Sum of the lowest and the highest coordinate of the original grid along each axis (m).
    ends: Vec<f64>,
    /// Translation (m, in the changed units).
    offset: f64,
}

impl ChangedAxes {
    fn new(change: Change, problem: &LevelProblem) -> Self {
        let grid = &problem.grid;
        let end = |(low, cells): (&f64, &u64)| low + (low + *cells as f64 * grid.h);
        let ends = grid.origin.iter().zip(&grid.cells).map(end).collect();
        let offset = change.moved * grid.h * change.length;
        Self { change, dimension: problem.dimension, ends, offset }
    }

    /// Converts the coordinate `x` along the original axis `i`.
    fn coordinate(&self, i: usize, x: f64) -> f64 {
        let is_reversed = self.change.axis(i, self.dimension).1 < 0.0;
        (if is_reversed { self.ends[i] - x } else { x }) * self.change.length + self.offset
    }

    /// Converts positions, one after another.
    fn places(&self, column: &[f64]) -> Vec<f64> {
        let d = self.dimension;
        let mut places = column.to_vec();
        for (k, x) in column.iter().enumerate() {
            places[self.entry(k, 1).0] = self.coordinate(k % d, *x);
        }
        places
    }

    /// Converts positions back.
    fn places_back(&self, column: &[f64]) -> Vec<f64> {
        let original = |k: usize| {
            let (entry, sign) = self.entry(k, 1);
            let x = column.get(entry).map_or(f64::NAN, |x| (x - self.offset) / self.change.length);
            if sign < 0.0 { self.ends[k % self.dimension] - x } else { x }
        };
        (0..column.len()).map(original).collect()
    }

    /// Converts scalars (rank 0), vectors (rank 1) or tensors (rank 2), one after another, and
    /// multiplies them by `scale`.
    fn tensors(&self, column: &[f64], rank: u32, scale: f64) -> Vec<f64> {
        let mut changed = column.to_vec();
        for (k, value) in column.iter().enumerate() {
            let (entry, sign) = self.entry(k, rank);
            changed[entry] = sign * value * scale;
        }
        changed
    }

    /// Converts scalars, vectors or tensors back, and divides them by `scale`.
    fn tensors_back(&self, column: &[f64], rank: u32, scale: f64) -> Vec<f64> {
        let original = |k: usize| {
            let (entry, sign) = self.entry(k, rank);
            column.get(entry).map_or(f64::NAN, |value| sign * value / scale)
        };
        (0..column.len()).map(original).collect()
    }

    /// Returns the index and the sign in the changed column of number `k` of the original column.
    fn entry(&self, k: usize, rank: u32) -> (usize, f64) {
        let d = self.dimension;
        let start = k - k % d.pow(rank);
        (0..rank).fold((start, 1.0), |(entry, sign), place| {
            let stride = d.pow(place);
            let (axis, factor) = self.change.axis(k / stride % d, d);
            (entry + axis * stride, sign * factor)
        })
    }

    fn problem(&self, problem: &LevelProblem) -> LevelProblem {
        let (d, change) = (self.dimension, self.change);
        let (volume, stress) = (change.volume(d), change.stress(d));
        let mut changed = problem.clone();
        let (old, grid) = (&problem.grid, &mut changed.grid);
        grid.h *= change.length;
        for i in 0..d {
            let (axis, _) = change.axis(i, d);
            grid.origin[axis] =
                old.origin[i] * change.length + (change.moved + change.shifted) * grid.h;
            grid.cells[axis] = old.cells[i] + u64::from(change.shifted != 0.0);
            grid.periodic[axis] = old.periodic[i];
        }
        for face in &mut changed.faces {
            let (axis, sign) = change.axis(face.axis, d);
            face.at = self.coordinate(face.axis, face.at);
            (face.axis, face.high) = (axis, face.high == (sign > 0.0));
            face.name = FACES[axis][usize::from(face.high)];
        }
        for material in &mut changed.materials {
            material.density *= change.mass / volume;
            change.convert_parameters(material, d);
        }
        for body in &mut changed.bodies {
            (body.from, body.to) = (self.places(&body.from), self.places(&body.to));
            for (low, high) in body.from.iter_mut().zip(&mut body.to) {
                (*low, *high) = (low.min(*high), low.max(*high));
            }
            body.centre = body.centre.as_ref().map(|centre| self.places(centre));
            body.radii = body.radii.map(|radii| radii.map(|radius| radius * change.length));
            if let Some(corners) = &mut body.corners {
                for corner in corners.iter_mut() {
                    let place = self.places(corner);
                    corner.copy_from_slice(&place);
                }
                // In 2-D, only an exchange reverses the sense of the corners.
                if change.exchanged {
                    corners.reverse();
                }
            }
        }
        let force = |value: &[f64]| self.tensors(value, 1, change.acceleration());
        for load in &mut changed.loads {
            load.rows.clear();
            for (_, number) in &mut load.numbers.values {
                if let HandedNumber::Vector(value) = number {
                    *value = force(value);
                }
            }
        }
        changed.constant_body_force = problem.constant_body_force.as_deref().map(force);
        changed.dt *= change.time;
        changed.until *= change.time;
        let order = change.order(problem.particles.len());
        let particles = &mut changed.particles;
        for (column, rank, scale) in [
            (&mut particles.velocity, 1, change.length / change.time),
            (&mut particles.mass, 0, change.mass),
            (&mut particles.reference_volume, 0, volume),
            (&mut particles.volume, 0, volume),
            (&mut particles.deformation_gradient, 2, 1.0),
            (&mut particles.stress, 2, stress),
            (&mut particles.body, 0, 1.0),
            (&mut particles.initial_stress, 2, stress),
            (&mut particles.initial_stress_across, 0, stress),
        ] {
            *column = self.tensors(&arranged(column, &order), rank, scale);
        }
        for column in [&mut particles.reference_position, &mut particles.position] {
            *column = self.places(&arranged(column, &order));
        }
        let frame = || self.clone();
        let force = problem.body_force.clone();
        changed.body_force = force.map(|force| Arc::new(ChangedField(force, frame())) as _);
        let fields = problem.fields.clone();
        changed.fields = fields.map(|fields| Arc::new(ChangedField(fields, frame())) as _);
        changed
    }
}

/// Fields of the original problem at points of the changed problem.
struct ChangedField<F>(F, ChangedAxes);

impl BodyForceField for ChangedField<Arc<dyn BodyForceField>> {
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3] {
        self.at_displaced(body, label, t, &[0.0; 3])
    }

    fn depends_on_displacement(&self) -> bool {
        self.0.depends_on_displacement()
    }

    fn at_displaced(&self, body: usize, label: &[f64], t: f64, u: &[f64; 3]) -> [f64; 3] {
        let Self(force, frame) = self;
        let (d, change) = (frame.dimension, frame.change);
        let (mut original, mut changed) = ([0.0; 3], [0.0; 3]);
        original[..d].copy_from_slice(&frame.tensors_back(&u[..d], 1, change.length));
        let label = frame.places_back(label);
        let value = force.at_displaced(body, &label, t / change.time, &original);
        changed[..d].copy_from_slice(&frame.tensors(&value[..d], 1, change.acceleration()));
        changed
    }
}

impl ProblemFields for ChangedField<Arc<dyn ProblemFields>> {
    fn bodies(&self, labels: &[f64]) -> Result<Vec<usize>, FieldError> {
        self.0.bodies(&self.1.places_back(labels))
    }

    fn nearest_body(&self, label: &[f64]) -> usize {
        self.0.nearest_body(&self.1.places_back(label))
    }

    fn check_places(&self, places: &FieldPlaces<'_>) -> Result<(), FieldError> {
        let labels = self.1.places_back(places.labels);
        self.0.check_places(&FieldPlaces::new(&labels, places.bodies))
    }

    fn values(&self, of: FieldName, t: f64, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError> {
        let Self(fields, frame) = self;
        let (change, labels) = (frame.change, frame.places_back(at.labels));
        let places = FieldPlaces::new(&labels, at.bodies);
        let values = fields.values(of, t / change.time, &places)?;
        let stress = change.stress(frame.dimension);
        let (rank, scale) = match of {
            FieldName::Displacement => (1, change.length),
            FieldName::Velocity => (1, change.length / change.time),
            FieldName::DeformationGradient => (2, 1.0),
            FieldName::Stress | FieldName::InitialStress => (2, stress),
            FieldName::InitialStressAcross => (0, stress),
            _ => (1, change.acceleration()),
        };
        Ok(frame.tensors(&values, rank, scale))
    }
}

/// A solver that runs changed problems. Its results are converted back.
pub struct Changed<'a> {
    /// The solver of the changed problems.
    pub solver: &'a dyn SolverFactory,
    /// The change of each problem.
    pub change: Change,
}

impl SolverFactory for Changed<'_> {
    fn name(&self) -> &str {
        self.solver.name()
    }

    fn precision(&self) -> Precision {
        self.solver.precision()
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        self.solver.lacks(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        if let Some(reason) = self.change.excluded(&problem) {
            return Err(reason.into());
        }
        let frame = ChangedAxes::new(self.change, &problem);
        let changed = frame.problem(&problem);
        let labels = changed.particles.reference_position.clone();
        let inner = self.solver.subject(changed)?;
        Ok(Box::new(ChangedSubject { inner, frame, labels, problem }))
    }
}

struct ChangedSubject {
    inner: Box<dyn Subject>,
    frame: ChangedAxes,
    /// Reference positions of the particles in the changed problem.
    labels: Vec<f64>,
    problem: LevelProblem,
}

impl Subject for ChangedSubject {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.inner.step(dt * self.frame.change.time)
    }

    fn sample(&self, samples: &mut Samples) {
        self.inner.sample(samples);
        let (frame, Change { length, mass, time, .. }) = (&self.frame, self.frame.change);
        // The order of points that the solver has chosen is its own.
        let mut places: Vec<usize> = (0..samples.len()).collect();
        if samples.label == self.labels {
            let order = frame.change.order(samples.len());
            places.sort_by_key(|k| order[*k]);
            samples.label.clone_from(&self.problem.particles.reference_position);
        } else {
            samples.label = frame.places_back(&samples.label);
        }
        let stress = frame.change.stress(frame.dimension);
        for (column, rank, scale) in [
            (&mut samples.displacement, 1, length),
            (&mut samples.velocity, 1, length / time),
            (&mut samples.weight, 0, frame.change.volume(frame.dimension)),
            (&mut samples.mass, 0, mass),
            (&mut samples.stress, 2, stress),
            (&mut samples.stress_across, 0, stress),
            (&mut samples.deformation_gradient, 2, 1.0),
        ] {
            *column = frame.tensors_back(&arranged(column, &places), rank, scale);
        }
    }

    fn counters(&self) -> RunCounters {
        self.inner.counters()
    }

    /// Computes sums over the samples, about the origin of the original problem.
    fn totals(&self) -> Option<Totals> {
        let Change { length, mass, time, .. } = self.frame.change;
        let stored = self.inner.totals()?.strain_energy;
        let mut samples = Samples::default();
        self.sample(&mut samples);
        let totals = Totals::of_points(&self.problem.particles.mass, &samples);
        let strain_energy = stored.map(|stored| stored * time * time / (mass * length * length));
        Some(Totals { strain_energy, ..totals })
    }
}
