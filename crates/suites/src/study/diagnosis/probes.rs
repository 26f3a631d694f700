//! Probes: single changes of the problem, the levels or the method.
//!
//! Any solver can run changes of the problem and of the levels. Changes of a method apply only to
//! methods of this crate.

use crate::mpm::input::MpmMethod;
use crate::mpm::{
    BasisName, FrameName, MassName, SchemeName, TransferName, combine, combine_across,
};
use crate::study::preflight::alignment::is_aligned;
use crate::subject::Start;
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Against, Case, ConvergencePlan, SameMethod};
use crate::verify::Axis;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Crossings {
    None,
    /// Some particles change their cell, or the solver does not report cell changes.
    Some,
}

pub(crate) struct ProbeKind {
    pub(crate) change: &'static str,
    /// Cause that is inferred if the change restores or raises the order, or reduces the error.
    pub(crate) cause: fn(&Case, Crossings) -> &'static str,
    pub(crate) remedy: &'static str,
    pub(crate) apply: fn(&ConvergencePlan) -> Option<ConvergencePlan>,
}

/// Reduces the amplitude. The suite is compiled again, so `apply` is not used.
pub(super) const AMPLITUDE: ProbeKind = ProbeKind {
    change: "a tenth of the amplitude",
    cause: |_, _| {
        "an error proportional to the strain, which no grid reduces: the exact solution assumes \
         small strains, or a large motion changes the positions of particles in their cells"
    },
    remedy: "a smaller amplitude, or an exact solution of the finite-strain equations",
    apply: |_| None,
};

pub(super) const REFERENCE: ProbeKind = ProbeKind {
    change: "the reference in place of the formula",
    cause: |_, _| "the exact formula solves a different model than the method",
    remedy: "compare the method with a solution of its own model",
    apply: |plan| {
        let has_both = plan.reference.is_some() && plan.cases[0].against == Against::Exact;
        has_both.then(|| compared_with(plan, Against::Reference))
    },
};

pub(super) const FORMULA: ProbeKind = ProbeKind {
    change: "the formula in place of the reference",
    cause: |_, _| "the reference solves a different model than the method",
    remedy: "compare the method with a solution of its own model",
    apply: |plan| {
        let has_both = plan.has_formulas() && plan.cases[0].against == Against::Reference;
        has_both.then(|| compared_with(plan, Against::Exact))
    },
};

pub(super) const ALIGNMENT: ProbeKind = ProbeKind {
    change: "grid lines on every interface and loaded face",
    cause: |_, _| "an interface or a loaded face lies inside a cell, which smears the solution",
    remedy: "numbers of cells with grid lines on the interface or the loaded face",
    apply: |plan| {
        let aligned = |h: f64| is_aligned(&plan.scene, h);
        let levels = &plan.refine.levels;
        (!levels.iter().all(|level| aligned(level.h))).then_some(())?;
        changed_levels(plan, |level| {
            let with = |cells: u64| {
                let share = level.cells as f64 / cells as f64;
                LevelPlan { cells, h: share * level.h, dt: share * level.dt, ..level }
            };
            (level.cells..3 * level.cells).map(with).find(|level| aligned(level.h))
        })
    },
};

pub(super) const PARTICLES: ProbeKind = ProbeKind {
    change: "twice as many particles along each axis of a cell",
    cause: |_, _| "too few particles per cell: the particles are the quadrature points",
    remedy: "more particles per cell",
    apply: |plan| {
        let dimension = plan.scene.dimension();
        (plan.refine.axis != Axis::Particles).then_some(())?;
        changed_levels(plan, |level| level.halved(Axis::Particles, dimension))
    },
};

pub(super) const DURATION: ProbeKind = ProbeKind {
    change: "twice the duration of the run",
    cause: |_, _| "the body has not come to rest at the end of the run",
    remedy: "a longer run, or damping nearer to the critical one",
    apply: |plan| {
        plan.exact.as_ref().filter(|exact| exact.at_rest)?;
        let mut plan = plan.clone();
        plan.cases.iter_mut().for_each(|case| case.until *= 2.0);
        Some(plan)
    },
};

pub(super) const STEP: ProbeKind = ProbeKind {
    change: "a quarter of the time step",
    cause: |_, _| "the error of the time step",
    remedy: "shorter steps, or steps that follow h",
    apply: |plan| {
        (plan.refine.axis != Axis::Time).then_some(())?;
        let mut plan = changed_levels(plan, |mut level| {
            level.dt *= 0.25;
            Some(level)
        })?;
        plan.refine.rule = plan.refine.rule.map(|share| 0.25 * share);
        Some(plan)
    },
};

pub(super) const CELLS: ProbeKind = ProbeKind {
    change: "cells of half the size",
    cause: |_, _| "the cell size: the levels are too coarse",
    remedy: "finer levels",
    apply: |plan| {
        let is_of_space = plan.refine.axis == Axis::Space;
        let dimension = plan.scene.dimension();
        changed_levels(plan, |level| {
            let finer = level.halved(Axis::Space, dimension)?;
            if is_of_space { finer.halved(Axis::Time, dimension) } else { Some(finer) }
        })
    },
};

fn compared_with(plan: &ConvergencePlan, against: Against) -> ConvergencePlan {
    let mut plan = plan.clone();
    plan.cases.iter_mut().for_each(|case| case.against = against);
    plan
}

