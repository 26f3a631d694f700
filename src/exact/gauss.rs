//! Composite Gauss-Legendre quadrature on boxes.

/// Number of points per panel and axis; exact for polynomials of degree 15.
const POINTS: usize = 8;

/// Returns points in `-1 <= xi <= 1` and weights, whose sum is 2. The points are roots of the
/// Legendre polynomial, computed by Newton's method (sufficient for eight roots; an alternative is
/// Golub & Welsch 1969).
fn rule() -> [(f64, f64); POINTS] {
    let n = POINTS as f64;
    std::array::from_fn(|k| {
        let mut x = libm::cos(std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5));
        let mut slope = 0.0;
        for _ in 0..20 {
            let (mut before, mut now) = (1.0, x);
            for m in 2..=POINTS {
                let m = m as f64;
                (before, now) = (now, ((2.0 * m - 1.0) * x * now - (m - 1.0) * before) / m);
            }
            slope = n * (x * now - before) / (x * x - 1.0);
            x -= now / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// Returns points and weights on the box with the intervals `axes`, each divided into `panels`.
/// Without axes, returns a single point of weight 1.
pub(crate) fn points(axes: &[(f64, f64)], panels: usize) -> Vec<(Vec<f64>, f64)> {
    let rule = rule();
    let mut all = vec![(Vec::new(), 1.0)];
    for (low, high) in axes {
        let half = 0.5 * (high - low) / panels as f64;
        let middle = |panel: usize| low + half * (2 * panel + 1) as f64;
        let along = (0..panels)
            .flat_map(|panel| rule.map(|(xi, weight)| (middle(panel) + half * xi, half * weight)));
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

    #[test]
    fn a_box_has_the_product_of_its_axes() {
        let all = points(&[(0.0, 2.0), (1.0, 2.0)], 2);
        let moment: f64 = all.iter().map(|(x, weight)| weight * x[0] * x[0] * x[1]).sum();
        assert_eq!(all.len(), 256);
        assert_relative_eq!(moment, 8.0 / 3.0 * 1.5, max_relative = 1e-14);
    }
}
