//! Vectors of up to three components, and fields of them.

pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(super) fn times(factor: f64, a: [f64; 3]) -> [f64; 3] {
    a.map(|x| factor * x)
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn size(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// A vector field `value + gradient (X - centre)` of the reference position.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct AffineField {
    pub(super) value: [f64; 3],
    /// Row i has the derivatives of component i.
    pub(super) gradient: [[f64; 3]; 3],
    /// Place (m) where the field has `value`.
    pub(super) centre: [f64; 3],
}

impl AffineField {
    /// The same vector everywhere.
    pub(super) fn uniform(value: [f64; 3]) -> Self {
        Self { value, ..Self::default() }
    }

    /// The field at a place (m).
    pub(super) fn at(&self, place: [f64; 3]) -> [f64; 3] {
        let from = minus(place, self.centre);
        std::array::from_fn(|i| {
            (0..3).fold(self.value[i], |sum, j| sum + self.gradient[i][j] * from[j])
        })
    }

    pub(super) fn is_zero(&self) -> bool {
        *self == Self { centre: self.centre, ..Self::default() }
    }

    /// One formula of X, Y, Z for each component.
    pub(super) fn formulas(&self, dimension: usize) -> Vec<String> {
        let term = |i: usize, j: usize| {
            let (slope, axis, centre) = (self.gradient[i][j], ["X", "Y", "Z"][j], self.centre[j]);
            (slope != 0.0).then(|| format!(" + ({slope:e})*({axis} - ({centre:e}))"))
        };
        let formula = |i: usize| {
            let terms: String = (0..dimension).filter_map(|j| term(i, j)).collect();
            format!("{:e}{terms}", self.value[i])
        };
        (0..dimension).map(formula).collect()
    }

    /// The field in units of length and value that are smaller by these factors.
    pub(super) fn scaled(&self, value: f64, length: f64) -> Self {
        Self {
            value: self.value.map(|x| x * value),
            gradient: self.gradient.map(|row| row.map(|x| x * value / length)),
            centre: self.centre.map(|x| x * length),
        }
    }
}
