//! Composite Gauss-Legendre quadrature on boxes.

/// Number of points per panel and axis; exact for polynomials of degree 15.
const POINTS: usize = 8;

/// Returns the `N` Gauss points in `-1 <= xi <= 1` and their weights, by Newton's method.
fn rule<const N: usize>() -> [(f64, f64); N] {
    let n = N as f64;
    std::array::from_fn(|k| {
        let mut x = libm::cos(std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5));
        let mut slope = 0.0;
        for _ in 0..20 {
            let (mut before, mut now) = (1.0, x);
            for m in 2..=N {
                let m = m as f64;
                (before, now) = (now, ((2.0 * m - 1.0) * x * now - (m - 1.0) * before) / m);
            }
            slope = n * (x * now - before) / (x * x - 1.0);
            x -= now / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// Returns points and weights on the box `axes`, each axis divided into `panels`.
pub(crate) fn points(axes: &[(f64, f64)], panels: usize) -> Vec<(Vec<f64>, f64)> {
    points_by(&rule::<POINTS>(), axes, panels)
}

fn points_by(rule: &[(f64, f64)], axes: &[(f64, f64)], panels: usize) -> Vec<(Vec<f64>, f64)> {
    let mut all = vec![(Vec::new(), 1.0)];
    for (low, high) in axes {
        let half = 0.5 * (high - low) / panels as f64;
        let middle = |panel: usize| low + half * (2 * panel + 1) as f64;
        let along = (0..panels).flat_map(|panel| {
            rule.iter().map(move |(xi, weight)| (middle(panel) + half * xi, half * weight))
        });
        let along: Vec<(f64, f64)> = along.collect();
        let extended = |(place, weight): (Vec<f64>, f64)| {
            let longer =
                move |(x, w): &(f64, f64)| ([place.as_slice(), &[*x]].concat(), weight * w);
            along.iter().map(longer).collect::<Vec<_>>()
        };
        all = all.into_iter().flat_map(extended).collect();
    }
    all
}

/// Points and weights for integrals over lattice cells, the boxes of single particles of a regular
/// lattice: 8 points per axis in one and two dimensions, and 4 in three, to limit the cost.
#[derive(Debug, Clone)]
pub struct CellQuadrature {
    /// Points of the cube from -1 to 1, with weights.
    points: Vec<(Vec<f64>, f64)>,
}

impl CellQuadrature {
    /// Creates the quadrature for cells in `dimension` dimensions.
    pub fn new(dimension: usize) -> Self {
        let cube = vec![(-1.0, 1.0); dimension];
        let few = || points_by(&rule::<4>(), &cube, 1);
        Self { points: if dimension < 3 { points(&cube, 1) } else { few() } }
    }

    /// Returns the integral of `value` over the part of a cell where `holds` is true. The cell has
    /// the half-lengths `half` (m) around `centre`.
    pub(super) fn integral(
        &self,
        centre: &[f64],
        half: &[f64],
        holds: impl Fn(&[f64]) -> bool,
        value: impl Fn(&[f64]) -> f64,
    ) -> f64 {
        let mut sum = 0.0;
        for (xi, weight) in &self.points {
            let mut place = [0.0; 3];
            for (axis, xi) in xi.iter().enumerate() {
                place[axis] = centre[axis] + half[axis] * xi;
            }
            let place = &place[..xi.len()];
            if holds(place) {
                sum += weight * value(place);
            }
        }
        half.iter().product::<f64>() * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn polynomials_of_degree_15_are_exact() {
        for (axes, panels) in [(&[(-1.0, 3.0)][..], 1), (&[(-1.0, 3.0)], 3), (&[], 2)] {
            let integral = |power: i32| -> f64 {
                let value = |place: &Vec<f64>| place.first().map_or(1.0, |x| x.powi(power));
                points(axes, panels).iter().map(|(place, weight)| weight * value(place)).sum()
            };
            for power in 0..16 {
                let power_of = |x: f64| x.powi(power + 1) / f64::from(power + 1);
                let exact = if axes.is_empty() { 1.0 } else { power_of(3.0) - power_of(-1.0) };
                assert_relative_eq!(integral(power), exact, max_relative = 1e-13);
            }
        }
    }

    /// The integral of X^6 Y^2 Z over the box from (0, 0, 0) to (1, 2, 4), and volumes of halves.
    #[test]
    fn cells_have_the_integrals_of_polynomials() {
        let value = |x: &[f64]| x.iter().zip([6, 2, 1]).map(|(x, n)| x.powi(n)).product::<f64>();
        for (d, exact) in [(1, 1.0 / 7.0), (2, 8.0 / 21.0), (3, 64.0 / 21.0)] {
            let (cells, half) = (CellQuadrature::new(d), &[0.5, 1.0, 2.0][..d]);
            let whole = cells.integral(half, half, |_| true, value);
            assert_relative_eq!(whole, exact, max_relative = 1e-14);
            let lower = cells.integral(half, half, |x| x[0] < 0.5, |_| 1.0);
            let upper = cells.integral(half, half, |x| x[0] > 0.5, |_| 1.0);
            let volume: f64 = half.iter().map(|h| 2.0 * h).product();
            assert_relative_eq!(lower, 0.5 * volume, max_relative = 1e-14);
            assert_relative_eq!(lower, upper, max_relative = 1e-14);
        }
    }
}
