//! Conduction of heat.

use super::contract::{LoadEntry, LoadWords};
use super::thermal_face;
use crate::exact::Term;
use crate::exact::formula::{Expr, Formula};
use crate::exact::heat::{Conduction, HeatForcing, Temperature, TemperatureDerivatives, source_at};
use crate::mpm::{Effect, Heat, HeatSource, Particles, Vector};
use crate::subject::PlaneState;
use crate::suite::compile::boundary::thermal::ThermalSpec;
use crate::suite::evaluator::coordinates_and_time;
#[cfg(feature = "schemas")]
use crate::suite::model::face_schema::by_face;
use crate::suite::model::heat::SceneHeat;
use crate::suite::model::load::{BodySite, BuildEffect, SceneLoad};
use crate::suite::yaml::{Diagnostic, NumberText, Ordered, Path};
use std::sync::Arc;

/// Name of the temperature in a source.
const TEMPERATURE: &str = "T";

/// Conduction of heat, and the conditions on the faces.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct HeatSpec {
    /// Conductivity (W/(m K)).
    conductivity: NumberText,
    /// Heat capacity (J/(kg K)).
    capacity: NumberText,
    /// Source (W/kg), a formula of the coordinates, t and T.
    source: Option<NumberText>,
    /// Initial temperature (K), a formula of the coordinates.
    initial: Option<NumberText>,
    /// Conditions on faces; one that is not named is insulated.
    #[serde(default)]
    #[cfg_attr(feature = "schemas", schemars(schema_with = "by_face::<ThermalSpec>"))]
    boundary: Ordered<ThermalSpec>,
}

impl LoadWords for HeatSpec {
    fn example(_: &str) -> String {
        "{conductivity: 0.1, capacity: 1, initial: s*X}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        let LoadEntry { evaluator, path, scene, .. } = entry;
        if let Some(outline) = &scene.outline {
            let kind = outline.kind();
            let message = format!("heat flows in a `box`, and the body is of kind `{kind}`");
            return Err(evaluator.diagnostic_at_key(path, &message));
        }
        if scene.heat().is_some() {
            return Err(evaluator.diagnostic_at_key(path, "heat appears twice"));
        }
        let source = self.source.as_ref().map(|text| source(entry, &path.then("source"), text));
        let initial = self.initial.as_ref().map(|text| entry.scalar(&path.then("initial"), text));
        let number =
            |key: &str, text: &NumberText, what| evaluator.positive(&path.then(key), text, what);
        Ok(Arc::new(SceneHeat {
            conductivity: number("conductivity", &self.conductivity, "the conductivity")?,
            capacity: number("capacity", &self.capacity, "the heat capacity")?,
            source: source.transpose()?,
            initial: initial.transpose()?,
            faces: thermal_face::faces(entry, &self.boundary)?,
        }))
    }

    fn against_plane(&self, plane: PlaneState) -> Option<&'static str> {
        (plane != PlaneState::Strain).then_some("heat flows in bodies in plane strain only")
    }

    fn is_of_one_body(&self) -> bool {
        true
    }

    fn acts_at_rest(&self) -> bool {
        true
    }
}

/// The source. A suite may declare a `T` of its own as long as the source does not name it.
fn source(entry: &LoadEntry<'_>, path: &Path, text: &NumberText) -> Result<Formula, Diagnostic> {
    let evaluator = entry.evaluator;
    let mut variables = coordinates_and_time(entry.dimension());
    let names_it = |expr: Expr| expr.names().iter().any(|(name, _)| name == TEMPERATURE);
    if evaluator.refuse_taken(&[TEMPERATURE]).is_ok()
        || Expr::parse(&text.to_string()).is_ok_and(names_it)
    {
        variables.push(TEMPERATURE);
    }
    evaluator.formula(path, text, &variables)
}

/// No force.
impl Term for SceneHeat {}

impl SceneLoad for SceneHeat {
    fn rows(&self) -> Vec<(String, String)> {
        let (k, c) = (self.conductivity, self.capacity);
        let mut texts = vec![format!("conductivity {k} W/(m K), capacity {c} J/(kg K)")];
        texts.extend(self.source.iter().map(|source| format!("source {} W/kg", source.source())));
        texts.extend(self.initial.iter().map(|initial| format!("from {} K on", initial.source())));
        let faces = self
            .faces
            .iter()
            .filter_map(|face| Some((format!("heat {}", face.name), face.condition.row()?)));
        [("heat".to_owned(), texts.join(", "))].into_iter().chain(faces).collect()
    }

    fn heat(&self) -> Option<&SceneHeat> {
        Some(self)
    }

    fn disturbs_rest(&self) -> bool {
        false
    }
}

impl<const D: usize> BuildEffect<D> for SceneHeat {
    /// The particles get their temperature here.
    fn build(&self, site: &mut BodySite<'_, D>) -> Result<Box<dyn Effect<D>>, String> {
        let start = initial::<D>(site.heat, self.initial.as_ref());
        let heat = Heat::new((self.conductivity, self.capacity), site.particles, |x0| {
            let TemperatureDerivatives { value, grad, .. } = start(x0.as_slice());
            (value, Vector::from_fn(|axis, _| grad[axis]))
        });
        let heat = heat.with_faces(thermal_face::build(&self.faces, site));
        let made = site.heat.filter(|problem| problem.manufactured);
        let source = match (made, &self.source) {
            (Some(made), _) => manufactured(made, site.particles),
            (None, Some(formula)) => stated(formula),
            (None, None) => return Ok(Box::new(heat)),
        };
        Ok(Box::new(heat.with_source(source)))
    }
}

/// The temperature at the start: what the scene states, or else that of the truth.
fn initial<const D: usize>(
    problem: Option<&Conduction>,
    stated: Option<&Formula>,
) -> impl Fn(&[f64]) -> TemperatureDerivatives + use<D> {
    let stated = stated.map(|formula| Temperature::new(formula.clone(), D));
    let field = stated.or_else(|| Some(problem?.temperature.clone()));
    move |label| {
        field
            .as_ref()
            .map_or_else(TemperatureDerivatives::default, |field| field.derivatives(label, 0.0))
    }
}

/// The source as the scene states it.
fn stated<const D: usize>(formula: &Formula) -> HeatSource<D> {
    let formula = formula.clone();
    Box::new(move |t, particles, into| {
        let places = particles.x0.iter().zip(&particles.temperature);
        for (into, (label, temperature)) in into.iter_mut().zip(places) {
            *into = source_at(&formula, label.as_slice(), t, *temperature);
        }
    })
}

/// The source that follows from the temperature.
fn manufactured<const D: usize>(made: &Conduction, particles: &Particles<D>) -> HeatSource<D> {
    let mut forcing = HeatForcing::new(made, particles.x0.iter().map(Vector::as_slice));
    Box::new(move |t, _, into| forcing.at(t, into))
}
