//! Tests of quasi-static load steps: columns with closed forms, Newton's convergence, the tangent,
//! and the report of failures.

use super::balance::Balance;
use super::*;
use crate::mpm::basis::BasisName;
use crate::mpm::boundary::{Fixed, Roller};
use crate::mpm::effect::{Effect, Gravity};
use crate::mpm::foundation::particles::Block;
use crate::mpm::kernel::kernel;
use crate::mpm::material::MaterialPlan;
use approx::assert_relative_eq;
use rstest::rstest;

/// A column along the first axis under its own weight, on a fixed bottom and between rollers.
#[derive(Debug, Clone, Copy)]
struct ColumnCase {
    material: MaterialPlan,
    height: f64,
    density: f64,
    gravity: f64,
    cells: usize,
    load_steps: u64,
}

impl ColumnCase {
    fn hencky(cells: usize, load_steps: u64) -> Self {
        let material = MaterialPlan::Hencky { young: 1e6, poisson: 0.0 };
        Self { material, height: 50.0, density: 80.0, gravity: 10.0, cells, load_steps }
    }

    fn drucker_prager(cells: usize, load_steps: u64) -> Self {
        let (young, poisson) = (15e3, 0.25);
        let (friction, dilation, strength) = (0.3, 0.1, 10.0);
        let material = MaterialPlan::DruckerPrager { young, poisson, friction, dilation, strength };
        Self { material, height: 10.0, density: 1.0, gravity: 15.0, cells, load_steps }
    }

    fn build<const D: usize>(self, basis: BasisName) -> QuasiStatic<D> {
        let h = self.height / self.cells as f64;
        let kernel = kernel::<D>(basis);
        let mut extent = [2; D];
        extent[0] = self.cells + 1;
        let grid = kernel.grid(Vector::zeros(), h, extent, [false; D]);
        let to = Vector::from_fn(|axis, _| if axis == 0 { self.height } else { 2.0 * h });
        let block = Block { from: Vector::zeros(), to, density: self.density };
        let particles = Particles::fill(&block, h, 2);
        let mut boundary: Vec<Box<dyn Boundary<D>>> = Vec::new();
        for axis in 1..D {
            for side in [Side::Low, Side::High] {
                boundary.push(Box::new(Roller::face(&grid, axis, side)));
            }
        }
        boundary.push(Box::new(Fixed::face(&grid, 0, Side::Low)));
        let weight =
            move |_: f64| Vector::from_fn(|axis, _| if axis == 0 { -self.gravity } else { 0.0 });
        let effects: Vec<Box<dyn Effect<D>>> = vec![Box::new(Gravity(Box::new(weight)))];
        let (material, load_steps) = (self.material.build(), self.load_steps);
        QuasiStatic::new(QuasiStaticSetup {
            grid,
            particles,
            kernel,
            material,
            effects,
            boundary,
            load_steps,
        })
        .unwrap()
    }

    /// Runs all load steps; returns the residuals of each.
    fn run<const D: usize>(self, solver: &mut QuasiStatic<D>) -> Vec<Vec<f64>> {
        let step = |_| {
            solver.step(1.0).unwrap();
            solver.residuals().to_vec()
        };
        (0..self.load_steps).map(step).collect()
    }

    /// Height (m) of a material point in equilibrium, for Hencky's law without Poisson effect:
    /// `x = (E/G) (f(G l/E) - f(G (l - Y)/E))` with Lambert's function W and `f = W + W^2/2`.
    fn hencky_height(self, y: f64) -> f64 {
        let weight = self.density * self.gravity / 1e6;
        let f = |x: f64| {
            let w = lambert(x);
            w + 0.5 * w * w
        };
        (f(weight * self.height) - f(weight * (self.height - y))) / weight
    }

    /// RMS of the displacement error (m) after the last load step.
    fn hencky_error(self, basis: BasisName) -> f64 {
        let mut solver = self.build::<1>(basis);
        self.run(&mut solver);
        let Particles { x, x0, .. } = solver.particles();
        let square = |(x, x0): (&Vector<1>, &Vector<1>)| {
            let error = x[0] - self.hencky_height(x0[0]);
            error * error
        };
        (x.iter().zip(x0).map(square).sum::<f64>() / x.len() as f64).sqrt()
    }
}

/// Lambert's function: `w exp(w) = x`.
fn lambert(x: f64) -> f64 {
    (0..50).fold(x, |w, _| w - (w - x * libm::exp(-w)) / (1.0 + w))
}

