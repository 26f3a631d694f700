//! Answers the requests of a solver for values at points and times.

use super::answer::{ColumnText, ValueRequest};
use super::error::{ProgramError, printable};
use super::frame::Outgoing;
use crate::external::capabilities::hint;
use crate::external::fields::{
    BODY_FIELDS, BodyForceField, FieldError, FieldName, FieldPlaces, PlacedBodyForce, ProblemFields,
};
use crate::external::problem::{LevelProblem, ProblemFace, ProblemLoad};
use serde_json::json;
use std::sync::Arc;

pub(super) struct Inquiry {
    dimension: usize,
    body_force: Option<Arc<dyn BodyForceField>>,
    fields: Option<Arc<dyn ProblemFields>>,
    faces: Vec<ProblemFace>,
    loads: Vec<ProblemLoad>,
    /// Default points of requests: reference positions (m) of particles or of the solver's points.
    labels: Vec<f64>,
    bodies: Vec<usize>,
    /// Body force at `labels`, created by the first request for a body force.
    placed: Option<PlacedBodyForce>,
    version: u64,
    binary: bool,
    /// Number of requests since the last call of `allow`.
    asked: u64,
    most: u64,
}

impl Inquiry {
    pub(super) fn new(problem: &LevelProblem, version: u64, binary: bool) -> Self {
        Self {
            dimension: problem.dimension,
            body_force: problem.body_force.clone(),
            fields: problem.fields.clone(),
            faces: problem.faces.clone(),
            loads: problem.loads.clone(),
            labels: problem.particles.reference_position.clone(),
            bodies: problem.particles.body.iter().map(|body| *body as usize).collect(),
            placed: None,
            version,
            binary,
            asked: 0,
            most: 0,
        }
    }

    /// Sets the default points of requests (m, D numbers each). Points outside the bodies are an
    /// error from version 2 of the protocol on.
    pub(super) fn set_points(&mut self, labels: &[f64]) -> Result<(), ProgramError> {
        let invalid = |reason| ProgramError::Protocol(format!("sent invalid points: {reason}"));
        self.bodies = self.bodies_of(labels).map_err(invalid)?;
        self.labels = labels.to_vec();
        Ok(())
    }

    /// Returns an initial field at the default points; `None` if the field is undefined.
    pub(super) fn start(&self, of: FieldName) -> Option<Vec<f64>> {
        let at = FieldPlaces::new(&self.labels, &self.bodies);
        self.fields.as_ref()?.values(of, 0.0, &at).ok()
    }

    pub(super) fn allow(&mut self, requests: u64) {
        (self.asked, self.most) = (0, requests);
    }

    /// Answers a request. `bytes` is the block of bytes that follows the request.
    pub(super) fn answer(
        &mut self,
        request: ValueRequest,
        bytes: &[u8],
    ) -> Result<Outgoing, ProgramError> {
        self.asked += 1;
        if self.asked > self.most {
            let asked = self.asked;
            let reason = format!("requested values {asked} times, more than the limit");
            return Err(ProgramError::Protocol(reason));
        }
        let ValueRequest { of, t, reference_position, displacement, body } = request;
        let name = of.as_deref().unwrap_or("body_force");
        let refused = |reason: FieldError| {
            let field = printable(name);
            ProgramError::Protocol(format!("requested values of `{field}`: {reason}"))
        };
        let field = field_named(name, &self.loads, &self.faces).map_err(refused)?;
        let t = time(field, t).map_err(refused)?;
        let numbers = |name: &str, column: ColumnText| {
            let (count, d) = (column.count(), self.dimension);
            column.numbers(name, count.next_multiple_of(d), bytes)
        };
        let own = reference_position.map(|column| numbers("reference_position", column));
        let displacement = displacement.map(|column| numbers("displacement", column));
        let (own, displacement) = (own.transpose()?, displacement.transpose()?);
        let places = self.places(field, own, displacement, body).map_err(refused)?;
        let values = match field {
            FieldName::BodyForce => self.forces(t, &places),
            _ => self.values(field, t, &places),
        };
        let kind = if of.is_some() { "values" } else { "body_force" };
        let mut message = Outgoing::new(kind, json!({}), self.binary);
        if of.is_some() {
            message.set("of", json!(name));
        }
        match values {
            Ok(values) => message.set_numbers("values", &values),
            Err(FieldError::Undefined(reason)) if of.is_some() => {
                message.set("error", json!(reason));
            }
            Err(reason) => return Err(refused(reason)),
        }
        Ok(message)
    }

    fn places(
        &self,
        field: FieldName,
        own: Option<Vec<f64>>,
        displacement: Option<Vec<f64>>,
        body: Option<usize>,
    ) -> Result<RequestedPlaces, FieldError> {
        let are_own = own.is_none();
        let labels = match own {
            Some(labels) => labels,
            None => self.default_places(field)?,
        };
        let count = labels.len() / self.dimension;
        let bodies = match (field, body) {
            (FieldName::Face(_), _) => vec![0; count],
            // A load that has the same value at all points has one default point, assigned to body
            // 0.
            (FieldName::Load(_), _) if are_own && labels.len() != self.labels.len() => {
                vec![0; count]
            }
            (_, None) if are_own => self.bodies.clone(),
            (_, None) => self.bodies_of(&labels)?,
            (_, Some(body)) => {
                let bodies = vec![body; count];
                if let Some(fields) = &self.fields {
                    let at = FieldPlaces::new(&labels, &bodies);
                    fields.check_places(&at)?;
                }
                bodies
            }
        };
        if let Some(displacement) = &displacement
            && displacement.len() != labels.len()
        {
            let (found, wanted) = (displacement.len(), labels.len());
            let reason = format!("sent {found} numbers as `displacement`, expected {wanted}");
            return Err(FieldError::Request(reason));
        }
        Ok(RequestedPlaces { labels, bodies, displacement, are_own })
    }

