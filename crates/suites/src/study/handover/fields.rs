//! Initial state, loads and face conditions at points that a solver chooses.

use crate::exact::Circle;
use crate::external::{FieldError, FieldName, FieldPlaces, ProblemFields};
use crate::mpm::input::initial_stress;
use crate::study::setup::initial_state::Initial;
use crate::subject::PlaneState;
use crate::suite::model::Scene;
use crate::suite::scene::numbers::{LoadNumbers, NumberField};

/// Radius (relative to the size of the body) at which stresses on the axis are evaluated, because
/// the hoop stretch r/R is undefined at R = 0.
const NEAR_AXIS: f64 = 1e-8;

pub(super) struct SceneFields {
    scene: Scene,
    bodies: Vec<FieldBody>,
    /// Whether random numbers were added to the velocities, stresses and F of particles.
    is_perturbed: bool,
}

struct FieldBody {
    scene: Scene,
    initial: Initial,
}

impl SceneFields {
    pub(super) fn new(scene: &Scene, initial: Vec<Initial>, is_perturbed: bool) -> Self {
        let scenes = scene.each().iter().cloned().zip(initial);
        let bodies = scenes.map(|(scene, initial)| FieldBody { scene, initial }).collect();
        Self { scene: scene.clone(), bodies, is_perturbed }
    }

    fn body(&self, number: usize) -> Result<&FieldBody, FieldError> {
        self.bodies.get(number).ok_or_else(|| {
            FieldError::Request(format!(
                "there is no body {number}; the problem has {}",
                self.bodies.len()
            ))
        })
    }

