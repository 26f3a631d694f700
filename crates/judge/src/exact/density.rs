//! Reference density of a body: constant or a function of position.

use super::formula::{Formula, Number, Slope};
use super::gauss::{CellQuadrature, points};
use super::outline::Outline;

/// Reference density rho0 (kg/m3).
#[derive(Debug, Clone)]
pub struct Density {
    /// A formula of the coordinates; `None` if the density is `largest` everywhere.
    formula: Option<Formula>,
    smallest: f64,
    largest: f64,
}

/// Number of sampling points of a density along each axis, including ends and middle.
const NODES: usize = 33;

/// Number of quadrature panels along each axis. The density must be positive at their points.
const PANELS: usize = 4;

/// Densities below this fraction of the largest density count as zero: on the rim of a disk,
/// rounding makes a density such as 1 - X^2 - Y^2 slightly negative or positive.
const ROUNDING: f64 = 1e-12;

/// A position in the body where the density is not positive.
#[derive(Debug, Clone, PartialEq)]
pub struct NoDensity {
    /// The position (m).
    pub label: Vec<f64>,
    /// The value of the formula (kg/m3).
    pub value: f64,
}

impl From<f64> for Density {
    fn from(density: f64) -> Self {
        Self { formula: None, smallest: density, largest: density }
    }
}

impl Density {
    /// Creates a density from a `formula` of the coordinates. The body is the box from `from` to
    /// `to`, or its part inside `outline`.
    ///
    /// # Errors
    /// A position inside the body where the density is not positive. On the rim it may be zero.
    pub fn of_place(
        formula: Formula,
        from: &[f64],
        to: &[f64],
        outline: Option<&dyn Outline>,
    ) -> Result<Self, NoDensity> {
        let holds = |label: &[f64]| outline.is_none_or(|outline| outline.holds(label));
        let axes: Vec<(f64, f64)> = from.iter().copied().zip(to.iter().copied()).collect();
        let inside = points(&axes, PANELS).into_iter().map(|(label, _)| label);
        for label in inside.filter(|label| holds(label)) {
            let value = formula.eval(&label);
            if !(value > 0.0 && value.is_finite()) {
                return Err(NoDensity { label, value });
            }
        }
        let node = |node: usize| -> Vec<f64> {
            let along = |(axis, (low, high)): (usize, &(f64, f64))| {
                let number = node / NODES.pow(axis as u32) % NODES;
                low + (high - low) * number as f64 / (NODES - 1) as f64
            };
            axes.iter().enumerate().map(along).collect()
        };
        let nodes = (0..NODES.pow(axes.len() as u32)).map(node).filter(|label| holds(label));
        let raster: Vec<NoDensity> =
            nodes.map(|label| NoDensity { value: formula.eval(&label), label }).collect();
        let largest = raster.iter().map(|at| at.value).fold(0.0, f64::max);
        let is_sound = |at: &NoDensity| at.value >= -ROUNDING * largest && at.value.is_finite();
        if let Some(at) = raster.iter().find(|at| !is_sound(at)) {
            return Err(at.clone());
        }
        let mut smallest = raster.iter().map(|at| at.value).fold(f64::INFINITY, f64::min);
        if !(smallest > ROUNDING * largest) {
            smallest = 0.0;
        }
        Ok(Self { formula: Some(formula), smallest, largest })
    }

    /// Returns the density (kg/m3) if it is uniform.
    pub fn uniform(&self) -> Option<f64> {
        self.formula.is_none().then_some(self.largest)
    }

    /// Returns the formula of a varying density.
    pub fn formula(&self) -> Option<&Formula> {
        self.formula.as_ref()
    }

    /// Returns the smallest density in the body or on its rim (kg/m3); it may be zero on the rim.
    pub fn smallest(&self) -> f64 {
        self.smallest
    }

    /// Returns the largest density in the body (kg/m3).
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Returns the density (kg/m3) at `label`; negative rounding errors on the rim become zero.
    pub fn at(&self, label: &[f64]) -> f64 {
        self.over(label)
    }

    fn over<T: Number>(&self, label: &[T]) -> T {
        let Some(formula) = &self.formula else { return T::from(self.largest) };
        Number::max(formula.eval(label), T::from(0.0))
    }

    pub(super) fn with_slopes(&self, label: &[f64]) -> Slope<3> {
        self.over(&Slope::place(label)[..label.len()])
    }

