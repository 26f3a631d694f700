//! Creates the FEM bar of a plan, as the tested method or as a reference.

use super::initial_state::Initial;
use crate::exact::{Forcing, Problem};
use crate::fem;
use crate::fem::{Bar, BarLaw, Sampling};
use crate::mpm::MaterialPlan;
use crate::subject::{Start, SubjectError};
use crate::suite::grammar::EquationName;
use crate::suite::model::method::Method;
use crate::suite::model::{ConvergencePlan, ReferencePlan, Scene};
use crate::suite::scene::cell_size;
use crate::suite::scene::load::{ListedLoad, LoadTarget};

pub(crate) fn bar(plan: &ConvergencePlan, method: Method, cells: u64) -> Result<Bar, SubjectError> {
    let Method::Fem { element, mass, law, start, sampling } = method else {
        return Err("not an FEM method".into());
    };
    let scene = &plan.scene;
    let (from, to) = (scene.from[0], scene.to[0]);
    let elements = libm::round((to - from) / cell_size(scene, cells)).max(1.0);
    let [deformed, moving] = [(); 2].map(|()| Initial::of_body(plan, scene));
    let setup = fem::BarSetup {
        from,
        to,
        cells: elements as usize,
        element,
        mass,
        // The density is uniform, because `compile::run` rejects a varying density with FEM.
        density: scene.density.largest(),
        law: piola(law, &scene.material)?,
        fixed: [&scene.faces[0], &scene.faces[1]].map(|face| !face.hold.is_free()),
        body_force: body_force(scene, plan.manufactured().cloned()),
        traction: [0, 1].map(|end| end_traction(scene, end)),
        initial_displacement: Box::new(move |x| deformed.at(&[x]).u[0]),
        initial_velocity: Box::new(move |x| moving.at(&[x]).velocity[0]),
        start,
        sampling,
    };
    Bar::new(setup).map_err(|error| error.to_string().into())
}

fn body_force(scene: &Scene, made: Option<Problem>) -> Option<fem::BarLoad> {
    let on_face = |load: &&ListedLoad| matches!(load.target(), LoadTarget::Face(_));
    let stated: Vec<_> = scene.loads.iter().filter(|load| !on_face(load)).cloned().collect();
    if stated.is_empty() && made.is_none() {
        return None;
    }
    let (mut forcing, mut forces) = (None, Vec::new());
    Some(Box::new(move |t, (places, u), values| {
        match &made {
            None => values.fill(0.0),
            Some(made) => {
                let labels = || places.iter().map(std::slice::from_ref);
                let forcing = forcing.get_or_insert_with(|| Forcing::new(made, labels()));
                forces.resize(values.len(), [0.0; 3]);
                forcing.at(t, &mut forces);
                values.iter_mut().zip(&forces).for_each(|(value, force)| *value = force[0]);
            }
        }
        add_stated(&stated, t, places, u, values);
    }))
}

/// Adds the prescribed forces (m/s2) at displaced positions. Uniform forces are evaluated once.
fn add_stated(loads: &[ListedLoad], t: f64, places: &[f64], u: &[f64], values: &mut [f64]) {
    for load in loads.iter().filter(|load| load.is_uniform()) {
        let everywhere = load.stated(0, &[], t, &[0.0; 3]);
        for value in &mut *values {
            *value += everywhere;
        }
    }
    for load in loads.iter().filter(|load| !load.is_uniform()) {
        for (value, (x, u)) in values.iter_mut().zip(places.iter().zip(u)) {
            *value += load.stated(0, &[*x], t, &[*u, 0.0, 0.0]);
        }
    }
}

/// Converts the traction of a suite, which acts along +X, to a tension along the outward normal.
fn end_traction(scene: &Scene, end: usize) -> Option<fem::TimeFunction> {
    let (x, outwards) = if end == 0 { (scene.from[0], -1.0) } else { (scene.to[0], 1.0) };
    scene.loads_on(LoadTarget::Face(end)).find_map(|load| load.tension(x, outwards))
}

/// Returns P(F) (Pa), the first Piola-Kirchhoff stress of a bar in uniaxial strain.
fn piola(law: EquationName, material: &MaterialPlan) -> Result<fem::ScalarFunction, SubjectError> {
    let (young, poisson) = material.elasticity().ok_or("the material has no Young's modulus")?;
    let law = BarLaw::find(law.name())
        .ok_or_else(|| format!("the built-in FEM does not support the law `{}`", law.name()))?;
    Ok(law.piola(young, poisson))
}

