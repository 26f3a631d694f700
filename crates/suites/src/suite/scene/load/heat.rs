//! Heat conduction.

use super::contract::{BodySite, SceneLoad};
use super::entry::{LoadEntry, LoadKeys};
use crate::exact::Term;
use crate::exact::formula::{Expr, Formula};
use crate::exact::heat::{Conduction, HeatForcing, Temperature, TemperatureDerivatives, source_at};
use crate::mpm::Side;
use crate::mpm::input::{EffectInput, FaceInput, HeatInput, HeatSourceAt, TemperatureAt};
use crate::subject::PlaneState;
use crate::suite::evaluator::{SuitePath, coordinates_and_time};
use crate::suite::scene::SceneFace;
use crate::suite::scene::boundary::FaceEntry;
use crate::suite::scene::boundary::thermal::{
    HeatCondition, Insulated, PeriodicTemperature, SceneHeat, ThermalFace, ThermalSpec,
};
#[cfg(feature = "schemas")]
use crate::suite::scene::face::by_face;
use crate::suite::scene::face::face;
use crate::suite::scene::numbers::with_unit;
use crate::suite::yaml::{Diagnostic, NumberText, Ordered};
use std::sync::Arc;

const TEMPERATURE: &str = "T";

/// Heat conduction, and thermal conditions on faces.
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
    /// Thermal conditions on faces; other faces are insulated.
    #[serde(default)]
    #[cfg_attr(feature = "schemas", schemars(schema_with = "by_face::<ThermalSpec>"))]
    boundary: Ordered<ThermalSpec>,
}

impl LoadKeys for HeatSpec {
    fn example(_: &str) -> String {
        "{conductivity: 0.1, capacity: 1, initial: s*X}".to_owned()
    }

    fn compile(&self, entry: &LoadEntry<'_>) -> Result<Arc<dyn SceneLoad>, Diagnostic> {
        let LoadEntry { path, scene, .. } = entry;
        if let Some(outline) = &scene.outline {
            let kind = outline.kind();
            let message =
                format!("heat is supported in a `box` only, but the body is of kind `{kind}`");
            return Err(path.diagnostic_at_key(&message));
        }
        if scene.heat().is_some() {
            return Err(path.diagnostic_at_key("heat appears twice"));
        }
        let source = self.source.as_ref().map(|text| source(entry, &path.then("source"), text));
        let initial =
            self.initial.as_ref().map(|text| path.then("initial").field(text, entry.dimension()));
        let number = |key: &str, text: &NumberText, what| path.then(key).positive(text, what);
        Ok(Arc::new(SceneHeat {
            conductivity: number("conductivity", &self.conductivity, "the conductivity")?,
            capacity: number("capacity", &self.capacity, "the heat capacity")?,
            source: source.transpose()?,
            initial: initial.transpose()?,
            faces: faces(entry, &self.boundary)?,
        }))
    }

    fn against_plane(&self, plane: PlaneState) -> Option<&'static str> {
        (plane != PlaneState::Strain).then_some("it is implemented in plane strain only")
    }

    fn is_of_one_body(&self) -> bool {
        true
    }

    fn acts_at_rest(&self) -> bool {
        true
    }
}

/// Compiles the heat source, a formula that may contain the temperature `T`.
fn source(
    entry: &LoadEntry<'_>,
    path: &SuitePath<'_>,
    text: &NumberText,
) -> Result<Formula, Diagnostic> {
    let mut variables = coordinates_and_time(entry.dimension());
    let names_it = |expr: Expr| expr.names().iter().any(|(name, _)| name == TEMPERATURE);
    if path.evaluator.refuse_taken(&[TEMPERATURE]).is_ok()
        || Expr::parse(&text.to_string()).is_ok_and(names_it)
    {
        variables.push(TEMPERATURE);
    }
    path.formula(text, &variables)
}

impl Term for SceneHeat {}

impl SceneLoad for SceneHeat {
    fn rows(&self) -> Vec<(String, String)> {
        let (k, c) = (self.conductivity, self.capacity);
        let mut texts = vec![format!("conductivity {k} W/(m K), capacity {c} J/(kg K)")];
        let row = |name: &str, value: &Formula, unit: &str| {
            format!("{name} = {}", with_unit(value.source(), unit))
        };
        texts.extend(self.source.iter().map(|source| row("source", source, "W/kg")));
        texts.extend(self.initial.iter().map(|initial| row("initial temperature", initial, "K")));
        let faces = self.faces.iter().filter_map(|face| {
            Some((format!("thermal condition {}", face.name), face.condition.row()?))
        });
        [("heat".to_owned(), texts.join(", "))].into_iter().chain(faces).collect()
    }

