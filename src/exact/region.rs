//! Part of the body: a box of material points.

/// The material points in a box.
#[derive(Debug, Clone)]
pub struct Region {
    /// Name that a suite gives it.
    pub name: String,
    /// Lowest corner (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
}

impl Region {
    /// Whether a reference position is inside; the faces belong to it.
    pub fn holds(&self, label: &[f64]) -> bool {
        label.iter().zip(&self.from).zip(&self.to).all(|((x, from), to)| (from..=to).contains(&x))
    }

    /// The corners of the part that lies in a body from `from` to `to`.
    pub fn within(&self, (from, to): (&[f64], &[f64])) -> (Vec<f64>, Vec<f64>) {
        let low = self.from.iter().zip(from).map(|(a, b)| a.max(*b));
        let high = self.to.iter().zip(to).map(|(a, b)| a.min(*b));
        (low.collect(), high.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::low_corner([1.0, 2.0], true)]
    #[case::high_corner([3.0, 4.0], true)]
    #[case::high_face([2.0, 4.0], true)]
    #[case::outside([2.0, 4.1], false)]
    #[case::nan([f64::NAN, 3.0], false)]
    fn faces_belong_to_it(#[case] label: [f64; 2], #[case] holds: bool) {
        let region = Region { name: String::new(), from: vec![1.0, 2.0], to: vec![3.0, 4.0] };
        assert_eq!(region.holds(&label), holds);
    }
}