/// `ln(R_(j+1)/R_j) / ln(R_j/R_(j-1))` for the last three residuals above 1e-10; `None` if there
/// are fewer, or the residual rises on the way.
fn newton_exponent(residuals: &[f64]) -> Option<f64> {
    let above: Vec<f64> = residuals.iter().copied().filter(|residual| *residual > 1e-10).collect();
    let falls = above.windows(2).all(|pair| pair[1] < pair[0]);
    let [.., a, b, c] = above[..] else { return None };
    falls.then(|| libm::log(c / b) / libm::log(b / a))
}

#[rstest]
#[case::one_step(ColumnCase::hencky(10, 1), true)]
#[case::one_step_fine(ColumnCase::hencky(80, 1), true)]
#[case::twenty_steps(ColumnCase::hencky(80, 20), true)]
#[case::yielding(ColumnCase::drucker_prager(80, 20), false)]
#[case::yielding_in_one_step(ColumnCase::drucker_prager(80, 1), false)]
fn newton_converges_quadratically(#[case] case: ColumnCase, #[case] is_smooth: bool) {
    let mut solver = case.build::<1>(BasisName::ContiguousGimp);
    let all = case.run(&mut solver);
    for residuals in &all {
        assert!(residuals.len() <= 7, "at most six corrections: {residuals:?}");
        assert!(*residuals.last().unwrap() < 1e-10, "{residuals:?}");
        if let Some(exponent) = newton_exponent(residuals) {
            assert!(exponent >= 1.8, "{exponent}: {residuals:?}");
        } else {
            assert!(!is_smooth || residuals.len() < 4, "{residuals:?}");
        }
    }
    assert_relative_eq!(all[0][0], 1.0, max_relative = 1e-12);
    let last = all.len() as f64;
    assert_relative_eq!(all.last().unwrap()[0], 1.0 / last, max_relative = 0.05);
}

#[rstest]
fn error_does_not_grow_with_the_number_of_load_steps(#[values(20, 40)] cells: usize) {
    let error = |steps| ColumnCase::hencky(cells, steps).hencky_error(BasisName::ContiguousGimp);
    let errors = [20, 40, 80].map(error);
    assert!(errors[1] <= 1.05 * errors[0] && errors[2] <= 1.05 * errors[0], "{errors:?}");
}

#[test]
fn error_falls_with_second_order_in_one_load_step() {
    for basis in [BasisName::Linear, BasisName::ContiguousGimp] {
        let errors = [10, 20, 40].map(|cells| ColumnCase::hencky(cells, 1).hencky_error(basis));
        for pair in errors.windows(2) {
            let order = libm::log2(pair[0] / pair[1]);
            assert!((order - 2.0).abs() <= 0.15, "{errors:?}");
        }
    }
}

/// A column between rollers has one and the same equilibrium in one, two and three dimensions.
#[rstest]
fn column_is_the_same_in_any_dimension(#[values(1, 2)] load_steps: u64) {
    let case = ColumnCase::drucker_prager(4, load_steps);
    let height = |x: Vec<f64>| x.into_iter().fold(0.0, f64::max);
    fn heights<const D: usize>(case: ColumnCase, basis: BasisName) -> Vec<f64> {
        let mut solver = case.build::<D>(basis);
        case.run(&mut solver);
        solver.particles().x.iter().map(|x| x[0]).collect()
    }
    for basis in [BasisName::Linear, BasisName::ContiguousGimp, BasisName::Cpdi] {
        let expected = height(heights::<1>(case, basis));
        assert!((9.0..9.99).contains(&expected));
        assert_relative_eq!(height(heights::<2>(case, basis)), expected, max_relative = 1e-10);
        assert_relative_eq!(height(heights::<3>(case, basis)), expected, max_relative = 1e-10);
    }
}

/// The bottom carries the weight.
#[test]
fn reaction_is_the_weight() {
    let case = ColumnCase::drucker_prager(6, 2);
    let mut solver = case.build::<2>(BasisName::ContiguousGimp);
    assert!(Subject::reaction(&solver, None).is_none());
    case.run(&mut solver);
    let weight: f64 = solver.particles().mass.iter().map(|mass| mass * case.gravity).sum();
    let reaction = Subject::reaction(&solver, Some((0, false))).unwrap();
    assert_relative_eq!(reaction.force[0], weight, max_relative = 1e-9);
}

