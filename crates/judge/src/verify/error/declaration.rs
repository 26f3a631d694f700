//! Declarations of the judged quantities: values at labels, and sums over the body or its walls.
//!
//! Errors of sums are divided by a size that is zero only for a body at rest: the value of an
//! energy, or the sum of the lengths of the added vectors.

use crate::exact::{SumDensity, SumPoint, Truth};
use mpm_subject::{Samples, Totals};
use std::borrow::Cow;

/// Writes exact values; the arguments are solution, dimensions, labels (m), time (s) and output.
pub(super) type ExactAtAll = fn(&dyn Truth, usize, &[f64], f64, &mut [f64]);

/// Properties of a judged quantity, except its name.
#[expect(clippy::struct_excessive_bools, reason = "four independent questions, each asked by name")]
pub(super) struct Declaration {
    /// Unit; empty for a dimensionless quantity.
    pub(super) unit: &'static str,
    pub(super) shape: TensorShape,
    /// Returns the values that a solver reports, label by label; empty if it reports none.
    pub(super) computed: fn(&Samples) -> Cow<'_, [f64]>,
    /// Writes the exact value at X and t. Returns false if the exact solution does not define it.
    pub(super) exact: fn(&dyn Truth, &[f64], f64, &mut [f64]) -> bool,
    /// Writes exact values at all labels, if the exact solution has a faster method for many.
    pub(super) exact_at_all: Option<ExactAtAll>,
    /// Size of the exact values by which errors are divided.
    pub(super) size: SolutionSize,
    /// Returns the magnitude of the stored numbers whose rounding limits the accuracy of the
    /// quantity, for a body of the given length (m); NaN if unknown.
    pub(super) rounding_size: fn(f64) -> f64,
    pub(super) is_primary: bool,
    /// Whether the quantity is defined only by some solvers and exact solutions.
    pub(super) is_optional: bool,
    /// Whether the quantity is defined only for moving bodies, not for heat conduction.
    pub(super) is_of_motion: bool,
    pub(super) needs_deformation_gradient: bool,
    /// Declaration of a sum over the body; `None` for a field, which has values at labels.
    pub(super) sum: Option<SumDeclaration>,
}

#[derive(Clone, Copy)]
pub(super) struct SumDeclaration {
    /// How the value is computed for a solver; components beyond the dimension are zero.
    pub(super) computed: ComputedSum,
    /// Exact value per unit of volume or area.
    pub(super) density: SumDensity,
    pub(super) needs: SumNeed,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum ComputedSum {
    OfTotals(fn(&Totals) -> Option<[f64; 3]>),
    /// A function of the second moments (kg m2) per axis, in the current and in the reference body.
    OfMoments(fn([f64; 3], [f64; 3]) -> [f64; 3]),
    /// The reaction force of walls.
    Reaction,
}

/// Property of the problem that a sum requires, in addition to a moving body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SumNeed {
    /// No further property.
    Nothing,
    /// A law that stores energy.
    StoredEnergy,
    /// A plane or three-dimensional body, which can rotate about the origin.
    Rotation,
    /// A face with prescribed zero displacement.
    Wall,
}

pub(super) enum SolutionSize {
    /// Largest magnitude of the values.
    Magnitude,
    /// Largest magnitude of the difference from the identity tensor.
    FromIdentity,
    /// Difference between the largest and the smallest value.
    Range,
}

/// Tensor order of a field's value at a label, in D dimensions.
pub(super) enum TensorShape {
    Scalar,
    Vector,
    /// D * D components, row by row.
    Tensor,
}

impl TensorShape {
    pub(super) fn components(&self, d: usize) -> usize {
        match self {
            // In zero dimensions there is nothing to compare, not even a scalar.
            Self::Scalar => d.min(1),
            Self::Vector => d,
            Self::Tensor => d * d,
        }
    }
}

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
    // A displacement is the difference between two rounded positions.
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

/// Stress tensor (Pa) in space, NaN where a component is unknown.
type SpaceStress = [[f64; 3]; 3];

