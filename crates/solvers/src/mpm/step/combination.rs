//! Rules for valid combinations of the parts of a method.

use super::volume_average::VolumeName;
use crate::mpm::basis::{BasisName, Domain, with_basis};
use crate::mpm::foundation::particles::FrameName;
use crate::mpm::mass::MassName;
use crate::mpm::material::MaterialPlan;
use crate::mpm::transfer::{TransferChoice, TransferKind};
use mpm_subject::{PlaneState, Precision, Start};
use thiserror::Error;

/// Error for an invalid combination: one line with the parts and the reason.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct CombinationError(String);

macro_rules! refusal {
    ($($text:tt)+) => {
        CombinationError(format!($($text)+))
    };
}

/// Rejects an invalid combination of basis, transfer, mass matrix and frame.
///
/// # Errors
/// One line with the parts that do not fit and the reason.
pub fn combine(
    basis: BasisName,
    transfer: impl Into<TransferChoice>,
    mass: MassName,
    frame: FrameName,
) -> Result<(), CombinationError> {
    let transfer = transfer.into();
    let (b, t, m, f) = (basis.name(), transfer.name(), mass.name(), frame.name());
    match (transfer.kind(), domain(basis), mass, frame) {
        (TransferKind::Fit, ..) if basis == BasisName::Linear => Err(refusal!(
            "the transfer `{t}` needs the inertia tensor of the weights, which the basis `{b}` does \
             not have on its nodes"
        )),
        (TransferKind::Series, _, MassName::Consistent, _) => Err(refusal!(
            "the transfer `{t}` is not supported with the mass matrix `{m}`: it approximates the \
             consistent one by powers of the lumped one"
        )),
        // For a linear velocity field, APIC-like transfers give node i the momentum m_i v(x_i),
        // which is the product of the lumped matrix and the nodal velocities. The inverse of a
        // consistent matrix would therefore give wrong velocities.
        (TransferKind::Field | TransferKind::Fit, _, MassName::Consistent, _) => Err(refusal!(
            "the transfer `{t}` is not supported with the mass matrix `{m}`: it gives each node \
             the momentum of its row sum of mass"
        )),
        (TransferKind::Cells, Domain::Fixed | Domain::Follows, ..) => Err(refusal!(
            "the transfer `{t}` is not supported with the basis `{b}`: it integrates over cells, \
             not over the domains of particles"
        )),
        (TransferKind::Cells, _, _, FrameName::Total) => Err(refusal!(
            "the transfer `{t}` is not supported in the frame `{f}`: it fits Cauchy stresses"
        )),
        (TransferKind::Cells, _, MassName::Consistent, _) => Err(refusal!(
            "the transfer `{t}` is not supported with the mass matrix `{m}`: it integrates mass \
             over cells, not over particles"
        )),
        (_, Domain::Follows, _, FrameName::Total) => Err(refusal!(
            "the basis `{b}` is not supported in the frame `{f}`: its domains follow a deformation \
             that the reference configuration does not have"
        )),
        _ => Ok(()),
    }
}

/// Rejects an invalid combination for several bodies on one grid. The bodies have contact if
/// `contact` is true, and otherwise share one velocity field.
///
/// # Errors
/// One line with the part and the reason.
pub fn combine_bodies(
    transfer: TransferChoice,
    mass: MassName,
    frame: FrameName,
    start: Start,
    contact: bool,
) -> Result<(), CombinationError> {
    let (t, m, f, s) = (transfer.name(), mass.name(), frame.name(), start.name());
    match (transfer.kind(), mass, frame, start) {
        (TransferKind::Series, ..) => Err(refusal!(
            "the transfer `{t}` is not supported for several bodies: it improves the velocity \
             field of a single body"
        )),
        (TransferKind::Cells, ..) => Err(refusal!(
            "the transfer `{t}` is not supported for several bodies: it fits the velocity field of \
             a single body"
        )),
        (_, MassName::Consistent, ..) => Err(refusal!(
            "the mass matrix `{m}` is not supported for several bodies, which have mass at the \
             same nodes"
        )),
        (_, _, FrameName::Total, _) => Err(refusal!(
            "the frame `{f}` is not supported for several bodies: they stay at their reference \
             positions and cannot meet"
        )),
        (_, _, _, Start::HalfStepBack) if contact => Err(refusal!(
            "`start: {s}` is not supported with contact: a half step with contact has no inverse"
        )),
        _ => Ok(()),
    }
}