    fn heat(&self) -> Option<&SceneHeat> {
        Some(self)
    }

    fn disturbs_rest(&self) -> bool {
        false
    }

    fn input(&self, site: &BodySite<'_>) -> EffectInput {
        let made = site.heat.filter(|problem| problem.manufactured);
        let source: Option<Box<dyn HeatSourceAt>> = match (made, &self.source) {
            (Some(made), _) => {
                Some(Box::new(ManufacturedSource { problem: made.clone(), forcing: None }))
            }
            (None, Some(formula)) => {
                Some(Box::new(StatedSource { formula: formula.clone(), labels: Vec::new() }))
            }
            (None, None) => None,
        };
        let condition = |face: &ThermalFace| {
            let side = if face.high { Side::High } else { Side::Low };
            Some((FaceInput { axis: face.axis, side }, face.condition.input()?))
        };
        EffectInput::Heat(HeatInput {
            conductivity: self.conductivity,
            capacity: self.capacity,
            initial: initial(self, site),
            source,
            faces: self.faces.iter().filter_map(condition).collect(),
        })
    }
}

/// Returns the initial temperature (K) and its gradient (K/m), as stated or exact.
fn initial(heat: &SceneHeat, site: &BodySite<'_>) -> TemperatureAt {
    let stated = heat.initial.clone().map(|formula| Temperature::new(formula, site.dimension));
    let field = stated.or_else(|| Some(site.heat?.temperature.clone()));
    Box::new(move |label| {
        let now = field.as_ref().map(|field| field.derivatives(label, 0.0));
        let TemperatureDerivatives { value, grad, .. } = now.unwrap_or_default();
        (value, grad)
    })
}

struct StatedSource {
    formula: Formula,
    labels: Vec<Vec<f64>>,
}

impl HeatSourceAt for StatedSource {
    fn prepare(&mut self, labels: &[&[f64]]) {
        self.labels = labels.iter().map(|label| label.to_vec()).collect();
    }

    fn write(&mut self, t: f64, temperature: &[f64], into: &mut [f64]) {
        for (into, (label, temperature)) in into.iter_mut().zip(self.labels.iter().zip(temperature))
        {
            *into = source_at(&self.formula, label, t, *temperature);
        }
    }
}

struct ManufacturedSource {
    problem: Conduction,
    forcing: Option<HeatForcing>,
}

impl HeatSourceAt for ManufacturedSource {
    fn prepare(&mut self, labels: &[&[f64]]) {
        self.forcing = Some(HeatForcing::new(&self.problem, labels.iter().copied()));
    }

    fn write(&mut self, t: f64, _: &[f64], into: &mut [f64]) {
        if let Some(forcing) = &mut self.forcing {
            forcing.at(t, into);
        }
    }
}

fn faces(
    entry: &LoadEntry<'_>,
    spec: &Ordered<ThermalSpec>,
) -> Result<Vec<ThermalFace>, Diagnostic> {
    let dimension = entry.dimension();
    let unnamed = |face: &SceneFace| {
        let SceneFace { name, axis, high, .. } = *face;
        let periodic = face.hold.is_periodic();
        let condition: Arc<dyn HeatCondition> =
            if periodic { Arc::new(PeriodicTemperature) } else { Arc::new(Insulated) };
        ThermalFace { name, axis, high, condition }
    };
    let path = entry.path.then("boundary");
    let mut faces: Vec<ThermalFace> = entry.scene.faces.iter().map(unnamed).collect();
    for (name, spec) in spec.as_slice() {
        let at = path.then(name.as_str());
        let i = face(&at, name, dimension, true)?;
        let (condition, spec) = spec.named();
        let condition = spec.compile(&FaceEntry { path: at.then(condition), dimension })?;
        on_grid(&at, condition.input().is_some(), &entry.scene.faces[i])?;
        faces[i].condition = condition;
    }
    Ok(faces)
}

/// Refuses prescribed temperatures and heat fluxes on a face that does not stay on a grid face,
/// because the condition applies to nodes.
fn on_grid(path: &SuitePath<'_>, lets_heat_in: bool, face: &SceneFace) -> Result<(), Diagnostic> {
    let (name, verb) = (face.name, face.hold.kind().verb);
    if face.hold.is_periodic() {
        let message = format!("the {name} face {verb}, so it cannot have a thermal condition");
        return Err(path.diagnostic_at_key(&message));
    }
    if face.hold.stays() || !lets_heat_in {
        return Ok(());
    }
    let message = format!("the {name} face {verb}, but heat can enter only at a face of the grid");
    path.refuse_key(&message, "hold it (`fixed` or `roller`), or leave it insulated")
}