/// Completes the stress of a body in `d` dimensions (Pa), with `across` out of the plane.
fn in_space(d: usize, stress: &[f64], across: Option<f64>) -> SpaceStress {
    let of_plane = across.filter(|_| d == 2).unwrap_or(f64::NAN);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            if i.max(j) < d {
                return stress[i * d + j];
            }
            if i == j { of_plane } else { 0.0 }
        })
    })
}

/// Returns the mean stress `p = -tr(sigma)/3` (Pa), positive in compression (Muir Wood 1990).
fn mean_stress(s: &SpaceStress) -> f64 {
    -(s[0][0] + s[1][1] + s[2][2]) / 3.0
}

/// Returns the deviatoric stress `q = sqrt(3/2 s:s)` (Pa), `s = sigma + p I` (Muir Wood 1990).
fn deviatoric_stress(s: &SpaceStress) -> f64 {
    let p = mean_stress(s);
    let deviator = |k: usize| s[k / 3][k % 3] + if k.is_multiple_of(4) { p } else { 0.0 };
    libm::sqrt(1.5 * (0..9).map(|k| deviator(k) * deviator(k)).sum::<f64>())
}

/// Computes a function of the stress at each label; empty if the samples have no stress.
fn of_stresses(samples: &Samples, value: fn(&SpaceStress) -> f64) -> Vec<f64> {
    let d = samples.dimension;
    let stresses = samples.stress.chunks_exact((d * d).max(1)).enumerate();
    stresses
        .map(|(p, stress)| value(&in_space(d, stress, samples.stress_across.get(p).copied())))
        .collect()
}

macro_rules! of_stress {
    ($($name:ident = $value:expr;)+) => {$(
        pub(super) const $name: Declaration = Declaration {
            shape: TensorShape::Scalar,
            computed: |samples| Cow::from(of_stresses(samples, $value)),
            exact: |truth, label, t, into| {
                let mut stress = vec![0.0; label.len() * label.len()];
                let is_known = truth.stress(label, t, &mut stress);
                let across = truth.stress_across(label, t);
                into[0] = ($value as fn(&SpaceStress) -> f64)(&in_space(label.len(), &stress, across));
                is_known
            },
            ..STRESS
        };
    )+};
}

of_stress! {
    STRESS_XX = |s| s[0][0];
    STRESS_YY = |s| s[1][1];
    STRESS_ZZ = |s| s[2][2];
    STRESS_XY = |s| s[0][1];
    STRESS_XZ = |s| s[0][2];
    STRESS_YZ = |s| s[1][2];
    MEAN_STRESS = mean_stress;
    DEVIATORIC_STRESS = deviatoric_stress;
}

/// Default values for the declarations of sums. Sums have no values at labels.
const SUM: Declaration = Declaration {
    unit: "J",
    shape: TensorShape::Scalar,
    computed: |_| Cow::from(&[]),
    exact: |_, _, _, _| false,
    ..STRESS
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

pub(super) const RADIUS_OF_GYRATION: Declaration = Declaration {
    unit: "",
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfMoments(|now, reference| {
            let [now, reference] = [now, reference].map(|moments| moments.iter().sum::<f64>());
            [root_of_ratio(now, reference), 0.0, 0.0]
        }),
        density: |point| moments(point.second_moment()),
        needs: SumNeed::Nothing,
    }),
    ..SUM
};

pub(super) const SEMI_AXIS: Declaration = Declaration {
    unit: "",
    sum: Some(SumDeclaration {
        computed: ComputedSum::OfMoments(|now, reference| {
            std::array::from_fn(|axis| root_of_ratio(now[axis], reference[axis]))
        }),
        density: |point| moments(point.second_moment()),
        needs: SumNeed::Nothing,
    }),
    ..SUM
};

/// Returns `sqrt(now/reference)`; zero on axes that the body does not have.
fn root_of_ratio(now: f64, reference: f64) -> f64 {
    if reference == 0.0 { 0.0 } else { (now / reference).sqrt() }
}

/// Returns second moments, and their sum, by which errors are divided.
pub(super) fn moments(values: [f64; 3]) -> ([f64; 3], f64) {
    (values, values.iter().sum())
}

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
