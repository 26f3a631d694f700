//! Particles of polygons, on every level of the suites with polygons.

use crate::common::valid_suite;
use mpm_verify::study::level_problem;
use mpm_verify::subject::PlaneState;
use rstest::rstest;

/// Mass and centre of mass must equal those of the body, by Green's theorem. For a body of
/// revolution the mass is that of one radian: density times the first moment of the section.
#[rstest]
#[case::convex(include_str!("../../../verification/bodies-at-large-strain/mms-polygon.yaml"))]
#[case::not_convex(include_str!("../../../verification/bodies-at-large-strain/mms-polygon-angle.yaml"))]
#[case::of_revolution(include_str!("../../../verification/axisymmetry-and-plane-stress/mms-polygon-axisymmetric.yaml"))]
fn mass_and_centre_of_mass_are_exact(#[case] text: &str) {
    let suite = valid_suite(text);
    let plan = suite.convergence().unwrap();
    let corners = plan.scene.outline.as_ref().unwrap().trace();
    let next = corners.iter().cycle().skip(1);
    let exact = corners.iter().zip(next).fold([0.0; 3], |sums, (a, b)| {
        let doubled = a.0 * b.1 - b.0 * a.1;
        let terms = [0.5, (a.0 + b.0) / 6.0, (a.1 + b.1) / 6.0];
        [0, 1, 2].map(|i| sums[i] + plan.scene.density.largest() * doubled * terms[i])
    });
    for level in &plan.refine.levels {
        let particles = level_problem(&suite.name, plan, &plan.cases[0], *level).unwrap().particles;
        let places = particles.reference_position.chunks_exact(2);
        let found = particles.mass.iter().zip(places).fold([0.0; 3], |sums, (mass, x)| {
            [sums[0] + mass, sums[1] + mass * x[0], sums[2] + mass * x[1]]
        });
        let known = match plan.scene.plane {
            PlaneState::Axisymmetric => vec![(found[0], exact[1])],
            _ => found.into_iter().zip(exact).collect(),
        };
        for (found, exact) in known {
            assert!((found - exact).abs() < 1e-13, "{found} is not {exact} on {level:?}");
        }
    }
}