    /// Computes the mass (kg) of the part of a body inside a box with the given centre and
    /// half-lengths (m), by quadrature over the points of the box for which `holds` returns true.
    pub fn mass(
        &self,
        cells: &CellQuadrature,
        centre: &[f64],
        half: &[f64],
        holds: &dyn Fn(&[f64]) -> bool,
    ) -> f64 {
        cells.integral(centre, half, holds, |label| self.at(label))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::PolytropicLaw;
    use crate::exact::tests::{bind, held};
    use crate::exact::{BodySum, Forcing, Motion, Problem, Round, SumPoint, SumRegion};
    use approx::assert_relative_eq;
    use std::sync::Arc;

    fn formula(text: &str, d: usize) -> Formula {
        bind(text, &["X", "Y", "Z"][..d])
    }

    /// Creates a density in the box from -1 to 1 along each of `d` axes.
    fn in_box(text: &str, d: usize) -> Result<Density, NoDensity> {
        Density::of_place(formula(text, d), &vec![-1.0; d], &vec![1.0; d], None)
    }

    #[test]
    fn range_includes_the_centre_and_the_rim() {
        let cloud = in_box("1 - X^2", 1).unwrap();
        assert_eq!((cloud.smallest().to_bits(), cloud.largest(), cloud.uniform()), (0, 1.0, None));
        let bar = in_box("2 + X", 1).unwrap();
        assert_eq!((bar.smallest(), bar.largest(), bar.at(&[0.5])), (1.0, 3.0, 2.5));
        assert_eq!(Density::from(3.0).uniform(), Some(3.0));
    }

    #[test]
    fn non_positive_density_is_refused_with_its_position() {
        let refused = in_box("X + 0.5", 1).unwrap_err();
        assert!(refused.label[0] < -0.5 && refused.value < 0.0, "{refused:?}");
        assert!(in_box("1 - X^2 - Y^2", 2).is_err(), "negative in the corners of the square");
        assert!(in_box("0*X", 1).is_err() && in_box("1/X^2 - 1/X^2", 1).is_err());
        assert!(in_box("1/(1 - X)", 1).is_err(), "infinite at the end");
        let disk = Round { centre: vec![0.0; 2], inner: 0.0, outer: 1.0 };
        let [from, to] = [[-1.0; 2], [1.0; 2]];
        let cloud = formula("1 - X^2 - Y^2", 2);
        assert!(Density::of_place(cloud, &from, &to, Some(&disk)).is_ok());
    }

    #[test]
    fn mass_is_the_integral_over_the_part_inside() {
        let density = Density { formula: Some(formula("1 + 2*X*Y^2", 2)), ..Density::from(1.0) };
        let cells = CellQuadrature::new(2);
        let mass = density.mass(&cells, &[0.5, 2.0], &[0.5, 1.0], &|_| true);
        assert_relative_eq!(mass, 2.0 + 26.0 / 3.0, max_relative = 1e-14);
        let half = density.mass(&cells, &[0.5, 2.0], &[0.5, 1.0], &|label| label[0] < 0.5);
        assert!(half > 1.0 && half < 0.5 * mass);
    }

    /// In a solid, the density enters only the inertia, `b = u_tt - Div P/rho0`.
    #[test]
    fn manufactured_force_uses_the_local_density() {
        let density = Density::of_place(formula("2 + X*Y", 2), &[0.0; 2], &[1.0; 2], None).unwrap();
        let problem = Problem { density, ..held(2) };
        assert_eq!(problem.check(), Ok(()));
        let (label, t) = ([0.3, 0.6], 0.2);
        let force = problem.manufactured_force(&label, t);
        let mut at_places = [[0.0; 3]];
        Forcing::new(&problem, [label.as_slice()].into_iter()).at(t, &mut at_places);
        assert_eq!(at_places[0], force);
        let now = problem.derivatives(&label, t);
        let stress = problem.divergence(&label, t, &now)[0];
        let uniform = Problem { density: 2.0.into(), ..held(2) }.manufactured_force(&label, t);
        let change = stress / 2.0 - stress / 2.18;
        assert_relative_eq!(force[0] - uniform[0], change, max_relative = 1e-10);
    }

    /// A plane cloud with K = 1/4, rho0 = 1 - R^2 and the motion x = a X.
    #[test]
    fn energies_of_a_round_cloud_match_closed_forms() {
        let disk: Arc<dyn Outline> =
            Arc::new(Round { centre: vec![0.0; 2], inner: 0.0, outer: 1.0 });
        let [from, to] = [vec![-1.0; 2], vec![1.0; 2]];
        let density =
            Density::of_place(formula("1 - X^2 - Y^2", 2), &from, &to, Some(disk.as_ref()));
        let motion =
            ["X", "Y"].map(|x| bind(&format!("(sqrt(1 + t^2) - 1)*{x}"), &["X", "Y", "t"]));
        let problem = Problem {
            equation: PolytropicLaw::new(0.25, 2.0).into(),
            density: density.unwrap(),
            outline: Some(disk),
            motion: Motion::new(motion.into()),
            terms: Vec::new(),
            faces: Vec::new(),
            manufactured: false,
            until: 1.0,
            from,
            to,
            ..held(2)
        };
        assert_eq!(problem.check(), Ok(()));
        let sum = |density: fn(&SumPoint<'_>) -> ([f64; 3], f64)| {
            BodySum::new(&problem, &SumRegion::Body, density).unwrap().at(1.0)[0]
        };
        let kinetic = sum(|point| ([point.kinetic_energy(), 0.0, 0.0], 1.0));
        assert_relative_eq!(kinetic, 0.130_899_694, max_relative = 1e-8);
        let stored = sum(|point| ([point.stored_energy(), 0.0, 0.0], 1.0));
        assert_relative_eq!(kinetic + stored, 0.261_799_388, max_relative = 1e-8);
    }

    /// The slopes of X^2 Y. A density that is negative by rounding has zero value and slope.
    #[test]
    fn slopes_are_derivatives_of_the_formula() {
        let density = Density { formula: Some(formula("X^2*Y", 2)), ..Density::from(1.0) };
        let slope = density.with_slopes(&[3.0, 2.0]);
        assert_eq!([slope.value(), slope.d(0), slope.d(1), slope.d(2)], [18.0, 12.0, 9.0, 0.0]);
        let beyond = density.with_slopes(&[3.0, -1e-17]);
        assert_eq!([beyond.value(), beyond.d(1)], [0.0; 2]);
    }
}