/// Residual differences of the whole body, at an iterate without symmetry, half of it plastic.
#[rstest]
fn tangent_of_a_body_agrees_with_central_differences(
    #[values(BasisName::Linear, BasisName::ContiguousGimp, BasisName::QuadraticBSpline)]
    basis: BasisName,
) {
    let case = ColumnCase::drucker_prager(3, 1);
    let solver = case.build::<2>(basis);
    let QuasiStaticSetup { grid, particles, kernel, material, boundary, .. } = &solver.setup;
    let balance = Balance::new(grid, particles, kernel.as_ref(), boundary).unwrap();
    let mut increment: Vec<Vector<2>> = (0..grid.nodes())
        .map(|i| {
            Vector::<2>::new(0.02, 0.03).map(|size| size * libm::sin(1.0 + size * i as f64 * 50.0))
        })
        .collect();
    for condition in boundary {
        condition.clear(&mut increment);
    }
    let load = vec![Vector::zeros(); grid.nodes()];
    let residual = |increment: Vec<Vector<2>>| {
        balance.iterate(particles, material.as_ref(), &load, increment).unwrap()
    };
    let at = residual(increment.clone());
    // K d = -r: the change of the residual along d is -r.
    let direction = balance.correction(particles, &at).unwrap();
    let size = direction.iter().map(|d| d.amax()).fold(0.0, f64::max);
    let step = 1e-4 * 0.02 / size;
    let moved = |share: f64| {
        let moved = increment.iter().zip(&direction).map(|(u, d)| u + d * share).collect();
        residual(moved).residual
    };
    let (low, high) = (moved(-step), moved(step));
    let (lowest, highest) = (moved(-2.0 * step), moved(2.0 * step));
    let free = |field: &[Vector<2>]| balance.norm(field);
    let difference: Vec<Vector<2>> = (0..low.len())
        .map(|i| {
            let narrow = (high[i] - low[i]) / (2.0 * step);
            let wide = (highest[i] - lowest[i]) / (4.0 * step);
            (narrow * 4.0 - wide) / 3.0 + at.residual[i]
        })
        .collect();
    let error = free(&difference) / at.norm;
    assert!(error <= 1e-7, "{error:.1e}");
}

/// Soil that hangs from its wall: the weight exceeds the tensile strength of the cone.
#[test]
fn load_without_equilibrium_is_reported_with_residual_and_node() {
    let case = ColumnCase { gravity: -15.0, ..ColumnCase::drucker_prager(10, 10) };
    let mut solver = case.build::<1>(BasisName::ContiguousGimp);
    let failure = (0..10).find_map(|_| solver.step(1.0).err()).expect("no equilibrium");
    assert!(solver.steps > 1, "the first load step is in balance");
    let Failure::NotConverged { residual, node } = failure else { panic!("{failure}") };
    assert!(residual > 1e-3 && (1..=11).contains(&node), "{residual}, {node}");
}

#[test]
fn body_without_load_or_tangent_is_refused() {
    let case = ColumnCase { gravity: 0.0, ..ColumnCase::hencky(3, 1) };
    let failure = case.build::<1>(BasisName::Linear).step(1.0).unwrap_err();
    assert_eq!(failure.to_string(), "no load acts on a node that is free to move");
    let mut setup = ColumnCase::hencky(3, 1).build::<1>(BasisName::Linear).setup;
    setup.material = MaterialPlan::LinearElastic { young: 1e6, poisson: 0.0 }.build();
    let failure = QuasiStatic::new(setup).err().expect("no tangent");
    assert_eq!(failure.to_string(), NO_TANGENT);
}

#[test]
fn resumed_run_has_equal_bits() {
    let case = ColumnCase::drucker_prager(8, 4);
    let mut whole = case.build::<1>(BasisName::ContiguousGimp);
    case.run(&mut whole);
    let mut first = case.build::<1>(BasisName::ContiguousGimp);
    (0..2).for_each(|_| first.step(1.0).unwrap());
    let mut checkpoint = Checkpoint::empty();
    assert!(first.checkpoint(&mut checkpoint));
    let bytes = checkpoint.into_bytes();
    let mut resumed = case.build::<1>(BasisName::ContiguousGimp);
    // The law creates its state in the first step.
    resumed.step(1.0).unwrap();
    let mut checkpoint = Checkpoint::from_bytes(&bytes);
    assert!(resumed.checkpoint(&mut checkpoint));
    assert!(checkpoint.is_used_up());
    (0..2).for_each(|_| resumed.step(1.0).unwrap());
    assert_eq!(resumed.particles().x, whole.particles().x);
    assert_eq!(resumed.particles().sigma, whole.particles().sigma);
    assert_eq!(resumed.counters(), whole.counters());
}