    fn initial(&self, of: FieldName, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError> {
        let d = self.scene.dimension();
        let mut values = Vec::new();
        for (label, body) in at.labels.chunks_exact(d).zip(at.bodies) {
            let FieldBody { scene, initial } = self.body(*body)?;
            let now = initial.at(label);
            let mut tensor = |component: &dyn Fn(usize, usize) -> f64| {
                values.extend((0..d * d).map(|k| component(k / d, k % d)));
            };
            match of {
                FieldName::Velocity => values.extend(&now.velocity[..d]),
                FieldName::DeformationGradient => {
                    tensor(&|i, j| now.grad[i][j] + f64::from(u8::from(i == j)));
                }
                FieldName::InitialStress => {
                    let stress = scene.initial_stress.at(label);
                    tensor(&|i, j| stress[i][j]);
                }
                FieldName::InitialStressAcross => {
                    let stress = scene.initial_stress.at(label);
                    values.extend((d..3).map(|i| stress[i][i]));
                }
                _ => values.extend(&now.u[..d]),
            }
        }
        Ok(values)
    }

    fn stress(&self, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError> {
        let d = self.scene.dimension();
        let mut values = vec![0.0; at.bodies.len() * d * d];
        for number in 0..self.bodies.len() {
            let places: Vec<usize> =
                (0..at.bodies.len()).filter(|place| at.bodies[*place] == number).collect();
            let labels: Vec<&[f64]> =
                places.iter().map(|place| &at.labels[place * d..(place + 1) * d]).collect();
            let stress = self.stress_of(number, &labels)?;
            for (place, stress) in places.iter().zip(stress.chunks_exact(d * d)) {
                values[place * d * d..(place + 1) * d * d].copy_from_slice(stress);
            }
        }
        Ok(values)
    }

    fn stress_of(&self, number: usize, labels: &[&[f64]]) -> Result<Vec<f64>, FieldError> {
        let FieldBody { scene, initial } = self.body(number)?;
        let plane = self.scene.plane;
        let axis = NEAR_AXIS * scene.size();
        let place = |label: &&[f64]| {
            let mut place = label.to_vec();
            if plane == PlaneState::Axisymmetric && !(place[0] >= axis) {
                place[0] = axis;
            }
            place
        };
        let places: Vec<Vec<f64>> = labels.iter().map(place).collect();
        let densities: Vec<f64> = labels.iter().map(|label| scene.density.at(label)).collect();
        let initial = initial.clone().input();
        initial_stress(&places, plane, &scene.material, &initial, &densities).map_err(|error| {
            FieldError::Undefined(format!("the initial stress is not defined there: {error}"))
        })
    }

    /// Returns the values of a load or a face condition, named `what` in messages, at each point.
    fn numbers(
        &self,
        what: &str,
        numbers: &LoadNumbers,
        t: f64,
        at: &FieldPlaces<'_>,
    ) -> Result<Vec<f64>, FieldError> {
        let d = self.scene.dimension();
        let Some(field) = &numbers.field else {
            let reason = format!(
                "`{what}` does not depend on the position; its constants are in \
                                  `values`"
            );
            return Err(FieldError::Request(reason));
        };
        if field.depends_on(d)[2] && at.displacement.is_none() {
            let reason = format!("`{what}` depends on the displacement, which the request lacks");
            return Err(FieldError::Request(reason));
        }
        let places = at.labels.chunks_exact(d).enumerate();
        let value = |(place, label): (usize, &[f64])| {
            let u = at.displacement.map_or(&[][..], |all| &all[place * d..(place + 1) * d]);
            field.at(label, t, u)
        };
        Ok(places.flat_map(value).collect())
    }

    fn check_on_face(&self, number: usize, at: &FieldPlaces<'_>) -> Result<(), FieldError> {
        let Some(face) = self.scene.faces.get(number) else {
            return Err(FieldError::Request("there is no such face".to_owned()));
        };
        let ends = if face.high { &self.scene.to } else { &self.scene.from };
        let (end, near) = (ends[face.axis], self.scene.rounding());
        let is_off = |label: &[f64]| !((label[face.axis] - end).abs() <= near);
        let surface = format!("the face `{}`, whose coordinate is {end} m", face.name);
        self.check_on(&surface, is_off, at)
    }

    fn check_on_rim(&self, circle: &Circle, at: &FieldPlaces<'_>) -> Result<(), FieldError> {
        let Circle { name, centre, radius, .. } = circle;
        let near = self.scene.rounding();
        let is_off = |label: &[f64]| {
            let square: f64 = label.iter().zip(centre).map(|(x, c)| (x - c) * (x - c)).sum();
            !((square.sqrt() - radius).abs() <= near)
        };
        self.check_on(&format!("the {name} rim, whose radius is {radius} m"), is_off, at)
    }

    fn check_on(
        &self,
        surface: &str,
        is_off: impl Fn(&[f64]) -> bool,
        at: &FieldPlaces<'_>,
    ) -> Result<(), FieldError> {
        let mut labels = at.labels.chunks_exact(self.scene.dimension()).enumerate();
        labels.find(|(_, label)| is_off(label)).map_or(Ok(()), |(place, label)| {
            let label = shown(label);
            Err(FieldError::Request(format!("place {place}, {label}, is not on {surface}")))
        })
    }
}

impl ProblemFields for SceneFields {
    fn bodies(&self, labels: &[f64]) -> Result<Vec<usize>, FieldError> {
        let body_of = |(place, label): (usize, &[f64])| {
            let mut holding =
                (0..self.bodies.len()).filter(|body| self.bodies[*body].scene.holds(label));
            match (holding.next(), holding.next()) {
                (Some(body), None) => Ok(body),
                (None, _) => Err(FieldError::Request(format!(
                    "place {place}, {}, is outside the body",
                    shown(label)
                ))),
                (Some(one), Some(other)) => Err(FieldError::Request(format!(
                    "place {place}, {}, belongs to the bodies {one} and {other}: name one of them \
                     as `body`",
                    shown(label)
                ))),
            }
        };
        labels.chunks_exact(self.scene.dimension()).enumerate().map(body_of).collect()
    }

    fn nearest_body(&self, label: &[f64]) -> usize {
        self.bodies.iter().position(|body| body.scene.holds(label)).unwrap_or(0)
    }

    fn check_places(&self, places: &FieldPlaces<'_>) -> Result<(), FieldError> {
        let labels = places.labels.chunks_exact(self.scene.dimension());
        for (place, (label, body)) in labels.zip(places.bodies).enumerate() {
            if !self.body(*body)?.scene.holds(label) {
                let reason = format!("place {place}, {}, is outside body {body}", shown(label));
                return Err(FieldError::Request(reason));
            }
        }
        Ok(())
    }

    fn values(&self, of: FieldName, t: f64, at: &FieldPlaces<'_>) -> Result<Vec<f64>, FieldError> {
        let has_noise =
            matches!(of, FieldName::Velocity | FieldName::DeformationGradient | FieldName::Stress);
        if self.is_perturbed && has_noise {
            let reason = "this run starts with random perturbations, which are defined at the \
                          particles only: read them from the columns of `particles`";
            return Err(FieldError::Undefined(reason.to_owned()));
        }
        let values = match of {
            FieldName::Stress => self.stress(at)?,
            FieldName::Load(number) => {
                let load = self.scene.loads.get(number);
                let load =
                    load.ok_or_else(|| FieldError::Request(format!("there is no load {number}")))?;
                if let Some(face) = load.target().face() {
                    self.check_on_face(face, at)?;
                }
                let numbers = load.numbers();
                let depends_on_place =
                    |field: &NumberField| field.depends_on(self.scene.dimension())[0];
                if let Some(circle) = self.scene.rim(load)
                    && numbers.field.as_ref().is_some_and(depends_on_place)
                {
                    self.check_on_rim(&circle, at)?;
                }
                self.numbers(load.effect.name(), &numbers, t, at)?
            }
            FieldName::Face(number) => {
                self.check_on_face(number, at)?;
                let face = &self.scene.faces[number];
                self.numbers(face.condition(), &face.hold.numbers(), t, at)?
            }
            _ => self.initial(of, at)?,
        };
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(FieldError::Undefined(format!("a value at t = {t} s is not finite")))
    }
}

fn shown(label: &[f64]) -> String {
    let all: Vec<String> = label.iter().map(ToString::to_string).collect();
    format!("({}) m", all.join(", "))
}
