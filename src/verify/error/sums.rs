//! Judged sums over the body and its walls: energies, momenta, reactions.
//!
//! They are relative to a size that is zero only of a body at rest: an energy to itself, a vector
//! to the sum of the lengths of its terms. An energy is the first of three components.

use super::declaration::{ComputedSum, Declaration, SolutionSize, SumDeclaration, SumNeed};
use super::tensor_shape::TensorShape;
use crate::exact::SumPoint;
use std::borrow::Cow;

/// A sum of nothing: it has no values at labels.
const SUM: Declaration = Declaration {
    unit: "J",
    shape: TensorShape::Scalar,
    computed: |_| Cow::from(&[]),
    exact: |_, _, _, _| false,
    exact_at_all: None,
    size: SolutionSize::Magnitude,
    rounding_size: |_| f64::NAN,
    is_primary: false,
    is_optional: true,
    is_of_motion: true,
    needs_deformation_gradient: false,
    sum: None,
};

pub(super) const KINETIC_ENERGY: Declaration = Declaration {
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfTotals(|totals| Some(scalar(totals.kinetic_energy).0)),
        density: |point| scalar(point.kinetic_energy()),
        needs: SumNeed::Nothing,
    }),
    ..SUM
};

pub(super) const STRAIN_ENERGY: Declaration = Declaration {
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfTotals(|totals| Some(scalar(totals.strain_energy?).0)),
        density: |point| scalar(point.stored_energy()),
        needs: SumNeed::StoredEnergy,
    }),
    ..SUM
};

pub(super) const ENERGY: Declaration = Declaration {
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfTotals(|totals| Some(scalar(totals.energy()?).0)),
        density: |point| scalar(point.kinetic_energy() + point.stored_energy()),
        needs: SumNeed::StoredEnergy,
    }),
    ..SUM
};

pub(super) const MOMENTUM: Declaration = Declaration {
    unit: "kg m/s",
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfTotals(|totals| Some(totals.momentum)),
        density: |point| vector(point.momentum()),
        needs: SumNeed::Nothing,
    }),
    ..SUM
};

pub(super) const ANGULAR_MOMENTUM: Declaration = Declaration {
    unit: "kg m2/s",
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfTotals(|totals| Some(totals.angular_momentum)),
        density: |point| vector(point.angular_momentum()),
        needs: SumNeed::Rotation,
    }),
    ..SUM
};

pub(super) const REACTION: Declaration = Declaration {
    unit: "N",
    sum: Some(SumDeclaration {
        computed: ComputedSum::Reaction,
        density: |point: &SumPoint<'_>| vector(point.traction()),
        needs: SumNeed::Wall,
    }),
    ..SUM
};

fn scalar(value: f64) -> ([f64; 3], f64) {
    ([value, 0.0, 0.0], value)
}

fn vector(value: [f64; 3]) -> ([f64; 3], f64) {
    (value, value.iter().fold(0.0, |length, component| libm::hypot(length, *component)))
}