fn changed_levels(
    plan: &ConvergencePlan,
    change: impl Fn(LevelPlan) -> Option<LevelPlan>,
) -> Option<ConvergencePlan> {
    let mut plan = plan.clone();
    let fine = plan.cases.iter_mut().filter_map(|case| match &mut case.against {
        Against::SameMethod(SameMethod::FineGrid(level)) => Some(level),
        _ => None,
    });
    for level in plan.refine.levels.iter_mut().chain(fine) {
        *level = change(*level)?;
        level.too_large(&plan.scene).is_none().then_some(())?;
    }
    Some(plan)
}

pub(super) const START: ProbeKind = ProbeKind {
    change: "`start: half_step_back`",
    cause: |_, _| "the start: v(0) is used as v(-dt/2), which is an error of first order in time",
    remedy: "`start: half_step_back`",
    apply: |plan| {
        with_method(plan, |method| match method {
            Method::Mpm(MpmMethod { start, .. }) | Method::Fem { start, .. } => {
                *start = Start::HalfStepBack;
            }
            _ => {}
        })
    },
};

pub(super) const SCHEME: ProbeKind = ProbeKind {
    change: "`scheme: musl`",
    cause: |_, _| "the scheme: USF updates the stress half a step late, an error of first order in time",
    remedy: "`scheme: musl` or `usl`, or shorter steps",
    apply: |plan| {
        with_mpm(plan, |method| {
            if method.scheme == SchemeName::Usf {
                method.scheme = SchemeName::Musl;
            }
        })
    },
};

pub(super) const DOMAINS: ProbeKind = ProbeKind {
    change: "`basis: cpgimp`",
    cause: |_, _| {
        "domains of fixed width: they separate where the body is stretched and overlap where it is \
         compressed, which is an error proportional to the strain"
    },
    remedy: "`basis: cpgimp`, whose domains follow the deformation",
    apply: |plan| {
        with_mpm(plan, |method| {
            if method.basis == BasisName::UniformGimp {
                method.basis = BasisName::ContiguousGimp;
            }
        })
    },
};

pub(super) const GRADIENTS: ProbeKind = ProbeKind {
    change: "`transfer: apic`",
    cause: |_, _| {
        "the velocity gradients at walls: `mls` fits them to the nodes around a particle, and next to \
         a held face its error is of first order"
    },
    remedy: "`transfer: apic`, which takes its gradients from the basis",
    apply: |plan| {
        let has_walls = plan.scene.faces.iter().any(|face| face.hold.is_held());
        with_mpm(plan, |method| {
            if has_walls && method.transfer == TransferName::Mls.into() {
                method.transfer = TransferName::Apic.into();
            }
        })
    },
};

pub(super) const MASS: ProbeKind = ProbeKind {
    change: "the consistent mass matrix",
    cause: |_, _| "lumping: row sums are inexact for an acceleration that varies in space",
    remedy: "`mass: consistent`",
    apply: |plan| {
        let walls = plan.scene.faces.iter();
        let mut refuses = walls.filter_map(|face| face.hold.kind().against_consistent_mass);
        (refuses.next().is_none()).then_some(())?;
        with_mpm(plan, |method| method.mass = MassName::Consistent)
    },
};

pub(super) const FRAME: ProbeKind = ProbeKind {
    change: "`frame: total_lagrangian`",
    cause: |case, crossings| match case.method {
        _ if crossings == Crossings::None => {
            "the motion itself, although no particle changes its cell: the grid does not follow the \
             motion, and an exact solution for small strains neglects the motion"
        }
        Method::Mpm(MpmMethod { basis: BasisName::Linear, .. }) => {
            "grid crossing: the nodal forces of linear functions jump whenever a particle changes \
             its cell"
        }
        _ => {
            "the motion carries particles away from their initial positions in the cells, so the \
             quadrature is less accurate than at the start"
        }
    },
    remedy: "`frame: total_lagrangian`, a smoother basis, or a smaller motion",
    apply: |plan| with_mpm(plan, |method| method.frame = FrameName::Total),
};

pub(super) const SMOOTH_BASIS: ProbeKind = ProbeKind {
    change: "`basis: quadratic_bspline`",
    cause: |_, crossings| match crossings {
        Crossings::None => "linear functions: their gradients jump from cell to cell",
        Crossings::Some => "grid crossing: the gradients of linear functions jump",
    },
    remedy: "a basis with continuous gradients",
    apply: |plan| {
        with_mpm(plan, |method| {
            if method.basis == BasisName::Linear {
                method.basis = BasisName::QuadraticBSpline;
            }
        })
    },
};

fn with_method(plan: &ConvergencePlan, change: impl Fn(&mut Method)) -> Option<ConvergencePlan> {
    let mut changed = plan.clone();
    changed.cases.iter_mut().for_each(|case| change(&mut case.method));
    let (before, after) = (plan.cases[0].method, changed.cases[0].method);
    let combined = match after {
        Method::Mpm(MpmMethod { basis, transfer, mass, frame, .. }) => {
            combine(basis, transfer, mass, frame)
                .and_then(|()| combine_across(plan.scene.plane, basis, transfer))
        }
        _ => Ok(()),
    };
    (after != before && combined.is_ok()).then_some(changed)
}

fn with_mpm(plan: &ConvergencePlan, change: impl Fn(&mut MpmMethod)) -> Option<ConvergencePlan> {
    with_method(plan, |method| {
        if let Method::Mpm(method) = method {
            change(method);
        }
    })
}
