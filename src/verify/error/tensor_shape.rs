//! Shapes of fields.

/// Components of a field at a label in D dimensions.
pub(super) enum TensorShape {
    /// 1.
    Scalar,
    /// D.
    Vector,
    /// D * D, row after row.
    Tensor,
}

impl TensorShape {
    /// Numbers at each label in `d` dimensions.
    pub(super) fn components(&self, d: usize) -> usize {
        match self {
            // Without a dimension there is nothing to compare, be it a number.
            Self::Scalar => d.min(1),
            Self::Vector => d,
            Self::Tensor => d * d,
        }
    }
}
