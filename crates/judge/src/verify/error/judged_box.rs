//! A box of reference positions to which errors are restricted.
//!
//! Errors in a box that no wave from the faces has reached do not depend on the faces.

use crate::verify::tuple;
use mpm_subject::Samples;

/// A closed box of reference positions.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedBox {
    /// Lowest corner (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
}

impl JudgedBox {
    /// Whether the reference position `label` (m) lies in the box. False if a coordinate is NaN.
    pub fn holds(&self, label: &[f64]) -> bool {
        let ends = self.from.iter().zip(&self.to);
        label.len() == self.from.len()
            && ends.zip(label).all(|((from, to), x)| from <= x && x <= to)
    }

    /// Returns the samples whose labels lie in the box, in their order. Columns with a wrong number
    /// of entries are not restricted, so that the comparison reports them as not measured.
    pub fn restrict(&self, samples: &Samples) -> Samples {
        let d = samples.dimension;
        let labels = samples.label.chunks(d.max(1));
        let kept: Vec<usize> =
            labels.enumerate().filter(|(_, label)| self.holds(label)).map(|(p, _)| p).collect();
        let rows = |column: &Vec<f64>, width: usize| {
            if column.len() != width * samples.len() {
                return column.clone();
            }
            kept.iter().flat_map(|p| &column[width * p..width * (p + 1)]).copied().collect()
        };
        Samples {
            dimension: d,
            label: rows(&samples.label, d),
            displacement: rows(&samples.displacement, d),
            velocity: rows(&samples.velocity, d),
            weight: rows(&samples.weight, 1),
            mass: rows(&samples.mass, 1),
            stress: rows(&samples.stress, d * d),
            stress_across: rows(&samples.stress_across, 1),
            deformation_gradient: rows(&samples.deformation_gradient, d * d),
            temperature: rows(&samples.temperature, 1),
        }
    }

    /// Formats the corners for a sentence, in metres.
    pub fn words(&self) -> String {
        let corner =
            |corner: &[f64]| tuple(&corner.iter().map(ToString::to_string).collect::<Vec<_>>());
        format!("{} to {} m", corner(&self.from), corner(&self.to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> JudgedBox {
        JudgedBox { from: vec![1.0, 2.0], to: vec![3.0, 4.0] }
    }

    #[test]
    fn every_column_is_restricted_to_the_same_labels() {
        let mut samples = Samples::default();
        let labels = [[0.5, 3.0], [2.0, 3.0], [2.0, 4.5], [1.0, 4.0], [f64::NAN, 3.0]];
        for (p, label) in labels.iter().enumerate() {
            let p = p as f64;
            samples.push(label, &[p, p + 0.1], &[p + 0.2, p + 0.3], p + 0.4);
            samples.mass.push(p + 0.5);
            samples.stress.extend([p, p + 0.6, p + 0.7, p + 0.8]);
            samples.temperature.push(p + 0.9);
        }
        let judged = square().restrict(&samples);
        assert_eq!(judged.label, [2.0, 3.0, 1.0, 4.0]);
        assert_eq!(judged.displacement, [1.0, 1.1, 3.0, 3.1]);
        assert_eq!(judged.velocity, [1.2, 1.3, 3.2, 3.3]);
        assert_eq!((judged.weight, judged.mass), (vec![1.4, 3.4], vec![1.5, 3.5]));
        assert_eq!(judged.stress, [1.0, 1.6, 1.7, 1.8, 3.0, 3.6, 3.7, 3.8]);
        assert_eq!((judged.dimension, judged.temperature), (2, vec![1.9, 3.9]));
        assert!(judged.deformation_gradient.is_empty(), "an absent column remains absent");
    }

    #[test]
    fn corners_are_written_with_their_unit() {
        assert_eq!(square().words(), "(1, 2) to (3, 4) m");
    }
}