/// Rejects a precision that is not available for several bodies.
///
/// # Errors
/// One line with the precision and the reason.
pub fn combine_precision(precision: Precision, bodies: usize) -> Result<(), CombinationError> {
    if precision == Precision::Double || bodies < 2 {
        return Ok(());
    }
    Err(refusal!(
        "`precision: {}` is supported for a single body only, but the scene has {bodies} bodies",
        precision.name()
    ))
}

/// Rejects a basis that is invalid for this out-of-plane state.
///
/// # Errors
/// One line with the basis and the reason.
pub fn combine_basis(plane: PlaneState, basis: BasisName) -> Result<(), CombinationError> {
    if plane != PlaneState::Axisymmetric || domain(basis) == Domain::Point {
        return Ok(());
    }
    let (b, p) = (basis.name(), plane.name());
    Err(refusal!(
        "the basis `{b}` is not supported in `plane: {p}`: its functions are means over domains in \
         the plane, not around the axis (Nairn & Guilkey 2015)"
    ))
}

/// Rejects a basis or a transfer that is invalid for this out-of-plane state.
///
/// # Errors
/// One line with the part and the reason.
pub fn combine_across(
    plane: PlaneState,
    basis: BasisName,
    transfer: TransferChoice,
) -> Result<(), CombinationError> {
    combine_basis(plane, basis)?;
    let (t, p) = (transfer.name(), plane.name());
    if plane == PlaneState::Strain || transfer.kind() != TransferKind::Cells {
        return Ok(());
    }
    Err(refusal!(
        "the transfer `{t}` is not supported in `plane: {p}`: it integrates over cells in the plane"
    ))
}

/// Rejects a [`VolumeName`] that is invalid in this frame, or for a body with this material,
/// `dimension` and out-of-plane state.
///
/// # Errors
/// One line with the name and the reason.
pub fn combine_volume(
    volume: VolumeName,
    frame: FrameName,
    material: &MaterialPlan,
    dimension: usize,
    plane: PlaneState,
) -> Result<(), CombinationError> {
    if volume == VolumeName::Particle {
        return Ok(());
    }
    let (v, f, p, law) = (volume.name(), frame.name(), plane.name(), material.name());
    let reason = match (frame, dimension, plane) {
        (FrameName::Total, ..) => refusal!(
            "`volume: {v}` is not supported in the frame `{f}`: it averages with the weights of \
             current positions"
        ),
        (_, 1, _) => refusal!(
            "`volume: {v}` is not supported in 1-D: it would average the whole strain, and \
             volumetric locking does not occur"
        ),
        (_, _, PlaneState::Stress) => refusal!(
            "`volume: {v}` is not supported in `plane: {p}`: the stretch across the plane is free, \
             so volumetric locking does not occur"
        ),
        (_, _, PlaneState::Axisymmetric) => refusal!(
            "`volume: {v}` is not supported in `plane: {p}`: its average does not contain the hoop \
             stretch"
        ),
        (_, _, PlaneState::Strain) => {
            return material.properties().takes_averaged_volume().map_err(|reason| {
                refusal!("`volume: {v}` is not supported with the law `{law}`: {reason}")
            });
        }
    };
    Err(reason)
}

fn domain(basis: BasisName) -> Domain {
    with_basis!(basis, B => <B as crate::mpm::basis::Basis>::DOMAIN)
}
