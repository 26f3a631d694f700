//! Non-uniformity of the pressure: between neighbouring particles, and over all particles.

use crate::subject::Samples;

/// Maximum number of particles with a neighbour search, which computes the distances of all pairs.
const MOST: usize = 4096;

/// Labels no further apart than this, in shortest distances, are neighbours along an axis.
const NEAR: f64 = 1.2;

/// The mean normal stress of each particle (Pa); `None` without stresses.
fn pressures(samples: &Samples) -> Option<Vec<f64>> {
    let (n, d) = (samples.len(), samples.dimension.max(1));
    let mean =
        |p: usize| (0..d).map(|i| samples.stress[(p * d + i) * d + i]).sum::<f64>() / d as f64;
    (samples.stress.len() == n * d * d).then(|| (0..n).map(mean).collect())
}

/// The largest minus the smallest mean normal stress, over the largest in magnitude; NaN without
/// stresses.
pub(super) fn stress_spread(samples: &Samples) -> f64 {
    let pressures = pressures(samples).unwrap_or_default();
    let high = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = pressures.iter().copied().fold(f64::INFINITY, f64::min);
    (high - low) / high.abs().max(low.abs())
}

/// RMS difference between the mean normal stress of a particle and that of its neighbours, over the
/// RMS of the mean normal stress. NaN without stresses or neighbours, or for too many particles.
pub(super) fn checkerboard(samples: &Samples) -> f64 {
    let (n, d) = (samples.len(), samples.dimension.max(1));
    let Some(pressure) = pressures(samples).filter(|_| (2..=MOST).contains(&n)) else {
        return f64::NAN;
    };
    let label = |p: usize| &samples.label[p * d..(p + 1) * d];
    let square = |p: usize, q: usize| {
        label(p).iter().zip(label(q)).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    let others = |p: usize| (0..n).filter(move |q| *q != p);
    let shortest = (1..n).map(|q| square(0, q)).fold(f64::INFINITY, f64::min) * NEAR * NEAR;
    let (mut apart, mut size, mut count) = (0.0, 0.0, 0_u32);
    for p in 0..n {
        let near: Vec<usize> = others(p).filter(|q| square(p, *q) <= shortest).collect();
        if near.is_empty() {
            continue;
        }
        let around = near.iter().map(|q| pressure[*q]).sum::<f64>() / near.len() as f64;
        apart += (pressure[p] - around) * (pressure[p] - around);
        size += pressure[p] * pressure[p];
        count += 1;
    }
    if count == 0 { f64::NAN } else { (apart / size).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A row of particles with these stresses.
    fn row(stress: &[f64]) -> Samples {
        let n = stress.len();
        Samples {
            dimension: 1,
            label: (0..n).map(|p| p as f64).collect(),
            weight: vec![1.0; n],
            stress: stress.to_vec(),
            ..Samples::default()
        }
    }

    #[test]
    fn a_sign_that_changes_from_particle_to_particle_counts_twice() {
        assert_relative_eq!(checkerboard(&row(&[1.0, -1.0, 1.0, -1.0, 1.0])), 2.0);
    }

    #[test]
    fn a_uniform_stress_has_none_and_no_stress_has_no_figure() {
        assert_relative_eq!(checkerboard(&row(&[3.0; 4])), 0.0);
        assert!(checkerboard(&row(&[0.0; 4])).is_nan());
        assert!(checkerboard(&row(&[])).is_nan());
    }

    /// The third particle counts neither in the differences nor in the size.
    #[test]
    fn particles_without_neighbours_have_no_part_in_it() {
        let apart = Samples { label: vec![0.0, 1.0, 9.0], ..row(&[1.0, 3.0, 2.0]) };
        assert_relative_eq!(checkerboard(&apart), (8.0_f64 / 10.0).sqrt());
    }

    #[test]
    fn a_particle_is_held_against_the_mean_of_its_neighbours() {
        let found = checkerboard(&row(&[1.0, 4.0, 3.0]));
        assert_relative_eq!(found, ((9.0 + 4.0 + 1.0) / 26.0_f64).sqrt());
    }

    #[test]
    fn a_spread_is_a_share_of_the_largest_in_magnitude() {
        assert_relative_eq!(stress_spread(&row(&[1.0, -4.0, 2.0])), 1.5);
        assert_relative_eq!(stress_spread(&row(&[8.0, 2.0])), 0.75);
    }
}