    fn default_places(&self, field: FieldName) -> Result<Vec<f64>, FieldError> {
        let (numbers, face) = match field {
            FieldName::Load(load) => {
                let load = &self.loads[load];
                (&load.numbers, self.faces.iter().find(|face| Some(face.name) == load.face))
            }
            FieldName::Face(face) => (&self.faces[face].numbers, Some(&self.faces[face])),
            _ => return Ok(self.labels.clone()),
        };
        let depends_on = |key| numbers.asked.iter().any(|(_, keys)| keys.contains(&key));
        let by_place = depends_on("reference_position");
        if depends_on("displacement") || (by_place && face.is_none()) {
            return Ok(self.labels.clone());
        }
        if by_place {
            let reason =
                "the value depends on the position, but the request has no `reference_position`";
            return Err(FieldError::Request(reason.to_owned()));
        }
        let mut place = vec![0.0; self.dimension];
        if let Some(face) = face {
            place[face.axis] = face.at;
        }
        Ok(place)
    }

    fn bodies_of(&self, labels: &[f64]) -> Result<Vec<usize>, FieldError> {
        let places = labels.chunks_exact(self.dimension);
        match &self.fields {
            Some(fields) if self.version > 1 => fields.bodies(labels),
            Some(fields) => Ok(places.map(|label| fields.nearest_body(label)).collect()),
            None => Ok(vec![0; places.len()]),
        }
    }

    fn forces(&mut self, t: f64, places: &RequestedPlaces) -> Result<Vec<f64>, FieldError> {
        let d = self.dimension;
        let RequestedPlaces { labels, bodies, displacement, are_own } = places;
        let Some(force) = &self.body_force else { return Ok(vec![0.0; labels.len()]) };
        let mut forces = vec![[0.0; 3]; bodies.len()];
        let each = labels.chunks_exact(d).zip(bodies);
        match displacement {
            None if force.depends_on_displacement() => {
                let reason =
                    "the value depends on the displacement, but the request has no `displacement`";
                return Err(FieldError::Request(reason.to_owned()));
            }
            None if *are_own => {
                let placed = self.placed.get_or_insert_with(|| {
                    force.at_places(bodies, &labels.chunks_exact(d).collect::<Vec<_>>())
                });
                placed(t, &mut forces);
            }
            None => {
                for (into, (label, body)) in forces.iter_mut().zip(each) {
                    *into = force.at(*body, label, t);
                }
            }
            Some(displacement) => {
                let all = forces.iter_mut().zip(each.zip(displacement.chunks_exact(d)));
                for (into, ((label, body), u)) in all {
                    let u = std::array::from_fn(|i| u.get(i).copied().unwrap_or(0.0));
                    *into = force.at_displaced(*body, label, t, &u);
                }
            }
        }
        let values: Vec<f64> = forces.iter().flat_map(|force| &force[..d]).copied().collect();
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(FieldError::Undefined(format!("a value at t = {t} s is not finite")))
    }

    fn values(
        &self,
        of: FieldName,
        t: f64,
        places: &RequestedPlaces,
    ) -> Result<Vec<f64>, FieldError> {
        let Some(fields) = &self.fields else {
            let reason = "the problem defines fields at its particles only";
            return Err(FieldError::Undefined(reason.to_owned()));
        };
        let mut at = FieldPlaces::new(&places.labels, &places.bodies);
        at.displacement = places.displacement.as_deref();
        fields.values(of, t, &at)
    }
}

struct RequestedPlaces {
    labels: Vec<f64>,
    bodies: Vec<usize>,
    displacement: Option<Vec<f64>>,
    are_own: bool,
}

fn field_named(
    name: &str,
    loads: &[ProblemLoad],
    faces: &[ProblemFace],
) -> Result<FieldName, FieldError> {
    if let Some((_, field)) = BODY_FIELDS.iter().find(|(known, _)| *known == name) {
        return Ok(*field);
    }
    let loads = (0..loads.len()).map(|load| (format!("load:{load}"), FieldName::Load(load)));
    let faces = faces.iter().enumerate();
    let faces = faces.map(|(i, face)| (format!("face:{}", face.name), FieldName::Face(i)));
    let known: Vec<(String, FieldName)> = loads.chain(faces).collect();
    if let Some((_, field)) = known.iter().find(|(known, _)| known == name) {
        return Ok(*field);
    }
    let names = BODY_FIELDS.iter().map(|(known, _)| *known);
    let names: Vec<&str> = names.chain(known.iter().map(|(known, _)| known.as_str())).collect();
    Err(FieldError::Request(format!("unknown field; {}", hint(name, &names))))
}

/// Returns the time (s) of a request; 0 by default for fields of the initial state.
fn time(field: FieldName, t: Option<f64>) -> Result<f64, FieldError> {
    match t {
        None if field.is_initial() => Ok(0.0),
        None => Err(FieldError::Request("the request has no time `t`".to_owned())),
        Some(t) if field.is_initial() && t != 0.0 => {
            Err(FieldError::Request(format!("the field is defined at t = 0 only, not at t = {t}")))
        }
        Some(t) if !t.is_finite() => {
            Err(FieldError::Request(format!("the time `t` is {t}; expected a finite number")))
        }
        Some(t) => Ok(t),
    }
}
