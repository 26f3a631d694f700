//! Changes of one setting of a method of this crate. They mean nothing for an external solver.

use super::probes::{Crossings, ProbeKind};
use crate::mpm::{
    BasisName, FrameName, MassName, SchemeName, TransferChoice, TransferName, combine,
    combine_across,
};
use crate::subject::Start;
use crate::suite::model::ConvergencePlan;
use crate::suite::model::method::Method;

/// The first velocity at half a step before the start.
pub(super) const START: ProbeKind = ProbeKind {
    change: "`start: half_step_back`",
    cause: |_, _| "the start: v(0) is used for v(-dt/2), an error of first order in time",
    remedy: "`start: half_step_back`",
    apply: |plan| match plan.cases[0].method {
        Method::Mpm { start: Start::AtZero, .. } | Method::Fem { start: Start::AtZero, .. } => {
            with_method(plan, |method| match method {
                Method::Mpm { start, .. } | Method::Fem { start, .. } => {
                    *start = Start::HalfStepBack;
                }
                Method::Heat { .. } | Method::External { .. } => {}
            })
        }
        _ => None,
    },
};

/// MUSL in place of USF.
pub(super) const SCHEME: ProbeKind = ProbeKind {
    change: "`scheme: musl`",
    cause: |_, _| "the scheme: USF updates the stress half a step late, first order in time",
    remedy: "`scheme: musl` or `usl`, or shorter steps",
    apply: |plan| match plan.cases[0].method {
        Method::Mpm { scheme: SchemeName::Usf, .. } => with_method(plan, |method| {
            if let Method::Mpm { scheme, .. } = method {
                *scheme = SchemeName::Musl;
            }
        }),
        _ => None,
    },
};

/// Domains that follow the deformation.
pub(super) const DOMAINS: ProbeKind = ProbeKind {
    change: "`basis: cpgimp`",
    cause: |_, _| {
        "domains of fixed width: they separate and overlap where the body is stretched and \
         compressed, an error of the order of the strain"
    },
    remedy: "`basis: cpgimp`, whose domains follow the deformation",
    apply: |plan| match plan.cases[0].method {
        Method::Mpm { basis: BasisName::UniformGimp, .. } => with_method(plan, |method| {
            if let Method::Mpm { basis, .. } = method {
                *basis = BasisName::ContiguousGimp;
            }
        }),
        _ => None,
    },
};

/// Gradients of the basis in place of gradients from a fit.
pub(super) const GRADIENTS: ProbeKind = ProbeKind {
    change: "`transfer: apic`",
    cause: |_, _| {
        "the velocity gradients at walls: `mls` fits them to the nodes around a particle, and next to \
         a held face its error is of first order"
    },
    remedy: "`transfer: apic`, which takes its gradients from the basis",
    apply: |plan| {
        let is_fit = |choice: TransferChoice| choice == TransferName::Mls.into();
        let has_walls = plan.scene.faces.iter().any(|face| face.hold.is_held());
        match plan.cases[0].method {
            Method::Mpm { transfer, .. } if has_walls && is_fit(transfer) => {
                with_method(plan, |method| {
                    if let Method::Mpm { transfer, .. } = method {
                        *transfer = TransferName::Apic.into();
                    }
                })
            }
            _ => None,
        }
    },
};

/// The consistent mass matrix.
pub(super) const MASS: ProbeKind = ProbeKind {
    change: "the consistent mass matrix",
    cause: |_, _| "lumping: row sums are not the mass that a smooth acceleration acts on",
    remedy: "`mass: consistent`",
    apply: |plan| {
        let walls = plan.scene.faces.iter();
        let mut refuses = walls.filter_map(|face| face.hold.against_consistent_mass());
        (refuses.next().is_none()).then_some(())?;
        with_method(plan, |method| {
            if let Method::Mpm { mass, .. } = method {
                *mass = MassName::Consistent;
            }
        })
    },
};

/// A grid that moves with the body.
pub(super) const FRAME: ProbeKind = ProbeKind {
    change: "`frame: total_lagrangian`",
    cause: |case, crossings| match case.method {
        _ if crossings == Crossings::None => {
            "the motion itself, although no particle changes its cell: the grid does not follow the \
             motion, and an exact solution of small strain neglects it"
        }
        Method::Mpm { basis: BasisName::Linear, .. } => {
            "grid crossing: the nodal forces of linear functions jump whenever a particle changes \
             its cell"
        }
        _ => {
            "the motion carries particles out of their places: they change cells and are drawn \
             apart, and the quadrature is worse than at the start"
        }
    },
    remedy: "`frame: total_lagrangian`, a smoother basis, or a smaller motion",
    apply: |plan| {
        with_method(plan, |method| {
            if let Method::Mpm { frame, .. } = method {
                *frame = FrameName::Total;
            }
        })
    },
};

/// A basis with continuous gradients.
pub(super) const SMOOTH_BASIS: ProbeKind = ProbeKind {
    change: "`basis: quadratic_bspline`",
    cause: |_, crossings| match crossings {
        Crossings::None => "linear functions: their gradients jump from cell to cell",
        Crossings::Some => "grid crossing: the gradients of linear functions jump",
    },
    remedy: "a basis with continuous gradients",
    apply: |plan| match plan.cases[0].method {
        Method::Mpm { basis: BasisName::Linear, .. } => with_method(plan, |method| {
            if let Method::Mpm { basis, .. } = method {
                *basis = BasisName::QuadraticBSpline;
            }
        }),
        _ => None,
    },
};

/// The plan with the method of its case changed; `None` if that is no change, or a method that
/// means nothing.
fn with_method(plan: &ConvergencePlan, change: impl Fn(&mut Method)) -> Option<ConvergencePlan> {
    let mut changed = plan.clone();
    changed.cases.iter_mut().for_each(|case| change(&mut case.method));
    let (before, after) = (plan.cases[0].method, changed.cases[0].method);
    let combined = match after {
        Method::Mpm { basis, transfer, mass, frame, .. } => combine(basis, transfer, mass, frame)
            .and_then(|()| combine_across(plan.scene.plane, basis, transfer)),
        Method::Fem { .. } | Method::Heat { .. } | Method::External { .. } => Ok(()),
    };
    (after != before && combined.is_ok()).then_some(changed)
}
