//! Declarations of the quantities that have values at labels.

use super::declaration::{Declaration, SolutionSize};
use super::tensor_shape::TensorShape;
use std::borrow::Cow;

pub(super) const DISPLACEMENT: Declaration = Declaration {
    unit: "m",
    shape: TensorShape::Vector,
    computed: |samples| Cow::from(&samples.displacement),
    exact: |truth, label, t, into| {
        truth.displacement(label, t, into);
        true
    },
    exact_at_all: Some(|truth, d, labels, t, into| truth.displacements(d, labels, t, into)),
    size: SolutionSize::Magnitude,
    // The difference of two positions, each rounded.
    rounding_size: |length| length,
    is_primary: true,
    is_optional: false,
    is_of_motion: true,
    needs_deformation_gradient: false,
    sum: None,
};

pub(super) const VELOCITY: Declaration = Declaration {
    unit: "m/s",
    computed: |samples| Cow::from(&samples.velocity),
    exact: |truth, label, t, into| {
        truth.velocity(label, t, into);
        true
    },
    exact_at_all: None,
    rounding_size: |_| f64::NAN,
    is_primary: false,
    ..DISPLACEMENT
};

pub(super) const STRESS: Declaration = Declaration {
    unit: "Pa",
    shape: TensorShape::Tensor,
    computed: |samples| Cow::from(&samples.stress),
    exact: |truth, label, t, into| truth.stress(label, t, into),
    is_optional: true,
    ..VELOCITY
};

pub(super) const DEFORMATION_GRADIENT: Declaration = Declaration {
    unit: "",
    computed: |samples| Cow::from(&samples.deformation_gradient),
    exact: |truth, label, t, into| truth.deformation_gradient(label, t, into),
    size: SolutionSize::FromIdentity,
    rounding_size: |_| 1.0,
    needs_deformation_gradient: true,
    ..STRESS
};

pub(super) const TEMPERATURE: Declaration = Declaration {
    unit: "K",
    shape: TensorShape::Scalar,
    computed: |samples| Cow::from(&samples.temperature),
    exact: |truth, label, t, into| {
        truth.temperature(label, t).map(|value| into[0] = value).is_some()
    },
    size: SolutionSize::Range,
    is_primary: true,
    is_of_motion: false,
    ..STRESS
};
