//! All that is known of a judged quantity besides its name.

use super::tensor_shape::TensorShape;
use crate::exact::{SumDensity, Truth};
use crate::subject::{Samples, Totals};
use std::borrow::Cow;

/// Exact values at all labels in so many dimensions, at a time.
pub(super) type ExactAtAll = fn(&dyn Truth, usize, &[f64], f64, &mut [f64]);

/// All that is known of a quantity besides its name.
#[expect(clippy::struct_excessive_bools, reason = "four independent questions, each asked by name")]
pub(super) struct Declaration {
    /// Its unit; empty for a number.
    pub(super) unit: &'static str,
    pub(super) shape: TensorShape,
    /// Values of a subject, label after label; empty from one that has none.
    pub(super) computed: fn(&Samples) -> Cow<'_, [f64]>,
    /// Exact value at the label X at time t; false from a truth that does not know it.
    pub(super) exact: fn(&dyn Truth, &[f64], f64, &mut [f64]) -> bool,
    /// Exact values at all labels in D dimensions at once, where a truth has a faster way.
    pub(super) exact_at_all: Option<ExactAtAll>,
    /// Natural size of exact values, which errors are compared with.
    pub(super) size: SolutionSize,
    /// Size of the numbers that its value is the difference of, on a body of length L (m); NaN
    /// where it is not known.
    pub(super) rounding_size: fn(f64) -> f64,
    /// Whether it is an unknown that a subject solves for: tables show its errors.
    pub(super) is_primary: bool,
    /// Whether only some subjects and some truths have it.
    pub(super) is_optional: bool,
    /// Whether only a body that moves has it.
    pub(super) is_of_motion: bool,
    /// Whether a subject must keep F for it.
    pub(super) needs_deformation_gradient: bool,
    /// Of a sum over the body, which has no values at labels.
    pub(super) sum: Option<SumDeclaration>,
}

/// A sum over the body or its walls.
#[derive(Clone, Copy)]
pub(super) struct SumDeclaration {
    /// Value of a subject; components beyond the dimension are zero.
    pub(super) computed: ComputedSum,
    /// Exact value per unit of volume or area.
    pub(super) density: SumDensity,
    pub(super) needs: SumNeed,
}

/// Value of a sum over a subject.
#[derive(Clone, Copy)]
pub(super) enum ComputedSum {
    /// From the totals over the body.
    OfTotals(fn(&Totals) -> Option<[f64; 3]>),
    /// The reaction of walls.
    Reaction,
}

/// Need of a sum, besides a body that moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SumNeed {
    /// Nothing.
    Nothing,
    /// A law that stores energy.
    StoredEnergy,
    /// A plane or space around an origin.
    Rotation,
    /// A face on which the body stands still.
    Wall,
}

/// Natural size of a field.
pub(super) enum SolutionSize {
    /// Largest magnitude.
    Magnitude,
    /// Largest magnitude of the difference from the identity.
    FromIdentity,
    /// Largest less smallest value.
    Range,
}