pub(crate) fn reference_method(plan: &ReferencePlan) -> Method {
    Method::Fem {
        element: plan.element,
        mass: plan.mass,
        law: plan.equation,
        start: Start::HalfStepBack,
        sampling: Sampling::Inside,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Equation;
    use crate::mpm::{Block, Matrix, Particles, StressUpdate, Vector};
    use crate::suite::compile::run::methods::law_of_bar;
    use crate::suite::compile::truth::equation_of;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Reference density (kg/m3).
    const DENSITY: f64 = 1.75;

    /// Computes `J sigma F^-T` (Pa) of the MPM material.
    fn piola_of_mpm<const D: usize>(plan: &MaterialPlan, f: &Matrix<D>) -> Matrix<3> {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut one = Particles::<D>::fill(&Block { from, to, density: DENSITY }, 1.0, 1);
        one.track_deformation();
        one.def_grad[0] = *f;
        plan.build().update(&mut StressUpdate::new(0.0, &mut one));
        let mut space = Matrix::<3>::identity();
        space.fixed_view_mut::<D, D>(0, 0).copy_from(f);
        let mut sigma = Matrix::<3>::zeros();
        sigma.fixed_view_mut::<D, D>(0, 0).copy_from(&one.sigma[0]);
        sigma * space.try_inverse().unwrap().transpose() * space.determinant()
    }

    fn known(hardening: f64) -> impl Iterator<Item = (MaterialPlan, Equation)> {
        let every = MaterialPlan::every(|parameter| match parameter.symbol {
            "nu" => 0.3,
            "Y" | "k" | "c" => 5.0,
            "H" => hardening,
            "eta" => 0.5,
            "etab" => 0.2,
            "phi" => 30.0,
            "psi" => 10.0,
            "g" => 1.4,
            _ => 100.0,
        });
        let known = every.into_iter().filter_map(|plan| Some((plan, equation_of(&plan)?)));
        known.filter(|(_, truth)| truth.is_finite())
    }

    #[test]
    fn every_material_that_deforms_has_an_exact_law() {
        let without: Vec<_> = MaterialPlan::every(|_| 0.5)
            .into_iter()
            .filter(|plan| equation_of(plan).is_none())
            .map(|plan| plan.name())
            .collect();
        assert_eq!(without, ["rigid"]);
    }

    #[test]
    fn mpm_fem_and_truth_mean_the_same_law() {
        let elastic = known(0.0).filter(|(plan, _)| plan.properties().is_elastic());
        elastic.for_each(|(plan, truth)| agree(&plan, &truth));
    }

    fn agree(plan: &MaterialPlan, truth: &Equation) {
        let bar = law_of_bar(plan).map(|law| piola(law, plan).unwrap());
        for stretch in [0.7, 1.0 + 1e-6, 1.4] {
            let stress = piola_of_mpm(plan, &Matrix::<1>::new(stretch))[(0, 0)];
            if let Some(bar) = &bar {
                assert_relative_eq!(bar(stretch), stress, max_relative = 1e-9);
            }
        }
        let f = Matrix::<3>::new(1.2, -0.1, 0.05, 0.3, 0.8, 0.1, 0.0, 0.15, 1.1);
        let grad = f - Matrix::identity();
        let stress = truth.piola(&[0, 1, 2].map(|i| [0, 1, 2].map(|j| grad[(i, j)])));
        let expected = piola_of_mpm(plan, &f);
        for (k, expected) in expected.iter().enumerate() {
            assert_relative_eq!(stress[k % 3][k / 3], *expected, epsilon = 1e-11);
        }
    }

    /// The uniaxial strain leaves the elastic range; loading never reverses. Fluids are at rest.
    #[rstest]
    fn mpm_and_exact_laws_agree(
        #[values(0.0, 40.0)] hardening: f64,
        #[values(0.7, 0.97, 1.0, 1.03, 1.4)] stretch: f64,
    ) {
        // Clay needs many steps: its return mapping has order 1 (`mpm::material::clay_paths`).
        let exact = known(hardening).filter(|(plan, _)| plan.name() != "cam_clay");
        for (plan, truth) in exact.filter(|(_, truth)| truth.admits(1, true).is_ok()) {
            let mut grad = [[0.0; 3]; 3];
            grad[0][0] = stretch - 1.0;
            let expected = piola_at(&plan, stretch);
            for found in [truth.piola(&grad), truth.cauchy(&grad)] {
                let found = found[0][0] * truth.density_factor(DENSITY);
                assert_relative_eq!(found, expected, max_relative = 1e-9, epsilon = 1e-12);
            }
        }
    }

    /// Computes P (Pa) of the MPM material in a bar at rest that was stretched in one step.
    fn piola_at(plan: &MaterialPlan, stretch: f64) -> f64 {
        let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
        let mut one = Particles::<1>::fill(&Block { from, to, density: DENSITY }, 1.0, 1);
        one.track_deformation();
        one.def_grad[0] = Matrix::<1>::new(stretch);
        one.grad_v[0] = Matrix::<1>::new(stretch - 1.0);
        let mut material = plan.build();
        material.update(&mut StressUpdate::new(1.0, &mut one));
        one.grad_v[0] = Matrix::zeros();
        material.update(&mut StressUpdate::new(1.0, &mut one));
        one.sigma[0][(0, 0)]
    }
}
