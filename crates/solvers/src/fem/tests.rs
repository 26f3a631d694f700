//! Tests of shape functions, quadrature, mesh and mass matrices.

use approx::assert_relative_eq;
use proptest::prelude::*;
use rstest::rstest;

use crate::fem::Element;
use crate::fem::mass::{consistent, lumped};
use crate::fem::mesh::Mesh;

fn element() -> impl Strategy<Value = Element> {
    prop_oneof![Just(Element::Linear), Just(Element::Quadratic)]
}

proptest! {
    #[test]
    fn gradients_are_slopes_of_the_shape_functions(element in element(), xi in -1.0..1.0) {
        let step = 1e-3; // a central difference is exact for these polynomials
        let (right, left) = (element.shape(xi + step), element.shape(xi - step));
        for (node, gradient) in element.gradient(xi).into_iter().enumerate() {
            let slope = (right[node] - left[node]) / (2.0 * step);
            prop_assert!((gradient - slope).abs() < 1e-12);
        }
    }

    /// Only one set of shape functions reproduces all polynomials of the element degree.
    #[test]
    fn interpolation_reproduces_polynomials(element in element(), x in -0.5..2.0, cells in 1..9) {
        let mesh = Mesh::new(-0.5, 2.0, cells as usize, element);
        let (cell, place) = mesh.locate(x);
        prop_assert!((mesh.position(cell, place) - x).abs() < 1e-14);
        for power in 0..=element.degree() as i32 {
            let nodes = 0..mesh.node_count();
            let nodal: Vec<f64> = nodes.map(|i| mesh.node(i).powi(power)).collect();
            prop_assert!((mesh.interpolate(cell, place, &nodal) - x.powi(power)).abs() < 1e-14);
        }
    }
}

#[rstest]
#[case(Element::Linear, 3)]
#[case(Element::Quadratic, 5)]
fn gauss_points_are_exact_to_their_degree(#[case] element: Element, #[case] degree: i32) {
    for power in 0..=degree {
        let points = element.quadrature().iter();
        let sum: f64 = points.map(|point| point.weight * point.xi.powi(power)).sum();
        let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
        assert_relative_eq!(sum, exact, epsilon = 1e-15);
    }
}

/// Matrices from Hughes 2000, section 7.3.2; the factors apply to an element of unit length and
/// density.
#[rstest]
#[case(Element::Linear, 6.0, &[2.0, 1.0, 1.0, 2.0])]
#[case(Element::Quadratic, 30.0, &[4.0, 2.0, -1.0, 2.0, 16.0, 2.0, -1.0, 2.0, 4.0])]
fn mass_matrix_of_an_element_matches_the_textbook(
    #[case] element: Element,
    #[case] divisor: f64,
    #[case] expected: &[f64],
) {
    let mesh = Mesh::new(0.0, 1.0, 1, element);
    for (&value, expected) in consistent(&mesh, 1.0).values().iter().zip(expected) {
        assert_relative_eq!(value, expected / divisor, epsilon = 1e-15);
    }
}

#[rstest]
fn lumping_sums_rows_and_preserves_the_mass(
    #[values(Element::Linear, Element::Quadratic)] element: Element,
) {
    let mesh = Mesh::new(1.0, 4.0, 7, element);
    let diagonal = lumped(&mesh, 2.5);
    let mut rows = vec![0.0; diagonal.len()];
    for (i, _, value) in consistent(&mesh, 2.5).triplet_iter() {
        rows[i] += value;
    }
    for (row, mass) in rows.iter().zip(&diagonal) {
        assert_relative_eq!(row, mass, max_relative = 1e-14);
    }
    assert_relative_eq!(diagonal.iter().sum::<f64>(), 2.5 * 3.0, max_relative = 1e-14);
}
