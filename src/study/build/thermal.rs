//! Conduction of heat, from the model to the solver.

use super::conditions::side;
use crate::{
    exact::{
        formula::Formula,
        heat::{Conduction, HeatForcing, Temperature, ThermalCondition, Warmth},
    },
    mpm::{
        BasisName, Grid, Heat, HeatSource, Particles, ScalarField, Side, Thermal, ThermalBoundary,
        Vector,
    },
    suite::model::Scene,
};

/// The conduction that the scene lists, for `particles`, which get their temperature here.
pub(crate) fn heat<const D: usize>(
    (body, problem): (&Scene, Option<&Conduction>),
    (grid, basis): (&Grid<D>, BasisName),
    particles: &mut Particles<D>,
) -> Option<Heat<D>> {
    let scene = body.heat.as_ref()?;
    let start = initial(body.dimension(), problem, scene.initial.as_ref());
    let law = (scene.conductivity, scene.capacity);
    let heat = Heat::new(law, particles, |x0| {
        let Warmth { value, grad, .. } = start(x0.as_slice());
        (value, Vector::from_fn(|axis, _| grad[axis]))
    });
    let faces = faces(body, (grid, basis), particles);
    let heat = heat.with_faces(faces);
    let made = problem.filter(|problem| problem.manufactured);
    let source = match (made, &scene.source) {
        (Some(made), _) => manufactured(made, particles),
        (None, Some(formula)) => stated(formula),
        (None, None) => return Some(heat),
    };
    Some(heat.with_source(source))
}

/// The temperature at the start: what the scene states, or else that of the truth.
fn initial(
    dimension: usize,
    problem: Option<&Conduction>,
    stated: Option<&Formula>,
) -> impl Fn(&[f64]) -> Warmth + use<> {
    let stated = stated.map(|formula| Temperature::new(formula.clone(), dimension));
    let field = stated.or_else(|| Some(problem?.temperature.clone()));
    move |label| field.as_ref().map_or_else(Warmth::default, |field| field.derivatives(label, 0.0))
}

/// The source as the scene states it.
fn stated<const D: usize>(formula: &Formula) -> HeatSource<D> {
    let source = of_place_and_time(formula);
    Box::new(move |t, labels, into| {
        for (into, label) in into.iter_mut().zip(labels) {
            *into = source(label, t);
        }
    })
}

/// The source that follows from the temperature.
fn manufactured<const D: usize>(made: &Conduction, particles: &Particles<D>) -> HeatSource<D> {
    let mut forcing = HeatForcing::new(made, particles.x0.iter().map(Vector::as_slice));
    Box::new(move |t, _, into| forcing.at(t, into))
}

fn faces<const D: usize>(
    scene: &Scene,
    (grid, basis): (&Grid<D>, BasisName),
    particles: &Particles<D>,
) -> Vec<ThermalBoundary<D>> {
    let stated = scene.heat.iter().flat_map(|heat| heat.faces.iter().zip(&scene.faces));
    let build =
        |(face, place): (&crate::exact::heat::ThermalFace, &crate::suite::model::SceneFace)| {
            let condition = match &face.condition {
                ThermalCondition::Insulated | ThermalCondition::Periodic => return None,
                ThermalCondition::Temperature(value) => {
                    Thermal::Temperature(of_place_and_time(value))
                }
                ThermalCondition::Flux(value) => Thermal::Flux(of_place_and_time(value)),
                ThermalCondition::Convection { coefficient, ambient } => Thermal::Convection {
                    coefficient: *coefficient,
                    ambient: of_place_and_time(ambient),
                },
            };
            let at: (usize, Side) = (face.axis, side(place));
            Some(ThermalBoundary::new((grid, basis), particles, at, condition))
        };
    stated.filter_map(build).collect()
}

fn of_place_and_time<const D: usize>(formula: &Formula) -> ScalarField<D> {
    let formula = formula.clone();
    Box::new(move |x: &Vector<D>, t| {
        let mut variables = [0.0; 4];
        variables[..D].copy_from_slice(x.as_slice());
        variables[D] = t;
        formula.eval(&variables[..=D])
    })
}
